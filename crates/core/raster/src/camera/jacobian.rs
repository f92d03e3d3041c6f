//! Derivatives of the pixel of a point by the pose.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Point3};

use super::CameraModel;
use pilotage_base::frames::Pose;

/// Step of the central differences in angle, radians.
const ANGLE_STEP: f64 = 1e-5;

impl CameraModel {
    /// Derivative of the pixel of a point by the position of the vehicle (north, east, down),
    /// pixels per metre, by central differences; `None` where the point cannot be seen.
    pub fn pixel_by_position(
        &self,
        pose: &Pose,
        point_in_world: &Point3<f64>,
    ) -> Option<Matrix2x3<f64>> {
        let step = 1e-5 * (point_in_world - pose.position_in_world).norm().max(1.0);
        self.difference(pose, point_in_world, step, |pose, axis, by| {
            pose.position_in_world[axis] += by;
        })
    }

    /// Derivative of the pixel of a point by roll, pitch and yaw, pixels per radian, by central
    /// differences; `None` where the point cannot be seen.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{Attitude, Pose};
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians()); // focal length 320 pixels
    /// # let (position_in_world, attitude) = (Point3::new(0.0, 0.0, -100.0), Attitude::level(0.0));
    /// # let pose = Pose { position_in_world, attitude };
    /// // A milliradian of pitch moves what lies below by f · 0.001 = 0.32 pixels.
    /// let by_attitude = camera.pixel_by_attitude(&pose, &Point3::origin()).ok_or("not in view")?;
    /// assert!((0.001 * by_attitude[(1, 1)].abs() - 0.32).abs() < 1e-6);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn pixel_by_attitude(
        &self,
        pose: &Pose,
        point_in_world: &Point3<f64>,
    ) -> Option<Matrix2x3<f64>> {
        self.difference(pose, point_in_world, ANGLE_STEP, |pose, axis, by| {
            let attitude = &mut pose.attitude;
            *[&mut attitude.roll, &mut attitude.pitch, &mut attitude.yaw][axis] += by;
        })
    }

    /// Covariance of the pixel of a point, px², when the attitude (roll, pitch, yaw) is known with
    /// `attitude_covariance`, rad²; first order. `None` where the point cannot be seen.
    pub fn pixel_covariance_from_attitude(
        &self,
        pose: &Pose,
        point_in_world: &Point3<f64>,
        attitude_covariance: &Matrix3<f64>,
    ) -> Option<Matrix2<f64>> {
        self.pixel_by_attitude(pose, point_in_world)
            .map(|j| j * attitude_covariance * j.transpose())
    }

    fn difference(
        &self,
        pose: &Pose,
        point_in_world: &Point3<f64>,
        step: f64,
        shift: impl Fn(&mut Pose, usize, f64),
    ) -> Option<Matrix2x3<f64>> {
        let mut jacobian = Matrix2x3::zeros();
        for axis in 0..3 {
            let pixel = |by: f64| {
                let mut shifted = *pose;
                shift(&mut shifted, axis, by);
                self.project(&shifted, point_in_world)
            };
            jacobian.set_column(axis, &((pixel(step)? - pixel(-step)?) / (2.0 * step)));
        }
        Some(jacobian)
    }
}
