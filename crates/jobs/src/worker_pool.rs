//! The workers of a page: who does what, and what happens when one dies.

use std::collections::{BTreeMap, BTreeSet};

use super::order::Urgency;
use super::places::{PLACES, ROLES, place, program_at, role_at};
use super::shared::{Follows, SHARES, SharedJob};
use super::{
    COARSE, FileContent, FramePictureOrder, Job, JobEvent, JobId, LetGoOrder, PictureForm, Program,
    ProvideOrder, ReadLogOrder, Reply, Request,
};

/// Time without an answer after which a worker counts as dead, milliseconds. A fault in a worker and
/// its end are noticed at once by other means; this is for one that hangs, and long enough for the
/// longest slice on a slow machine.
const SILENCE: f64 = 60_000.0;
/// Ticks of the page's timer that must have passed as well: a page that slept accuses nobody.
const SILENT_TICKS: u32 = 6;
/// Times that a job is begun anew after its worker died under it.
const RESTARTS: u8 = 2;

/// A line to one worker.
pub trait WorkerPort {
    /// Sends a request.
    fn send(&mut self, request: &Request);

    /// Ends the worker, whatever it is doing.
    fn close(&mut self);
}

struct Seat<P> {
    port: Option<P>,
    /// Keys of the files that this worker holds.
    holds: BTreeSet<String>,
    /// Key of the files of the log that it read last.
    log: Option<String>,
    /// When the unanswered ping was sent, and ticks since.
    unanswered: Option<(f64, u32)>,
    /// Whether it is to end with its last job.
    is_leaving: bool,
}

/// Key under which a seat remembers that it has the tiles of a job.
fn tiles_of(id: JobId) -> String {
    format!("{} of {id}", super::WEB_TILES)
}

struct Assigned {
    seat: usize,
    job: Job,
    restarts: u8,
}

/// Shares jobs out among workers: one for flights, one for map tiles, one for questions; the first two
/// share the measurement of a landmark and proposals, for which the flight waits and tiles do not, and
/// train detectors, for which nothing waits.
/// Workers are opened when first needed, with the smallest program that does what they are for; two with
/// different programs for the same role take turns, the more urgent job first, as one worker would. Files that jobs name are kept here and given to a worker before
/// the first job that names them.
pub struct WorkerPool<P> {
    open: Box<dyn FnMut(usize, Program) -> P>,
    seats: [Seat<P>; PLACES],
    jobs: BTreeMap<JobId, Assigned>,
    /// Jobs that are shared, by the number under which they were asked for.
    shared: BTreeMap<JobId, SharedJob>,
    /// Jobs that keep their place without working.
    held: BTreeSet<JobId>,
    /// Jobs that wait for a more urgent one of the same role in the other program.
    waiting: BTreeSet<JobId>,
    files: BTreeMap<String, Vec<(String, FileContent)>>,
    /// Tiles of the web of the jobs that are not over, by the number under which they were asked for.
    tiles: BTreeMap<JobId, Vec<(String, FileContent)>>,
    events: Vec<(JobId, JobEvent)>,
    last_job: JobId,
    lost: usize,
}

impl<P: WorkerPort> WorkerPool<P> {
    /// A pool whose workers are opened by `open`, which gets the number of the seat and the program.
    pub fn new(open: impl FnMut(usize, Program) -> P + 'static) -> Self {
        let seat = || Seat {
            port: None,
            holds: BTreeSet::new(),
            log: None,
            unanswered: None,
            is_leaving: false,
        };
        Self {
            open: Box::new(open),
            seats: std::array::from_fn(|_| seat()),
            jobs: BTreeMap::new(),
            shared: BTreeMap::new(),
            held: BTreeSet::new(),
            waiting: BTreeSet::new(),
            files: BTreeMap::new(),
            tiles: BTreeMap::new(),
            events: Vec::new(),
            last_job: 0,
            lost: 0,
        }
    }

    /// Opens the workers with the small program before they are needed.
    pub fn warm_up(&mut self) {
        for role in 0..ROLES {
            self.open_seat(place(role, Program::Flying));
        }
    }

    /// Begins a job.
    pub fn start(&mut self, job: Job) -> JobId {
        let id = self.reserve();
        self.start_as(id, job);
        id
    }

