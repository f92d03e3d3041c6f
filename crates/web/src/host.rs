//! The page's services for the app.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use js_sys::{Uint8Array, Uint8ClampedArray};
use pilotage_core::navigator::{StepReport, StepTiming};
use pilotage_jobs::{
    FileContent, FirstSeconds, Job, JobEvent, JobId, KeptMeasurement, Prelude, Reply, WorkerPool,
    wanted_addresses,
};
use pilotage_ui::host::{Download, Host, OpenedFile};
use pilotage_ui::job_owners::JobOwners;
use pilotage_ui::short_map::ShortMap;

use wasm_bindgen::JsValue;

use crate::browser::{Shell, now};
use crate::fetched::fetched;
use crate::lent;
use crate::port::{BrowserPort, Inbox, Notice};

/// Longest time spent in one frame on reading what workers said, milliseconds.
const READING: f64 = 3.0;

/// Documents and files that the browser remembered of an earlier visit, by key.
#[derive(Default)]
pub struct Remembered {
    /// Documents.
    pub bytes: ShortMap<String, Vec<u8>>,
    /// Large files.
    pub files: ShortMap<String, FileContent>,
}

/// The page's services; every clone is the same, but that the owners of jobs are known to that of the app, which starts them.
#[derive(Clone)]
pub struct PageHost {
    inner: Rc<RefCell<Inner>>,
    owners: JobOwners,
}

struct Inner {
    shell: Shell,
    pool: WorkerPool<BrowserPort>,
    prelude: Prelude,
    /// Events that the prelude told of jobs that began.
    told_first: Vec<(JobId, JobEvent)>,
    inbox: Inbox,
    remembered: Remembered,
    opened: Vec<Vec<OpenedFile>>,
    /// Troubles of the page's JavaScript, by title and text.
    troubles: Vec<(String, String)>,
    announced: String,
    timings: Vec<StepTiming>,
    /// Jobs that wait for tiles of the web.
    fetching: Vec<JobId>,
    /// Place in the app that the entry of the browser's history has; none before the app's first word about it.
    place: Option<String>,
    /// Place to which people went by the browser's Back or Forward.
    wanted: Option<String>,
    /// Files of the page that were fetched, by name.
    fetched: ShortMap<String, Vec<u8>>,
    /// Problem last told of tiles that cannot be had, in words.
    told: Option<String>,
    /// Fate of the link that was to be copied last, once it is known: whether the clipboard took it.
    link_copied: Option<bool>,
    /// Whether what nobody asked for is left undone.
    leaves_ahead: bool,
}

impl Inner {
    /// Whether a job's tiles were on their way; they are awaited no more.
    fn ends_fetching(&mut self, job: JobId) -> bool {
        let at = self.fetching.iter().position(|id| *id == job);
        at.map(|at| self.fetching.swap_remove(at)).is_some()
    }
}

