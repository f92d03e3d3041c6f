//! Workers without a browser: jobs run on the calling thread.

use std::cell::Cell;
use std::sync::Arc;

use pilotage_core::imagery::ByteSource;

use super::order::Urgency;
use super::{Abilities, FileContent, Job, JobEvent, JobId, JobRunner, Reply, Request};

/// Worker on the calling thread. Orders and replies go through the bytes that a worker of the page would get.
///
/// ```
/// use pilotage_jobs::{FlightSource, FlyOrder, InlineWorkers, Job, JobEvent, MapSource};
///
/// let mut workers = InlineWorkers::new();
/// let flight = FlightSource::Files("gone".to_owned());
/// let id = workers.start(Job::Fly(FlyOrder { flight, map: MapSource::Nothing, mission: None }));
/// let mut last = None;
/// while workers.busy() {
///     last = workers.events().pop().or(last);
/// }
/// let (of, JobEvent::Failed(why)) = last.ok_or("an end")? else { return Err("it was flown") };
/// assert!(of == id && why.contains("open them again"));
/// # Ok::<(), &str>(())
/// ```
pub struct InlineWorkers {
    runner: JobRunner,
    next_job: JobId,
    waiting: Vec<(JobId, JobEvent)>,
}

impl Default for InlineWorkers {
    fn default() -> Self {
        Self::new()
    }
}

impl InlineWorkers {
    /// A worker that can do every job, without files.
    pub fn new() -> Self {
        Self {
            runner: JobRunner::new(Abilities::WHOLE),
            next_job: 0,
            waiting: Vec::new(),
        }
    }

    /// Lends a file to the worker, and gives the content that an order names it by.
    pub fn lend(&mut self, number: u32, source: Arc<dyn ByteSource>) -> FileContent {
        let length = source.length();
        self.runner.state_mut().lend(number, source);
        FileContent::Lent { number, length }
    }

    /// Whether jobs are unfinished or events not yet taken.
    pub fn busy(&self) -> bool {
        self.runner.busy() || !self.waiting.is_empty()
    }

    /// Works until every job is done.
    pub fn finish_jobs(&mut self) {
        while self.turn() {}
    }

    /// Starts a job; its events arrive by [`InlineWorkers::events`].
    pub fn start(&mut self, job: Job) -> JobId {
        self.next_job += 1;
        self.receive(sent(Request::Start(self.next_job, job)));
        self.next_job
    }

    /// Asks a job to stop; its last event is `Cancelled`.
    pub fn cancel(&mut self, job: JobId) {
        self.receive(Request::Cancel(job));
    }

    /// Lets a job keep its place without working, or work on.
    pub fn hold(&mut self, job: JobId, is_held: bool) {
        self.receive(Request::Hold(job, is_held));
    }

    /// Works for a slice and takes the events that have arrived, in order.
    pub fn events(&mut self) -> Vec<(JobId, JobEvent)> {
        self.turn();
        std::mem::take(&mut self.waiting)
    }

    fn receive(&mut self, request: Request) {
        let waiting = &mut self.waiting;
        self.runner
            .receive(request, &mut |reply| keep(waiting, &reply));
    }

    fn turn(&mut self) -> bool {
        // A clock that moves while work is done, so that slices end.
        let ticks = Cell::new(0.0);
        let clock = || {
            ticks.set(ticks.get() + 1.0);
            ticks.get()
        };
        let waiting = &mut self.waiting;
        self.runner.turn(&clock, &mut |reply| keep(waiting, &reply))
    }
}

/// A request after it went through the bytes that a worker would get; files go beside them.
fn sent(request: Request) -> Request {
    if matches!(&request, Request::Start(_, job) if job.urgency() == Urgency::Files) {
        return request;
    }
    let bytes = request
        .to_bytes()
        .and_then(|bytes| Request::from_bytes(&bytes));
    bytes.expect("a request that a worker can read")
}

/// Keeps what a reply tells, after it went through the bytes that the page would get.
fn keep(waiting: &mut Vec<(JobId, JobEvent)>, reply: &Reply) {
    if let Some(Reply::Event(id, event)) = Reply::from_bytes(&reply.to_bytes()) {
        waiting.push((id, event));
    }
}

#[cfg(test)]
#[path = "inline_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "maps_tests.rs"]
mod maps_tests;