    /// Begins a job under a reserved number.
    pub fn start_as(&mut self, id: JobId, job: Job) {
        if let Job::Provide(ProvideOrder { key, files }) = job {
            for seat in &mut self.seats {
                seat.holds.remove(&key);
            }
            self.files.insert(key, files);
            self.events.push((id, JobEvent::Finished));
        } else {
            self.share_out(id, job);
        }
    }

    /// Gives a job to a worker, or to those that share it.
    fn share_out(&mut self, id: JobId, job: Job) {
        let Some(mut whole) = SharedJob::new(&job) else {
            return self.assign(id, job, 0);
        };
        let parts = whole.jobs().map(|job| (self.reserve(), job));
        for (part, _) in &parts {
            whole.add(*part);
        }
        self.shared.insert(id, whole);
        for (part, job) in parts {
            self.assign(part, job, 0);
        }
    }

    /// A number for a job that begins later, by [`WorkerPool::begin`].
    pub fn reserve(&mut self) -> JobId {
        self.last_job += 1;
        self.last_job
    }

    /// Begins a job under a reserved number, with tiles of the web that it needs.
    pub fn begin(&mut self, id: JobId, job: Job, tiles: Vec<(String, FileContent)>) {
        self.tiles.insert(id, tiles);
        self.share_out(id, job);
    }

    /// Gives the worker on a seat the tiles of a job, or of that of which it is a share, unless it has them.
    fn give_tiles(&mut self, seat: usize, id: JobId) {
        let whole = self.shared.iter().find(|(_, whole)| whole.has(id));
        let asked = whole.map_or(id, |(whole, _)| *whole);
        if let Some(files) = self.tiles.get(&asked)
            && self.seats[seat].holds.insert(tiles_of(asked))
        {
            let provide = Job::Provide(ProvideOrder {
                key: super::WEB_TILES.to_owned(),
                files: files.clone(),
            });
            self.open_seat(seat).send(&Request::Start(0, provide));
        }
    }

    /// Lets go of the tiles of a job that is over.
    fn let_tiles_go(&mut self, id: JobId) {
        if self.tiles.remove(&id).is_some() {
            for seat in &mut self.seats {
                seat.holds.remove(&tiles_of(id));
            }
        }
    }

    /// Says something about a job in a worker's place.
    pub fn say(&mut self, id: JobId, event: JobEvent) {
        self.events.push((id, event));
    }

    /// Asks a job to stop.
    pub fn cancel(&mut self, id: JobId) {
        let parts = self.shared.get(&id).map(SharedJob::parts);
        for part in parts.into_iter().flatten() {
            self.cancel(part);
        }
        if let Some(assigned) = self.jobs.get(&id)
            && let Some(port) = &mut self.seats[assigned.seat].port
        {
            port.send(&Request::Cancel(id));
        }
    }

    /// Lets a job keep its place without working, or work on, also if it begins later.
    pub fn hold(&mut self, id: JobId, is_held: bool) {
        if is_held {
            self.held.insert(id);
        } else {
            self.held.remove(&id);
        }
        self.tell_hold(id);
        if let Some(seat) = self.jobs.get(&id).map(|assigned| assigned.seat) {
            self.take_turns(role_at(seat));
        }
    }

    /// Takes what the worker on a seat said.
    pub fn receive(&mut self, seat: usize, reply: Reply) {
        self.seats[seat].unanswered = None;
        let Reply::Event(id, event) = reply else {
            return;
        };
        let Some(assigned) = self.jobs.get_mut(&id) else {
            return;
        };
        if let (Job::Train(order), JobEvent::Training(report)) = (&mut assigned.job, &event)
            && report.left.is_some()
        {
            // Another worker would go on from there.
            order.left.clone_from(&report.left);
        }
        if event.is_last() {
            self.strike(id);
        }
        self.tell(id, event);
    }

    /// Takes a job off the list: of what its worker still says of it nothing is heard.
    fn strike(&mut self, id: JobId) {
        let Some(Assigned { seat, .. }) = self.jobs.remove(&id) else {
            return;
        };
        self.held.remove(&id);
        self.waiting.remove(&id);
        self.take_turns(role_at(seat));
        if self.seats[seat].is_leaving {
            self.end_if_idle(seat);
        }
    }

