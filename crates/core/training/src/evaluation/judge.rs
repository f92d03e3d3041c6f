//! A trained detector judged on photos that neither it nor its threshold has seen.

use std::f64::consts::TAU;
use std::sync::Arc;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{EvaluatedLook, EvaluatedMark};
use crate::{FlightEnvelope, Photographer, TrainingError, TrainingPhoto};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::Imagery;
use pilotage_simulate::other_days::OtherDays;
use pilotage_vision::landmark::cascade::Cascade;
use pilotage_vision::landmark::trained::{DetectorWindow, Mark, TrainedDetector, search};
use pilotage_vision::landmark::{Landmark, tolerance};

/// Number of photos of which one is of a place without the landmark.
const ELSEWHERE_EVERY: usize = 5;
/// Tries to find such a place on the map.
const TRIES: usize = 50;
/// Parts the days of judging from those of a training with the same seed.
const DAYS: u64 = 0x7a1_0e03;

/// Extent of a judging: the photos and days that are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JudgingPlan {
    /// Photos.
    pub photos: usize,
    /// Days on which they are taken.
    pub days: usize,
    /// Draws everything.
    pub seed: u64,
}

impl Default for JudgingPlan {
    fn default() -> Self {
        Self {
            photos: 200,
            days: 20,
            seed: 1,
        }
    }
}

/// Judges a detector, a photo in every call.
pub struct DetectorJudge {
    trained: TrainedDetector,
    landmark: Landmark,
    photographer: Photographer,
    ground: GroundRect,
    plan: JudgingPlan,
    random: ChaCha8Rng,
    next: usize,
    /// Photos so far without the landmark and with it, of which each go through all days.
    taken: [usize; 2],
    looks: Vec<EvaluatedLook>,
}

impl DetectorJudge {
    /// Judges what was `trained` for `landmark` of `map` from all over `envelope`, on days that `others`
    /// draws for judging.
    pub fn new(
        landmark: &Landmark,
        trained: TrainedDetector,
        map: &Arc<dyn Imagery>,
        others: &dyn OtherDays,
        envelope: &FlightEnvelope,
        plan: JudgingPlan,
    ) -> Self {
        let seed = plan.seed ^ DAYS;
        let days = others.photographed(plan.days.max(1), seed);
        let envelope = envelope.clone();
        Self {
            trained,
            landmark: landmark.clone(),
            photographer: Photographer::new(landmark, Arc::clone(map), &days, envelope, seed),
            ground: map.bounds(),
            plan,
            random: ChaCha8Rng::seed_from_u64(seed),
            next: 0,
            taken: [0; 2],
            looks: Vec::new(),
        }
    }

    /// Photos looked at, and photos in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.next, self.plan.photos)
    }

    /// Looks that were marked so far.
    pub fn looks(&self) -> &[EvaluatedLook] {
        &self.looks
    }

    /// Looks at the next photo; false once all are seen.
    ///
    /// # Errors
    /// If the landmark does not fit into the pictures.
    pub fn advance(&mut self) -> Result<bool, TrainingError> {
        if self.next >= self.plan.photos {
            return Ok(false);
        }
        let photo = self.photo()?;
        let TrainedDetector {
            cascade, window, ..
        } = &self.trained;
        let look = look(&mut self.photographer, &photo, cascade, window);
        self.looks.extend(look);
        Ok(true)
    }

    /// The next photo. If one counter chose day and kind, all photos without the landmark would be of days of their own
    /// wherever the days are a multiple of the turns.
    fn photo(&mut self) -> Result<TrainingPhoto, TrainingError> {
        let turn = self.next % ELSEWHERE_EVERY == ELSEWHERE_EVERY - 1;
        self.next += 1;
        let elsewhere = if turn { self.place_without() } else { None };
        let taken = &mut self.taken[usize::from(elsewhere.is_none())];
        self.photographer.turn_to(*taken);
        *taken += 1;
        let photo = match elsewhere {
            Some(place) => self.photographer.take_elsewhere(place),
            None => self.photographer.take(),
        };
        photo.ok_or_else(|| TrainingError::TooLarge(self.landmark.name.clone()))
    }

    /// A place on the map from which the search does not reach the landmark.
    fn place_without(&mut self) -> Option<GroundPoint> {
        let near = self.photographer.apart();
        let center = self.landmark.bounds.center();
        let within = self.ground.grown(-near);
        (0..TRIES).find_map(|_| {
            let distance = near * (1.0 + 4.0 * self.random.random::<f64>());
            let (sin, cos) = (TAU * self.random.random::<f64>()).sin_cos();
            let place =
                GroundPoint::new(center.north + distance * cos, center.east + distance * sin);
            within.contains(&place).then_some(place)
        })
    }
}

