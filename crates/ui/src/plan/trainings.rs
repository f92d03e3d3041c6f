//! Detectors being trained: which, how far, and what is kept so that they can go on after a reload.

use pilotage_core::landmark::Landmark;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::documents::Documents;
use crate::feature::FeatureContext;
use crate::host::Host;
use pilotage_jobs::{
    Job, JobEvent, JobId, MapSource, TrainOrder, TrainingLeft, TrainingOutcome, TrainingReport,
};

/// Key in the browser's storage.
pub const TRAININGS_KEY: &str = "trainings";
/// First byte of what is stored: the form of the bytes.
const FORM: u8 = 3;
/// Trainings that are worked on at a time; the others wait.
const AT_A_TIME: usize = 2;
/// Most trainings that are kept: those of the mission that is open before others, the latest of each.
const MOST_KEPT: usize = 40;

/// State of a training.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrainingState {
    /// For a worker.
    Waiting,
    /// At work.
    Working,
    /// It keeps its place.
    Paused,
    /// Over.
    Done,
    /// It came to nothing.
    Failed,
}

/// The training of one landmark.
#[derive(Debug)]
pub struct Training {
    /// Order of the training, and the state from which it can go on.
    pub order: TrainOrder,
    /// Whether it shall be worked on.
    wanted: bool,
    job: Option<JobId>,
    /// Whether the job keeps its place without working.
    is_held: bool,
    /// Whether people have yet to be told that it was left at an earlier visit.
    is_untold: bool,
    /// Last report of the worker.
    pub report: Option<TrainingReport>,
    /// Activity before the first report, in words.
    pub words: String,
    /// Result of the training.
    pub outcome: Option<TrainingOutcome>,
    /// Why nothing came of it.
    pub trouble: Option<String>,
}

impl Training {
    fn new(order: TrainOrder, wanted: bool) -> Self {
        Self {
            order,
            wanted,
            job: None,
            is_held: false,
            is_untold: false,
            report: None,
            words: String::new(),
            outcome: None,
            trouble: None,
        }
    }

    /// State of the training.
    pub fn state(&self) -> TrainingState {
        match (&self.outcome, &self.trouble) {
            (Some(_), _) => TrainingState::Done,
            (_, Some(_)) => TrainingState::Failed,
            _ if !self.wanted => TrainingState::Paused,
            _ if self.job.is_some() && !self.is_held => TrainingState::Working,
            _ => TrainingState::Waiting,
        }
    }

    fn is_over(&self) -> bool {
        matches!(self.state(), TrainingState::Done | TrainingState::Failed)
    }

    /// Reports on the whole stages.
    pub fn stages(&self) -> &[pilotage_core::training::StageReport] {
        let left = || self.order.left.as_ref().map(|l| l.stages.as_slice());
        let told = self.report.as_ref().map(|r| r.stages.as_slice());
        let ended = self.outcome.as_ref().map(|o| o.stages.as_slice());
        ended.or(told).or_else(left).unwrap_or_default()
    }

    /// Work so far, seconds.
    pub fn seconds(&self) -> f64 {
        let left = || self.order.left.as_ref().map(|l| l.seconds);
        let told = self.report.as_ref().map(|r| r.seconds);
        let ended = self.outcome.as_ref().map(|o| o.seconds);
        ended.or(told).or_else(left).unwrap_or(0.0)
    }

    /// Whether it is of that landmark of the mission that is open, or of any.
    fn is_meant(&self, which: Option<u32>, documents: &Documents) -> bool {
        which.is_none_or(|id| self.order.landmark.id == id) && is_here(self, documents)
    }

    /// Whether it is of the landmark as that is now.
    fn is_of(&self, landmark: &Landmark) -> bool {
        let of = &self.order.landmark;
        (of.id, of.bounds) == (landmark.id, landmark.bounds)
    }
}

/// Record of a training that is kept between visits.
#[derive(Debug, Serialize, Deserialize)]
struct KeptTraining {
    /// The version of the program, which alone goes on to the same detector.
    program: String,
    order: TrainOrder,
    outcome: Option<TrainingOutcome>,
}

