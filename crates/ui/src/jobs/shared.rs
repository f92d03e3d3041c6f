//! A measurement that several workers share: what each has done, and what it comes to together.

use std::collections::BTreeMap;

use pilotage_core::plan::{Rehearsal, View};

use super::assess::Share;
use super::{AssessmentOrder, Job, JobEvent, JobId};

/// Workers that share a measurement.
pub const SHARES: usize = 2;

/// The shares of a measurement, under the number of the whole.
pub struct SharedMeasurement {
    order: Box<AssessmentOrder>,
    /// How far each of the jobs is that are not over.
    parts: BTreeMap<JobId, f32>,
    views: Vec<(usize, View)>,
    is_summing: bool,
}

/// What follows for the whole from what one of the jobs said.
#[derive(Debug, PartialEq)]
pub enum Follows {
    /// Say this of the whole.
    Say(JobEvent),
    /// Nothing yet.
    Wait,
    /// Begin this job, which tells the result.
    Begin(Box<Job>),
}

impl SharedMeasurement {
    /// Nothing done yet.
    pub fn new(order: Box<AssessmentOrder>) -> Self {
        Self {
            order,
            parts: BTreeMap::new(),
            views: Vec::new(),
            is_summing: false,
        }
    }

    /// The jobs that it is shared out as.
    pub fn jobs(&self) -> [Job; SHARES] {
        std::array::from_fn(|part| {
            let share = Share { part, of: SHARES };
            Job::AssessShare(self.order.clone(), share)
        })
    }

    /// Counts a job as one of its own.
    pub fn add(&mut self, part: JobId) {
        self.parts.insert(part, 0.0);
    }

    /// Whether a job is one of its own.
    pub fn has(&self, part: JobId) -> bool {
        self.parts.contains_key(&part)
    }

    /// Its jobs that are not over.
    pub fn parts(&self) -> Vec<JobId> {
        self.parts.keys().copied().collect()
    }

    /// Takes what one of its jobs said.
    pub fn take(&mut self, part: JobId, event: JobEvent) -> Follows {
        match event {
            JobEvent::Progress(share, words) => {
                let nothing_yet = self.parts.values().all(|done| *done == 0.0) && share == 0.0;
                self.parts.insert(part, share);
                if nothing_yet {
                    return Follows::Say(JobEvent::Progress(0.0, words));
                }
                let over = (SHARES - self.parts.len()) as f32;
                let done = (over + self.parts.values().sum::<f32>()) / SHARES as f32;
                let all = Rehearsal::VIEWS;
                let words = format!("View {:.0} of {all}", done * all as f32);
                Follows::Say(JobEvent::Progress(done, words))
            }
            JobEvent::Views(mut views) => {
                self.views.append(&mut views);
                Follows::Wait
            }
            JobEvent::Finished if !self.is_summing => {
                self.parts.remove(&part);
                if !self.parts.is_empty() {
                    return Follows::Wait;
                }
                self.is_summing = true;
                self.views.sort_by_key(|(look, _)| *look);
                let views = self.views.iter().map(|(_, view)| *view).collect();
                Follows::Begin(Box::new(Job::SumUp(self.order.clone(), views)))
            }
            JobEvent::Cancelled => {
                self.parts.remove(&part);
                if self.parts.is_empty() {
                    Follows::Say(JobEvent::Cancelled)
                } else {
                    Follows::Wait
                }
            }
            event => Follows::Say(event),
        }
    }
}
