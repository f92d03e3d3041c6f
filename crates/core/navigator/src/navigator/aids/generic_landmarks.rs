//! Buildings, trees, waters and paved places that nobody picked, paired with those of the map.

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use std::sync::Arc;

use super::super::observation::Observation;
use super::super::sighting::SightingReport;
use super::aid::{Aid, AidInfo, AidLook, AidMoment, AidNumber, BeginAid};
use super::error::AidError;
use super::generic_sighting;
use pilotage_mission::settings::GENERIC_LANDMARKS;
use pilotage_reference::association::CommonError;
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
                  other, and they give one place together.",
    channels: &[],
    components: &[("north", "m"), ("east", "m")],
    tells_place: true,
    numbers: &[
        AidNumber {
            key: "tilt",
            label: "Error of the camera's roll and pitch",
            unit: "rad",
            usual: 0.0183,
        },
        AidNumber {
            key: "yaw",
            label: "Error of the camera's yaw",
            unit: "rad",
            usual: 0.0201,
        },
        AidNumber {
            key: "height",
            label: "Error of the height",
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
    let deviations = Vector4::new(numbers[0], numbers[0], numbers[1], numbers[2]);
    let network = CoverNetwork::usual();
    Ok(Box::new(GenericLandmarks {
        known: SeenTiles::of(Arc::clone(&ground.map), network.clone()),
        network,
        pose: Matrix4::from_diagonal(&deviations.component_mul(&deviations)),
        sighting: None,
    }))
};

/// The aid.
struct GenericLandmarks {
    known: SeenTiles,
    network: CoverNetwork,
    /// Covariance of the camera's roll, pitch, yaw and height, but for the believed bias of the heading.
    pose: Matrix4<f64>,
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
        let mut pose = self.pose;
        pose[(2, 2)] += look.belief.covariance[(2, 2)];
        let common = CommonError { position, pose };
        let association = view.associated(&observed, &around, common);
        let sets = (observed.as_slice(), around.as_slice());
        self.sighting = Some(generic_sighting::report(sets, &association, look, farthest));
        let fix = association.fix?;
        let place = view.below().to_vector() + fix.offset;
        let by_pose = &fix.by_pose;
        let own = fix.covariance - by_pose * pose * by_pose.transpose();
        // The bias of the heading is left to the filter.
        let pose = (by_pose, &self.pose);
        Some(Observation::of_place(place, &own, pose, look.belief.mean.z))
    }
}
