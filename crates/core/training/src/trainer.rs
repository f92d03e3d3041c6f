//! A detector trained for one landmark from the map alone, a little in every call.

use std::sync::Arc;

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::envelope::FlightEnvelope;
use super::evaluation::{EvaluatedLook, EvaluatedMark, look};
use super::held_out::{HeldOutPhotos, TrainingPhotos, look_alike};
use super::labelled::in_stretches;
use super::photo::{Photographer, TrainingPhoto};
use super::plan::TrainingPlan;
use super::precision;
use super::sample::TrainingSample;
use super::training_error::TrainingError;
use pilotage_raster::imagery::Imagery;
use pilotage_simulate::other_days::OtherDays;
use pilotage_vision::landmark::cascade::train::{
    CascadeTraining, StageGoal, StageRow, TrainingSettings,
};
use pilotage_vision::landmark::cascade::{Cascade, CascadeError, Patch, TrainedStage, responses};
use pilotage_vision::landmark::trained::{
    DetectorWindow, Likelihood, TemplateLikelihood, TrainedDetector, Variants,
};
use pilotage_vision::landmark::{Detector, Landmark, SearchRequest, TemplateDetector, tolerance};

/// Of the held-out photos, one in so many is also looked at for the landmark's map patch.
const TEMPLATE_EVERY: usize = 3;
/// With fewer windows than this that pass though they should not, there is nothing left to learn from.
const FEWEST_FALSE: usize = 40;

/// Stage of the table that people watch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageReport {
    /// Result of the stage.
    pub row: StageRow,
    /// Share of all windows of something else that passed the stages before it.
    pub passed_before: f64,
}

/// Phase of a training.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrainingPhase {
    /// Photos are taken.
    Photos,
    /// The pictures are searched for what the stages so far take for the landmark.
    Mining,
    /// Votes are found.
    Voting,
    /// It is judged on photos that it was not trained on.
    Judging,
    /// Done.
    Done,
}

/// Part of a training that is kept so that it can go on after a reload: stages that are whole.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrainingProgress {
    /// Stages, features numbered within the pool.
    pub stages: Vec<TrainedStage>,
    /// Reports of the stages.
    pub reports: Vec<StageReport>,
    /// Windows of something else that they learned from: the number of the photo, column, row.
    pub learned_from: Vec<PhotoWindow>,
    /// Whether the last stage is among them, so that only the judging is left.
    pub complete: bool,
}

/// A window: the number of its photo, and its upper left corner.
type PhotoWindow = (usize, (usize, usize));

/// A detector in the making; [`Self::advance`] does a little.
pub struct DetectorTraining {
    plan: TrainingPlan,
    landmark: Landmark,
    window: DetectorWindow,
    photographer: Photographer,
    /// Says what the filter thinks of the photos by which it is judged, and takes them.
    judge: Photographer,
    held_out: TrainingPhotos,
    /// Real frames to learn from, too.
    labelled: Vec<TrainingPhoto>,
    positives: Vec<(Patch, usize)>,
    /// Searched pictures and their days.
    samples: Vec<(TrainingSample, usize)>,
    kept: TrainingProgress,
    cascade: Option<CascadeTraining>,
    current: Option<Cascade>,
    passed_before: f64,
    mined: Vec<PhotoWindow>,
    last: bool,
    /// Number of the windows kept that belong to whole stages.
    learned: usize,
    windows: usize,
    next: usize,
    looks: Vec<EvaluatedLook>,
    /// The landmark by its map patch, and scores of places by it with whether they were right.
    template: TemplateDetector,
    by_patch: Vec<(f64, bool)>,
    phase: TrainingPhase,
}

