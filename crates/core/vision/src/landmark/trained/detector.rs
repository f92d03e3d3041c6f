//! The cascade detector of the navigator.

use std::collections::HashMap;
use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::{Mark, TrainedDetector, search};
use crate::landmark::{
    Detection, Detector, FrameView, Refusal, SearchRequest, Sighting, tolerance,
};

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

/// Log odds that a mark is the landmark, by its score and by how far from the expected place it lies:
/// right marks lie there by the covariance of the search, wrong ones anywhere in its region.
fn log_odds(
    trained: &TrainedDetector,
    mark: &Mark,
    request: &SearchRequest<'_>,
    (north, east): (f64, f64),
) -> f64 {
    let spread = &request.displacement_covariance;
    let off = mark.ground.to_vector()
        - trained.precision.bias
        - request.landmark.bounds.center().to_vector();
    let nearness = spread.try_inverse().map_or(0.0, |inverse| {
        let density = -0.5 * off.dot(&(inverse * off)) - (TAU * spread.determinant().sqrt()).ln();
        density + (4.0 * north * east).ln()
    });
    trained.likelihood.log_odds(mark.score) + nearness
}

/// Whether what is found beside the outermost window seen whole is right all the same: the landmark's own
/// window lies up to [`DetectorWindow::beside`](super::DetectorWindow::beside) further out, half as far on
/// average.
fn is_near_at_edge(trained: &TrainedDetector, view: &FrameView<'_>) -> bool {
    let pixel = (view.ground_down - view.pose.position_in_world.z) / view.camera.focal;
    let (north, east) = trained.window.beside();
    0.5 * north.max(east) <= tolerance(pixel)
}

/// Probabilities that each of several places is the landmark's, which can be but one of them or none, by
/// their log odds.
pub(in crate::landmark) fn probabilities(log_odds: &[f64]) -> Vec<f64> {
    let odds = |z: &f64| z.clamp(-40.0, 40.0).exp();
    let all: f64 = 1.0 + log_odds.iter().map(odds).sum::<f64>();
    log_odds.iter().map(|z| odds(z) / all).collect()
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
        // By score and place together another mark than that of the best score may be the likeliest.
        let mut judged: Vec<(f64, &Mark)> = (marks.iter())
            .map(|mark| (log_odds(trained, mark, request, reach), mark))
            .collect();
        judged.sort_by(|a, b| b.0.total_cmp(&a.0));
        let odds: Vec<f64> = judged.iter().map(|(odds, _)| *odds).collect();
        let likely = probabilities(&odds);
        let Some((_, best)) = judged.first() else {
            return Sighting::Refused(Refusal::OutOfPicture, None);
        };
        let ([rotation, log_scale], covariance) = trained.precision.of(best);
        let arm: Vector2<f64> = landmark.reference.to_vector() - center.to_vector();
        let arm = nalgebra::Rotation2::new(rotation) * arm * log_scale.exp();
        let detection = Detection {
            ground: (best.ground.to_vector() - trained.precision.bias + arm).into(),
            covariance,
            score: likely.first().copied().unwrap_or_default(),
            second_score: likely.get(1).copied().unwrap_or_default(),
            probability: likely.first().copied(),
            rotation,
            scale: log_scale.exp(),
        };
        let least = trained.likelihood.log_odds(trained.least_score);
        // A window that did not pass every stage was not weighed by the last of them.
        let is_whole = best.stages >= trained.cascade.stages.len();
        let refusal = if !is_whole || odds.first().is_none_or(|best| *best < least) {
            Some(Refusal::LowScore)
        } else if detection.score < BELIEVED {
            Some(Refusal::Ambiguous)
        } else if best.at_edge && !is_near_at_edge(trained, view) {
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
