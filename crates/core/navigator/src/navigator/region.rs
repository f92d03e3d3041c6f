//! The region manager: which landmarks can be in view, given position, covariance, attitude and camera.
//!
//! DeAngelo 2016, chapter 2, asks for landmarks within a distance of the estimate. Here the distance
//! follows from the picture: a landmark is looked for if its whole box may lie in the picture at some
//! place within the search region.

use nalgebra::{Matrix2, Point2, Point3, Vector2};

use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_vision::landmark::Landmark;

/// Standard deviations by which the expected place may be off.
const REACH: f64 = 3.0;

/// Metres from below the camera beyond which a landmark need not be looked at more closely: the furthest
/// corner of the picture and what the position (covariance `spread`, m²) may be off.
///
/// Infinite where a corner shows no ground.
pub fn reach(camera: &CameraModel, pose: &Pose, ground_down: f64, spread: &Matrix2<f64>) -> f64 {
    let (w, h) = (camera.width as f64, camera.height as f64);
    let below = GroundPoint::from(pose.position_in_world.xy().coords);
    let corners = [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)].map(|(x, y)| {
        let seen = camera.ground_at(pose, &Point2::new(x, y), ground_down);
        seen.map_or(f64::INFINITY, |ground| ground.distance(&below))
    });
    let deviation = spread.trace().max(0.0).sqrt();
    // The noise of the pose adds a little to what the position may be off.
    let height = (ground_down - pose.position_in_world.z).abs();
    corners.into_iter().fold(0.0, f64::max) + 2.0 * REACH * deviation + height
}

/// Whether `landmark`, expected where a camera at `pose` sees it or `moved` (pixels) from there, with
/// innovation covariance `covariance` (pixels²), may lie wholly in the picture.
pub fn may_be_in_view(
    camera: &CameraModel,
    pose: &Pose,
    landmark: &Landmark,
    ground_down: f64,
    moved: &Vector2<f64>,
    covariance: &Matrix2<f64>,
) -> bool {
    let b = landmark.bounds;
    let corners = [
        (b.north, b.west),
        (b.north, b.east),
        (b.south, b.east),
        (b.south, b.west),
    ];
    let mut low = Point2::new(f64::INFINITY, f64::INFINITY);
    let mut high = Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
    for (north, east) in corners {
        let Some(pixel) = camera.project(pose, &Point3::new(north, east, ground_down)) else {
            return false;
        };
        let pixel = pixel + moved;
        low = Point2::new(low.x.min(pixel.x), low.y.min(pixel.y));
        high = Point2::new(high.x.max(pixel.x), high.y.max(pixel.y));
    }
    let reach_x = REACH * covariance[(0, 0)].max(0.0).sqrt();
    let reach_y = REACH * covariance[(1, 1)].max(0.0).sqrt();
    let fits = |low: f64, high: f64, size: f64, reach: f64| {
        high - low <= size && low + reach >= 0.0 && high - reach <= size
    };
    fits(low.x, high.x, camera.width as f64, reach_x)
        && fits(low.y, high.y, camera.height as f64, reach_y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::{Attitude, GroundPoint, GroundRect};

    fn seen(north: f64, sigma_pixels: f64) -> bool {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let pose = Pose {
            position_in_world: Point3::new(0.0, 0.0, -100.0),
            attitude: Attitude::level(0.0),
        };
        let bounds = GroundRect::centered(GroundPoint::new(north, 0.0), 20.0, 20.0);
        let covariance = Matrix2::identity() * (sigma_pixels * sigma_pixels);
        may_be_in_view(
            &camera,
            &pose,
            &Landmark::new(1, "barn", bounds),
            0.0,
            &Vector2::zeros(),
            &covariance,
        )
    }

    #[test]
    fn a_landmark_below_is_looked_for_and_one_far_ahead_is_not() {
        assert!(seen(0.0, 5.0));
        assert!(!seen(150.0, 5.0));
    }

    #[test]
    fn an_uncertain_position_widens_the_region() {
        assert!(!seen(70.0, 5.0));
        assert!(seen(70.0, 80.0));
    }
}
