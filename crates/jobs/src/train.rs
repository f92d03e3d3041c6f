//! A detector trained for a landmark from the map, a little in every call.
//!
//! What the page needs to know of a training passes it as bytes and as text: only workers hold the
//! programs that train cascades and read them.

use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameSource as _};
use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::distinctness;
use pilotage_core::mission::FrameLabels;
use pilotage_core::training::evaluation::AtThreshold;
use pilotage_core::training::{DetectorTraining, FlightEnvelope, TrainingPhoto, labelled_photos};

use super::order::{Order, Reads, Urgency, VariantOrder, WorkerRole, around, keys_of};
use super::running::SLICE;
use super::{
    Advance, JobEvent, MapSource, RunningJob, TrainOrder, TrainingLeft, TrainingOutcome,
    TrainingReport, WorkerState,
};

/// Time between two words on a training, milliseconds; what follows a whole stage is told at once.
const TOLD_EVERY: f64 = 400.0;

impl TrainOrder {
    /// Envelope of the flights around the planned one.
    pub fn envelope(&self) -> FlightEnvelope {
        FlightEnvelope {
            ground_down: self.ground_down,
            ..FlightEnvelope::around(&self.camera, self.height, self.sensors)
        }
    }

    /// The place that the landmark's map patch would be taken for it, if there is one within reach.
    fn look_alike(&self, map: &dyn Imagery) -> Option<GroundPoint> {
        if self.look_alikes_within <= 0.0 {
            return None;
        }
        let found = distinctness(map, &self.landmark.bounds, self.look_alikes_within);
        let least = self.plan.template.least_score;
        let (place, score) = found.look_alike?;
        (score >= least).then_some(place)
    }
}

/// A detector being trained.
pub struct Train {
    order: TrainOrder,
    envelope: FlightEnvelope,
    /// Photos of the labelled frames read so far, and the number of labels read.
    labelled: Vec<TrainingPhoto>,
    read: usize,
    /// Flight of the labelled frames as its mission has it flown.
    flown: Option<Arc<Flight>>,
    training: Option<DetectorTraining>,
    /// Whole stages that were told.
    told: usize,
    told_at: f64,
    /// Work in this worker, milliseconds.
    worked: f64,
}

impl Train {
    /// Nothing done yet of an order for flights in an envelope.
    pub fn new(order: TrainOrder, envelope: FlightEnvelope) -> Self {
        Self {
            told: order.left.as_ref().map_or(0, |left| left.stages.len()),
            order,
            envelope,
            labelled: Vec::new(),
            read: 0,
            flown: None,
            training: None,
            told_at: 0.0,
            worked: 0.0,
        }
    }