impl PageHost {
    /// Fetches tiles, then begins the job that reads them.
    fn fetch_for(&self, job: Job, addresses: Vec<String>) -> JobId {
        let mut inner = self.inner.borrow_mut();
        let id = inner.pool.reserve();
        inner.fetching.push(id);
        let list = addresses.iter().map(JsValue::from).collect();
        let promise = inner.shell.fetch_tiles(list);
        let shared = self.inner.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let came = fetched(addresses, promise).await;
            let mut inner = shared.borrow_mut();
            if !inner.ends_fetching(id) {
                return;
            }
            if came.problem.is_some() && came.problem != inner.told {
                let text = came.problem.clone().unwrap_or_default();
                inner.pool.say(id, JobEvent::Remark(text));
                inner.told = came.problem;
            } else if came.problem.is_none() && came.is_new {
                // The server answers again: the next time that it does not is news.
                inner.told = None;
            }
            inner.pool.begin(id, job, came.tiles);
            inner.inbox.context.request_repaint();
        });
        id
    }

    /// Services for a page with these remembered documents.
    pub fn new(shell: Shell, context: egui::Context, mut remembered: Remembered) -> Self {
        let stored = remembered.bytes.get(FirstSeconds::KEY);
        let stored = stored.and_then(|bytes| FirstSeconds::decode(bytes));
        if let Some(stored) = &stored {
            let measured = KeptMeasurement::encode_all(&stored.measured);
            let key = FirstSeconds::MEASURED_KEY.to_owned();
            remembered.bytes.insert(key, measured);
        }
        let inbox = Inbox {
            notices: Rc::default(),
            context,
        };
        let line = inbox.clone();
        let mut pool =
            WorkerPool::new(move |seat, program| BrowserPort::open(seat, program, line.clone()));
        pool.warm_up();
        let inner = Inner {
            shell,
            pool,
            prelude: Prelude::new(stored),
            told_first: Vec::new(),
            inbox,
            remembered,
            opened: Vec::new(),
            troubles: Vec::new(),
            announced: String::new(),
            timings: Vec::new(),
            fetching: Vec::new(),
            place: None,
            wanted: None,
            fetched: ShortMap::default(),
            told: None,
            link_copied: None,
            leaves_ahead: false,
        };
        Self {
            inner: Rc::new(RefCell::new(inner)),
            owners: JobOwners::default(),
        }
    }

    /// Files that the user chose or dropped.
    pub fn open_files(&self, files: Vec<OpenedFile>) {
        let mut inner = self.inner.borrow_mut();
        inner.opened.push(files);
        inner.inbox.context.request_repaint();
    }

    /// Has the app tell that something went wrong.
    pub fn tell_trouble(&self, title: String, text: String) {
        let mut inner = self.inner.borrow_mut();
        inner.troubles.push((title, text));
        inner.inbox.context.request_repaint();
    }

    /// Goes to a place in the app, to which the browser's Back or Forward led.
    pub fn go_to(&self, place: String) {
        let mut inner = self.inner.borrow_mut();
        inner.wanted = Some(place);
        inner.inbox.context.request_repaint();
    }

    /// Called by a timer: looks whether the workers are alive.
    pub fn tick(&self) {
        let mut inner = self.inner.borrow_mut();
        inner.read_notices();
        inner.pool.tick(now());
        if inner.pool.has_events() {
            inner.inbox.context.request_repaint();
        }
    }

    /// Median milliseconds of the navigator per camera frame in which it looked for landmarks, as
    /// the workers measured them, as JSON.
    pub fn navigator_json(&self) -> String {
        let inner = self.inner.borrow();
        let median = |of: fn(&StepTiming) -> f64| {
            let mut values: Vec<f64> = inner.timings.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied()
        };
        serde_json::json!({
            "frames": inner.timings.len(),
            "predict": median(|t| t.predict),
            "see": median(|t| t.see),
            "update": median(|t| t.update),
        })
        .to_string()
    }

    /// Pieces of the stored first seconds that were computed by now, and how many came out otherwise, as JSON.
    pub fn first_seconds_json(&self) -> String {
        let (compared, different) = self.inner.borrow().prelude.checked();
        serde_json::json!({ "compared": compared, "different": different }).to_string()
    }

    /// Lets what is being flown keep its place without working; for tests.
    pub fn rest_flight(&self) {
        self.inner.borrow_mut().pool.hold_flights();
    }

    /// Leaves undone what nobody asked for; for tests.
    pub fn leave_ahead(&self) {
        self.inner.borrow_mut().leaves_ahead = true;
    }

    /// Ends a worker without a word; for tests.
    pub fn silence_worker(&self, seat: usize) {
        if let Some(port) = self.inner.borrow().pool.port(seat) {
            port.silence();
        }
    }

    /// Makes a worker run into a fault; for tests.
    pub fn crash_worker(&self, seat: usize) {
        if let Some(port) = self.inner.borrow().pool.port(seat) {
            port.crash();
        }
    }
}

/// Tells that the stored first seconds differ from those that this program computes, which is a fault of the
/// build.
fn tell_of_difference(id: JobId) {
    let text = format!("the stored first seconds differ from what job {id} computes");
    web_sys::console::error_1(&text.into());
}

impl Inner {
    fn note_timings(&mut self, event: &JobEvent) {
        match event {
            JobEvent::RunStarted(_) => self.timings.clear(),
            JobEvent::Steps(steps) => {
                let looked = |step: &&StepReport| {
                    let frame = step.frame.as_ref();
                    frame.is_some_and(|f| !f.candidates.is_empty())
                };
                let timings = steps.iter().filter(looked).map(|step| step.timing);
                self.timings.extend(timings);
            }
            _ => {}
        }
    }

