//! A detector trained for one landmark from the map alone, a little in every call.

use std::sync::Arc;

use nalgebra::Matrix2;
use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::envelope::FlightEnvelope;
use super::evaluation::{EvaluatedLook, EvaluatedMark, look};
use super::photo::Photographer;
use super::plan::TrainingPlan;
use super::sample::Sample;
use crate::imagery::Imagery;
use crate::landmark::Landmark;
use crate::landmark::cascade::train::{CascadeTraining, StageGoal, StageRow, TrainingSettings};
use crate::landmark::cascade::{Cascade, CascadeError, Patch, TrainedStage, responses};
use crate::landmark::trained::{DetectorWindow, Likelihood, TrainedDetector};
use crate::plan::OtherDays;

/// Of the photos, one in so many is of a look-alike, if there are any.
const LOOK_ALIKE_EVERY: usize = 4;
/// With fewer windows than this that pass though they should not, there is nothing left to learn from.
const FEWEST_FALSE: usize = 40;

/// Why a detector cannot be trained.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrainingError {
    /// It is too large for the pictures.
    #[error(
        "landmark \"{0}\" does not fit into a picture from that height; fly higher or mark a smaller box"
    )]
    TooLarge(String),
    /// Nothing in it tells it from its surroundings.
    #[error("landmark \"{0}\" cannot be told from its surroundings: no feature parts them")]
    Featureless(String),
    /// The cascade is none.
    #[error("the detector of landmark \"{name}\": {cause}")]
    Cascade {
        /// Of which landmark.
        name: String,
        /// What is wrong.
        cause: CascadeError,
    },
}

/// One stage of the table that people watch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageReport {
    /// How it went.
    pub row: StageRow,
    /// Share of all windows of something else that passed the stages before it.
    pub passed_before: f64,
}

/// Where a training stands.
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

/// What of a training is kept so that it can go on after a reload: stages that are whole.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrainingProgress {
    /// Stages, features numbered within the pool.
    pub stages: Vec<TrainedStage>,
    /// How they went.
    pub reports: Vec<StageReport>,
    /// Windows of something else that they learned from: the number of the photo, column, row.
    pub learned_from: Vec<Place>,
    /// Whether the last stage is among them, so that only the judging is left.
    pub complete: bool,
}

/// A window: the number of its photo, and its upper left corner.
type Place = (usize, (usize, usize));

/// A detector in the making; [`Self::advance`] does a little.
pub struct DetectorTraining {
    plan: TrainingPlan,
    landmark: Landmark,
    window: DetectorWindow,
    photographer: Photographer,
    judge: Photographer,
    positives: Vec<(Patch, usize)>,
    /// Searched pictures and their days.
    samples: Vec<(Sample, usize)>,
    kept: TrainingProgress,
    cascade: Option<CascadeTraining>,
    current: Option<Cascade>,
    passed_before: f64,
    mined: Vec<Place>,
    last: bool,
    /// How many of the windows kept belong to whole stages.
    learned: usize,
    windows: usize,
    next: usize,
    looks: Vec<EvaluatedLook>,
    phase: TrainingPhase,
}

