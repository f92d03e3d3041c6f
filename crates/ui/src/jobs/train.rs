//! A detector trained for a landmark from the map, a little in every call.
//!
//! What the page needs to know of a training passes it as bytes and as text: only workers hold the
//! programs that train cascades and read them.

use pilotage_core::camera::CameraModel;
use pilotage_core::flight::FrameSource as _;
use pilotage_core::landmark::Landmark;
use pilotage_core::landmark::cascade::train::StageRow;
use pilotage_core::mission::FrameLabels;
use pilotage_core::navigator::SensorNoise;
use pilotage_core::training::evaluation::AtThreshold;
use pilotage_core::training::{
    DetectorTraining, FlightEnvelope, Photo, StageReport, TrainingPhase, TrainingPlan,
    labelled_photos,
};
use serde::{Deserialize, Serialize};

use super::running::SLICE;
use super::{Advance, FlightSource, JobEvent, MapSource, RunningJob, Workshop, whole_bytes};

/// Time between two words on a training, milliseconds; what follows a whole stage is told at once.
const TOLD_EVERY: f64 = 400.0;

/// Which detector to train, and for which flights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainOrder {
    /// The map.
    pub map: MapSource,
    /// The landmark.
    pub landmark: Landmark,
    /// The camera.
    pub camera: CameraModel,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// Errors of the camera's pose of which the filter does not know.
    pub sensors: SensorNoise,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// How much it is shown.
    pub plan: TrainingPlan,
    /// Frames of a flight in which people showed the landmark, to learn from as well.
    pub labelled: Option<LabelledFrames>,
    /// Where the same training was left.
    pub left: Option<TrainingLeft>,
}

/// Frames of a flight, and what people said of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LabelledFrames {
    /// The flight.
    pub flight: FlightSource,
    /// The labels.
    pub labels: Vec<FrameLabels>,
}

/// Where a training can go on after its worker is gone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingLeft {
    /// Its stages that are whole, as the worker wrote them.
    #[serde(with = "whole_bytes")]
    pub progress: Vec<u8>,
    /// How they went.
    pub stages: Vec<StageReport>,
    /// Work in it, seconds.
    pub seconds: f64,
}

/// Where a training stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingReport {
    /// How much is done, about: 0 to 1.
    pub fraction: f32,
    /// What is being done.
    pub phase: TrainingPhase,
    /// How the whole stages went.
    pub stages: Vec<StageReport>,
    /// The stage that grows.
    pub growing: Option<StageRow>,
    /// Work so far, seconds.
    pub seconds: f64,
    /// Where it could go on, once another stage is whole.
    pub left: Option<TrainingLeft>,
}

/// What came of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingOutcome {
    /// The detector, as [`Landmark::trained_text`] says it.
    pub detector: String,
    /// How its stages went.
    pub stages: Vec<StageReport>,
    /// Held-out photos of the landmark, and those in which it is found.
    pub judged: usize,
    /// Of these, those in which it is found.
    pub found: usize,
    /// Of all held-out photos, those in which something else is taken for it.
    pub false_alarms: usize,
    /// Score from which on a mark counts.
    pub least_score: f64,
    /// Standard deviation of the place, north and east, metres.
    pub sigmas: [f64; 2],
    /// Work in it, seconds.
    pub seconds: f64,
}

/// A detector being trained.
pub struct Train {
    order: TrainOrder,
    /// What was read of the labelled frames, and of how many labels.
    labelled: Vec<Photo>,
    read: usize,
    training: Option<DetectorTraining>,
    /// Whole stages that were told.
    told: usize,
    told_at: f64,
    /// Work in this worker, milliseconds.
    worked: f64,
}

impl Train {
    /// Nothing done yet.
    pub fn new(order: TrainOrder) -> Self {
        Self {
            told: order.left.as_ref().map_or(0, |left| left.stages.len()),
            order,
            labelled: Vec::new(),
            read: 0,
            training: None,
            told_at: 0.0,
            worked: 0.0,
        }
    }

    /// Reads the next labelled frame; false if all are read.
    fn read_labelled(
        &mut self,
        workshop: &mut Workshop,
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
        let flight = workshop.flight(&frames.flight)?;
        let mut open = flight.borrow_mut();
        let (flight, pictures) = (open.flight.clone(), &mut open.frames);
        let labels = std::slice::from_ref(labels);
        let read = labelled_photos(&flight, labels, &order.landmark, |i| pictures.picture(i));
        self.labelled.extend(read.map_err(|why| why.to_string())?);
        Ok(true)
    }

    fn begin(&mut self, workshop: &mut Workshop) -> Result<DetectorTraining, String> {
        let order = &self.order;
        let map = workshop.cached_map(&order.map)?;
        let others = workshop.others(&order.map)?;
        let envelope = FlightEnvelope {
            ground_down: order.ground_down,
            ..FlightEnvelope::around(&order.camera, order.height, order.sensors)
        };
        let plan = order.plan.clone();
        let training =
            DetectorTraining::new(&order.landmark, &map, others.as_ref(), &envelope, plan)
                .with_labelled(std::mem::take(&mut self.labelled));
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
        workshop: &mut Workshop,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let begun = clock();
        if self.training.is_none() {
            if self.read_labelled(workshop, emit)? {
                self.worked += clock() - begun;
                return Ok(Advance::More);
            }
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.training = Some(self.begin(workshop)?);
        }
        let mut more = true;
        let mut now = begun;
        while let Some(training) = self.training.as_mut().filter(|_| more)
            && now - begun < SLICE
        {
            // A whole stage is told before the next begins, so that it can be kept.
            let whole = training.reports().len();
            more = training.advance().map_err(|why| why.to_string())?;
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

#[cfg(test)]
#[path = "train_tests.rs"]
mod tests;