    /// Says what a worker said of a job; of a share, what follows for the whole.
    fn tell(&mut self, id: JobId, event: JobEvent) {
        let whole = self.shared.iter_mut().find(|(_, whole)| whole.has(id));
        let Some((whole_id, whole)) = whole.map(|(whole_id, whole)| (*whole_id, whole)) else {
            if event.is_last() {
                self.let_tiles_go(id);
            }
            self.events.push((id, event));
            return;
        };
        match whole.take(id, event) {
            Follows::Wait => {}
            Follows::Begin(job) => {
                let part = self.reserve();
                if let Some(whole) = self.shared.get_mut(&whole_id) {
                    whole.add(part);
                }
                self.assign(part, *job, 0);
            }
            Follows::Say(event) => {
                if event.is_last()
                    && let Some(whole) = self.shared.remove(&whole_id)
                {
                    // They may have failed, too, before they hear of it.
                    for part in whole.parts() {
                        self.cancel(part);
                        self.strike(part);
                    }
                    self.let_tiles_go(whole_id);
                }
                self.events.push((whole_id, event));
            }
        }
    }

    /// Lets go of all files but those under the keys `in_use`, and ends every worker once it has
    /// nothing to do: what it made for what was open goes with it, because the memory of a program
    /// never shrinks. It is opened again when needed. Who has read the log that is in use stays: reading
    /// it once more would take longer than what is asked about it.
    pub fn let_go(&mut self, in_use: &BTreeSet<String>) {
        self.files.retain(|key, _| in_use.contains(key));
        for seat in 0..self.seats.len() {
            let log = self.seats[seat].log.as_ref();
            let has_log = log.is_some_and(|key| in_use.contains(key));
            if !has_log {
                self.end_if_idle(seat);
            }
            let it = &mut self.seats[seat];
            let Some(port) = &mut it.port else { continue };
            it.is_leaving = !has_log;
            it.holds.retain(|key| in_use.contains(key));
            let keys = in_use.iter().cloned().collect();
            port.send(&Request::Start(0, Job::LetGo(LetGoOrder { keys })));
        }
    }

    /// Ends the worker on a seat if it has no job.
    fn end_if_idle(&mut self, seat: usize) {
        if self.jobs.values().any(|assigned| assigned.seat == seat) {
            return;
        }
        let it = &mut self.seats[seat];
        it.is_leaving = false;
        it.unanswered = None;
        it.holds.clear();
        it.log = None;
        if let Some(mut port) = it.port.take() {
            port.close();
        }
    }

    /// Called by a timer of the page, about twice a second, with a clock in milliseconds: asks
    /// whether the workers listen and replaces one that does not. True if one was replaced.
    pub fn tick(&mut self, now: f64) -> bool {
        let mut replaced = false;
        for seat in 0..self.seats.len() {
            let it = &mut self.seats[seat];
            let Some(port) = &mut it.port else { continue };
            match &mut it.unanswered {
                None => {
                    it.unanswered = Some((now, 0));
                    port.send(&Request::Ping);
                }
                Some((since, ticks)) => {
                    *ticks += 1;
                    if *ticks >= SILENT_TICKS && now - *since >= SILENCE {
                        self.worker_died(seat);
                        replaced = true;
                    }
                }
            }
        }
        replaced
    }

    /// Replaces the worker on a seat; its jobs begin anew, or fail if that happened too often.
    pub fn worker_died(&mut self, seat: usize) {
        let Some(mut port) = self.seats[seat].port.take() else {
            return;
        };
        port.close();
        self.seats[seat].holds.clear();
        self.seats[seat].log = None;
        self.seats[seat].unanswered = None;
        self.seats[seat].is_leaving = false;
        self.lost += 1;
        let interrupted: Vec<_> = self
            .jobs
            .iter()
            .filter(|(_, assigned)| assigned.seat == seat)
            .map(|(id, _)| *id)
            .collect();
        for id in interrupted {
            let Some(assigned) = self.jobs.remove(&id) else {
                continue;
            };
            self.waiting.remove(&id);
            if assigned.restarts < RESTARTS {
                let text = "Begun anew after the worker stopped".to_owned();
                self.tell(id, JobEvent::Progress(0.0, text));
                self.assign(id, assigned.job, assigned.restarts + 1);
            } else {
                let text = "The part of the app that does this stopped three times, for lack of memory or because it could \
                    not be loaded. Everything you have open is still here. Check the connection and try again, or try a \
                    smaller map or fewer frames."
                    .to_owned();
                self.tell(id, JobEvent::Failed(text));
            }
        }
        self.take_turns(role_at(seat));
    }