impl DetectorTraining {
    /// Prepares to train a detector for `landmark` of `map`, which looks on other days as `others` says.
    pub fn new(
        landmark: &Landmark,
        map: &Arc<dyn Imagery>,
        others: &dyn OtherDays,
        envelope: &FlightEnvelope,
        plan: TrainingPlan,
    ) -> Self {
        let height = 0.5 * (envelope.height[0] + envelope.height[1]);
        let window = DetectorWindow::around(&landmark.bounds, height / envelope.camera.focal);
        let with = |days: usize, salt: u64| {
            let seed = plan.seed ^ salt;
            let days = others.spread(days.max(1), seed);
            Photographer::new(landmark, Arc::clone(map), &days, envelope.clone(), seed)
        };
        Self {
            photographer: with(plan.days, 0x7a1_0001),
            judge: with(plan.days, 0x7a1_0002),
            plan,
            landmark: landmark.clone(),
            window,
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

    /// What to keep of it.
    pub fn progress(&self) -> TrainingProgress {
        let stages = self.cascade.as_ref().map(|c| c.stages().to_vec());
        TrainingProgress {
            stages: stages.unwrap_or_else(|| self.kept.stages.clone()),
            reports: self.kept.reports.clone(),
            learned_from: self.kept.learned_from[..self.learned].to_vec(),
            complete: self.kept.complete,
        }
    }

    /// Where it stands.
    pub fn phase(&self) -> TrainingPhase {
        self.phase
    }

    /// The stage that grows, as it stands.
    pub fn growing(&self) -> Option<StageRow> {
        self.cascade.as_ref()?.growing()
    }

    /// How the whole stages went.
    pub fn reports(&self) -> &[StageReport] {
        &self.kept.reports
    }

    /// How much is done, about: 0 to 1.
    pub fn fraction(&self) -> f64 {
        let share = |next: usize, all: usize| next as f64 / all.max(1) as f64;
        match self.phase {
            TrainingPhase::Photos => 0.4 * share(self.next, self.plan.photos),
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
        let photo = match self.look_alike(self.next) {
            Some(place) => self.photographer.take_elsewhere(place),
            None => self.photographer.take(),
        };
        let photo = photo.ok_or_else(|| self.too_large())?;
        let mut random = ChaCha8Rng::seed_from_u64(self.plan.seed ^ (self.next as u64) << 8);
        let reach = self.photographer.reach();
        for _ in 0..self.plan.shown {
            let Some(assumed) = self.photographer.assume(&photo) else {
                continue;
            };
            let phase = (random.random::<f64>() - 0.5, random.random::<f64>() - 0.5);
            let envelope = self.photographer.envelope();
            let sample = Sample::of(&photo, &assumed, envelope, &self.window, reach, phase);
            if let Some(patch) = sample.landmark.and_then(|place| sample.patch(place)) {
                self.positives.push((patch, photo.day));
            }
            // Once is enough to search.
            if self.samples.len() <= self.next {
                self.samples.push((sample, photo.day));
            }
        }
        self.next += 1;
        if self.next >= self.plan.photos {
            return self.begin_cascade();
        }
        Ok(())
    }

    /// The look-alike that photo `number` is of.
    fn look_alike(&self, number: usize) -> Option<crate::frames::GroundPoint> {
        let places = &self.plan.look_alikes;
        let turn = number % LOOK_ALIKE_EVERY == LOOK_ALIKE_EVERY - 1;
        (turn && !places.is_empty()).then(|| places[number / LOOK_ALIKE_EVERY % places.len()])
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
        self.last = self.mined.len() < FEWEST_FALSE || stages >= self.plan.most_stages;
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
        let photo = match self.look_alike(self.next) {
            Some(place) => self.judge.take_elsewhere(place),
            None => self.judge.take(),
        };
        self.next += 1;
        let photo = photo.ok_or_else(|| self.too_large())?;
        if let Some(cascade) = &self.current {
            let look = look(&mut self.judge, &photo, cascade, &self.window);
            self.looks.extend(look);
        }
        Ok(())
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
        let right = marks.iter().filter(|m| m.right && m.score >= least_score);
        let (count, sum) = right.fold((0.0, Matrix2::zeros()), |(count, sum), m| {
            let v = nalgebra::Vector2::from(m.offset);
            (count + 1.0, sum + v * v.transpose())
        });
        let pixel = self.window.gsd;
        Some(TrainedDetector {
            cascade,
            window: self.window,
            bounds: self.landmark.bounds,
            least_score,
            likelihood: Likelihood::fit(&judged),
            // A pixel's worth of knowledge from before, so that few marks do not pretend to know.
            covariance: (sum + Matrix2::identity() * (0.5 * pixel).powi(2)) / (count + 1.0),
        })
    }
}
