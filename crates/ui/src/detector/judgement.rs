//! Judgement of a detector where it was not trained: asked for, taken.

use pilotage_core::landmark::{DetectorChoice, Landmark};
use pilotage_core::mission::FrameLabels;
use pilotage_core::plan::Proposal;
use pilotage_jobs::{
    EvaluationOrder, EvaluationReport, FlightSource, FlownCamera, Job, JobEvent, JobId,
};
use serde_json::Value;

use super::evaluation::EvaluationView;
use crate::documents::Documents;
use crate::feature::FeatureContext;
use crate::plan::flown;
use crate::state_json::object;

/// Judgement of a detector, and the dialog that shows it.
#[derive(Default)]
pub(super) struct Judgement {
    pub is_open: bool,
    /// Landmark whose detector it is.
    pub landmark: Option<u32>,
    /// Job under way, its progress, 0 to 1, and its words.
    pub job: Option<(JobId, f32, String)>,
    pub report: Option<EvaluationReport>,
    /// Order of what was judged, and of what it was judged by.
    of: Option<Box<EvaluationOrder>>,
    pub trouble: Option<String>,
    pub view: EvaluationView,
}

impl Judgement {
    /// Shows how well the detector of a landmark does, after judging it unless that was done: of the one that is
    /// selected, else of the one that is `looked_at`, else of any that has one.
    pub fn open(&mut self, looked_at: Option<u32>, context: &mut FeatureContext<'_>) {
        let selection = *context.selection;
        let mission = &context.documents.mission;
        let others = mission.landmarks.iter().map(|l| l.id);
        let candidates = selection.into_iter().chain(looked_at).chain(others);
        let mut landmarks = candidates.filter_map(|id| mission.landmark(id));
        let Some(landmark) = landmarks.find(|l| l.is_trained()).cloned() else {
            let text = "Train a detector for a landmark first.";
            return context.note("No detector to evaluate", text);
        };
        self.is_open = true;
        let of = judging(&landmark, context.documents);
        let is_known = self.of.as_ref().is_some_and(|known| is_alike(known, &of));
        if is_known && (self.job.is_some() || self.is_whole()) {
            if let Some(report) = &mut self.report {
                report.name = landmark.name;
            }
            return;
        }
        self.stop(context);
        (self.landmark, self.of) = (Some(landmark.id), Some(of.clone()));
        (self.report, self.trouble) = (None, None);
        let job = context.start(Job::Evaluate(of));
        self.job = Some((job, 0.0, "Starting …".to_owned()));
    }

    /// Stops the judging; what has been seen stays on screen.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((job, ..)) = self.job.take() {
            context.cancel(job);
        }
    }

    /// Closes the dialog.
    pub fn close(&mut self) {
        self.is_open = false;
    }

    /// Forgets a judgement on pictures of a flight that is open no longer.
    pub fn leave_flight(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        (self.report, self.of, self.trouble) = (None, None, None);
        self.is_open = false;
    }

    /// Takes an event of the job under way; false if it is of another one.
    pub fn take(&mut self, job: JobId, event: JobEvent) -> bool {
        if self.job.as_ref().is_none_or(|(own, ..)| *own != job) {
            return false;
        }
        let is_last = event.is_last();
        match event {
            JobEvent::Progress(fraction, what) => {
                if let Some((_, part, words)) = &mut self.job {
                    (*part, *words) = (fraction, what);
                }
            }
            JobEvent::Evaluation(report) => self.report = Some(*report),
            JobEvent::Failed(why) => self.trouble = Some(why),
            JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if is_last {
            self.job = None;
        }
        true
    }

    /// Whether its report is there and whole.
    fn is_whole(&self) -> bool {
        self.report.as_ref().is_some_and(|r| !r.is_partial)
    }

    /// State of it, for journeys.
    pub fn state(&self) -> Value {
        let progress = self.job.as_ref();
        object!({
            "open": self.is_open,
            "whole": self.is_whole(),
            "figures": self.report.as_ref().map_or(&[][..], |r| &r.figures),
            "progress": progress.map(|(_, part, words)| object!({"part": part, "words": words})),
        })
    }
}

/// Whether both judge one detector by the same pictures, whatever its landmark is called and whether it is used.
fn is_alike(a: &EvaluationOrder, b: &EvaluationOrder) -> bool {
    let bare = |order: &EvaluationOrder| {
        let mut bare = order.clone();
        let landmark = &mut bare.about.landmark;
        landmark.choose_detector(DetectorChoice::Cascade);
        *landmark = landmark.looked_for();
        landmark.enabled = true;
        bare
    };
    bare(a) == bare(b)
}

/// Order to judge the detector of a landmark: on generated days and, where the flight was recorded, on its pictures.
fn judging(landmark: &Landmark, documents: &Documents) -> Box<EvaluationOrder> {
    let with = flown::planned_with(documents, Proposal::POSITION);
    let about = with.assessment(landmark);
    let is_recorded = matches!(documents.flight.source, FlightSource::Files(_));
    let flight = is_recorded.then(|| documents.flight.source.clone());
    let tells = |l: &&FrameLabels| l.tells_of(landmark.id);
    let labels = documents.mission.labels.iter().filter(tells);
    Box::new(EvaluationOrder {
        camera: FlownCamera::of(&documents.mission),
        labels: labels.cloned().collect(),
        ..EvaluationOrder::usual(about, flight)
    })
}
