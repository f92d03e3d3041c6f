//! The detector of the navigator: for each landmark the one that was chosen for it.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Matrix2;

use super::choice::DetectorChoice;
use super::trained::{BELIEVED, CascadeDetector, TemplateLikelihood, probabilities};
use super::{
    Detection, Detector, FrameView, Landmark, Refusal, SearchRequest, Sighting, TemplateDetector,
    TemplateSettings,
};
use pilotage_raster::imagery::Imagery;

/// Square of the distance, in standard deviations of their difference, up to which two places are one:
/// the 99 % point of chi-square with two degrees of freedom.
const SAME_PLACE: f64 = 9.21;

/// Finds each landmark by the detector that was chosen for it; by its map patch where no other was
/// trained.
pub struct ChosenDetector {
    template: TemplateDetector,
    cascade: CascadeDetector,
    choices: HashMap<u32, DetectorChoice>,
}

impl ChosenDetector {
    /// For `landmarks` of `map`.
    pub fn new(map: Arc<dyn Imagery>, settings: TemplateSettings, landmarks: &[Landmark]) -> Self {
        let mut choices = HashMap::new();
        let mut trained = HashMap::new();
        for landmark in landmarks {
            let choice = landmark.detector_choice();
            if choice == DetectorChoice::Template {
                continue;
            }
            if let Some(detector) = landmark.trained_detector() {
                choices.insert(landmark.id, choice);
                trained.insert(landmark.id, detector);
            }
        }
        Self {
            template: TemplateDetector::new(map, settings),
            cascade: CascadeDetector::new(trained, settings.search_sigmas),
            choices,
        }
    }

    fn both(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting {
        let by_patch = self.template.detect(view, request);
        let by_cascade = self.cascade.detect(view, request);
        let Some(trained) = self.cascade.trained(request.landmark.id) else {
            return by_patch;
        };
        let (Some(patch), Some(cascade)) = (by_patch.best(), by_cascade.best()) else {
            return match by_cascade {
                Sighting::Found(_) => by_cascade,
                Sighting::Refused(..) => by_patch,
            };
        };
        let between =
            |d: &Detection| -> Matrix2<f64> { d.covariance.fixed_view::<2, 2>(0, 0).into() };
        let apart = patch.ground.to_vector() - cascade.ground.to_vector();
        let spread = between(patch) + between(cascade) + trained.precision.covariance;
        let square = spread.try_inverse().map_or(f64::INFINITY, |inverse| {
            (apart.transpose() * inverse * apart)[0]
        });
        let odds_of_cascade = (cascade.score / (1.0 - cascade.score).max(1e-12))
            .max(1e-12)
            .ln();
        let said = |t: &TemplateLikelihood| t.log_ratio(patch.score);
        if square <= SAME_PLACE {
            // Two that err independently name one place: what they say adds up, and the finer of them says
            // where.
            let odds = odds_of_cascade + trained.template.as_ref().map_or(0.0, said);
            let probability = probabilities(&[odds])[0];
            let detection = Detection {
                score: probability,
                second_score: cascade.second_score,
                probability: Some(probability),
                ..*patch
            };
            return if detection.score >= BELIEVED {
                Sighting::Found(detection)
            } else {
                Sighting::Refused(Refusal::LowScore, Some(detection))
            };
        }
        let Some(template) = &trained.template else {
            return match (&by_patch, &by_cascade) {
                // Each is sure of another place: neither is believed.
                (Sighting::Found(_), Sighting::Found(_)) => {
                    Sighting::Refused(Refusal::Ambiguous, Some(*cascade))
                }
                (_, Sighting::Found(_)) => by_cascade,
                _ => by_patch,
            };
        };
        // It is at one of the two places or at none.
        let odds = [odds_of_cascade, template.likelihood.log_odds(patch.score)];
        let likely = probabilities(&odds);
        let by_both = |sighting: Sighting, share: f64| match sighting {
            Sighting::Found(detection) if share < BELIEVED => {
                Sighting::Refused(Refusal::Ambiguous, Some(detection))
            }
            sighting => sighting,
        };
        if likely[0] >= likely[1] {
            by_both(by_cascade, likely[0])
        } else {
            by_both(by_patch, likely[1])
        }
    }
}

impl Detector for ChosenDetector {
    fn detect(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting {
        match self.choices.get(&request.landmark.id) {
            None | Some(DetectorChoice::Template) => self.template.detect(view, request),
            Some(DetectorChoice::Cascade) => self.cascade.detect(view, request),
            Some(DetectorChoice::Both) => self.both(view, request),
        }
    }
}
