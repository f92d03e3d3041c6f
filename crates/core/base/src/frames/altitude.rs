//! Altitudes that say what they count from.

use serde::{Deserialize, Serialize};

/// Reference that an altitude counts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum AltitudeFrame {
    /// Above mean sea level.
    Amsl,
    /// Above the place of take-off.
    AboveTakeOff,
    /// Above the ground straight below.
    AboveGround,
}

/// An altitude and what it counts from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Altitude {
    /// Metres.
    pub metres: f64,
    /// Reference that the metres count from.
    pub frame: AltitudeFrame,
}

/// Reference heights that turn one altitude into another at a place: heights above mean sea level, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AltitudeReference {
    /// Height of the place of take-off, metres above mean sea level.
    pub take_off: f64,
    /// Height of the ground straight below, metres above mean sea level.
    pub ground: f64,
}

impl AltitudeFrame {
    /// All frames, in the order in which people are offered them.
    pub const ALL: [Self; 3] = [Self::AboveTakeOff, Self::AboveGround, Self::Amsl];

    /// Name for people, to stand behind a number.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Amsl => "AMSL",
            Self::AboveTakeOff => "above take-off",
            Self::AboveGround => "above ground",
        }
    }
}

impl Altitude {
    /// The altitude `metres` in `frame`.
    ///
    /// ```
    /// use pilotage_base::frames::{Altitude, AltitudeFrame, AltitudeReference};
    ///
    /// // 120 m above a field at 300 m, over a hill of 350 m.
    /// let altitude = Altitude::new(120.0, AltitudeFrame::AboveTakeOff);
    /// let reference = AltitudeReference { take_off: 300.0, ground: 350.0 };
    /// assert_eq!(altitude.amsl(&reference), 420.0);
    /// let above_hill = altitude.counted_from(AltitudeFrame::AboveGround, &reference);
    /// assert_eq!(above_hill.metres, 70.0);
    /// ```
    pub const fn new(metres: f64, frame: AltitudeFrame) -> Self {
        Self { metres, frame }
    }

    /// Metres above mean sea level.
    pub fn amsl(&self, reference: &AltitudeReference) -> f64 {
        self.metres + reference.zero_of(self.frame)
    }

    /// The same height counted from something else at the same place.
    #[must_use]
    pub fn counted_from(&self, frame: AltitudeFrame, reference: &AltitudeReference) -> Self {
        Self {
            metres: self.amsl(reference) - reference.zero_of(frame),
            frame,
        }
    }
}

impl std::fmt::Display for Altitude {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.0} m {}", self.metres, self.frame.name())
    }
}

impl AltitudeReference {
    /// Height above mean sea level at which `frame` counts zero, metres.
    fn zero_of(&self, frame: AltitudeFrame) -> f64 {
        match frame {
            AltitudeFrame::Amsl => 0.0,
            AltitudeFrame::AboveTakeOff => self.take_off,
            AltitudeFrame::AboveGround => self.ground,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn over_a_hill_the_height_above_ground_is_less_than_above_take_off() {
        let reference = AltitudeReference {
            take_off: 200.0,
            ground: 260.0,
        };
        let altitude = Altitude::new(120.0, AltitudeFrame::AboveTakeOff);
        let above_ground = altitude.counted_from(AltitudeFrame::AboveGround, &reference);
        assert_eq!(
            above_ground,
            Altitude::new(60.0, AltitudeFrame::AboveGround)
        );
        assert_eq!(altitude.amsl(&reference), 320.0);
        assert_eq!(above_ground.to_string(), "60 m above ground");
    }

    proptest! {
        #[test]
        fn an_altitude_survives_the_way_through_any_frames(
            metres in -500.0_f64..9000.0,
            take_off in -400.0_f64..6000.0,
            ground in -400.0_f64..8000.0,
        ) {
            let reference = AltitudeReference { take_off, ground };
            for from in AltitudeFrame::ALL {
                for through in AltitudeFrame::ALL {
                    let altitude = Altitude::new(metres, from);
                    let back = altitude
                        .counted_from(through, &reference)
                        .counted_from(from, &reference);
                    prop_assert!((back.metres - metres).abs() < 1e-9);
                }
            }
        }
    }
}
