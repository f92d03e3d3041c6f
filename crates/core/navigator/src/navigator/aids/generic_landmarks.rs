//! Buildings, trees, waters and paved places that nobody picked, paired with those of the map.

use nalgebra::{Matrix2, Matrix4, Vector2, Vector3, Vector4};
use std::sync::Arc;

use super::super::observation::Observation;
use super::super::sighting::SightingReport;
use super::aid::{Aid, AidInfo, AidLook, AidMoment, AidNumber, BeginAid};
use super::error::AidError;
use super::generic_sighting;
use pilotage_mission::settings::GENERIC_LANDMARKS;
use pilotage_reference::association::{CommonError, JointFix};
use pilotage_reference::seeing::{PictureView, SeenTiles};
use pilotage_vision::ground_class::CoverNetwork;

/// Believed places of the aircraft in which landmarks are looked up, standard deviations.
const REACH: f64 = 3.5;
/// Farthest that landmarks are looked up from what the picture shows, metres.
const FARTHEST: f64 = 400.0;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: GENERIC_LANDMARKS.aid,
    label: "Generic landmarks",
    description: "Buildings, trees, waters and paved places that the camera sees, paired with those of the map by \
                  their arrangement. None is told from another by itself: pairs are believed that agree with each \
                  other, and they give one place together. Pictures of more than 13 km² of ground are not looked at.",
    channels: &[],
    components: &[("north", "m"), ("east", "m")],
    tells_place: true,
    passes_over: |camera, pose, ground_down| {
        PictureView::is_too_wide(camera, pose, ground_down)
            .then_some("they show more than 13 km² of ground, or none")
    },
    numbers: &[
        AidNumber {
            key: "tilt",
            label: "Least error of the camera's roll and pitch",
            unit: "rad",
            usual: 0.0183,
        },
        AidNumber {
            key: "yaw",
            label: "Least error of the camera's yaw",
            unit: "rad",
            usual: 0.0201,
        },
        AidNumber {
            key: "height",
            label: "Least error of the height",
            unit: "m",
            usual: 0.6,
        },
        AidNumber {
            key: GENERIC_LANDMARKS.number,
            label: "Error per axis that all landmarks share",
            unit: "m",
            usual: GENERIC_LANDMARKS.usual,
        },
    ],
};

/// Makes the aid.
pub const BEGIN: BeginAid = |numbers, ground| {
    let ground = ground.ok_or_else(|| AidError::UnknownGround {
        key: INFO.key.to_owned(),
        what: "map".to_owned(),
        remedy: "open one, or switch the aid off".to_owned(),
    })?;
    let network = CoverNetwork::usual();
    Ok(Box::new(GenericLandmarks {
        known: SeenTiles::of(Arc::clone(&ground.map), network.clone()),
        network,
        stated: StatedErrors::of(Vector3::new(numbers[0], numbers[1], numbers[2]), numbers[3]),
        sighting: None,
    }))
};

/// The aid.
struct GenericLandmarks {
    known: SeenTiles,
    network: CoverNetwork,
    stated: StatedErrors,
    /// Report of what it saw last, until that is told.
    sighting: Option<SightingReport>,
}

impl Aid for GenericLandmarks {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let look = moment.look.as_ref();
        look.and_then(|look| self.fix(look)).into_iter().collect()
    }

    fn sighting(&mut self) -> Option<SightingReport> {
        self.sighting.take()
    }
}

impl GenericLandmarks {
    /// Place of the aircraft by what is seen in a picture.
    fn fix(&mut self, look: &AidLook<'_>) -> Option<Observation<'static>> {
        let (camera, ground_down) = (look.model.camera, look.model.ground_down);
        let network = &self.network;
        let view = PictureView::of(camera, &look.pose, ground_down, look.picture, network)?;
        let observed: Vec<_> = view.seen.iter().filter_map(|l| view.observed(l)).collect();
        let position: Matrix2<f64> = look.belief.covariance.fixed_view::<2, 2>(0, 0).into();
        let farthest = view.corners().iter().map(Vector2::norm).fold(0.0, f64::max);
        let doubt = REACH * look.deviation();
        let around = view.around(&mut self.known, farthest + doubt.min(FARTHEST));
        let pose = self.stated.pose(look);
        let common = CommonError { position, pose };
        let association = view.associated(&observed, &around, common);
        let sets = (observed.as_slice(), around.as_slice());
        self.sighting = Some(generic_sighting::report(sets, &association, look, farthest));
        let fix = association.fix?;
        Some(
            self.stated
                .observation(look, view.below().to_vector(), &fix),
        )
    }
}

/// Errors that are stated for the aid.
struct StatedErrors {
    /// Least covariance of the camera's roll, pitch, yaw and height.
    pose: Matrix4<f64>,
    /// Error per axis that all landmarks share, metres.
    of_map: f64,
}

impl StatedErrors {
    /// Least standard deviations of roll and pitch, of yaw (radians) and of height (metres), and the error per axis that
    /// all landmarks share, metres.
    fn of(pose: Vector3<f64>, of_map: f64) -> Self {
        let deviations = Vector4::new(pose.x, pose.x, pose.y, pose.z);
        Self {
            pose: Matrix4::from_diagonal(&deviations.component_mul(&deviations)),
            of_map,
        }
    }

