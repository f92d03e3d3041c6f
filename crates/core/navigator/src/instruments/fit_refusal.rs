//! Results of a fit that cannot be.

use serde::{Deserialize, Serialize};

use super::fit::AirFit;
use super::problem::FitPrior;
use pilotage_flight::{Finding, Severity};

/// Airspeed scales that can be: a pitot tube that shows a third or three times the pressure is none.
const SCALES: (f64, f64) = (0.6, 1.7);
/// Largest length of a sideslip that can be, m: 2m / (ρ S c) with 40 kg/m² of wing and a side force of 0.3 per radian.
const LONGEST_SLIP: f64 = 220.0;
/// Largest steady sideslip that can be, radians.
const WIDEST_SLIP: f64 = 0.35;
/// Fastest wind in which anything flies, m/s.
const FASTEST_WIND: f64 = 60.0;
/// Standard deviations by which a length may fall short of zero.
const SHORT: f64 = 2.0;

/// Result of a fit that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FitRefusal {
    /// An airspeed scale; 1 is taken in its place.
    Scale(f64),
    /// A sideslip with this length (m) and offset (m²/s²); none is taken in its place.
    Slip(f64, f64),
    /// A wind of this speed, m/s; nothing is taken of the fit.
    Wind(f64),
}

impl FitRefusal {
    /// Result that cannot be of a fit at a mean airspeed of `airspeed` m/s, if there is one.
    pub(super) fn of(fit: &AirFit, airspeed: f64) -> Option<Self> {
        let (length, offset) = (fit.slip_length, fit.slip_offset);
        let is_backwards = length < -SHORT * fit.slip_deviation;
        let is_wide = offset.abs() > WIDEST_SLIP * (fit.scale * airspeed).powi(2).max(1.0);
        if fit.wind.norm() > FASTEST_WIND {
            Some(Self::Wind(fit.wind.norm()))
        } else if is_backwards || is_wide || length > LONGEST_SLIP {
            Some(Self::Slip(length, offset))
        } else if !(SCALES.0..=SCALES.1).contains(&fit.scale) {
            Some(Self::Scale(fit.scale))
        } else {
            None
        }
    }

    /// Prior that holds fixed what is refused; `None` if nothing is left of the fit.
    pub(super) fn believed(&self, prior: FitPrior) -> Option<FitPrior> {
        /// A deviation that lets nothing move.
        const FIXED: f64 = 1e-6;
        match self {
            Self::Scale(_) => Some(FitPrior {
                scale: FIXED,
                ..prior
            }),
            Self::Slip(..) => Some(FitPrior {
                slip_length: FIXED,
                slip_offset: FIXED,
                ..prior
            }),
            Self::Wind(_) => None,
        }
    }

    /// In words.
    pub fn finding(&self) -> Finding {
        let (title, text) = match self {
            Self::Scale(scale) => (
                "No airspeed scale fits",
                format!(
                    "The track wants the airspeed multiplied by {scale:.2}, and no pitot tube reads so wrong: it is \
                     taken as it reads. Airspeed, heading or velocity may be in another unit than they are said to be."
                ),
            ),
            Self::Slip(length, offset) => (
                "No sideslip fits",
                format!(
                    "The track wants a sideslip of ({offset:.0} m²/s² - {length:.0} m · side force) / airspeed, and no \
                     airplane slips so: none is reckoned with. The side force may be of another axis or sign."
                ),
            ),
            Self::Wind(speed) => (
                "No wind fits",
                format!(
                    "The track wants a wind of {speed:.0} m/s, in which nothing flies: airspeed and heading are taken \
                     as they read. Airspeed, heading or velocity may be in another unit than they are said to be."
                ),
            ),
        };
        Finding {
            severity: Severity::Warning,
            title: title.to_owned(),
            text,
            span: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::generated::GeneratedPlan;
    use super::super::{CalibrationSettings, HeadingChoice, Instruments};
    use super::*;
    use pilotage_flight::{ChannelName, Flight};

    /// A flight of which one channel is multiplied.
    fn known(name: ChannelName, factor: f64) -> super::super::Calibration {
        let mut flight: Flight = GeneratedPlan {
            duration: 150.0,
            leg: 20.0,
            ..GeneratedPlan::default()
        }
        .fly(1)
        .flight;
        for channel in flight.channels.iter_mut().filter(|c| c.name == name) {
            for value in &mut channel.values {
                *value *= factor;
            }
        }
        let instruments = Instruments::of(&flight, None).unwrap();
        let settings = CalibrationSettings::default();
        instruments.calibrate(instruments.stretch.1, HeadingChoice::Logged, &settings)
    }

    #[test]
    fn an_airspeed_in_knots_is_refused_as_a_scale_and_said() {
        let sound = known(ChannelName::Airspeed, 1.0);
        assert_eq!(sound.refused, None);
        let knots = known(ChannelName::Airspeed, 3.6);
        let refused = knots.refused;
        assert!(
            matches!(refused, Some(FitRefusal::Scale(scale)) if scale < 0.6),
            "{refused:?}"
        );
        let fit = knots.fit.unwrap();
        assert!((fit.scale - 1.0).abs() < 0.01, "{fit:?}");
        let titles: Vec<String> = knots.findings().into_iter().map(|f| f.title).collect();
        assert!(
            titles.contains(&"No airspeed scale fits".to_owned()),
            "{titles:?}"
        );
    }

    #[test]
    fn a_side_force_of_the_other_sign_is_no_sideslip() {
        let turned = known(ChannelName::AccelerationRight, -1.0);
        assert!(
            matches!(turned.refused, Some(FitRefusal::Slip(..))),
            "{:?}",
            turned.refused
        );
        assert!(turned.fit.unwrap().slip_length.abs() < 0.01);
    }
}
