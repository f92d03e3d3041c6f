//! Which landmarks a planned frame holds, and what each would say of the state.

use nalgebra::{Matrix2, Matrix4, Matrix4x3, Vector3};

use super::prediction::PlannedLandmark;
use crate::camera::CameraModel;
use crate::frames::Pose;
use crate::navigator::SensorNoise;
use crate::navigator::geometry::{appearance, ground_jacobian, pose_jacobian};

/// What a landmark says of the state in one frame, linearized at the planned pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// Index of the landmark.
    pub landmark: usize,
    /// Change of (pixel x, y, rotation, log scale) with (north, east, heading bias).
    pub slope: Matrix4x3<f64>,
    /// Their change with (roll, pitch, yaw, height).
    pub pose_jacobian: Matrix4<f64>,
    /// Covariance of what is measured, without the pose's error.
    pub covariance: Matrix4<f64>,
    /// Probability that it can be recognised on the day.
    pub recognised: f64,
    /// Probability that it is accepted in this frame if it lies in the picture and can be recognised.
    pub per_frame: f64,
}

/// Where the camera is planned to be at a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlannedFrame<'a> {
    pub camera: &'a CameraModel,
    pub pose: Pose,
    pub ground_down: f64,
}

impl PlannedFrame<'_> {
    fn height(&self) -> f64 {
        (self.ground_down - self.pose.position_in_world.z).max(1.0)
    }

    /// Whether the whole box lies in the picture of a camera turned by `shake` (roll, pitch, yaw).
    pub fn holds(&self, landmark: &PlannedLandmark, shake: &Vector3<f64>) -> bool {
        let mut pose = self.pose;
        pose.attitude.roll += shake[0];
        pose.attitude.pitch += shake[1];
        pose.attitude.yaw += shake[2];
        self.camera
            .holds(&pose, &landmark.landmark.bounds, self.ground_down, 0.0)
    }

    /// What landmark `index` would say; `None` if it is out of reach of any shake, or is not expected
    /// to be found from this height.
    pub fn look(
        &self,
        index: usize,
        landmark: &PlannedLandmark,
        sensors: &SensorNoise,
    ) -> Option<Look> {
        let height = self.height();
        let center = landmark.landmark.reference_in_world(self.ground_down);
        let pixel = self.camera.project(&self.pose, &center)?;
        // Beyond six standard deviations of the shake it never comes into the picture.
        let margin = -6.0 * self.camera.focal * sensors.roll.max(sensors.pitch);
        if !self.camera.in_picture(&pixel, margin) {
            return None;
        }
        let expected = landmark.detection.at(height)?;
        if expected.probability() <= 0.0 {
            return None;
        }
        let pose_jacobian = pose_jacobian(self.camera, &self.pose, &center)?;
        let mut slope = Matrix4x3::zeros();
        for axis in 0..2 {
            let moved = |step: f64| {
                let mut pose = self.pose;
                pose.position_in_world[axis] += step;
                appearance(self.camera, &pose, &self.pose, &center)
            };
            slope.set_column(axis, &((moved(0.1)? - moved(-0.1)?) / 0.2));
        }
        // A heading that reads too much is a camera turned less than believed.
        slope.set_column(2, &-pose_jacobian.column(2));
        let to_pixel: Matrix2<f64> =
            ground_jacobian(self.camera, &self.pose, &pixel, self.ground_down)?.try_inverse()?;
        let mut to_picture = Matrix4::identity();
        to_picture.fixed_view_mut::<2, 2>(0, 0).copy_from(&to_pixel);
        let b = landmark.landmark.bounds;
        let half = 0.25 * (b.width() + b.height());
        let angle = sensors.pixel / (half * self.camera.focal / height).max(1.0);
        let floor = nalgebra::Vector4::new(sensors.pixel, sensors.pixel, angle, angle);
        Some(Look {
            landmark: index,
            slope,
            pose_jacobian,
            covariance: to_picture * expected.covariance * to_picture.transpose()
                + Matrix4::from_diagonal(&floor.map(|sd| sd * sd)),
            recognised: expected.recognised,
            per_frame: expected.per_frame,
        })
    }
}