    fn read_notices(&mut self) {
        let begun = now();
        while now() - begun < READING {
            let Some(notice) = self.inbox.notices.borrow_mut().pop_front() else {
                return;
            };
            match notice {
                Notice::Said(seat, bytes) => {
                    if let Some(reply) = Reply::from_bytes(&bytes) {
                        self.pool.receive(seat, reply);
                    }
                }
                Notice::Died(seat) => {
                    let of_seat = |n: &Notice| matches!(n, Notice::Said(s, _) | Notice::Died(s) if *s == seat);
                    self.inbox.notices.borrow_mut().retain(|n| !of_seat(n));
                    self.pool.worker_died(seat);
                }
            }
        }
        self.inbox.context.request_repaint();
    }
}

impl Host for PageHost {
    fn now(&self) -> f64 {
        now()
    }

    fn owners(&mut self) -> &mut JobOwners {
        &mut self.owners
    }

    fn begin(&mut self, job: Job) -> JobId {
        let addresses = wanted_addresses(&job);
        if addresses.is_empty() {
            let mut inner = self.inner.borrow_mut();
            let id = inner.pool.reserve();
            let job = inner.prelude.complete(job);
            let first = inner.prelude.begin(id, &job);
            inner
                .told_first
                .extend(first.into_iter().map(|it| (id, it)));
            inner.pool.start_as(id, job);
            return id;
        }
        self.fetch_for(job, addresses)
    }

    fn cancel(&mut self, job: JobId) {
        let mut inner = self.inner.borrow_mut();
        if inner.ends_fetching(job) {
            inner.pool.say(job, JobEvent::Cancelled);
        } else {
            inner.pool.cancel(job);
        }
    }

    fn hold(&mut self, job: JobId, is_held: bool) {
        self.inner.borrow_mut().pool.hold(job, is_held);
    }

    fn let_go(&mut self, in_use: &BTreeSet<String>) {
        self.inner.borrow_mut().pool.let_go(in_use);
    }

    fn download(&mut self, addresses: Vec<String>) {
        let list = addresses.into_iter().map(JsValue::from).collect();
        self.inner.borrow().shell.download_tiles(list);
    }

    fn download_state(&mut self) -> Option<Download> {
        let state = self.inner.borrow().shell.download_state();
        let [done, all, failed, over] = state[..] else {
            return None;
        };
        Some(Download {
            done: done as u64,
            all: all as u64,
            failed: failed as u64,
            over: over > 0.0,
            is_full: over > 1.0,
        })
    }

    fn stop_download(&mut self) {
        self.inner.borrow().shell.stop_download();
    }