/// Looks in a photo for what `cascade` finds in windows like `window`, from where the filter may think that it
/// was taken; `None` if the photo's place does not appear on the ground from there.
pub(crate) fn look(
    photographer: &mut Photographer,
    photo: &TrainingPhoto,
    cascade: &Cascade,
    window: &DetectorWindow,
) -> Option<EvaluatedLook> {
    let assumed = photographer.assume(photo)?;
    let envelope = photographer.envelope();
    let reach = photographer.reach();
    let view = photo.view(&assumed, envelope.ground_down);
    // Where the filter expects it: its map place, which appears elsewhere by the pose's error.
    let middle = photo.around.center();
    let marks = search(cascade, window, &view, middle, (reach, reach)).unwrap_or_default();
    let near = photo
        .present
        .then(|| tolerance(photo.height / envelope.camera.focal));
    let mark = |m: &Mark| EvaluatedMark::of(m, &assumed.appears, near);
    Some(EvaluatedLook {
        day: photo.day,
        height: photo.height,
        tilt: photo.known_tilt[0].hypot(photo.known_tilt[1]),
        heading_error: assumed.heading_error,
        log_scale: assumed.log_scale,
        real: false,
        present: photo.present,
        marks: marks.iter().map(mark).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{FarmDays, envelope, farm, house};
    use pilotage_vision::landmark::cascade::{
        Cascade, CascadeFeature, NodeSplit, TrainedStage, TrainedTree,
    };
    use pilotage_vision::landmark::trained::{Likelihood, MarkPrecision, Variants};

    /// A detector of one stump.
    fn detector(landmark: &Landmark) -> TrainedDetector {
        let feature = CascadeFeature::Hog {
            cell: [0, 0, 8, 8],
            component: 3,
        };
        let stump = TrainedTree::stump(0, NodeSplit::Threshold(0.1), -1.0, 1.0);
        let stage = TrainedStage {
            trees: vec![stump],
            threshold: -2.0,
        };
        let window = DetectorWindow::around(&landmark.bounds, 0.8, Variants::default());
        let (width, height) = (window.width, window.height);
        TrainedDetector {
            cascade: Cascade::from_parts(width, height, vec![feature], &[stage]).unwrap(),
            window,
            bounds: landmark.bounds,
            least_score: 1.0,
            likelihood: Likelihood {
                offset: 0.0,
                slope: 1.0,
            },
            precision: MarkPrecision::even(1.0),
            template: None,
        }
    }

    #[test]
    fn every_day_has_photos_with_the_landmark_and_without_it() {
        let (landmark, days) = (house(), 20);
        let plan = JudgingPlan {
            photos: 200,
            days,
            seed: 1,
        };
        let trained = detector(&landmark);
        let mut judge =
            DetectorJudge::new(&landmark, trained, &farm(), &FarmDays, &envelope(), plan);
        let mut counts = vec![[0; 2]; days];
        for _ in 0..plan.photos {
            let photo = judge.photo().unwrap();
            counts[photo.day][usize::from(photo.present)] += 1;
        }
        assert_eq!(counts, vec![[2, 8]; days]);
    }
}
