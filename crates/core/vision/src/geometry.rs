//! Propagation of errors of the camera's pose and of the ground into the picture.

use nalgebra::{DMatrix, Matrix2, Matrix4, Point2, Point3, Vector2, Vector4};

use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_raster::camera::{CameraModel, PosedCamera};

/// Components of what is measured of one landmark: pixel x, pixel y, rotation, log scale.
pub const COMPONENTS: usize = 4;

/// Appearance of a landmark to a camera at `pose`, for somebody who believes `assumed`: pixel (x, y) of its
/// reference point, and the turn (radians clockwise) and log scale of its surroundings in the picture
/// rectified with the assumed pose. `None` where it is not in front of the lens.
pub fn appearance(
    camera: &CameraModel,
    pose: &Pose,
    assumed: &Pose,
    point: &Point3<f64>,
) -> Option<Vector4<f64>> {
    appearance_to(&camera.posed(pose), &camera.posed(assumed), point)
}

/// The same of a camera at both poses.
fn appearance_to(
    camera: &PosedCamera<'_>,
    assumed: &PosedCamera<'_>,
    point: &Point3<f64>,
) -> Option<Vector4<f64>> {
    /// Half the size of the surroundings, metres; the plane is flat, so that it hardly matters.
    const ARM: f64 = 5.0;
    let pixel = camera.project(point)?;
    let seen = |north: f64, east: f64| {
        let pixel = camera.project(&(point + nalgebra::Vector3::new(north, east, 0.0)))?;
        assumed
            .ground_at(&pixel, point.z)
            .map(GroundPoint::to_vector)
    };
    let along_north = (seen(ARM, 0.0)? - seen(-ARM, 0.0)?) / (2.0 * ARM);
    let along_east = (seen(0.0, ARM)? - seen(0.0, -ARM)?) / (2.0 * ARM);
    // The similarity next to the map (north, east) → (north, east) seen.
    let rotation = (along_north.y - along_east.x).atan2(along_north.x + along_east.y);
    let log_scale = 0.5
        * (along_north.x * along_east.y - along_north.y * along_east.x)
            .abs()
            .max(1e-12)
            .ln();
    Some(Vector4::new(pixel.x, pixel.y, rotation, log_scale))
}

/// Change of the appearance of `point` with the true roll, pitch, yaw (radians) and height (metres),
/// by central differences; `None` where the point is not in front of the lens.
pub fn pose_jacobian(
    camera: &CameraModel,
    pose: &Pose,
    point: &Point3<f64>,
) -> Option<Matrix4<f64>> {
    let assumed = camera.posed(pose);
    let moved = |step: Vector4<f64>| {
        let mut moved = *pose;
        moved.attitude.roll += step[0];
        moved.attitude.pitch += step[1];
        moved.attitude.yaw += step[2];
        moved.position_in_world.z -= step[3];
        appearance_to(&camera.posed(&moved), &assumed, point)
    };
    let steps = [1e-4, 1e-4, 1e-4, 1e-2];
    let mut jacobian = Matrix4::zeros();
    for (axis, size) in steps.into_iter().enumerate() {
        let mut step = Vector4::zeros();
        step[axis] = size;
        let difference = (moved(step)? - moved(-step)?) / (2.0 * size);
        jacobian.set_column(axis, &difference);
    }
    Some(jacobian)
}

/// Noise of what is measured of several landmarks in one picture: their own covariance on the
/// diagonal, and what the common error of the camera's pose does to all of them, everywhere.
pub fn joint_noise(
    own: &[Matrix4<f64>],
    jacobians: &[Matrix4<f64>],
    pose: &Matrix4<f64>,
    scale: f64,
) -> DMatrix<f64> {
    let n = own.len();
    let mut noise = DMatrix::zeros(COMPONENTS * n, COMPONENTS * n);
    for i in 0..n {
        for j in 0..n {
            let mut block = jacobians[i] * pose * jacobians[j].transpose();
            if i == j {
                block += own[i];
            }
            noise
                .fixed_view_mut::<COMPONENTS, COMPONENTS>(COMPONENTS * i, COMPONENTS * j)
                .copy_from(&(block * scale));
        }
    }
    noise
}

/// Covariance in the picture, px², of a place on the ground whose standard deviation is `deviation` metres per axis, where the
/// ground maps into the picture by `to_pixel`, pixels per metre.
pub fn place_covariance(to_pixel: &Matrix2<f64>, deviation: f64) -> Matrix2<f64> {
    to_pixel * to_pixel.transpose() * deviation.powi(2)
}

/// Error that is added to what a detector says of the place, turn and size of a landmark, standard deviations per axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AppearanceError {
    /// In the picture, pixels.
    pub pixel: f64,
    /// On the ground, metres.
    pub ground: f64,
}

