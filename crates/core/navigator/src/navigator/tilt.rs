//! Effect of a wrong tilt of the camera, where that is a state of the filter, on what is seen.

use nalgebra::{DVector, Matrix4, MatrixXx2, MatrixXx4};

use pilotage_estimation::vehicle::Kinematics;
use pilotage_vision::geometry::COMPONENTS;

/// Change of what is measured with the errors of roll and pitch, true less assumed, where the readings are assumed.
pub struct ByTilt(MatrixXx2<f64>);

impl ByTilt {
    /// Of an observation by its change with the errors of roll, pitch, yaw and height.
    pub fn of(by_pose: &MatrixXx4<f64>) -> Self {
        Self(by_pose.fixed_columns::<2>(0).into_owned())
    }

    /// Of the appearances of landmarks, stacked.
    pub fn of_landmarks(jacobians: &[Matrix4<f64>]) -> Self {
        let rows = COMPONENTS * jacobians.len();
        Self(MatrixXx2::from_fn(rows, |row, axis| {
            jacobians[row / COMPONENTS][(row % COMPONENTS, axis)]
        }))
    }

    /// Adds to what is `expected` by the readings the part of their biases in the state that is `seen`.
    pub fn add(&self, expected: &mut DVector<f64>, seen: &Kinematics) {
        self.add_biases(expected, seen.tilt_bias);
    }

    /// The same of biases of roll and pitch, radians, where there are any.
    pub fn add_biases(&self, expected: &mut DVector<f64>, biases: Option<[f64; 2]>) {
        let Some([roll, pitch]) = biases else {
            return;
        };
        // A reading that is too large is a truth that is smaller.
        expected.axpy(-roll, &self.0.column(0), 1.0);
        expected.axpy(-pitch, &self.0.column(1), 1.0);
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point2, dvector};
    use pilotage_base::frames::{Attitude, GroundPoint};
    use pilotage_raster::camera::CameraModel;
    use pilotage_vision::geometry::appearance;
    use pilotage_vision::landmark::Landmark;

    use super::super::expected::{Anchor, AppearanceModel, appearances};
    use super::*;
    use pilotage_base::frames::GroundRect;

    #[test]
    fn a_landmark_is_expected_where_a_camera_sees_it_that_is_tilted_otherwise_than_it_reads() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let model = AppearanceModel {
            camera: &camera,
            attitude: Attitude {
                roll: 0.2,
                pitch: -0.06,
                yaw: 0.8,
            },
            camera_down: -300.0,
            ground_down: 0.0,
        };
        let at = GroundPoint::new(3.0, -4.0);
        let (assumed, mut truth) = (model.pose(at, 0.0), model.pose(at, 0.0));
        let biases = [0.002, -0.003];
        truth.attitude.roll -= biases[0];
        truth.attitude.pitch -= biases[1];
        let bounds = GroundRect::centered(GroundPoint::new(20.0, -15.0), 30.0, 30.0);
        let landmark = Landmark::new(1, "barn", bounds);
        let point = landmark.reference_in_world(0.0);
        let seen = appearance(&camera, &truth, &assumed, &point).unwrap();
        let anchor = Anchor::at(&camera, &assumed, &Point2::new(seen.x, seen.y), 0.0).unwrap();
        let jacobian = anchor.pose_jacobian(&camera, &assumed, &point).unwrap();
        let places = [(landmark.reference, anchor)];
        let mut expected = appearances(&model.attitude, &places, &assumed, at, 0.0);
        let untilted = (&expected - dvector![seen.x, seen.y, seen.z, seen.w]).norm();
        ByTilt::of_landmarks(&[jacobian]).add_biases(&mut expected, Some(biases));
        let off = (expected - dvector![seen.x, seen.y, seen.z, seen.w]).norm();
        assert!(untilted > 1.5 && off < 0.02 * untilted, "{untilted} {off}");
    }
}
