//! Landmarks that a planned frame holds, and the information of each about the state.

use nalgebra::{Matrix2, Matrix4, Matrix4x5, Matrix5, Matrix5x4, SMatrix, Vector3, Vector4};

use super::request::PlannedLandmark;
use pilotage_base::frames::Pose;
use pilotage_estimation::vehicle::StateComponent;
use pilotage_mission::settings::SensorNoise;
use pilotage_navigator::navigator::{lasting_variances, weakened};
use pilotage_raster::camera::CameraModel;
use pilotage_vision::geometry::{
    AppearanceError, appearance, ground_jacobian, place_covariance, pose_jacobian,
};

/// Look at a landmark from one frame, linearized at the planned pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlannedLook {
    /// Index of the landmark.
    pub landmark: usize,
    /// Change of its appearance with what of the state is [`seen`].
    slope: Matrix4x5<f64>,
    /// Its change with the camera's roll, pitch, yaw and height.
    pose_jacobian: Matrix4<f64>,
    /// Covariance of what is measured, beside the errors of the camera's pose.
    covariance: Matrix4<f64>,
    /// Part of the variances, with that of the camera's pose, that is the same in every look.
    lasting: Vector4<f64>,
    /// Probability that it can be recognised on the day.
    pub recognised: f64,
    /// Probability that it is accepted in this frame if it lies in the picture and can be recognised.
    pub per_frame: f64,
}

impl PlannedLook {
    /// Information about what of the state is [`seen`] and (roll, pitch, yaw, height) in look number `look`, as the filter
    /// weighs it; `None` if a covariance is singular.
    pub fn information(&self, look: u32, pose_noise: &Matrix4<f64>) -> Option<Information> {
        let of_pose = self.pose_jacobian * pose_noise * self.pose_jacobian.transpose();
        let covariance = weakened(look, &self.covariance, &of_pose, &self.lasting);
        Information::new(&self.slope, &self.pose_jacobian, &covariance)
    }
}

/// Fisher information of what is measured in one picture, about part of the state and the pose's errors
/// together.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Information {
    /// About (north, east, heading bias, roll bias, pitch bias), 1/m², 1/rad².
    state: Matrix5<f64>,
    /// About those with (roll, pitch, yaw, height).
    coupling: Matrix5x4<f64>,
    /// About (roll, pitch, yaw, height).
    pose: Matrix4<f64>,
}

/// Components of a state of this `layout` that make up what is seen: the rows of the state, the columns (north and east on
/// the map, heading bias, roll bias, pitch bias). A column of what is no state is zero.
pub(super) fn seen<const N: usize>(layout: &[StateComponent; N]) -> SMatrix<f64, N, 5> {
    const SEEN: [&[StateComponent]; 5] = [
        &[StateComponent::PositionNorth, StateComponent::MapErrorNorth],
        &[StateComponent::PositionEast, StateComponent::MapErrorEast],
        &[StateComponent::HeadingBias],
        &[StateComponent::RollBias],
        &[StateComponent::PitchBias],
    ];
    SMatrix::from_fn(|row, column| f64::from(u8::from(SEEN[column].contains(&layout[row]))))
}

impl Information {
    /// Of a measurement with these slopes and this covariance; `None` if that is singular.
    fn new(
        slope: &Matrix4x5<f64>,
        pose_jacobian: &Matrix4<f64>,
        covariance: &Matrix4<f64>,
    ) -> Option<Self> {
        let weight = covariance.try_inverse()?;
        Some(Self {
            state: slope.transpose() * weight * slope,
            coupling: slope.transpose() * weight * pose_jacobian,
            pose: pose_jacobian.transpose() * weight * pose_jacobian,
        })
    }

    /// Of independent measurements in one picture together.
    pub fn add(&mut self, other: &Self) {
        self.state += other.state;
        self.coupling += other.coupling;
        self.pose += other.pose;
    }

    /// Information that is left about the state when the pose's errors have covariance `pose_noise` and are
    /// the same in all of the picture: `HᵀR⁻¹H` with the R of
    /// [`joint_noise`](pilotage_vision::geometry::joint_noise), by Woodbury's identity.
    pub fn about_state(&self, pose_noise: &Matrix4<f64>) -> Option<Matrix5<f64>> {
        let inner = (Matrix4::identity() + self.pose * pose_noise).try_inverse()?;
        Some(self.state - self.coupling * pose_noise * inner * self.coupling.transpose())
    }
}

