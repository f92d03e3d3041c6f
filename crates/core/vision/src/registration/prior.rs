//! Prior of a camera's pose before its picture is laid on the map.

use std::f64::consts::{FRAC_PI_2, PI};

use super::MapShape;
use super::limits::REACH;
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, wrap_pi};

/// Least standard deviation of what is known, metres, radians, or of a logarithm: what is known better is held.
const HELD: f64 = 1e-3;

/// Knowledge of the turn of a stored picture against the mount, beyond one that the camera has already.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StoredTurn {
    /// There is none.
    None,
    /// Any number of quarter turns, one of which is tried first.
    Quarters {
        /// The turn that is tried first, radians clockwise.
        first: f64,
    },
}

/// Prior of the heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HeadingPrior {
    /// Nothing: all around is searched.
    Unknown,
    /// A measured heading.
    Around {
        /// Radians clockwise from north.
        heading: f64,
        /// Standard deviation, radians.
        deviation: f64,
        /// Turn of the stored picture against the mount.
        stored: StoredTurn,
    },
}

impl HeadingPrior {
    /// Headings to try, at most `step` radians apart.
    pub(super) fn candidates(&self, step: f64) -> Vec<f64> {
        match *self {
            Self::Unknown => {
                let count = (std::f64::consts::TAU / step).ceil();
                let spacing = std::f64::consts::TAU / count;
                (0..count as usize)
                    .map(|i| wrap_pi(i as f64 * spacing))
                    .collect()
            }
            Self::Around {
                heading, deviation, ..
            } => spread(REACH * deviation, step)
                .map(|off| wrap_pi(heading + off))
                .collect(),
        }
    }

    /// Farthest from a heading on a grid that others are possible, radians.
    pub(super) fn farthest(&self) -> f64 {
        match *self {
            Self::Unknown => PI,
            Self::Around { deviation, .. } => REACH * deviation,
        }
    }

    /// The heading, radians, if it is held.
    pub(super) fn held(&self) -> Option<f64> {
        match *self {
            Self::Around {
                heading, deviation, ..
            } if deviation < HELD => Some(heading),
            _ => None,
        }
    }

    /// Turns of the stored picture to try, radians clockwise, the one to be tried first before the others.
    pub(super) fn turns(&self) -> Vec<f64> {
        const QUARTERS: [f64; 4] = [0.0, FRAC_PI_2, PI, -FRAC_PI_2];
        match *self {
            Self::Around {
                stored: StoredTurn::Quarters { first },
                ..
            } => {
                let mut turns = QUARTERS.to_vec();
                turns.sort_by_key(|turn| wrap_pi(turn - first).abs() > 0.5 * FRAC_PI_2);
                turns
            }
            _ => vec![0.0],
        }
    }
}

/// Values from -`half` to `half`, evenly and at most `step` apart, zero among them; zero alone where `half` is zero.
pub(super) fn spread(half: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = (half / step).ceil() as i32;
    let spacing = half / f64::from(count.max(1));
    (-count..=count).map(move |i| f64::from(i) * spacing)
}

/// Prior of a camera's pose, as standard deviations around a mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosePrior {
    /// Place below the camera.
    pub position: GroundPoint,
    /// Standard deviation of the place per axis, metres.
    pub position_deviation: f64,
    /// Ground over which the camera is as likely at one place as at another, if that is known instead: position and
    /// deviation then say no more than how far is searched.
    pub anywhere_on: Option<GroundRect>,
    /// Height above the ground plane, metres.
    pub height: f64,
    /// Standard deviation of the height's natural logarithm.
    pub log_height_deviation: f64,
    /// Heading of the body.
    pub heading: HeadingPrior,
    /// Roll of the body, radians.
    pub roll: f64,
    /// Pitch of the body, radians.
    pub pitch: f64,
    /// Standard deviation of roll and of pitch, radians.
    pub tilt_deviation: f64,
    /// Standard deviation of the ground's slope along each axis, radians: to the camera it is a tilt.
    pub slope_deviation: f64,
    /// Stretch of the map.
    pub shape: MapShape,
    /// Standard deviation of both of the shape's numbers.
    pub shape_deviation: f64,
    /// Standard deviation of the map's own place per axis, metres.
    pub map_deviation: f64,
}

impl PosePrior {
    /// Heights to try, metres, at most a factor of exp(`step`) apart.
    pub(super) fn heights(&self, step: f64) -> Vec<f64> {
        spread(REACH * self.log_height_deviation, step)
            .map(|off| self.height * off.exp())
            .collect()
    }

    /// Whether the height is held.
    pub(super) fn holds_height(&self) -> bool {
        self.log_height_deviation < HELD
    }

    /// Standard deviation of the place per axis, metres.
    pub(super) fn place_deviation(&self) -> f64 {
        self.position_deviation.max(HELD)
    }

    /// Standard deviation of the tilt that the camera seems to have against the ground, radians.
    pub(super) fn apparent_tilt_deviation(&self) -> f64 {
        self.tilt_deviation.hypot(self.slope_deviation).max(HELD)
    }

    /// Share of an apparent tilt that is the camera's: the rest is the ground's slope.
    pub(super) fn share_of_tilt(&self) -> f64 {
        (self.tilt_deviation / self.apparent_tilt_deviation()).powi(2)
    }

    /// Natural logarithm of the density of a height and a heading, against that at the mean of each.
    pub(super) fn log_density(&self, height: f64, heading: f64) -> f64 {
        let deviations = |off: f64, deviation: f64| off / deviation.max(HELD);
        let height = deviations((height / self.height).ln(), self.log_height_deviation);
        let heading = match self.heading {
            HeadingPrior::Unknown => 0.0,
            HeadingPrior::Around {
                heading: mean,
                deviation,
                ..
            } => deviations(wrap_pi(heading - mean), deviation),
        };
        -0.5 * (height * height + heading * heading)
    }

    /// Attitude with this heading.
    pub(super) fn attitude(&self, heading: f64) -> Attitude {
        Attitude {
            roll: self.roll,
            pitch: self.pitch,
            yaw: heading,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quarter_turn_is_tried_the_first_one_first() {
        let turns = |stored| {
            let around = HeadingPrior::Around {
                heading: 0.0,
                deviation: 0.1,
                stored,
            };
            around.turns()
        };
        assert_eq!(turns(StoredTurn::None), [0.0]);
        assert_eq!(HeadingPrior::Unknown.turns(), [0.0]);
        for first in [0.0, FRAC_PI_2, PI, -PI, -FRAC_PI_2] {
            let tried = turns(StoredTurn::Quarters { first });
            assert!(wrap_pi(tried[0] - first).abs() < 1e-9, "{first}: {tried:?}");
            let mut all = tried.clone();
            all.sort_by(f64::total_cmp);
            assert_eq!(all, [-FRAC_PI_2, 0.0, FRAC_PI_2, PI]);
        }
    }
}