    /// The line to the worker on a seat, if it is open.
    pub fn port(&self, seat: usize) -> Option<&P> {
        self.seats.get(seat)?.port.as_ref()
    }

    /// Takes the events that have arrived.
    pub fn take_events(&mut self) -> Vec<(JobId, JobEvent)> {
        std::mem::take(&mut self.events)
    }

    /// Whether events have arrived.
    pub fn has_events(&self) -> bool {
        !self.events.is_empty()
    }

    /// Workers that died since the last call.
    pub fn take_lost(&mut self) -> usize {
        std::mem::take(&mut self.lost)
    }

    fn open_seat(&mut self, seat: usize) -> &mut P {
        let open = &mut self.open;
        let open = || open(seat, program_at(seat));
        self.seats[seat].port.get_or_insert_with(open)
    }

    /// The seat of a job: with the small program if that does it, unless only the whole one is there.
    fn free_seat_for(&self, job: &Job) -> usize {
        let role = self.free_role_for(job);
        let [small, whole] = Program::ALL.map(|program| place(role, program));
        let is_open = |seat: usize| self.seats[seat].port.is_some();
        match Program::of(job) {
            Program::Flying if is_open(small) || !is_open(whole) => small,
            Program::Flying | Program::Whole => whole,
        }
    }

    /// The role that does a job; a prediction while something is dragged does not wait behind a whole one,
    /// nor a picture that is looked at behind anything, if a worker has less to do. Trainings go on side
    /// by side.
    fn free_role_for(&self, job: &Job) -> usize {
        let role = job.role() as usize;
        let jobs = |role: usize| {
            let jobs = self.jobs.values();
            jobs.filter(|a| role_at(a.seat) == role).count()
        };
        match job {
            Job::Predict(order) if order.worlds <= COARSE && jobs(role) > 0 => 1,
            Job::Train(_) => {
                let is_at_work = |id: &JobId, a: &Assigned, role: usize| {
                    role_at(a.seat) == role
                        && matches!(a.job, Job::Train(_))
                        && !self.held.contains(id)
                };
                let trained = |role: usize| {
                    let jobs = self.jobs.iter();
                    jobs.filter(|(id, a)| is_at_work(id, a, role)).count()
                };
                // Answers come and go, as tiles do; a flight stays.
                let is_long = |a: &&Assigned| a.job.urgency() > Urgency::Asked;
                let long = |role: usize| {
                    let jobs = self.jobs.values().filter(is_long);
                    jobs.filter(|a| role_at(a.seat) == role).count()
                };
                let roles = 0..SHARES;
                let least = roles.min_by_key(|role| (trained(*role), long(*role)));
                least.unwrap_or(role)
            }
            Job::FramePicture(FramePictureOrder {
                form: PictureForm::PixelsOf(_),
                ..
            }) => {
                let is_open = |role: &usize| {
                    let seats = Program::ALL.map(|program| place(*role, program));
                    seats.iter().any(|seat| self.seats[*seat].port.is_some())
                };
                let roles = [role, 1, 0].into_iter().filter(is_open);
                roles.min_by_key(|role| jobs(*role)).unwrap_or(role)
            }
            _ => role,
        }
    }

    fn assign(&mut self, id: JobId, job: Job, restarts: u8) {
        let seat = self.free_seat_for(&job);
        self.open_seat(seat);
        self.seats[seat].is_leaving = false;
        if let Job::ReadLog(ReadLogOrder { key, .. }) = &job {
            self.seats[seat].log = Some(key.clone());
        }
        for key in job.files() {
            if let Some(files) = self.files.get(key)
                && self.seats[seat].holds.insert(key.to_owned())
            {
                let provide = Job::Provide(ProvideOrder {
                    key: key.to_owned(),
                    files: files.clone(),
                });
                self.open_seat(seat).send(&Request::Start(0, provide));
            }
        }
        self.give_tiles(seat, id);
        let request = Request::Start(id, job);
        self.open_seat(seat).send(&request);
        if let Request::Start(_, job) = request {
            // To be begun anew if the worker dies under it; a copy of any job is much code.
            let assigned = Assigned {
                seat,
                job,
                restarts,
            };
            self.jobs.insert(id, assigned);
        }
        if self.held.contains(&id) {
            self.tell_hold(id);
        }
        self.take_turns(role_at(seat));
    }
}

#[path = "worker_pool_turns.rs"]
mod turns;

#[cfg(test)]
#[path = "worker_pool_tests.rs"]
mod tests;
