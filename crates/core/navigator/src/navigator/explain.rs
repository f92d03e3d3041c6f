//! A past step looked at again, for people.

use std::sync::Arc;

use nalgebra::{Matrix2, Vector2};

use super::StepReport;
use pilotage_base::frames::Pose;
use pilotage_flight::Flight;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{PYRAMID_LEVELS, Picture, Pyramid};
use pilotage_vision::landmark::{
    CascadeEvidence, FrameView, Landmark, MatchEvidence, Refusal, SearchRequest, TemplateDetector,
};

/// The pictures that explain what the template detector did.
///
/// `None` if the landmark is unknown or was not looked for in that step.
pub fn explain(
    flight: &Flight,
    map: Arc<dyn Imagery>,
    run_settings: &NavigatorSettings,
    landmark: &Landmark,
    step: &StepReport,
    picture: &Picture,
) -> Option<Result<MatchEvidence, Refusal>> {
    let look = DetectorLook::again(flight, run_settings, landmark, step, picture)?;
    let mut detector = TemplateDetector::new(map, run_settings.detector);
    Some(detector.explain(&look.view(), &look.request(landmark)))
}

/// Evidence of the landmark's trained detector, what it saw and did, whichever detector was chosen.
///
/// `None` if the landmark is unknown or was not looked for in that step.
pub fn explain_cascade(
    flight: &Flight,
    map: &dyn Imagery,
    run_settings: &NavigatorSettings,
    landmark: &Landmark,
    step: &StepReport,
    picture: &Picture,
) -> Option<Result<CascadeEvidence, Refusal>> {
    let look = DetectorLook::again(flight, run_settings, landmark, step, picture)?;
    let sigmas = run_settings.detector.search_sigmas;
    Some(CascadeEvidence::new(
        map,
        &look.view(),
        &look.request(landmark),
        sigmas,
    ))
}

/// Input that a detector was given.
struct DetectorLook {
    camera: CameraModel,
    pose: Pose,
    ground_down: f64,
    luminance: Pyramid,
    /// Standard deviations (north, east) of where the landmark would appear, metres.
    deviations: Vector2<f64>,
    /// Standard deviations of its turn (radians) and of the logarithm of its size.
    turn_and_size: [f64; 2],
}

impl DetectorLook {
    fn again(
        flight: &Flight,
        run_settings: &NavigatorSettings,
        landmark: &Landmark,
        step: &StepReport,
        picture: &Picture,
    ) -> Option<Self> {
        let frame = step.frame.as_ref()?;
        let candidate = frame
            .candidates
            .iter()
            .find(|c| c.landmark == landmark.id)?;
        let camera = flight.camera_of_frame(frame.index);
        // What was searched says how uncertain the place was.
        let (region, bounds) = (candidate.search_region, landmark.bounds);
        let sigmas = run_settings.detector.search_sigmas.max(1e-9);
        let wider = Vector2::new(region.north - bounds.north, region.east - bounds.east);
        Some(Self {
            camera,
            pose: frame.assumed_pose,
            ground_down: flight.ground_down,
            luminance: Pyramid::new(picture.to_gray(), PYRAMID_LEVELS),
            deviations: wider / sigmas,
            turn_and_size: candidate.turn_and_size,
        })
    }

    fn view(&self) -> FrameView<'_> {
        FrameView {
            camera: &self.camera,
            pose: self.pose,
            ground_down: self.ground_down,
            luminance: &self.luminance,
        }
    }

    fn request<'l>(&self, landmark: &'l Landmark) -> SearchRequest<'l> {
        let variances = self.deviations.map(|sd| sd * sd);
        SearchRequest {
            landmark,
            displacement_covariance: Matrix2::from_diagonal(&variances),
            turn_deviation: self.turn_and_size[0],
            log_scale_deviation: self.turn_and_size[1],
        }
    }
}