impl DetectorTraining {
    /// Prepares to train a detector for `landmark` of `map`, which looks on other days as `others` says.
    pub fn new(
        landmark: &Landmark,
        map: &Arc<dyn Imagery>,
        others: &dyn OtherDays,
        envelope: &FlightEnvelope,
        mut plan: TrainingPlan,
    ) -> Self {
        let height = 0.5 * (envelope.height[0] + envelope.height[1]);
        let variants = Variants {
            preparation: plan.preparation,
            ..envelope.variants()
        };
        let gsd = height / envelope.camera.focal;
        let window = DetectorWindow::around(&landmark.bounds, gsd, variants);
        let (days, seed) = (plan.days.max(1), plan.seed);
        let with = |salt: u64| {
            let seed = seed ^ salt;
            let days = others.photographed(days, seed);
            Photographer::new(landmark, Arc::clone(map), &days, envelope.clone(), seed)
        };
        let photographer = with(0x7a1_0001);
        let judge = with(0x7a1_0002);
        // Photos of those so near that the landmark may stand beside them are photos of the landmark.
        let apart = photographer.apart();
        plan.look_alikes
            .retain(|place| place.distance(&landmark.bounds.center()) > apart);
        Self {
            photographer,
            held_out: Box::new(HeldOutPhotos::new(
                judge.clone(),
                &plan.look_alikes,
                plan.held_out,
            )),
            judge,
            template: TemplateDetector::new(Arc::clone(map), plan.template),
            plan,
            landmark: landmark.clone(),
            window,
            labelled: Vec::new(),
            positives: Vec::new(),
            samples: Vec::new(),
            kept: TrainingProgress::default(),
            cascade: None,
            current: None,
            passed_before: 1.0,
            mined: Vec::new(),
            last: false,
            learned: 0,
            windows: 0,
            next: 0,
            looks: Vec::new(),
            by_patch: Vec::new(),
            phase: TrainingPhase::Photos,
        }
    }

    /// Goes on where the same training was left.
    #[must_use]
    pub fn resumed(mut self, progress: TrainingProgress) -> Self {
        self.learned = progress.learned_from.len();
        self.kept = progress;
        self
    }

    /// Learns from real frames, too (see [`super::labelled_photos`]); to be said before anything else, and
    /// the same again when a training is resumed.
    #[must_use]
    pub fn with_labelled(mut self, photos: Vec<TrainingPhoto>) -> Self {
        self.labelled = in_stretches(photos);
        self
    }

    /// Has the photos by which it is to be judged taken elsewhere, such as by another thread: `through` is
    /// given them and gives them back.
    #[must_use]
    pub fn with_held_out(mut self, through: impl FnOnce(TrainingPhotos) -> TrainingPhotos) -> Self {
        self.held_out = through(self.held_out);
        self
    }

    /// Photos that it learns from, real frames among them.
    pub(super) fn all_photos(&self) -> usize {
        self.plan.photos + self.labelled.len()
    }

    /// Part of the training to keep.
    pub fn progress(&self) -> TrainingProgress {
        let stages = self.cascade.as_ref().map(|c| c.stages().to_vec());
        TrainingProgress {
            stages: stages.unwrap_or_else(|| self.kept.stages.clone()),
            reports: self.kept.reports.clone(),
            learned_from: self.kept.learned_from[..self.learned].to_vec(),
            complete: self.kept.complete,
        }
    }

    /// Phase of the training.
    pub fn phase(&self) -> TrainingPhase {
        self.phase
    }

    /// The stage that grows, as it stands.
    pub fn growing(&self) -> Option<StageRow> {
        self.cascade.as_ref()?.growing()
    }

    /// Reports of the whole stages.
    pub fn reports(&self) -> &[StageReport] {
        &self.kept.reports
    }

    /// Share that is done, about: 0 to 1.
    pub fn fraction(&self) -> f64 {
        let share = |next: usize, all: usize| next as f64 / all.max(1) as f64;
        match self.phase {
            TrainingPhase::Photos => 0.4 * share(self.next, self.all_photos()),
            TrainingPhase::Mining | TrainingPhase::Voting => {
                let stage = self.kept.reports.len() as f64;
                // Stages grow rarer; about six are usual.
                0.4 + 0.3 * (1.0 - (-stage / 3.0).exp())
            }
            TrainingPhase::Judging => 0.7 + 0.3 * share(self.next, self.plan.held_out),
            TrainingPhase::Done => 1.0,
        }
    }

    /// Photos on which it was judged, and what it marked in them.
    pub fn looks(&self) -> &[EvaluatedLook] {
        &self.looks
    }

    /// Does a little: a photo, a search, a vote. False once it is done.
    ///
    /// # Errors
    /// If the landmark does not fit into the pictures or nothing tells it from its surroundings.
    pub fn advance(&mut self) -> Result<bool, TrainingError> {
        match self.phase {
            TrainingPhase::Photos => self.take_photo()?,
            TrainingPhase::Mining => self.mine()?,
            TrainingPhase::Voting => self.vote()?,
            TrainingPhase::Judging => self.judge()?,
            TrainingPhase::Done => return Ok(false),
        }
        Ok(true)
    }

    fn too_large(&self) -> TrainingError {
        TrainingError::TooLarge(self.landmark.name.clone())
    }

    fn broken(&self, cause: CascadeError) -> TrainingError {
        TrainingError::Cascade {
            name: self.landmark.name.clone(),
            cause,
        }
    }

