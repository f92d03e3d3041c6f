//! Data and priors of a fit.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::series::Series;
use super::slip::SideForce;

/// Prior of the unknowns before any measurement, standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitPrior {
    /// Airspeed scale about 1.
    pub scale: f64,
    /// Heading offset about zero, radians.
    pub heading: f64,
    /// Heading drift about zero, rad/s; zero for a heading that does not drift.
    pub drift: f64,
    /// Wind per axis, m/s.
    pub wind: f64,
    /// Length of the sideslip about zero, m.
    pub slip_length: f64,
    /// Offset of the sideslip about zero, m²/s².
    pub slip_offset: f64,
}

/// Data and prior of a fit.
pub(super) struct FitProblem<'a> {
    /// Velocities over ground, m/s.
    pub(super) velocities: &'a Series<Vector2<f64>>,
    /// Airspeed as read, m/s.
    pub(super) airspeed: &'a Series,
    /// Horizontal part of the nose's direction.
    pub(super) nose: &'a Series<Vector2<f64>>,
    /// Side force; may be empty.
    pub(super) side_force: &'a SideForce,
    /// Stretch of the velocities, seconds.
    pub(super) span: (f64, f64),
    /// Time for which the error is remembered when new is told from old, seconds.
    pub(super) memory: f64,
    /// Priors.
    pub(super) prior: FitPrior,
}