    /// Covariance of the errors of the look's roll, pitch, yaw and height with which landmarks are paired: what the filter
    /// is told of the camera if that is more, and the bias of the heading.
    fn pose(&self, look: &AidLook<'_>) -> Matrix4<f64> {
        let mut pose = self.pose.sup(&look.noise.pose_covariance());
        pose[(2, 2)] += look.belief.covariance[(2, 2)];
        pose
    }

    /// The fix of a look from the ground `below` the believed camera, metres north and east, as an observation. The errors
    /// that it has in common with others of the picture are those of which the filter is told; the bias of the heading is
    /// left to the filter, and what is stated beyond these is its own.
    fn observation(
        &self,
        look: &AidLook<'_>,
        below: Vector2<f64>,
        fix: &JointFix,
    ) -> Observation<'static> {
        let told = look.noise.pose_covariance();
        let mut known = told;
        known[(2, 2)] += look.belief.covariance[(2, 2)];
        let by_pose = &fix.by_pose;
        let shared = Matrix2::identity() * look.beyond_state(self.of_map);
        let own = fix.covariance - by_pose * known * by_pose.transpose() + shared;
        let place = below + fix.offset;
        Observation::of_place(place, &own, (by_pose, &told), look.belief.mean.z)
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::picture_errors::PictureErrors;
    use super::super::look_for_tests::{HEIGHT, TestLooks};
    use super::*;
    use nalgebra::{DMatrix, Matrix2x4, Matrix6};

    /// Errors of roll and pitch of 1°, of yaw of 2°, of height of 0.6 m; 1 m of the map.
    fn stated() -> StatedErrors {
        let [one, two] = [1.0_f64, 2.0].map(f64::to_radians);
        StatedErrors::of(Vector3::new(one, two, 0.6), 1.0)
    }

    /// A fix of two metres of its own by pairs that tell nothing of the pose, which moves it by the height.
    fn fix(pose: &Matrix4<f64>) -> JointFix {
        let by_pose = Matrix2x4::new(0.0, HEIGHT, 0.0, 0.0, -HEIGHT, 0.0, 0.0, 0.0);
        JointFix {
            offset: Vector2::zeros(),
            covariance: Matrix2::identity() * 4.0 + by_pose * pose * by_pose.transpose(),
            by_pose,
            chi_square: 0.0,
            degrees: 2,
            pose: Vector4::zeros(),
            joint: Matrix6::identity(),
        }
    }

    #[test]
    fn a_mount_that_nobody_states_makes_a_fix_as_vague_as_the_filter_is_told() {
        let looks = TestLooks::default();
        let stated = stated();
        let engine = looks.engine(15.0);
        let noise = |roll: f64| {
            let mut look = looks.look(engine.as_ref());
            look.noise.roll = roll;
            let fix = fix(&stated.pose(&look));
            stated.observation(&look, Vector2::zeros(), &fix).noise
        };
        // Less than what is stated for the aid changes nothing.
        let least = noise(1e-3);
        let of_roll = (HEIGHT * 1_f64.to_radians()).powi(2);
        // Two metres of its own, one of the map, which is no state here.
        assert!(
            (least[(1, 1)] - (4.0 + 1.0 + of_roll)).abs() < 1e-9,
            "{least}"
        );
        let vague = noise(0.17);
        let grown = (HEIGHT * 0.17).powi(2) - of_roll;
        assert!(
            (vague[(1, 1)] - least[(1, 1)] - grown).abs() < 1e-6,
            "{vague}"
        );
        assert_eq!(vague[(0, 0)], least[(0, 0)]);
    }

    #[test]
    fn after_what_tells_nothing_of_the_pose_a_fix_is_taken_in_as_it_is() {
        let looks = TestLooks::default();
        let stated = stated();
        let engine = looks.engine(15.0);
        for roll in [1e-3, 0.17] {
            let mut look = looks.look(engine.as_ref());
            look.noise.roll = roll;
            let pose = look.noise.pose_covariance();
            let mut errors = PictureErrors::new(pose);
            let by_none = (&Matrix2x4::zeros(), &pose);
            let before =
                Observation::of_place(Vector2::zeros(), &Matrix2::identity(), by_none, 0.0);
            errors.note(before);
            let fix = fix(&stated.pose(&look));
            let observed = stated.observation(&look, Vector2::zeros(), &fix);
            let given = errors.given(&observed).unwrap();
            assert!((given.noise - &observed.noise).norm() < 1e-9);
        }
    }

    #[test]
    fn the_error_that_landmarks_share_is_noise_where_it_is_no_state() {
        let looks = TestLooks::default();
        let stated = stated();
        let engine = looks.engine(15.0);
        let noise = |of_state: f64| {
            let mut look = looks.look(engine.as_ref());
            look.map_deviation = of_state;
            let fix = fix(&stated.pose(&look));
            stated.observation(&look, Vector2::zeros(), &fix).noise
        };
        let difference = noise(0.0) - noise(stated.of_map);
        assert!((difference - DMatrix::identity(2, 2)).norm() < 1e-9);
    }
}