    fn fetch(&mut self, file: &str) {
        let file = file.to_owned();
        let promise = self.inner.borrow().shell.fetch_own(&file);
        let shared = self.inner.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let came = wasm_bindgen_futures::JsFuture::from(promise).await;
            let bytes = came.map(|bytes| Uint8Array::new(&bytes).to_vec());
            let mut inner = shared.borrow_mut();
            inner.fetched.insert(file, bytes.unwrap_or_default());
            inner.inbox.context.request_repaint();
        });
    }

    fn fetched(&mut self, file: &str) -> Option<Vec<u8>> {
        self.inner.borrow_mut().fetched.remove(file)
    }

    fn events(&mut self) -> Vec<(JobId, JobEvent)> {
        let mut inner = self.inner.borrow_mut();
        inner.read_notices();
        let mut events = std::mem::take(&mut inner.told_first);
        for (id, event) in inner.pool.take_events() {
            inner.note_timings(&event);
            let before = inner.prelude.checked().1;
            let new = inner.prelude.hear(id, event);
            events.extend(new.into_iter().map(|event| (id, event)));
            if inner.prelude.checked().1 > before {
                tell_of_difference(id);
            }
        }
        events
    }

    fn opened(&mut self) -> Vec<Vec<OpenedFile>> {
        std::mem::take(&mut self.inner.borrow_mut().opened)
    }

    fn ask_for_files(&mut self) {
        self.inner.borrow().shell.ask_for_files();
    }

    fn save_file(&mut self, name: &str, bytes: &[u8]) {
        let bytes = Uint8Array::from(bytes);
        self.inner.borrow().shell.save_file(name, bytes);
    }

    fn save_picture(&mut self, name: &str, svg: &str, [width, height]: [u32; 2]) {
        let inner = self.inner.borrow();
        inner.shell.save_picture(name, svg, width, height);
    }

    fn follow(&mut self, place: &str) -> Option<String> {
        let mut inner = self.inner.borrow_mut();
        let wanted = inner.wanted.take();
        if wanted.is_some() {
            // Wherever that leads is what the entry shows.
            inner.place = None;
        } else if inner.place.as_deref() != Some(place) {
            inner.shell.show_place(place, inner.place.is_none());
            inner.place = Some(place.to_owned());
        }
        wanted
    }

    fn save_pixels(&mut self, name: &str, [width, height]: [u32; 2], pixels: &[u8]) {
        let inner = self.inner.borrow();
        let pixels = Uint8ClampedArray::from(pixels);
        inner.shell.save_pixels(name, pixels, width, height);
    }

    fn start_film(&mut self) -> String {
        self.inner.borrow().shell.start_film()
    }

    fn stop_film(&mut self, name: &str) {
        self.inner.borrow().shell.stop_film(name);
    }

    fn store(&mut self, key: &str, bytes: &[u8]) {
        let bytes = Uint8Array::from(bytes);
        self.inner.borrow().shell.store(key, bytes);
    }

    fn recall(&self, key: &str) -> Option<Vec<u8>> {
        self.inner.borrow_mut().remembered.bytes.remove(key)
    }

    fn store_lent(&mut self, key: &str, number: u32) {
        let file = lent::file(number);
        self.inner.borrow().shell.store_file(key, &file);
    }

    fn recall_lent(&self, key: &str) -> Option<FileContent> {
        self.inner.borrow_mut().remembered.files.remove(key)
    }

    fn forget(&mut self, key: &str) {
        self.inner.borrow().shell.forget(key);
    }

    fn troubles(&mut self) -> Vec<(String, String)> {
        std::mem::take(&mut self.inner.borrow_mut().troubles)
    }

    fn failed_stores(&mut self) -> Vec<String> {
        self.inner.borrow().shell.failed_stores()
    }

    fn interrupted_saves(&mut self) -> Vec<String> {
        self.inner.borrow().shell.interrupted_saves()
    }

    fn print(&mut self, style: &str, body: &str) {
        self.inner.borrow().shell.print(style, body);
    }

    fn copy_link(&mut self, fragment: &str) {
        // The answer of an earlier one is none to this.
        self.inner.borrow_mut().link_copied = None;
        let promise = self.inner.borrow().shell.copy_link(fragment);
        let shared = self.inner.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let copied = wasm_bindgen_futures::JsFuture::from(promise).await;
            let mut inner = shared.borrow_mut();
            inner.link_copied = Some(copied.is_ok_and(|it| it.is_truthy()));
            inner.inbox.context.request_repaint();
        });
    }

    fn link_copied(&mut self) -> Option<bool> {
        self.inner.borrow_mut().link_copied.take()
    }

    fn own_server(&self) -> String {
        self.inner.borrow().shell.own_server()
    }

    fn prefers_stillness(&self) -> bool {
        self.inner.borrow().shell.prefers_stillness()
    }

    fn prefers_light(&self) -> bool {
        self.inner.borrow().shell.prefers_light()
    }

    fn is_touched_first(&self) -> bool {
        self.inner.borrow().shell.is_touched_first()
    }

    fn works_ahead(&self) -> bool {
        !self.inner.borrow().leaves_ahead
    }

    fn lost_workers(&mut self) -> usize {
        self.inner.borrow_mut().pool.take_lost()
    }

    fn announce(&mut self, text: &str) {
        let mut inner = self.inner.borrow_mut();
        if inner.announced != text {
            text.clone_into(&mut inner.announced);
            inner.shell.announce(text);
        }
    }
}
