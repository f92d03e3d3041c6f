//! The judging of a detector: how far it is, what came of it.

use crate::detector::EvaluationView;
use crate::host::Host;
use pilotage_jobs::{EvaluationReport, JobEvent, JobId};

/// The judging of a detector and the dialog that shows it.
#[derive(Default)]
pub(super) struct Evaluating {
    pub is_open: bool,
    /// The landmark that is shown.
    pub landmark: Option<u32>,
    pub job: Option<(JobId, f32, String)>,
    pub report: Option<EvaluationReport>,
    /// Text of the trained detector that was judged.
    pub of: Option<String>,
    pub trouble: Option<String>,
    pub view: EvaluationView,
}

impl Evaluating {
    /// State of the dialog: whether it is open, and whether its report is whole.
    pub fn state(&self) -> (bool, bool) {
        let is_whole = self.report.as_ref().is_some_and(|r| !r.is_partial);
        (self.is_open, is_whole)
    }

    /// Progress of the judging, 0 to 1, and its words.
    pub fn progress(&self) -> Option<(f32, &str)> {
        let (_, part, words) = self.job.as_ref()?;
        Some((*part, words.as_str()))
    }

    /// Figures of the report.
    pub fn figures(&self) -> &[String] {
        self.report.as_ref().map_or(&[], |r| &r.figures)
    }

    /// Forgets a judgement on pictures of a flight that is open no longer.
    pub fn leave_flight(&mut self, host: &mut dyn Host) {
        if let Some((id, ..)) = self.job.take() {
            host.cancel(id);
        }
        (self.report, self.of, self.trouble) = (None, None, None);
        self.is_open = false;
    }

    /// Takes what a worker says of the judging; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        let Some((_, part, words)) = self.job.as_mut().filter(|job| job.0 == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(fraction, what) => {
                (*part, *words) = (*fraction, what.clone());
            }
            JobEvent::Evaluation(report) => self.report = Some(report.as_ref().clone()),
            JobEvent::Failed(why) => {
                self.trouble = Some(why.clone());
                self.job = None;
            }
            JobEvent::Finished | JobEvent::Cancelled => self.job = None,
            _ => {}
        }
        true
    }
}
