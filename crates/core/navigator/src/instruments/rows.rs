//! Velocities over ground, each with what the air data say of its time.

use nalgebra::Vector2;

use super::problem::FitProblem;
use super::slip::Slip;

/// Times about that of a velocity over ground at which the air data are read for it, seconds: receivers tell means,
/// and noise is less.
const AVERAGED: [f64; 5] = [-0.1, -0.05, 0.0, 0.05, 0.1];

/// Time after which a nose wags otherwise, seconds: airplanes of some metres yaw faster, and turn slower.
const BESIDE: f64 = 2.0;

/// Velocity with what the air data say of it.
#[derive(Clone, Copy)]
pub(super) struct AirDataRow {
    /// When it was true, seconds.
    pub(super) time: f64,
    /// Velocity over ground (north, east), m/s.
    pub(super) ground: Vector2<f64>,
    /// Horizontal air velocity as read, m/s.
    pub(super) air: Vector2<f64>,
    /// Horizontal part of the nose's direction.
    pub(super) nose: Vector2<f64>,
    /// The same as it was a while before and will be a while after: its noise is another.
    pub(super) nose_beside: Vector2<f64>,
    /// Airspeed as read, m/s.
    pub(super) airspeed: f64,
    /// Slip by its side force.
    pub(super) slip: Slip,
}

/// The rows of a problem when airspeed and velocity come so many seconds late.
pub(super) fn rows(
    problem: &FitProblem<'_>,
    airspeed_delay: f64,
    gps_delay: f64,
) -> Vec<AirDataRow> {
    let share = 1.0 / AVERAGED.len() as f64;
    let row = |(stamp, ground): (f64, Vector2<f64>)| {
        let mut row = AirDataRow {
            time: stamp - gps_delay,
            ground,
            air: Vector2::zeros(),
            nose: Vector2::zeros(),
            nose_beside: Vector2::zeros(),
            airspeed: 0.0,
            slip: Slip::default(),
        };
        for part in AVERAGED {
            let there = row.time + part;
            let nose = problem.nose.at(there)?;
            let airspeed = problem.airspeed.at(there + airspeed_delay)?;
            row.air += nose * airspeed * share;
            row.nose += nose * share;
            row.airspeed += airspeed * share;
            let slip = problem.side_force.slip(there, &nose, airspeed);
            row.slip.per_length += slip.per_length * share;
            row.slip.per_offset += slip.per_offset * share;
        }
        let beside = [-BESIDE, BESIDE].map(|part| problem.nose.at(row.time + part));
        row.nose_beside = match beside {
            [Some(before), Some(after)] => 0.5 * (before + after),
            [one, other] => one.or(other).unwrap_or(row.nose),
        };
        Some(row)
    };
    let (from, to) = problem.span;
    let velocities = problem.velocities.between(from, to);
    velocities.filter_map(row).collect()
}
