//! A job that several workers share: what each has done, and what it comes to together.

use pilotage_core::sorting::sort;
use std::collections::BTreeMap;

use pilotage_core::plan::{LandmarkCandidate, Rehearsal, ViewResult};

use super::{
    AssessmentOrder, Job, JobEvent, JobId, ProposeOrder, Share, ShareOrder, SuggestOrder,
    SumUpOrder,
};

/// Workers that share a job.
pub const SHARES: usize = 2;

/// The shares of a job, under the number of the whole.
pub struct SharedJob {
    whole: Whole,
    /// Progress of each of the jobs that are not over.
    parts: BTreeMap<JobId, f32>,
    is_summing: bool,
}

/// Job that is shared, and its results so far.
enum Whole {
    /// A landmark that is measured, and the views of it, each with the number of its look.
    Measurement(Box<AssessmentOrder>, Vec<(usize, ViewResult)>),
    /// Landmarks that are proposed, and the places that passed, by the number of the share.
    Proposal(Box<SuggestOrder>, BTreeMap<usize, Vec<LandmarkCandidate>>),
}

/// Consequence for the whole of an event of one of the jobs.
#[derive(Debug, PartialEq)]
pub enum Follows {
    /// Say this of the whole.
    Say(JobEvent),
    /// Nothing yet.
    Wait,
    /// Begin this job, which tells the result.
    Begin(Box<Job>),
}

impl SharedJob {
    /// Nothing done yet of `job`; `None` if it is not one that is shared.
    pub fn new(job: &Job) -> Option<Self> {
        let whole = match job {
            Job::Assess(order) => Whole::Measurement(order.clone(), Vec::new()),
            Job::Suggest(order) => Whole::Proposal(order.clone(), BTreeMap::new()),
            _ => return None,
        };
        Some(Self {
            whole,
            parts: BTreeMap::new(),
            is_summing: false,
        })
    }

    /// The jobs that it is shared out as.
    pub fn jobs(&self) -> [Job; SHARES] {
        std::array::from_fn(|part| {
            let share = Share { part, of: SHARES };
            match &self.whole {
                Whole::Measurement(order, _) => Job::AssessShare(ShareOrder(order.clone(), share)),
                Whole::Proposal(order, _) => Job::SuggestShare(ShareOrder(order.clone(), share)),
            }
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
                Follows::Say(JobEvent::Progress(done, self.words(done)))
            }
            JobEvent::Views(mut some) => {
                if let Whole::Measurement(_, views) = &mut self.whole {
                    views.append(&mut some);
                }
                Follows::Wait
            }
            JobEvent::Candidates(part, some) => {
                if let Whole::Proposal(_, found) = &mut self.whole {
                    found.insert(part, some);
                }
                Follows::Wait
            }
            JobEvent::Finished if !self.is_summing => {
                self.parts.remove(&part);
                if !self.parts.is_empty() {
                    return Follows::Wait;
                }
                self.is_summing = true;
                Follows::Begin(Box::new(self.last_job()))
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

    fn words(&self, done: f32) -> String {
        match &self.whole {
            Whole::Measurement(..) => {
                let all = Rehearsal::VIEWS;
                format!("View {:.0} of {all}", done * all as f32)
            }
            Whole::Proposal(..) => "Rehearsing all places".to_owned(),
        }
    }

    /// The job that tells the result of the shares.
    fn last_job(&mut self) -> Job {
        match &mut self.whole {
            Whole::Measurement(order, views) => {
                sort(views, &|a, b| a.0.cmp(&b.0));
                let views = views.iter().map(|(_, view)| *view).collect();
                Job::SumUp(SumUpOrder(order.clone(), views))
            }
            Whole::Proposal(order, found) => {
                let found = std::mem::take(found).into_values().flatten().collect();
                Job::Propose(ProposeOrder(order.clone(), found))
            }
        }
    }
}
