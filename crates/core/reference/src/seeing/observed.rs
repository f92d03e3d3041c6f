//! Landmarks of a picture and of the table as the association takes them.

use nalgebra::{Matrix2, Matrix2x4, Point3, Vector2};

use super::precision::{detection, place_deviation};
use crate::GenericLandmark;
use crate::association::{ObservedLandmark, PossibleLandmark};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_raster::camera::CameraModel;

/// A landmark that was seen on the ground by the assumed `pose`; `None` where the camera does not look there.
pub fn observed(
    landmark: &GenericLandmark,
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
) -> Option<ObservedLandmark> {
    Some(ObservedLandmark {
        class: landmark.class,
        place: landmark.place.to_vector() - pose.position_in_world.xy().coords,
        covariance: Matrix2::identity() * place_deviation(landmark).powi(2),
        size: landmark.size,
        by_pose: ground_by_pose(landmark.place, camera, pose, ground_down)?,
    })
}

/// A landmark of the table, around the place `below` where the aircraft is believed to be. All that its place errs is
/// in what is observed: that was measured against the map.
pub fn possible(landmark: &GenericLandmark, below: GroundPoint) -> PossibleLandmark {
    PossibleLandmark {
        class: landmark.class,
        place: landmark.place.to_vector() - below.to_vector(),
        covariance: Matrix2::zeros(),
        size: landmark.size,
        detection: detection(landmark),
    }
}

/// Change of the ground seen at the pixel of `place` with the assumed roll, pitch, yaw (radians) and height (metres).
///
/// ```
/// use nalgebra::Point3;
/// use pilotage_base::frames::{Attitude, GroundPoint, Pose};
/// use pilotage_raster::camera::CameraModel;
/// use pilotage_reference::seeing::ground_by_pose;
///
/// let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
/// let pose = Pose { position_in_world: Point3::new(0.0, 0.0, -300.0), attitude: Attitude::level(0.0) };
/// let moved = ground_by_pose(GroundPoint::new(0.0, 30.0), &camera, &pose, 0.0).ok_or("out of sight")?;
/// // Nose up by a radian: 300 m ahead. Turned by a radian: 30 m south. Higher by a metre: 30 m / 300 m outward.
/// let told = [moved[(0, 1)], moved[(0, 2)], moved[(1, 3)]];
/// assert!(told.iter().zip([300.0, -30.0, 0.1]).all(|(told, known)| (told - known).abs() < 0.01));
/// # Ok::<(), &str>(())
/// ```
pub fn ground_by_pose(
    place: GroundPoint,
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
) -> Option<Matrix2x4<f64>> {
    let point = Point3::new(place.north, place.east, ground_down);
    let pixel = camera.project(pose, &point)?;
    let moved = |axis: usize, step: f64| -> Option<Vector2<f64>> {
        let mut moved = *pose;
        match axis {
            0 => moved.attitude.roll += step,
            1 => moved.attitude.pitch += step,
            2 => moved.attitude.yaw += step,
            _ => moved.position_in_world.z -= step,
        }
        let ground = camera.ground_at(&moved, &pixel, ground_down);
        ground.map(GroundPoint::to_vector)
    };
    let mut jacobian = Matrix2x4::zeros();
    for (axis, step) in [1e-4, 1e-4, 1e-4, 1e-2].into_iter().enumerate() {
        let difference = (moved(axis, step)? - moved(axis, -step)?) / (2.0 * step);
        jacobian.set_column(axis, &difference);
    }
    Some(jacobian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GenericClass;
    use pilotage_base::frames::Attitude;

    #[test]
    fn errors_of_the_attitude_move_the_ground_by_the_height_and_those_of_the_heading_turn_it() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let pose = Pose {
            position_in_world: Point3::new(50.0, -20.0, -300.0),
            attitude: Attitude::level(0.0),
        };
        let barn = GenericLandmark {
            place: GroundPoint::new(50.0, 10.0),
            class: GenericClass::Building,
            size: 12.0,
            orientation: 0.0,
            confidence: 1.0,
            stability: 1.0,
        };
        let seen = observed(&barn, &camera, &pose, 0.0).unwrap();
        assert!((seen.place - Vector2::new(0.0, 30.0)).norm() < 1e-9);
        let j = seen.by_pose;
        // The right wing down looks west of what is below, by the height and a little more; nose up looks ahead.
        assert!((j[(1, 0)] + 303.0).abs() < 0.1, "{j}");
        assert!((j[(0, 1)] - 300.0).abs() < 0.1, "{j}");
        assert!(
            (j[(0, 2)] + 30.0).abs() < 0.01 && j[(1, 2)].abs() < 0.01,
            "{j}"
        );
        assert!((j[(1, 3)] - 0.1).abs() < 1e-6, "{j}");
    }
}
