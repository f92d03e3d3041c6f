//! The jobs of one worker.

use super::{Advance, Job, JobEvent, JobId, Reply, Request, RunningJob, Workshop};

struct Entry {
    id: JobId,
    urgency: u8,
    job: Box<dyn RunningJob>,
}

/// Takes requests and works on the most urgent job, the eldest among equals, a slice at a time.
#[derive(Default)]
pub struct JobRunner {
    workshop: Workshop,
    entries: Vec<Entry>,
}

impl JobRunner {
    /// A runner without jobs.
    pub fn new() -> Self {
        Self::default()
    }

    /// What the jobs share.
    pub fn workshop_mut(&mut self) -> &mut Workshop {
        &mut self.workshop
    }

    /// Whether a slice would do anything.
    pub fn busy(&self) -> bool {
        !self.entries.is_empty()
    }

    /// Takes a request; what it answers at once is emitted.
    pub fn receive(&mut self, request: Request, emit: &mut dyn FnMut(Reply)) {
        match request {
            Request::Start(id, job) => {
                let urgency = urgency(&job);
                let job = self.workshop.start(job);
                let place = self.entries.partition_point(|e| e.urgency <= urgency);
                self.entries.insert(place, Entry { id, urgency, job });
            }
            Request::Cancel(id) => {
                let before = self.entries.len();
                self.entries.retain(|e| e.id != id);
                if self.entries.len() < before {
                    emit(Reply::Event(id, JobEvent::Cancelled));
                }
            }
            Request::Ping => emit(Reply::Alive),
        }
    }

    /// Works for one slice; false once there is nothing to do.
    pub fn turn(&mut self, clock: &dyn Fn() -> f64, emit: &mut dyn FnMut(Reply)) -> bool {
        let Some(entry) = self.entries.first_mut() else {
            return false;
        };
        let id = entry.id;
        let advance = entry.job.advance(&mut self.workshop, clock, &mut |event| {
            emit(Reply::Event(id, as_sentence(event)));
        });
        if advance == Advance::Done {
            self.entries.remove(0);
        }
        self.busy()
    }
}

/// Ends the text of a failure with a full stop: it is shown beside other sentences.
fn as_sentence(event: JobEvent) -> JobEvent {
    match event {
        JobEvent::Failed(text) if !text.trim_end().ends_with(['.', '!', '?']) => {
            JobEvent::Failed(format!("{}.", text.trim_end()))
        }
        event => event,
    }
}

/// Smaller is sooner: what people wait for with a finger on the map comes before a flight.
fn urgency(job: &Job) -> u8 {
    match job {
        Job::Provide { .. } => 0,
        Job::DescribeMap(_)
        | Job::Open { .. }
        | Job::ReadPlaces { .. }
        | Job::DecodePicture { .. } => 1,
        Job::Tile { .. }
        | Job::Distinctness { .. }
        | Job::ExplainMatch { .. }
        | Job::Predict(_)
        | Job::SumUp(..)
        | Job::Pack(_) => 2,
        Job::TakeHeights(_)
        | Job::Assess(_)
        | Job::AssessShare(..)
        | Job::Envelope(_)
        | Job::Suggest(_)
        | Job::Find(_)
        | Job::Brief(_) => 3,
        Job::PrepareMap(_) => 5,
        Job::Fly { .. } | Job::Field(_) => 4,
        // What was asked before may still need them.
        Job::LetGo { .. } => 6,
    }
}
