//! Agreement of a prediction with flights: whether it holds, as far as they can tell.

use serde::Serialize;

use super::prediction_calibration::Verification;

/// Least flights of which something is said about the prediction.
const ENOUGH_FLIGHTS: usize = 5;
/// Share of positions that the corridor is to hold.
const STATED: f64 = 0.95;
/// Standard deviations by which a share differs for certain.
const CERTAIN: f64 = 2.0;

/// Agreement of a prediction with flights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
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
    /// Sentence on the meaning of it for whoever flies the route.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Open => "Too few flights to say whether the prediction holds.",
            Self::Holds => "The prediction holds.",
            Self::TooGood => {
                "The prediction is too good for this route: keep more room than its corridor."
            }
            Self::TooBad => "The errors are smaller than predicted.",
        }
    }
}

impl Verification {
    /// Agreement of the prediction with the flights, by the share of positions inside the corridor and its standard
    /// deviation over flights.
    pub fn agreement(&self) -> PredictionAgreement {
        // With no flight outside, the deviation is 0; one in all flights would be the next to be seen.
        let least = 0.05 / self.flights.max(1) as f64;
        let deviation = self.corridor_uncertainty.max(least);
        match (self.inside_corridor - STATED) / deviation {
            _ if self.flights < ENOUGH_FLIGHTS => PredictionAgreement::Open,
            off if off < -CERTAIN => PredictionAgreement::TooGood,
            off if off > CERTAIN => PredictionAgreement::TooBad,
            _ => PredictionAgreement::Holds,
        }
    }

    /// Two standard deviations of the share of positions inside the corridor; `None` where flights are too few to
    /// tell.
    pub fn corridor_margin(&self) -> Option<f64> {
        (self.flights >= ENOUGH_FLIGHTS).then_some(CERTAIN * self.corridor_uncertainty)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flown(flights: usize, share: f64, deviation: f64) -> Verification {
        Verification {
            flights,
            inside_corridor: share,
            corridor_uncertainty: deviation,
            ..Verification::default()
        }
    }

    #[test]
    fn a_prediction_is_judged_only_by_enough_flights_and_beyond_their_scatter() {
        let judged = |flights, share, deviation| flown(flights, share, deviation).agreement();
        assert_eq!(judged(4, 0.2, 0.01), PredictionAgreement::Open);
        assert_eq!(judged(20, 0.93, 0.02), PredictionAgreement::Holds);
        assert_eq!(judged(20, 0.80, 0.04), PredictionAgreement::TooGood);
        assert_eq!(judged(20, 0.999, 0.001), PredictionAgreement::TooBad);
        assert_eq!(judged(5, 1.0, 0.0), PredictionAgreement::TooBad);
        assert_eq!(judged(20, 0.90, 0.04), PredictionAgreement::Holds);
    }

    #[test]
    fn a_margin_is_told_where_flights_are_judged() {
        assert_eq!(flown(4, 0.9, 0.03).corridor_margin(), None);
        assert_eq!(flown(5, 0.9, 0.03).corridor_margin(), Some(0.06));
    }
}