/// All trainings.
#[derive(Debug, Default)]
pub struct Trainings {
    list: Vec<Training>,
    /// Jobs to be stopped.
    unwanted: Vec<JobId>,
    /// Detectors to be kept with their landmarks, and the map that each is of.
    ready: Vec<(MapSource, Landmark, TrainingOutcome)>,
    /// Whether there is something new to be stored.
    changed: bool,
}

impl Trainings {
    /// The training of a landmark as it is now, on the map that is open.
    pub fn of(&self, landmark: &Landmark, documents: &Documents) -> Option<&Training> {
        let map = &documents.map.source;
        let mut all = self.list.iter();
        all.find(|t| t.order.map == *map && t.is_of(landmark))
    }

    /// Result of the training that made the detector which a landmark has.
    pub fn outcome(&self, landmark: &Landmark, documents: &Documents) -> Option<&TrainingOutcome> {
        let outcome = self.of(landmark, documents)?.outcome.as_ref()?;
        (landmark.trained_text() == Some(&outcome.detector)).then_some(outcome)
    }

    /// Trainings of the landmarks of a mission over the map that is open that are not done.
    pub fn unfinished<'a>(
        &'a self,
        documents: &'a Documents,
    ) -> impl Iterator<Item = &'a Training> {
        let here = |t: &&Training| is_here(t, documents) && t.outcome.is_none();
        self.list.iter().filter(here)
    }

    /// Trains these; one that was left goes on. Those of other maps, and of what was other ground, stay as they are.
    pub fn ask(&mut self, orders: Vec<TrainOrder>) {
        for order in orders {
            let known = |t: &&mut Training| t.order.map == order.map && t.is_of(&order.landmark);
            match self.list.iter_mut().find(known) {
                Some(t) if !t.is_over() => t.wanted = true,
                Some(t) => {
                    self.unwanted.extend(t.job.take());
                    *t = Training::new(order, true);
                }
                None => self.list.push(Training::new(order, true)),
            }
        }
    }

    /// Lets trainings of the mission keep their place, or go on: of one landmark, or all that are not over.
    pub fn pause(&mut self, which: Option<u32>, pause: bool, documents: &Documents) {
        for t in &mut self.list {
            if t.is_meant(which, documents) && !t.is_over() {
                t.wanted = !pause;
            }
        }
    }

    /// Forgets the training of one landmark of the mission, or all that are not done.
    pub fn cancel(&mut self, which: Option<u32>, documents: &Documents) {
        let unwanted = &mut self.unwanted;
        self.list.retain_mut(|t| {
            let stays = t.outcome.is_some() || !t.is_meant(which, documents);
            if !stays {
                unwanted.extend(t.job.take());
            }
            stays
        });
        self.changed = true;
    }

    /// Takes what was stored at an earlier visit; it waits to be resumed.
    pub fn recall(&mut self, host: &dyn Host) {
        let bytes = host.recall(TRAININGS_KEY).unwrap_or_default();
        let body = bytes.strip_prefix(&[FORM]).unwrap_or_default();
        let kept: Vec<KeptTraining> = postcard::from_bytes(body).unwrap_or_default();
        let kept = kept.into_iter().filter(|k| k.program == program());
        self.list = kept
            .map(|kept| Training {
                is_untold: kept.outcome.is_none(),
                outcome: kept.outcome,
                ..Training::new(kept.order, false)
            })
            .collect();
    }

    /// Names of the landmarks of the mission that is open of which a training was left at an earlier visit, once.
    pub fn take_left(&mut self, documents: &Documents) -> Vec<String> {
        let untold = self.list.iter_mut();
        let untold = untold.filter(|t| t.is_untold && is_here(t, documents));
        let told = untold.map(|t| {
            t.is_untold = false;
            t.order.landmark.name.clone()
        });
        told.collect()
    }

    /// Encodes the trainings that are to be kept: those of other maps, and of boxes that were changed, first make room.
    fn encode(&self, documents: &Documents) -> Vec<u8> {
        let kept = self.list.iter().filter(|t| t.trouble.is_none());
        let mut kept: Vec<&Training> = kept.collect();
        let late = kept.len().saturating_sub(MOST_KEPT);
        kept.sort_by_key(|t| is_here(t, documents));
        let kept: Vec<KeptTraining> = kept[late..]
            .iter()
            .map(|t| KeptTraining {
                program: program(),
                order: t.order.clone(),
                outcome: t.outcome.clone(),
            })
            .collect();
        postcard::to_extend(&kept, vec![FORM]).unwrap_or_default()
    }

    /// Begins, holds and stops what is due.
    pub fn work(&mut self, context: &mut FeatureContext<'_>) {
        for id in self.unwanted.drain(..) {
            context.cancel(id);
        }
        for t in &mut self.list {
            // Of another map, or of a box that was changed, nothing is worked on.
            if t.job.is_some() && !is_here(t, context.documents) {
                t.wanted = false;
                if let Some(id) = t.job.take() {
                    context.cancel(id);
                }
            }
            if let Some(id) = t.job.filter(|_| !t.wanted && !t.is_held) {
                t.is_held = true;
                context.host.hold(id, true);
            }
        }
        let at_work = |t: &&Training| t.state() == TrainingState::Working;
        let mut room = AT_A_TIME.saturating_sub(self.list.iter().filter(at_work).count());
        for t in &mut self.list {
            if room == 0 {
                break;
            }
            if t.state() != TrainingState::Waiting || !is_here(t, context.documents) {
                continue;
            }
            room -= 1;
            t.is_held = false;
            if let Some(id) = t.job {
                context.host.hold(id, false);
            } else {
                "Waiting for a worker".clone_into(&mut t.words);
                t.report = None;
                t.job = Some(context.start(Job::Train(Box::new(t.order.clone()))));
                // What was only asked for is kept, too.
                self.changed = true;
            }
        }
        if std::mem::take(&mut self.changed) {
            context
                .host
                .store(TRAININGS_KEY, &self.encode(context.documents));
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        let Some(at) = self.list.iter().position(|t| t.job == Some(id)) else {
            return false;
        };
        let t = &mut self.list[at];
        match event {
            JobEvent::Progress(_, words) => t.words.clone_from(words),
            JobEvent::Training(report) => {
                if let Some(left) = &report.left {
                    t.order.left = Some(left.clone());
                    self.changed = true;
                }
                t.report = Some(report.as_ref().clone());
            }
            JobEvent::Trained(outcome) => {
                t.outcome = Some(outcome.as_ref().clone());
                t.order.left = None;
                let (map, landmark) = (t.order.map.clone(), t.order.landmark.clone());
                self.ready.push((map, landmark, outcome.as_ref().clone()));
                self.changed = true;
            }
            JobEvent::Failed(why) => {
                t.trouble = Some(why.clone());
                t.job = None;
                self.changed = true;
            }
            JobEvent::Finished | JobEvent::Cancelled => t.job = None,
            _ => return false,
        }
        true
    }

    /// Outcomes that nobody has taken yet, each with the map and the landmark as it was trained for.
    pub fn take_ready(&mut self) -> Vec<(MapSource, Landmark, TrainingOutcome)> {
        std::mem::take(&mut self.ready)
    }

    /// Trainings for journeys.
    pub fn json(&self, documents: &Documents) -> Value {
        let here = self.list.iter().filter(|t| is_here(t, documents));
        let all = here.map(|t| {
            let report = t.report.as_ref();
            json!({
                "id": t.order.landmark.id,
                "name": t.order.landmark.name,
                "state": format!("{:?}", t.state()),
                "phase": report.map(|r| format!("{:?}", r.phase)),
                "fraction": report.map(|r| r.fraction),
                "stages": t.stages().len(),
                "growing": report.and_then(|r| r.growing).map(|row| row.votes),
                "seconds": t.seconds(),
                "photos": t.order.plan.photos,
                "trouble": t.trouble,
                "outcome": t.outcome.as_ref().map(|o| json!({
                    "judged": o.judged,
                    "found": o.found,
                    "false_alarms": o.false_alarms,
                    "least_score": o.least_score,
                })),
            })
        });
        all.collect()
    }
}

