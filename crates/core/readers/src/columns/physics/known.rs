//! Knowledge that the columns of a flight are held against.

use super::axes::AxesFit;
use super::board::Id;
use super::grid::{TimeCells, quantile};

/// Slower is at rest, m/s.
const AT_REST: f64 = 1.0;

/// References that the columns are compared with, once they are known; values per cell of the grid, NaN where
/// there is none.
pub(super) struct Known {
    pub grid: TimeCells,
    /// Velocity over ground, m/s north, east, down.
    pub velocity: [Vec<f64>; 3],
    /// Whether that is of the position's own steps.
    pub is_of_track: bool,
    /// Roll, pitch and heading, radians, unwrapped.
    pub attitude: [Vec<f64>; 3],
    /// Their rates, rad/s.
    pub attitude_rates: [Vec<f64>; 3],
    /// Whether heading, pitch and the other axes were found to be those of ROS; `None` where nothing tells.
    pub is_ros: Option<bool>,
    /// Whether the sense of the heading is by evidence.
    pub is_heading_sure: bool,
    /// A velocity that has the amount of the track's, but hardly its direction.
    pub turned: Option<TurnedVelocities>,
}

/// Velocities that have the amount of the track's, but hardly its direction.
pub(super) struct TurnedVelocities {
    pub ids: Vec<Id>,
    /// Best agreement along north and east.
    pub earth: AxesFit,
}

impl Known {
    /// Nothing yet, on this grid.
    pub fn new(grid: TimeCells) -> Self {
        let none = || vec![f64::NAN; grid.count];
        Self {
            velocity: [none(), none(), none()],
            is_of_track: false,
            attitude: [none(), none(), none()],
            attitude_rates: [none(), none(), none()],
            is_ros: None,
            is_heading_sure: false,
            turned: None,
            grid,
        }
    }

    /// Speed over ground per cell, m/s.
    pub fn speed(&self) -> Vec<f64> {
        let [north, east, _] = &self.velocity;
        north.iter().zip(east).map(|(n, e)| n.hypot(*e)).collect()
    }

    /// Speed over ground that it stays below nine tenths of the time that it moves, m/s; 0 where it never does.
    pub fn fast(&self) -> f64 {
        let mut speed = self.speed();
        speed.retain(|speed| *speed > AT_REST);
        quantile(&speed, 0.9).max(0.0)
    }

    /// Course over ground per cell, radians clockwise from north, NaN where it is too slow to have one.
    pub fn course(&self) -> Vec<f64> {
        let speed = self.speed();
        let least = (0.3 * self.fast()).max(AT_REST);
        let [north, east, _] = &self.velocity;
        let course = |index: usize| {
            if speed[index] > least {
                east[index].atan2(north[index])
            } else {
                f64::NAN
            }
        };
        (0..speed.len()).map(course).collect()
    }
}
