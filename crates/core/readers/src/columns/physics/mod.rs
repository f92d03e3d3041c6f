//! Units and axes of columns judged together, by what physics says that they have to do with each other.
//!
//! The position's steps are the reference of speeds, courses and velocities; these that of attitudes; attitude that of
//! gyros and accelerometers, whose reading at rest is gravity; velocity, airspeed and heading that of the wind. What is
//! found so is told; what cannot be is asked.

mod air;
mod angles;
mod attitude;
mod axes;
mod board;
mod body_velocity;
mod grid;
mod heights;
mod inertial;
mod lean;
mod nameless;
mod place;
mod quaternion;
mod questions;
mod ros;
mod unknown;
mod velocity;

use super::ColumnMap;
use super::groups::Group;
use super::rows::Rows;
use super::settle::settle;
use board::Board;
use grid::Grid;

/// What a column's name says for sure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Hint {
    /// Whether the table states its unit.
    pub is_stated: bool,
    /// Whether it is one of several that are called by the letters or numbers of axes, so that nobody knows which.
    pub is_axis: bool,
}

/// What is known of a table besides its map.
#[derive(Debug)]
pub(super) struct Evidence {
    pub rows: Rows,
    pub hints: Vec<Hint>,
    pub groups: Vec<Group>,
}

/// What the columns are held against, once it is known; values per cell of the grid, NaN where there is none.
struct Known {
    grid: Grid,
    /// Velocity over ground, m/s north, east, down.
    velocity: [Vec<f64>; 3],
    /// Whether that is of the position's own steps.
    is_of_track: bool,
    /// Roll, pitch and heading, radians, unwrapped.
    attitude: [Vec<f64>; 3],
    /// Their rates, rad/s.
    attitude_rates: [Vec<f64>; 3],
    /// Whether heading, pitch and the other axes were found to be those of ROS; `None` where nothing tells.
    is_ros: Option<bool>,
    /// Whether the sense of the heading is by evidence.
    is_heading_sure: bool,
    /// A velocity that has the amount of the track's, but hardly its direction.
    turned: Option<velocity::Turned>,
}

/// Judges the tables of one flight, a map each, and writes into the maps what was found.
pub(super) fn judge(maps: &mut [&mut ColumnMap], evidence: &[Evidence]) {
    let mut board = Board::new(maps, evidence);
    let Some(grid) = board.grid() else {
        nameless::tell(&mut board);
        questions::ask(&mut board);
        return;
    };
    let mut known = Known::new(grid);
    nameless::place(&mut board);
    place::judge(&mut board, &mut known);
    unknown::place(&mut board, &known);
    nameless::heights(&mut board, &known);
    velocity::judge(&mut board, &mut known);
    heights::judge(&mut board, &mut known);
    nameless::attitude(&mut board, &known);
    attitude::judge(&mut board, &mut known);
    heights::by_pitch(&mut board, &known);
    body_velocity::judge(&mut board, &known);
    unknown::inertial(&mut board, &known);
    inertial::judge(&mut board, &mut known);
    nameless::airspeed(&mut board, &known);
    air::judge(&mut board, &known);
    // What contradicted the track may have left others alone.
    for map in board.maps.iter_mut() {
        settle(&mut map.columns);
    }
    nameless::tell(&mut board);
    questions::ask(&mut board);
}

impl Known {
    fn new(grid: Grid) -> Self {
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
    fn speed(&self) -> Vec<f64> {
        let [north, east, _] = &self.velocity;
        north.iter().zip(east).map(|(n, e)| n.hypot(*e)).collect()
    }

    /// Course over ground per cell, radians clockwise from north, NaN where it is too slow to have one.
    fn course(&self) -> Vec<f64> {
        let speed = self.speed();
        let least = (0.3 * grid::quantile(&speed, 0.9)).max(1.0);
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
