//! The job that a feature has under way, where it has one at a time.

use pilotage_jobs::{Job, JobEvent, JobId};

use crate::feature::FeatureContext;

/// Event of a job, as the work of a feature took it.
#[derive(Debug)]
pub enum WorkEvent {
    /// It told of progress, failure or the end, and is dealt with.
    Taken,
    /// It has another content, which is its owner's if anybody's.
    Content(JobEvent),
    /// It is of another job.
    Other(JobEvent),
}

/// Job that a feature has under way, as its panel tells of it.
#[derive(Debug, Default)]
pub struct FeatureWork {
    /// The job, while it is under way.
    pub job: Option<JobId>,
    /// Progress in words, while the job is under way.
    pub words: Option<String>,
    /// Why the last one failed.
    pub trouble: Option<String>,
}

impl FeatureWork {
    /// Starts a job in the place of the one under way.
    pub fn begin(&mut self, words: String, job: Job, context: &mut FeatureContext<'_>) {
        self.stop(context);
        *self = Self {
            job: Some(context.start(job)),
            words: Some(words),
            ..Self::default()
        };
    }

    /// Takes an event of the job: progress, failure and end; results are its owner's.
    pub fn take(&mut self, job: JobId, event: JobEvent) -> WorkEvent {
        if self.job != Some(job) {
            return WorkEvent::Other(event);
        }
        if event.is_last() {
            (self.job, self.words) = (None, None);
        }
        match event {
            JobEvent::Progress(share, words) => {
                self.words = Some(format!("{words}: {:.0} %", 100.0 * share));
            }
            JobEvent::Failed(why) => self.trouble = Some(why),
            JobEvent::Finished | JobEvent::Cancelled => {}
            content => return WorkEvent::Content(content),
        }
        WorkEvent::Taken
    }

    /// Stops the job under way; whether there was one.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.words = None;
        let job = self.job.take();
        if let Some(job) = job {
            context.cancel(job);
        }
        job.is_some()
    }
}