impl AppearanceError {
    /// Covariance of pixel x, pixel y, rotation and log scale of a patch of half the size `half`, metres, where the
    /// ground maps into the picture by `to_pixel`, pixels per metre, `scale` of them in any direction. Turn and size
    /// are as uncertain as its rim is by as much.
    ///
    /// ```
    /// use nalgebra::Matrix2;
    /// use pilotage_vision::geometry::AppearanceError;
    ///
    /// // Four pixels to the metre: 0.3 px, and 0.1 m, which is 0.4 px.
    /// let error = AppearanceError { pixel: 0.3, ground: 0.1 };
    /// let covariance = error.covariance(&(Matrix2::identity() * 4.0), 4.0, 20.0);
    /// assert!((covariance[(0, 0)].sqrt() - 0.5).abs() < 1e-12);
    /// // 0.5 px at a rim 80 px away.
    /// assert!((covariance[(2, 2)].sqrt() - 0.5 / 80.0).abs() < 1e-12);
    /// ```
    pub fn covariance(&self, to_pixel: &Matrix2<f64>, scale: f64, half: f64) -> Matrix4<f64> {
        let angle = self.pixel / (half * scale).max(1.0);
        let deviations = Vector4::new(self.pixel, self.pixel, angle, angle);
        let mut covariance = Matrix4::from_diagonal(&deviations.map(|sd| sd * sd));
        if self.ground > 0.0 {
            let mut both = covariance.fixed_view_mut::<2, 2>(0, 0);
            both += place_covariance(to_pixel, self.ground);
            let turn = (self.ground / half).powi(2);
            covariance[(2, 2)] += turn;
            covariance[(3, 3)] += turn;
        }
        covariance
    }
}

/// Change of the ground point (north, east) with the pixel: 2 × 2, metres per pixel; `None` where the
/// ray does not reach the ground.
///
/// ```
/// use nalgebra::{Point2, Point3};
/// use pilotage_base::frames::{Attitude, Pose};
/// use pilotage_raster::camera::CameraModel;
/// use pilotage_vision::geometry::ground_jacobian;
///
/// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians()); // focal length 320 pixels
/// # let (position_in_world, attitude) = (Point3::new(0.0, 0.0, -160.0), Attitude::level(0.0));
/// # let pose = Pose { position_in_world, attitude };
/// // 160 m up, heading north: a pixel to the right is half a metre east, one down half a metre south.
/// let jacobian = ground_jacobian(&camera, &pose, &Point2::new(320.0, 240.0), 0.0);
/// let jacobian = jacobian.ok_or("above the horizon")?;
/// assert!((jacobian[(1, 0)] - 0.5).abs() < 1e-9);
/// assert!((jacobian[(0, 1)] + 0.5).abs() < 1e-9);
/// # Ok::<(), &str>(())
/// ```
pub fn ground_jacobian(
    camera: &CameraModel,
    pose: &Pose,
    pixel: &Point2<f64>,
    ground_down: f64,
) -> Option<Matrix2<f64>> {
    let posed = camera.posed(pose);
    let at = |dx: f64, dy: f64| {
        posed
            .ground_at(&Point2::new(pixel.x + dx, pixel.y + dy), ground_down)
            .map(GroundPoint::to_vector)
    };
    let along_x: Vector2<f64> = at(0.5, 0.0)? - at(-0.5, 0.0)?;
    let along_y: Vector2<f64> = at(0.0, 0.5)? - at(0.0, -0.5)?;
    Some(Matrix2::from_columns(&[along_x, along_y]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::Attitude;

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
        let roll = j.fixed_view::<2, 1>(0, 0).norm();
        assert!((roll - camera.focal).abs() < 1e-3 * camera.focal, "{j}");
        let height = j.fixed_view::<2, 1>(0, 3).norm();
        assert!(height < 1e-9, "height does not move the nadir point: {j}");
    }

    #[test]
    fn a_camera_turned_clockwise_sees_its_surroundings_turned_back() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let j = pose_jacobian(&camera, &pose(100.0), &Point3::new(12.0, -7.0, 0.0)).unwrap();
        assert!((j[(2, 2)] + 1.0).abs() < 1e-3, "{j}");
        assert!(
            (j[(3, 3)] + 1.0 / 100.0).abs() < 1e-4,
            "higher means smaller: {j}"
        );
    }

    #[test]
    fn two_landmarks_share_the_error_of_the_attitude() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let points = [Point3::new(10.0, 5.0, 0.0), Point3::new(-8.0, 12.0, 0.0)];
        let jacobians = points.map(|p| pose_jacobian(&camera, &pose(100.0), &p).unwrap());
        let pose_noise = Matrix4::from_diagonal(&Vector4::new(4e-4, 4e-4, 4e-4, 0.25));
        let own = [Matrix4::identity() * 1e-4; 2];
        let joint = joint_noise(&own, &jacobians, &pose_noise, 1.0);
        let correlation = joint[(0, 4)] / (joint[(0, 0)] * joint[(4, 4)]).sqrt();
        assert!(correlation > 0.9, "{joint}");
        assert!(joint.cholesky().is_some());
    }
}
