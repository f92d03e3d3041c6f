//! Places at which one frame may lie, and the region within which it was looked for.

use nalgebra::{Matrix2, Vector2};

use super::Estimate;
use super::place_on_map::PlaceOnMap;
use super::tilt::LastingTilt;
use pilotage_base::frames::GroundPoint;
use pilotage_vision::registration::{PosePrior, Registration};

/// Within what a frame was looked for, on the map: standard deviation per axis.
#[derive(Clone, Copy, Debug)]
pub struct SearchedRegion {
    pub position: GroundPoint,
    /// Standard deviation, metres.
    pub deviation: f64,
}

impl SearchedRegion {
    /// A circle on the map that holds what is believed.
    pub fn around(believed: &Estimate, on_map: &PlaceOnMap) -> Self {
        let along = on_map.covariance(believed).symmetric_eigenvalues();
        Self {
            position: GroundPoint::from(on_map.mean(believed)),
            deviation: along.max().max(0.0).sqrt(),
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
    /// Place of the map's error in it.
    pub on_map: PlaceOnMap,
    pub places: Vec<Registration>,
}

impl FoundPlaces {
    /// Covariance with which a frame told its place on the map, the map's own error apart, m².
    pub fn told(&self, at: &Registration) -> Matrix2<f64> {
        let of_map = Matrix2::identity() * self.prior.map_deviation.powi(2);
        at.camera.covariance.fixed_view::<2, 2>(0, 0) - of_map
    }

    /// Density with which a place was expected where it was looked for, 1/m².
    pub fn density_searched(&self, at: &Registration) -> f64 {
        let region = Matrix2::from_diagonal_element(self.searched.deviation.powi(2));
        density(
            &self.searched.position.to_vector(),
            &(region + self.told(at)),
            at,
        )
    }

    /// Density with which a filter expects a place that believes so, 1/m².
    pub fn density_believed(&self, believed: &Estimate, at: &Registration) -> f64 {
        let by_tilt = &at.camera.by_tilt;
        let (mean, covariance) =
            self.tilt
                .place((believed, &self.on_map), by_tilt, self.tilt_biases);
        density(&mean, &(covariance + self.told(at)), at)
    }
}

/// Density of a place around `mean` with `covariance`, 1/m².
fn density(mean: &Vector2<f64>, covariance: &Matrix2<f64>, at: &Registration) -> f64 {
    let place = at.camera.pose.position_in_world.xy().coords;
    let off = place - mean;
    let Some(information) = covariance.try_inverse() else {
        return 0.0;
    };
    let squared = (off.transpose() * information * off)[0];
    (-0.5 * squared).exp() / (std::f64::consts::TAU * covariance.determinant().sqrt())
}
