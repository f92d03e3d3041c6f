//! Result of a rehearsal in sentences.

use super::flights::RouteRehearsal;
use crate::plan::words::distance_text;
use crate::units::Units;

/// Least flights of which something is said about the prediction.
const ENOUGH_FLIGHTS: usize = 5;
/// Share of positions that the corridor is to hold.
const STATED: f64 = 0.95;
/// Standard deviations by which a share differs for certain.
const CERTAIN: f64 = 2.0;

/// Agreement of a prediction with flights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PredictionAgreement {
    /// Too few flights to say.
    Open,
    /// The errors agree with it.
    Holds,
    /// The errors are larger.
    TooGood,
    /// The errors are smaller.
    TooBad,
}

impl PredictionAgreement {
    /// Judged by the share of positions inside the corridor, and its standard deviation over flights.
    fn of(flights: usize, share: f64, deviation: f64) -> Self {
        // With no flight outside, the deviation is 0; one in all flights would be the next to be seen.
        let deviation = deviation.max(0.05 / flights.max(1) as f64);
        match (share - STATED) / deviation {
            _ if flights < ENOUGH_FLIGHTS => Self::Open,
            off if off < -CERTAIN => Self::TooGood,
            off if off > CERTAIN => Self::TooBad,
            _ => Self::Holds,
        }
    }
}

impl RouteRehearsal {
    /// Agreement of the prediction with what was flown.
    pub fn agreement(&self) -> PredictionAgreement {
        let all = self.summary();
        PredictionAgreement::of(all.flights, all.inside_corridor, all.corridor_uncertainty)
    }

    /// Result in sentences.
    pub fn sentences(&self, units: Units) -> Vec<String> {
        let (Some(worst), Some(preferences)) = (self.worst(), self.preferences()) else {
            return Vec::new();
        };
        let all = self.summary();
        let (factor, unit) = units.length();
        let count = match all.flights {
            1 => "1 flight".to_owned(),
            count => format!("{count} flights"),
        };
        let how = if preferences.pictures {
            "with pictures of other days"
        } else {
            "without pictures, landmarks found as predicted"
        };
        let range = if all.flights < ENOUGH_FLIGHTS {
            String::new()
        } else {
            format!(" ± {:.0}", 100.0 * CERTAIN * all.corridor_uncertainty)
        };
        let share = 100.0 * all.inside_corridor;
        let mut sentences = vec![
            format!("{count}, {how}: {share:.0}{range} % of positions inside the 95 % corridor."),
            format!(
                "True error {:.1} {unit} RMS where {:.1} {unit} are predicted; at most {:.1} {unit}, {} along.",
                all.rms_m * factor,
                all.predicted_rms_m * factor,
                worst.worst.0 * factor,
                distance_text(worst.worst.1, units),
            ),
        ];
        sentences.extend(match self.agreement() {
            PredictionAgreement::Open | PredictionAgreement::Holds => None,
            PredictionAgreement::TooGood => Some(
                "The prediction is too good for this route: keep more room than its corridor."
                    .to_owned(),
            ),
            PredictionAgreement::TooBad => {
                Some("The errors are smaller than predicted.".to_owned())
            }
        });
        sentences
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prediction_is_judged_only_by_enough_flights_and_beyond_their_scatter() {
        assert_eq!(
            PredictionAgreement::of(4, 0.2, 0.01),
            PredictionAgreement::Open
        );
        assert_eq!(
            PredictionAgreement::of(20, 0.93, 0.02),
            PredictionAgreement::Holds
        );
        assert_eq!(
            PredictionAgreement::of(20, 0.80, 0.04),
            PredictionAgreement::TooGood
        );
        assert_eq!(
            PredictionAgreement::of(20, 0.999, 0.001),
            PredictionAgreement::TooBad
        );
        assert_eq!(
            PredictionAgreement::of(5, 1.0, 0.0),
            PredictionAgreement::TooBad
        );
        assert_eq!(
            PredictionAgreement::of(20, 0.90, 0.04),
            PredictionAgreement::Holds
        );
    }
}