    fn take_photo(&mut self) -> Result<(), TrainingError> {
        let taken = if self.next >= self.plan.photos {
            None
        } else {
            let taken = match look_alike(&self.plan.look_alikes, self.next) {
                Some(place) => self.photographer.take_elsewhere(place),
                None => self.photographer.take(),
            };
            Some(taken.ok_or_else(|| self.too_large())?)
        };
        let real = self.next.checked_sub(self.plan.photos);
        let Some(photo) = taken.as_ref().or_else(|| self.labelled.get(real?)) else {
            return self.begin_cascade();
        };
        let mut random = ChaCha8Rng::seed_from_u64(self.plan.seed ^ (self.next as u64) << 8);
        let reach = self.photographer.reach();
        for _ in 0..self.plan.shown {
            let Some(assumed) = self.photographer.assume(photo) else {
                continue;
            };
            let phase = (random.random::<f64>() - 0.5, random.random::<f64>() - 0.5);
            let variants = &self.window.variants;
            let best = variants.nearest(assumed.rotation(), assumed.log_scale);
            // What is searched may be in any variant, and once is enough to search.
            let is_searched = self.samples.len() <= self.next;
            let mut variant = best;
            if is_searched && variants.count() > 1 {
                variant = variants.at(random.random_range(0..variants.count()));
            }
            let envelope = self.photographer.envelope();
            let of = |variant| {
                TrainingSample::of(
                    photo,
                    &assumed,
                    envelope,
                    &self.window,
                    variant,
                    reach,
                    phase,
                )
            };
            let mut sample = of(&best);
            if let Some(found) = &sample
                && let Some(patch) = found.landmark.and_then(|place| found.patch(place))
            {
                self.positives.push((patch, photo.day));
            }
            if variant != best {
                sample = of(&variant);
            }
            if let Some(sample) = sample.filter(|_| is_searched) {
                self.samples.push((sample, photo.day));
            }
        }
        self.next += 1;
        if self.next >= self.all_photos() {
            return self.begin_cascade();
        }
        Ok(())
    }

    fn begin_cascade(&mut self) -> Result<(), TrainingError> {
        let positives = std::mem::take(&mut self.positives);
        let settings = TrainingSettings {
            kind: self.plan.kind,
            width: self.window.width,
            height: self.window.height,
            seed: self.plan.seed,
        };
        let training = CascadeTraining::new(settings, positives);
        self.cascade = Some(training.resumed(self.kept.stages.clone()));
        self.begin_mining();
        if self.kept.complete {
            return self.begin_judging();
        }
        Ok(())
    }

    fn begin_mining(&mut self) {
        self.mined.clear();
        (self.next, self.windows) = (0, 0);
        self.current = self
            .cascade
            .as_ref()
            .and_then(|c| c.cascade().ok().flatten());
        self.phase = TrainingPhase::Mining;
    }

    /// Searches one picture for windows that pass all stages so far though they should not.
    fn mine(&mut self) -> Result<(), TrainingError> {
        if let Some((sample, _)) = self.samples.get(self.next) {
            let said = self
                .current
                .as_ref()
                .map(|c| (c, responses(c, &sample.picture)));
            for row in 0..sample.others.height() {
                for column in 0..sample.others.width() {
                    if sample.others.get(column, row) == 0 {
                        continue;
                    }
                    self.windows += 1;
                    let passes = said.as_ref().is_none_or(|(cascade, said)| {
                        usize::from(said.stages.get(column, row)) == cascade.stages.len()
                    });
                    if passes {
                        self.mined.push((self.next, (column, row)));
                    }
                }
            }
            self.next += 1;
            return Ok(());
        }
        let stages = self.cascade.as_ref().map_or(0, |c| c.stages().len());
        self.passed_before = self.mined.len() as f64 / self.windows.max(1) as f64;
        // After a stage that missed its goal, only one that weighs everything can do better.
        let missed = |r: &StageReport| r.row.false_alarm_rate > self.plan.goal.false_alarm_rate;
        self.last = self.mined.len() < FEWEST_FALSE
            || stages >= self.plan.most_stages
            || self.kept.reports.last().is_some_and(missed);
        let mut random = ChaCha8Rng::seed_from_u64(self.plan.seed ^ (stages as u64) << 32);
        let count = self.plan.negatives.min(self.mined.len());
        let chosen = index::sample(&mut random, self.mined.len(), count);
        self.kept
            .learned_from
            .extend(chosen.iter().map(|i| self.mined[i]));
        let from = if self.last {
            0
        } else {
            self.kept.learned_from.len() - count
        };
        let negatives: Vec<(Patch, usize)> = self.kept.learned_from[from..]
            .iter()
            .filter_map(|(sample, place)| {
                let (sample, day) = &self.samples[*sample];
                Some((sample.patch(*place)?, *day))
            })
            .collect();
        let goal = if self.last {
            StageGoal {
                false_alarm_rate: -1.0,
                most_votes: self.plan.last_votes,
                ..self.plan.goal
            }
        } else {
            self.plan.goal
        };
        self.phase = TrainingPhase::Voting;
        let begun = self
            .cascade
            .as_mut()
            .map(|c| c.begin_stage(&negatives, goal));
        begun.unwrap_or(Ok(())).map_err(|cause| self.broken(cause))
    }

