//! A host without a browser: jobs run on the calling thread, files and storage are plain maps.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use pilotage_core::imagery::ByteSource;

use super::{Abilities, FileContent, Job, JobEvent, JobId, JobRunner, Reply, Request};
use crate::host::{Host, OpenedFile};

/// Runs jobs a slice at a time whenever the app asks for events, with a clock of its own.
pub struct InlineHost {
    runner: JobRunner,
    next_job: JobId,
    waiting: Vec<(JobId, JobEvent)>,
    clock: Cell<f64>,
    /// Files to hand to the app at its next question.
    pub drops: VecDeque<Vec<OpenedFile>>,
    /// What the app stored, by key; fill it before the app starts to play a reload.
    pub stored: BTreeMap<String, Vec<u8>>,
    /// Files that the app offered to the user, in order.
    pub saved: Vec<(String, Vec<u8>)>,
    /// Times the app asked for the file dialog.
    pub dialogs: usize,
    /// The fragment of the last link that was copied.
    pub link: String,
    /// The last announcement.
    pub announced: String,
    /// The web: what lies at addresses.
    pub web: BTreeMap<String, Vec<u8>>,
    /// Workers to report as lost at the app's next question.
    pub lost: usize,
}

impl Default for InlineHost {
    fn default() -> Self {
        Self::new()
    }
}

impl InlineHost {
    /// A host with nothing stored.
    pub fn new() -> Self {
        Self {
            runner: JobRunner::new(Abilities::WHOLE),
            next_job: 0,
            waiting: Vec::new(),
            clock: Cell::default(),
            drops: VecDeque::new(),
            stored: BTreeMap::new(),
            saved: Vec::new(),
            dialogs: 0,
            link: String::new(),
            announced: String::new(),
            web: BTreeMap::new(),
            lost: 0,
        }
    }

    /// Moves the clock forward by milliseconds.
    pub fn pass_time(&mut self, milliseconds: f64) {
        self.clock.set(self.clock.get() + milliseconds);
    }

    /// The runner, to put maps into its workshop.
    pub fn runner_mut(&mut self) -> &mut JobRunner {
        &mut self.runner
    }

    /// Lends a file to the workers; what to hand to the app for it.
    pub fn lend(&mut self, number: u32, source: Arc<dyn ByteSource>) -> FileContent {
        let length = source.length();
        self.runner.workshop_mut().lend(number, source);
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
    if matches!(request, Request::Start(_, Job::Provide { .. })) {
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

impl Host for InlineHost {
    fn now(&self) -> f64 {
        self.clock.get()
    }

    fn start(&mut self, job: Job) -> JobId {
        self.next_job += 1;
        let tiles = super::wanted_addresses(&job)
            .into_iter()
            .filter_map(|address| {
                let bytes = self.web.get(&address)?.clone();
                Some((address, FileContent::from(bytes)))
            });
        let tiles: Vec<_> = tiles.collect();
        let key = super::WEB_TILES.to_owned();
        self.runner.workshop_mut().provide(key, &tiles);
        let waiting = &mut self.waiting;
        self.runner
            .receive(sent(Request::Start(self.next_job, job)), &mut |reply| {
                keep(waiting, &reply);
            });
        self.next_job
    }

    fn cancel(&mut self, job: JobId) {
        let waiting = &mut self.waiting;
        self.runner
            .receive(Request::Cancel(job), &mut |reply| keep(waiting, &reply));
    }

    fn hold(&mut self, job: JobId, is_held: bool) {
        let waiting = &mut self.waiting;
        let request = Request::Hold(job, is_held);
        self.runner
            .receive(request, &mut |reply| keep(waiting, &reply));
    }

    fn let_go(&mut self, in_use: &BTreeSet<String>) {
        let keys = in_use.iter().cloned().collect();
        self.start(Job::LetGo { keys });
    }

    fn events(&mut self) -> Vec<(JobId, JobEvent)> {
        self.turn();
        std::mem::take(&mut self.waiting)
    }

    fn opened(&mut self) -> Vec<Vec<OpenedFile>> {
        self.drops.drain(..).collect()
    }

    fn ask_for_files(&mut self) {
        self.dialogs += 1;
    }

    fn save_file(&mut self, name: &str, bytes: &[u8]) {
        self.saved.push((name.to_owned(), bytes.to_vec()));
    }

    fn store(&mut self, key: &str, bytes: &[u8]) {
        self.stored.insert(key.to_owned(), bytes.to_vec());
    }

    fn forget(&mut self, key: &str) {
        self.stored.remove(key);
    }

    fn recall(&self, key: &str) -> Option<Vec<u8>> {
        self.stored.get(key).cloned()
    }

    fn lost_workers(&mut self) -> usize {
        std::mem::take(&mut self.lost)
    }

    fn copy_link(&mut self, fragment: &str) {
        fragment.clone_into(&mut self.link);
    }

    fn announce(&mut self, text: &str) {
        text.clone_into(&mut self.announced);
    }
}

#[cfg(test)]
#[path = "inline_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "maps_tests.rs"]
mod maps_tests;
