//! How errors of the camera's pose and of the ground become errors in the picture.

use nalgebra::{DMatrix, Matrix2, Matrix2x4, Matrix4, Point2, Point3, Vector2, Vector4};

use super::SensorNoise;
use crate::camera::CameraModel;
use crate::frames::{GroundPoint, Pose};

/// Change of the pixel of `point` with roll, pitch, yaw (radians) and height (metres): 2 × 4, by
/// central differences; `None` where the point is not in front of the lens.
pub fn pose_jacobian(
    camera: &CameraModel,
    pose: &Pose,
    point: &Point3<f64>,
) -> Option<Matrix2x4<f64>> {
    let moved = |step: Vector4<f64>| {
        let mut pose = *pose;
        pose.attitude.roll += step[0];
        pose.attitude.pitch += step[1];
        pose.attitude.yaw += step[2];
        pose.position_in_world.z -= step[3];
        camera.project(&pose, point)
    };
    let steps = [1e-4, 1e-4, 1e-4, 1e-2];
    let mut jacobian = Matrix2x4::zeros();
    for (axis, size) in steps.into_iter().enumerate() {
        let mut step = Vector4::zeros();
        step[axis] = size;
        let difference = (moved(step)? - moved(-step)?) / (2.0 * size);
        jacobian.set_column(axis, &difference);
    }
    Some(jacobian)
}

/// Covariance of roll, pitch, yaw and height.
pub fn pose_covariance(noise: &SensorNoise) -> Matrix4<f64> {
    let variances = [noise.roll, noise.pitch, noise.yaw, noise.height].map(|sd| sd * sd);
    Matrix4::from_diagonal(&Vector4::from(variances))
}

/// Noise of the pixels of several landmarks in one picture: their own covariance on the diagonal, and
/// what the common error of the camera's pose does to all of them, everywhere.
pub fn joint_noise(
    own: &[Matrix2<f64>],
    jacobians: &[Matrix2x4<f64>],
    pose: &Matrix4<f64>,
    scale: f64,
) -> DMatrix<f64> {
    let n = own.len();
    let mut noise = DMatrix::zeros(2 * n, 2 * n);
    for i in 0..n {
        for j in 0..n {
            let mut block = jacobians[i] * pose * jacobians[j].transpose();
            if i == j {
                block += own[i];
            }
            noise
                .fixed_view_mut::<2, 2>(2 * i, 2 * j)
                .copy_from(&(block * scale));
        }
    }
    noise
}

/// Change of the ground point (north, east) with the pixel: 2 × 2, metres per pixel; `None` where the
/// ray does not reach the ground.
pub fn ground_jacobian(
    camera: &CameraModel,
    pose: &Pose,
    pixel: &Point2<f64>,
    ground_down: f64,
) -> Option<Matrix2<f64>> {
    let at = |dx: f64, dy: f64| {
        camera
            .ground_at(pose, &Point2::new(pixel.x + dx, pixel.y + dy), ground_down)
            .map(GroundPoint::to_vector)
    };
    let along_x: Vector2<f64> = at(0.5, 0.0)? - at(-0.5, 0.0)?;
    let along_y: Vector2<f64> = at(0.0, 0.5)? - at(0.0, -0.5)?;
    Some(Matrix2::from_columns(&[along_x, along_y]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::Attitude;

    fn pose(height: f64) -> Pose {
        Pose {
            position_in_world: Point3::new(0.0, 0.0, -height),
            attitude: Attitude::level(0.3),
        }
    }

    #[test]
    fn a_degree_of_roll_moves_the_nadir_point_by_the_focal_length_times_the_angle() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let j = pose_jacobian(&camera, &pose(100.0), &Point3::origin()).unwrap();
        assert!(
            (j.column(0).norm() - camera.focal).abs() < 1e-3 * camera.focal,
            "{j}"
        );
        assert!(
            j.column(3).norm() < 1e-9,
            "height does not move the nadir point: {j}"
        );
    }

    #[test]
    fn two_landmarks_share_the_error_of_the_attitude() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let points = [Point3::new(10.0, 5.0, 0.0), Point3::new(-8.0, 12.0, 0.0)];
        let jacobians = points.map(|p| pose_jacobian(&camera, &pose(100.0), &p).unwrap());
        let noise = SensorNoise {
            roll: 0.02,
            pitch: 0.02,
            yaw: 0.02,
            height: 0.5,
            pixel: 0.1,
        };
        let own = [Matrix2::identity() * 0.04; 2];
        let joint = joint_noise(&own, &jacobians, &pose_covariance(&noise), 1.0);
        let correlation = joint[(0, 2)] / (joint[(0, 0)] * joint[(2, 2)]).sqrt();
        assert!(correlation > 0.9, "{joint}");
        assert!(joint.cholesky().is_some());
    }
}