    /// Reads the next labelled frame; false if all are read.
    fn read_labelled(
        &mut self,
        worker: &mut WorkerState,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<bool, String> {
        let order = &self.order;
        let Some(frames) = &order.labelled else {
            return Ok(false);
        };
        let Some(labels) = frames.labels.get(self.read) else {
            return Ok(false);
        };
        self.read += 1;
        let words = format!(
            "Reading labelled frame {} of {}",
            self.read,
            frames.labels.len()
        );
        emit(JobEvent::Progress(0.0, words));
        let open = worker.flight(&frames.flight)?;
        let mut open = open.borrow_mut();
        let flown = self
            .flown
            .get_or_insert_with(|| frames.camera.flown(&open.flight));
        let (flight, pictures) = (Arc::clone(flown), &mut open.frames);
        // Of one picture the labels of this flight may stand beside some that name none.
        let place = FrameLabels::place_among(&frames.labels, &flight.identity(), &labels.frame);
        if place != Some(self.read - 1) {
            return Ok(true);
        }
        let labels = std::slice::from_ref(labels);
        let read = labelled_photos(&flight, labels, &order.landmark, |i| pictures.picture(i));
        self.labelled.extend(read.map_err(|why| why.to_string())?);
        Ok(true)
    }

    fn begin(&mut self, worker: &mut WorkerState) -> Result<DetectorTraining, String> {
        let order = &self.order;
        let map = worker.cached_map(&order.map)?;
        let others = worker.others(&order.map)?;
        let mut plan = order.plan.clone();
        plan.look_alikes.extend(order.look_alike(map.as_ref()));
        let envelope = &self.envelope;
        let mut training =
            DetectorTraining::new(&order.landmark, &map, others.as_ref(), envelope, plan)
                .with_labelled(std::mem::take(&mut self.labelled));
        if let Some(elsewhere) = worker.elsewhere {
            training = training.with_held_out(elsewhere);
        }
        let left = order.left.as_ref();
        let progress = left.and_then(|left| postcard::from_bytes(&left.progress).ok());
        Ok(match progress {
            Some(progress) => training.resumed(progress),
            None => training,
        })
    }

    fn seconds(&self) -> f64 {
        let before = self.order.left.as_ref().map_or(0.0, |left| left.seconds);
        before + 1e-3 * self.worked
    }

    /// Says where it stands, if something new is to be said.
    fn tell(&mut self, now: f64, emit: &mut dyn FnMut(JobEvent)) {
        let seconds = self.seconds();
        let Some(training) = &self.training else {
            return;
        };
        let stages = training.reports();
        let is_whole = stages.len() > self.told;
        if !is_whole && now - self.told_at < TOLD_EVERY {
            return;
        }
        let left = is_whole.then(|| TrainingLeft {
            progress: postcard::to_stdvec(&training.progress()).unwrap_or_default(),
            stages: stages.to_vec(),
            seconds,
        });
        emit(JobEvent::Training(Box::new(TrainingReport {
            fraction: training.fraction() as f32,
            phase: training.phase(),
            stages: stages.to_vec(),
            growing: training.growing(),
            seconds,
            left,
        })));
        (self.told, self.told_at) = (stages.len(), now);
    }

    fn outcome(&self) -> Option<TrainingOutcome> {
        let training = self.training.as_ref()?;
        let trained = training.trained()?;
        let mut landmark = self.order.landmark.clone();
        landmark.keep_trained(Some(&trained));
        let judged = AtThreshold::over(training.looks(), trained.least_score);
        Some(TrainingOutcome {
            detector: landmark.trained_text()?.to_owned(),
            stages: training.reports().to_vec(),
            judged: judged.found.of,
            found: judged.found.happened,
            false_alarms: judged.deceived.happened,
            least_score: trained.least_score,
            sigmas: [0, 1].map(|axis| trained.precision.covariance[(axis, axis)].sqrt()),
            seconds: self.seconds(),
        })
    }
}

impl RunningJob for Train {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let begun = clock();
        if self.training.is_none() {
            if self.read_labelled(worker, emit)? {
                self.worked += clock() - begun;
                return Ok(Advance::More);
            }
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.training = Some(self.begin(worker)?);
        }
        let mut more = true;
        let mut now = begun;
        while let Some(training) = self.training.as_mut().filter(|_| more)
            && now - begun < SLICE
        {
            // A whole stage is told before the next begins, so that it can be kept.
            let whole = training.reports().len();
            more = training.advance().map_err(|why| {
                let words = why.to_string();
                emit(JobEvent::Untrainable(words.clone()));
                words
            })?;
            now = clock();
            if training.reports().len() > whole {
                break;
            }
        }
        self.worked += now - begun;
        self.tell(now, emit);
        if more {
            return Ok(Advance::More);
        }
        let outcome = self.outcome().ok_or("the training came to no end")?;
        emit(JobEvent::Trained(Box::new(outcome)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for TrainOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        let labelled = self.labelled.as_ref();
        keys_of(labelled.map(|frames| &frames.flight), Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        // Photos of what looks like it reach as far around that.
        let area = self.landmark.bounds.grown(self.look_alikes_within);
        Some((&self.map, Reads::Areas(vec![around(&area)])))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        let envelope = self.envelope();
        Box::new(Train::new(self, envelope))
    }
}

impl TrainOrder {
    /// Training for flights in another envelope than that around the planned one.
    pub fn within(self, envelope: FlightEnvelope) -> VariantOrder<Self> {
        VariantOrder::new(self, move |order| Box::new(Train::new(order, envelope)))
    }
}

#[cfg(test)]
#[path = "train_tests.rs"]
mod tests;