    fn vote(&mut self) -> Result<(), TrainingError> {
        let Some(cascade) = &mut self.cascade else {
            return Ok(());
        };
        let Some(row) = cascade.vote() else {
            return Ok(());
        };
        if row.votes == 0 {
            // Nothing parts the two any further.
            return self.begin_judging();
        }
        self.kept.reports.push(StageReport {
            row,
            passed_before: self.passed_before,
        });
        self.learned = self.kept.learned_from.len();
        self.begin_mining();
        if self.last {
            self.kept.complete = true;
            return self.begin_judging();
        }
        Ok(())
    }

    fn begin_judging(&mut self) -> Result<(), TrainingError> {
        if self.current.is_none() {
            return Err(TrainingError::Featureless(self.landmark.name.clone()));
        }
        self.next = 0;
        self.samples.clear();
        self.mined.clear();
        self.phase = TrainingPhase::Judging;
        Ok(())
    }

    fn judge(&mut self) -> Result<(), TrainingError> {
        if self.next >= self.plan.held_out {
            self.phase = TrainingPhase::Done;
            return Ok(());
        }
        self.next += 1;
        let photo = self.held_out.next().ok_or_else(|| self.too_large())?;
        if let Some(cascade) = &self.current {
            let look = look(&mut self.judge, &photo, cascade, &self.window);
            self.looks.extend(look);
        }
        if self.next.is_multiple_of(TEMPLATE_EVERY) {
            let places = self.look_by_patch(&photo);
            self.by_patch.extend(places);
        }
        Ok(())
    }

    /// Scores of the landmark's map patch in a photo, and whether they are those of the right place.
    fn look_by_patch(&mut self, photo: &TrainingPhoto) -> Vec<(f64, bool)> {
        let Some(assumed) = self.judge.assume(photo) else {
            return Vec::new();
        };
        let envelope = self.judge.envelope();
        // What appears at a place here is the middle of the box, wherever in it the reference point is.
        let landmark = Landmark {
            reference: self.landmark.bounds.center(),
            ..self.landmark.clone()
        };
        let request = SearchRequest {
            landmark: &landmark,
            displacement_covariance: assumed.covariance,
            turn_deviation: envelope.sensors.yaw,
            log_scale_deviation: envelope.sensors.height / photo.height,
        };
        let view = photo.view(&assumed, envelope.ground_down);
        let sighting = self.template.detect(&view, &request);
        let near = tolerance(photo.height / envelope.camera.focal);
        sighting.best().map_or_else(Vec::new, |best| {
            let is_near = best.ground.distance(&assumed.appears) <= near;
            vec![
                (best.score, photo.present && is_near),
                (best.second_score, false),
            ]
        })
    }

    /// The detector, once it is done.
    pub fn trained(&self) -> Option<TrainedDetector> {
        let cascade = self
            .current
            .clone()
            .filter(|_| self.phase == TrainingPhase::Done)?;
        let marks: Vec<&EvaluatedMark> = self.looks.iter().flat_map(|l| &l.marks).collect();
        let judged: Vec<(f64, bool)> = marks.iter().map(|m| (m.score, m.right)).collect();
        let mut wrong: Vec<f64> = judged.iter().filter(|m| !m.1).map(|m| m.0).collect();
        wrong.sort_unstable_by(|a, b| b.total_cmp(a));
        let allowed = (self.plan.false_alarms * self.looks.len() as f64).floor() as usize;
        // Just above the first false alarm too many; what did not pass every stage never counts.
        let least_score = wrong.get(allowed).map_or(0.0, |s| s.next_up().max(0.0));
        let likelihood = Likelihood::fit(&judged);
        let precision = precision::learned(&self.looks, least_score, self.window.gsd);
        Some(TrainedDetector {
            cascade,
            window: self.window,
            bounds: self.landmark.bounds,
            least_score,
            likelihood,
            precision,
            template: TemplateLikelihood::learned(&self.by_patch),
        })
    }
}