/// Planned pose of the camera at a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlannedFrame<'a> {
    pub camera: &'a CameraModel,
    pub pose: Pose,
    pub ground_down: f64,
    /// Noise that is new in each frame.
    pub noise: &'a SensorNoise,
    /// Error of the map at a landmark that is no state of the filter, standard deviation per axis, metres.
    pub map_deviation: f64,
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

    /// Look at landmark `index`; `None` if it is out of reach of any shake, or is not expected to be found from this height.
    pub fn look(&self, index: usize, landmark: &PlannedLandmark) -> Option<PlannedLook> {
        let sensors = self.noise;
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
        let mut slope = Matrix4x5::zeros();
        for axis in 0..2 {
            let moved = |step: f64| {
                let mut pose = self.pose;
                pose.position_in_world[axis] += step;
                appearance(self.camera, &pose, &self.pose, &center)
            };
            slope.set_column(axis, &((moved(0.1)? - moved(-0.1)?) / 0.2));
        }
        // An angle that reads too much is a camera turned less than believed.
        for (column, angle) in [(2, 2), (3, 0), (4, 1)] {
            slope.set_column(column, &-pose_jacobian.column(angle));
        }
        let to_pixel: Matrix2<f64> =
            ground_jacobian(self.camera, &self.pose, &pixel, self.ground_down)?.try_inverse()?;
        let mut to_picture = Matrix4::identity();
        to_picture.fixed_view_mut::<2, 2>(0, 0).copy_from(&to_pixel);
        let b = landmark.landmark.bounds;
        let half = 0.25 * (b.width() + b.height());
        let unknown = AppearanceError {
            pixel: sensors.pixel,
            ground: sensors.ground,
        };
        let focal = self.camera.focal / height;
        let mut covariance = to_picture * expected.covariance * to_picture.transpose()
            + unknown.covariance(&to_pixel, focal, half);
        let mut of_place = covariance.fixed_view_mut::<2, 2>(0, 0);
        of_place += place_covariance(&to_pixel, self.map_deviation);
        covariance.try_inverse()?;
        let on_ground = AppearanceError {
            pixel: 0.0,
            ..unknown
        };
        let on_ground = on_ground.covariance(&to_pixel, focal, half);
        Some(PlannedLook {
            landmark: index,
            slope,
            pose_jacobian,
            covariance,
            lasting: lasting_variances(&on_ground, sensors, &pose_jacobian),
            recognised: expected.recognised,
            per_frame: expected.per_frame,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use pilotage_vision::geometry::joint_noise;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn two_landmarks_say_of_the_state_what_their_joint_noise_leaves() {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let mut any = || 2.0 * random.random::<f64>() - 1.0;
        let slopes = [(); 2].map(|()| Matrix4x5::from_fn(|_, _| any()));
        let jacobians = [(); 2].map(|()| Matrix4::from_fn(|_, _| any()));
        let own = [(); 2].map(|()| {
            let root = Matrix4::from_fn(|_, _| any());
            root * root.transpose() + Matrix4::identity() * 0.1
        });
        let pose_noise = Matrix4::from_diagonal(&nalgebra::Vector4::new(0.09, 0.49, 0.0, 4.0));
        let mut both = Information::default();
        for i in 0..2 {
            both.add(&Information::new(&slopes[i], &jacobians[i], &own[i]).unwrap());
        }
        let said = both.about_state(&pose_noise).unwrap();
        let slope = DMatrix::from_fn(8, 5, |i, j| slopes[i / 4][(i % 4, j)]);
        let noise = joint_noise(&own, &jacobians, &pose_noise, 1.0);
        let expected = slope.transpose() * noise.try_inverse().unwrap() * slope;
        for i in 0..5 {
            for j in 0..5 {
                let off = (said[(i, j)] - expected[(i, j)]).abs();
                assert!(off < 1e-9 * expected.norm(), "{said} {expected}");
            }
        }
    }
}
