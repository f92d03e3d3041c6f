//! Effect of a wrong tilt of the camera, where that is a state of the filter, on what is seen.

use nalgebra::{DVector, Matrix2, Matrix4, MatrixXx2, MatrixXx4, Vector2};

use super::Estimate;
use super::engine::place_in_state;
use super::place_on_map::PlaceOnMap;
use pilotage_estimation::vehicle::{Kinematics, StateComponent};
use pilotage_mission::settings::NavigatorSettings;
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

/// Part of the camera's tilt that stays over a flight, as a filter knows it.
#[derive(Clone, Copy, Debug)]
pub struct LastingTilt {
    /// Place of the bias of roll in the state, that of pitch follows; `None` where they are no states.
    index: Option<usize>,
    /// Standard deviation of each where they are no states, beyond what frames are taken to be tilted by, radians.
    deviation: f64,
}

impl LastingTilt {
    /// Of a filter with these settings.
    pub fn of(settings: &NavigatorSettings) -> Self {
        let index = place_in_state(settings, StateComponent::RollBias);
        let is_noise = index.is_none();
        let beyond = settings
            .whole_frames
            .filter(|_| is_noise)
            .map(|frames| settings.sensors.tilt_bias.powi(2) - frames.tilt_deviation.powi(2));
        Self {
            index,
            deviation: beyond.unwrap_or(0.0).max(0.0).sqrt(),
        }
    }

    /// Biases of roll and pitch that are believed, radians.
    pub fn biases(&self, believed: &Estimate) -> [f64; 2] {
        let of = |i: usize| [believed.mean[i], believed.mean[i + 1]];
        self.index.map_or([0.0; 2], of)
    }

    /// Variance of the two together, in the worst direction at most, radians².
    pub fn variance(&self, believed: &Estimate) -> f64 {
        let of = |i: usize| believed.covariance[(i, i)] + believed.covariance[(i + 1, i + 1)];
        self.index.map_or(self.deviation.powi(2), of)
    }

    /// Variance of each where they are no states, radians².
    pub fn variance_of_noise(&self) -> f64 {
        self.deviation.powi(2)
    }

    /// Mean and covariance of the place on the map, north and east, that a frame is expected to tell which moves with the
    /// tilt as `by_tilt` says (metres per radian) and was laid as if the biases were `assumed`.
    pub fn place(
        &self,
        (believed, on_map): (&Estimate, &PlaceOnMap),
        by_tilt: &Matrix2<f64>,
        assumed: [f64; 2],
    ) -> (Vector2<f64>, Matrix2<f64>) {
        let (mean, own) = (on_map.mean(believed), on_map.covariance(believed));
        let Some(i) = self.index else {
            let noise = self.variance_of_noise() * by_tilt * by_tilt.transpose();
            return (mean, own + noise);
        };
        let off = Vector2::from(self.biases(believed)) - Vector2::from(assumed);
        let across = by_tilt * on_map.covariance_with(believed, i);
        let of_tilt = by_tilt * believed.covariance.fixed_view::<2, 2>(i, i) * by_tilt.transpose();
        (
            mean + by_tilt * off,
            own + across + across.transpose() + of_tilt,
        )
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Point2, dvector};
    use pilotage_base::frames::{Attitude, GroundPoint};
    use pilotage_raster::camera::CameraModel;
    use pilotage_vision::geometry::appearance;
    use pilotage_vision::landmark::Landmark;
    use pilotage_vision::registration::FollowSettings;

    use super::super::engine::frame_noise;
    use super::super::expected::{Anchor, AppearanceModel, appearances};
    use super::*;
    use pilotage_base::frames::GroundRect;
    use pilotage_mission::settings::VehicleChoice;

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

    #[test]
    fn a_place_laid_with_a_wrong_tilt_is_expected_where_position_and_bias_have_it_together() {
        let mut settings = NavigatorSettings::default();
        settings.sensors.tilt_bias = 0.17;
        settings.whole_frames = Some(FollowSettings {
            map_deviation: 3.0,
            ..FollowSettings::default()
        });
        let lasting = LastingTilt::of(&settings);
        // North, east, two of the wind, roll, pitch, and two of the map.
        let slopes = DMatrix::from_fn(8, 8, |i, j| ((3 * i + 5 * j) as f64).sin());
        let believed = Estimate {
            mean: DVector::from_fn(8, |i, _| 0.1 * i as f64),
            covariance: &slopes * slopes.transpose(),
        };
        assert_eq!(lasting.biases(&believed), [0.4, 0.5]);
        let by_tilt = Matrix2::new(20.0, -110.0, 115.0, 25.0);
        let (mean, covariance) = lasting.place(
            (&believed, &PlaceOnMap::of(&settings, 3.0)),
            &by_tilt,
            [0.3, 0.3],
        );
        let mut jacobian = DMatrix::zeros(2, 8);
        jacobian.view_mut((0, 0), (2, 2)).fill_with_identity();
        jacobian.view_mut((0, 4), (2, 2)).copy_from(&by_tilt);
        jacobian.view_mut((0, 6), (2, 2)).fill_with_identity();
        let all = &jacobian * &believed.covariance * jacobian.transpose();
        assert!((covariance - all.fixed_view::<2, 2>(0, 0)).amax() < 1e-9);
        assert!(
            (mean
                - Vector2::new(
                    0.6 + 20.0 * 0.1 - 110.0 * 0.2,
                    0.8 + 115.0 * 0.1 + 25.0 * 0.2
                ))
            .amax()
                < 1e-9
        );
        // The largest model leaves none beside the error of the map.
        settings.vehicle = VehicleChoice::AirplaneFull;
        assert_eq!(LastingTilt::of(&settings).biases(&believed), [0.0, 0.0]);
        assert_eq!(
            frame_noise(&settings),
            settings.sensors.without_biases(false, true)
        );
        // A height that is estimated leaves no room: then it is noise of every frame, beyond that which frames have anyway.
        settings.estimates_height = true;
        let noise = LastingTilt::of(&settings);
        let own = FollowSettings::default().tilt_deviation;
        let beyond = 0.17_f64.powi(2) - own.powi(2);
        assert!((noise.variance_of_noise() - beyond).abs() < 1e-12);
        assert_eq!(noise.biases(&believed), [0.0, 0.0]);
    }
}
