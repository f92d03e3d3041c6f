//! The cascade detector of the navigator.

use std::collections::HashMap;

use nalgebra::{Matrix4, Vector2};

use super::{Mark, TrainedDetector, search};
use crate::landmark::{Detection, Detector, FrameView, Refusal, SearchRequest, Sighting};

/// Standard deviation of the turn that a cascade, which measures none, leaves open, radians.
const TURN: f64 = 0.5;
/// The same of the logarithm of the scale.
const LOG_SCALE: f64 = 0.3;
/// Probability from which on a place is believed.
pub(in crate::landmark) const BELIEVED: f64 = 0.9;

/// Finds landmarks by cascades that were trained for them.
pub struct CascadeDetector {
    trained: HashMap<u32, TrainedDetector>,
    search_sigmas: f64,
}

impl CascadeDetector {
    /// A detector with cascades for some landmarks, by their ids; it searches out to so many standard
    /// deviations.
    pub fn new(trained: HashMap<u32, TrainedDetector>, search_sigmas: f64) -> Self {
        Self {
            trained,
            search_sigmas,
        }
    }

    /// The detector for a landmark, if one was trained for it as it is.
    pub fn trained(&self, landmark: u32) -> Option<&TrainedDetector> {
        self.trained.get(&landmark)
    }
}

/// Probabilities that each mark is the landmark, which can be but one of them or none.
pub fn probabilities(trained: &TrainedDetector, marks: &[Mark]) -> Vec<f64> {
    let odds = |m: &Mark| {
        trained
            .likelihood
            .log_odds(m.score)
            .clamp(-40.0, 40.0)
            .exp()
    };
    let all: f64 = 1.0 + marks.iter().map(odds).sum::<f64>();
    marks.iter().map(|m| odds(m) / all).collect()
}

impl Detector for CascadeDetector {
    fn detect(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting {
        let landmark = request.landmark;
        let Some(trained) = self.trained.get(&landmark.id) else {
            return Sighting::Refused(Refusal::Untrained, None);
        };
        let reach = request.half_extents(self.search_sigmas);
        let center = landmark.bounds.center();
        let marks = match search(&trained.cascade, &trained.window, view, center, reach) {
            Ok(marks) => marks,
            Err(refusal) => return Sighting::Refused(refusal, None),
        };
        let likely = probabilities(trained, &marks);
        let Some(best) = marks.first() else {
            return Sighting::Refused(Refusal::OutOfPicture, None);
        };
        let arm: Vector2<f64> = landmark.reference.to_vector() - center.to_vector();
        let mut covariance = Matrix4::from_diagonal(&nalgebra::Vector4::new(
            0.0,
            0.0,
            TURN * TURN,
            LOG_SCALE * LOG_SCALE,
        ));
        covariance
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&trained.covariance);
        let detection = Detection {
            ground: (best.ground.to_vector() + arm).into(),
            covariance,
            score: likely.first().copied().unwrap_or_default(),
            second_score: likely.get(1).copied().unwrap_or_default(),
            rotation: 0.0,
            scale: 1.0,
        };
        let refusal = if best.score < trained.least_score {
            Some(Refusal::LowScore)
        } else if detection.score < BELIEVED {
            Some(Refusal::Ambiguous)
        } else if best.at_edge {
            Some(Refusal::AtSearchEdge)
        } else {
            None
        };
        match refusal {
            Some(refusal) => Sighting::Refused(refusal, Some(detection)),
            None => Sighting::Found(detection),
        }
    }
}
