//! Places at which one frame may lie, and the region within which it was looked for.

use nalgebra::{Matrix2, Vector2};

use super::Estimate;
use super::tilt::LastingTilt;
use pilotage_base::frames::GroundPoint;
use pilotage_vision::registration::{PosePrior, Registration};

/// Within what a frame was looked for: standard deviation per axis.
#[derive(Clone, Copy, Debug)]
pub struct SearchedRegion {
    pub position: GroundPoint,
    /// Metres.
    pub deviation: f64,
}

impl SearchedRegion {
    /// Density with which a place of that covariance was expected, 1/m².
    pub fn density(&self, at: &Registration) -> f64 {
        let own = Matrix2::from_diagonal_element(self.deviation.powi(2));
        density(&self.position.to_vector(), &own, at)
    }

    /// A circle that holds what is believed.
    pub fn around(believed: &Estimate) -> Self {
        Self {
            position: believed.position(),
            deviation: believed.greatest_variance().sqrt(),
        }
    }
}

/// Places at which a frame may lie, likeliest first.
#[derive(Clone, Debug)]
pub struct FoundPlaces {
    /// When it was taken, seconds.
    pub time: f64,
    /// Down coordinate of the ground, metres.
    pub ground_down: f64,
    pub searched: SearchedRegion,
    /// Prior with which it was laid.
    pub prior: PosePrior,
    /// Biases of roll and pitch with which it was laid, radians.
    pub tilt_biases: [f64; 2],
    /// Place of these in the state of a filter.
    pub tilt: LastingTilt,
    pub places: Vec<Registration>,
}

/// Density with which a place is expected around `mean` with `covariance`, 1/m².
pub fn density(mean: &Vector2<f64>, covariance: &Matrix2<f64>, at: &Registration) -> f64 {
    let place = at.camera.pose.position_in_world.xy().coords;
    let covariance = covariance + at.camera.covariance.fixed_view::<2, 2>(0, 0);
    let off = place - mean;
    let Some(information) = covariance.try_inverse() else {
        return 0.0;
    };
    let squared = (off.transpose() * information * off)[0];
    (-0.5 * squared).exp() / (std::f64::consts::TAU * covariance.determinant().sqrt())
}