fn program() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Whether a training is of a landmark as it is now, on the map that is open.
fn is_here(t: &Training, documents: &Documents) -> bool {
    let landmark = documents.mission.landmark(t.order.landmark.id);
    t.order.map == documents.map.source && landmark.is_some_and(|l| t.is_of(l))
}

/// State of a training that was left, in words.
pub fn left_words(left: Option<&TrainingLeft>) -> String {
    match left {
        Some(left) => format!("Paused at stage {}", left.stages.len() + 1),
        None => "Paused".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::{GroundPoint, GroundRect};

    use super::super::planner::Planner;
    use super::*;
    use crate::documents::Session;

    /// A mission over the map of a world with one landmark there, whose id is 1.
    fn over(world: &str, east: f64) -> Documents {
        let mut documents = Documents::new(&Session::demo());
        let bounds = GroundRect::centered(GroundPoint::new(0.0, east), 20.0, 20.0);
        documents.mission.landmarks = vec![Landmark::new(1, "Barn", bounds)];
        documents.map.source = MapSource::world(world);
        documents
    }

    fn order(documents: &Documents) -> Vec<TrainOrder> {
        Planner::default().train_orders(&[1], documents)
    }

    #[test]
    fn a_mission_of_another_map_leaves_the_trainings_of_the_same_number_alone() {
        let (here, there) = (over("here", 0.0), over("there", 0.0));
        let mut trainings = Trainings::default();
        let mut left = order(&here);
        left[0].left = Some(TrainingLeft {
            progress: vec![1],
            stages: Vec::new(),
            seconds: 5.0,
        });
        trainings.ask(left);
        trainings.pause(None, true, &here);
        trainings.ask(order(&there));
        trainings.pause(None, false, &there);
        trainings.cancel(None, &there);
        assert_eq!(trainings.unfinished(&there).count(), 0);
        let first = trainings.unfinished(&here).next();
        let first = first.expect("the training of the first mission");
        assert_eq!(first.state(), TrainingState::Paused);
        assert!((first.seconds() - 5.0).abs() < 1e-9, "its stages are kept");
        assert!(first.is_of(&here.mission.landmarks[0]));
    }

    #[test]
    fn a_training_is_of_the_ground_of_its_landmark() {
        let (before, after) = (over("here", 0.0), over("here", 90.0));
        let mut trainings = Trainings::default();
        trainings.ask(order(&before));
        trainings.ask(order(&after));
        trainings.cancel(Some(1), &after);
        assert_eq!(trainings.unfinished(&before).count(), 1);
        assert!(trainings.of(&after.mission.landmarks[0], &after).is_none());
    }

    #[test]
    fn a_training_that_can_go_on_stays_stored_however_often_other_boxes_were_tried() {
        let here = over("here", 0.0);
        let mut trainings = Trainings::default();
        trainings.ask(order(&here));
        for metres in 1..=u8::try_from(MOST_KEPT).expect("few") {
            trainings.ask(order(&over("here", f64::from(metres))));
        }
        let bytes = trainings.encode(&here);
        let kept: Vec<KeptTraining> = postcard::from_bytes(&bytes[1..]).expect("trainings");
        assert_eq!(kept.len(), MOST_KEPT);
        let bounds = here.mission.landmarks[0].bounds;
        let is_of = |it: &&KeptTraining| it.order.landmark.bounds == bounds;
        assert_eq!(kept.iter().filter(is_of).count(), 1);
    }

    #[test]
    fn what_was_left_is_told_once_where_it_can_be_resumed() {
        let (here, there) = (over("here", 0.0), over("there", 0.0));
        let mut trainings = Trainings::default();
        trainings.ask(order(&here));
        trainings.list[0].is_untold = true;
        assert!(trainings.take_left(&there).is_empty());
        assert_eq!(trainings.take_left(&here), ["Barn"]);
        assert!(trainings.take_left(&here).is_empty());
    }
}
