//! Orders on the threads of the terminal, each thread with the store of a worker. Nothing else starts threads.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::{Flight, FrameSource, NoPictures, SharedFrames};
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::simulate::FlightDay;
use pilotage_core::training::TrainingPhotos;
use pilotage_jobs::{
    Abilities, Advance, FlightSource, JobEvent, KeptFrames, MapSource, OpenFlight, Order,
    WorkerState,
};

/// Key of the files that the terminal has opened itself.
pub(crate) const KEY: &str = "files";

/// Question whether work shall go on: the refusal in words if not.
pub type GoesOn<'a> = &'a mut dyn FnMut() -> Result<(), String>;

/// Time between two questions whether somebody still waits for work.
const ASKED_EVERY: Duration = Duration::from_millis(20);

/// Everything that all workers share: each is given it before it begins.
#[derive(Clone, Default)]
pub struct Lent {
    /// Opened maps, by the source that orders name.
    maps: Vec<(MapSource, Arc<dyn Imagery>)>,
    /// Files, with the key by which orders name them.
    files: Option<(&'static str, Arc<dyn FileSet>)>,
    /// A flight, with its pictures if it has any.
    flight: Option<(Arc<Flight>, Arc<dyn FrameSource + Send + Sync>)>,
    /// Generated ground as cameras see it.
    seen: Option<(FlightDay, Arc<CachedImagery>)>,
}

impl Lent {
    /// The source by which orders name a map that was opened from a file.
    pub fn map_of_file() -> MapSource {
        MapSource::Files(KEY.to_owned())
    }

    /// The source by which orders name the flight.
    pub fn flight() -> FlightSource {
        FlightSource::Files(KEY.to_owned())
    }

    /// With the map of a flight, if it has one, and the source by which orders name that.
    pub fn over(map: Option<Arc<dyn Imagery>>) -> (MapSource, Self) {
        match map {
            Some(map) => {
                let source = Self::map_of_file();
                (source.clone(), Self::default().with_map(source, map))
            }
            None => (MapSource::Nothing, Self::default()),
        }
    }

    /// With a map, in place of the one that a worker would open from that source.
    #[must_use]
    pub fn with_map(mut self, source: MapSource, map: Arc<dyn Imagery>) -> Self {
        self.maps.push((source, map));
        self
    }

    /// With files that orders name by that key.
    #[must_use]
    pub fn with_files(mut self, key: &'static str, files: Arc<dyn FileSet>) -> Self {
        self.files = Some((key, files));
        self
    }

    /// With a flight of files, and its pictures if it has any.
    #[must_use]
    pub fn with_flight(mut self, open: &OpenFlight) -> Self {
        let frames = Arc::from(shared(&open.frames));
        self.flight = Some((Arc::clone(&open.flight), frames));
        self
    }

    /// With the flight that is lent changed, and its pictures as they are.
    #[must_use]
    pub fn with_flight_changed(mut self, flight: Arc<Flight>) -> Self {
        if let Some((lent, _)) = &mut self.flight {
            *lent = flight;
        }
        self
    }

    /// With the generated ground as cameras see it on a day.
    #[must_use]
    pub fn with_ground(mut self, day: FlightDay, seen: Arc<CachedImagery>) -> Self {
        self.seen = Some((day, seen));
        self
    }

    /// A worker that was given all of it.
    pub fn worker(&self) -> WorkerState {
        let mut worker = WorkerState::new(Abilities::WHOLE.opens);
        for (source, map) in &self.maps {
            worker.insert_map(source, Arc::clone(map));
        }
        if let Some((key, files)) = &self.files {
            worker.keep_files(key, Arc::clone(files));
        }
        if let Some((day, seen)) = &self.seen {
            worker.show_ground(*day, Arc::clone(seen));
        }
        if let Some((flight, frames)) = &self.flight {
            let frames = shared(frames.as_ref());
            let open = OpenFlight {
                utc_at_zero: None,
                flight: Arc::clone(flight),
                mission: None,
                frames: KeptFrames::stored(flight, frames),
            };
            worker.keep_flight(KEY, open);
        }
        worker
    }
}

/// A source of the same pictures for another thread; none where they are not stored.
fn shared(frames: &dyn FrameSource) -> SharedFrames {
    frames.another().unwrap_or_else(|| Box::new(NoPictures))
}

/// Does the orders on as many threads as there are processors. `hear` is told the events of each with its number, all
/// of the first before those of the second, whoever is done first; the last of an order is `Finished` or `Failed`.
///
/// ```
/// use pilotage_disk::workers::{Lent, run};
/// use pilotage_jobs::{DescribeMapOrder, JobEvent, MapSource};
///
/// let orders = ["countryside", "hall", "moon"].map(|world| DescribeMapOrder(MapSource::world(world)));
/// let mut told = Vec::new();
/// run(orders.into(), &Lent::default(), &mut |number, event| {
///     if event != JobEvent::Finished {
///         told.push((number, matches!(event, JobEvent::MapInfo(_))));
///     }
///     Ok(())
/// })?;
/// // There is no world called moon, and nobody else fails for it.
/// assert_eq!(told, [(0, true), (1, true), (2, false)]);
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// Whatever `hear` says; the orders that are left are not done then.
pub fn run<O: Order + Send>(
    orders: Vec<O>,
    lent: &Lent,
    hear: &mut dyn FnMut(usize, JobEvent) -> Result<(), String>,
) -> Result<(), String> {
    run_on(processors(), orders, lent, hear)
}

/// Does `then` once the standard input has ended, or cannot be read, whatever else is under way.
pub fn once_input_ends(then: impl FnOnce(std::io::Result<u64>) + Send + 'static) {
    std::thread::spawn(|| {
        let mut input = std::io::stdin().lock();
        then(std::io::copy(&mut input, &mut std::io::sink()));
    });
}

/// Number of processors.
pub fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// As [`run`], on so many threads.
///
/// # Errors
/// Whatever `hear` says; the orders that are left are not done then.
pub fn run_on<O: Order + Send>(
    threads: usize,
    orders: Vec<O>,
    lent: &Lent,
    hear: &mut dyn FnMut(usize, JobEvent) -> Result<(), String>,
) -> Result<(), String> {
    let mut in_order = InOrder::default();
    run_as_done(threads, orders, lent, &mut |number, event| {
        in_order.take(number, event, hear)
    })
}

/// As [`run_on`], but `hear` is told every event when it comes, of whichever order: for who keeps what is done, so that none
/// of it is lost while one before is not done.
///
/// ```
/// use pilotage_disk::workers::{Lent, run_as_done};
/// use pilotage_jobs::{DescribeMapOrder, JobEvent, MapSource};
///
/// let orders = ["hall", "countryside"].map(|world| DescribeMapOrder(MapSource::world(world)));
/// let mut done = [false; 2];
/// run_as_done(2, orders.into(), &Lent::default(), &mut |number, event| {
///     done[number] |= event == JobEvent::Finished;
///     Ok(())
/// })?;
/// assert_eq!(done, [true; 2]);
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// Whatever `hear` says; the orders that are left are not done then.
pub fn run_as_done<O: Order + Send>(
    threads: usize,
    orders: Vec<O>,
    lent: &Lent,
    hear: &mut dyn FnMut(usize, JobEvent) -> Result<(), String>,
) -> Result<(), String> {
    let count = orders.len();
    let queue = Mutex::new(orders.into_iter().enumerate());
    let is_over = AtomicBool::new(false);
    let work = |events: Sender<(usize, JobEvent)>| {
        let mut worker = lent.worker();
        while !is_over.load(Ordering::Relaxed) {
            let next = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((number, order)) = next else { return };
            // The last may have a processor to itself.
            let is_alone = number + 1 == count && number.is_multiple_of(threads) && threads > 1;
            worker.take_photos_by(is_alone.then_some(elsewhere));
            let mut tell = |event| {
                // Nobody hears any more once the orders are given up.
                events.send((number, event)).ok();
            };
            let goes_on = || !is_over.load(Ordering::Relaxed);
            finish(order, &mut worker, &goes_on, &mut tell);
        }
    };
    std::thread::scope(|scope| {
        let (send, receive) = channel();
        for _ in 0..threads.min(count) {
            let send = send.clone();
            scope.spawn(|| work(send));
        }
        drop(send);
        let heard = receive
            .into_iter()
            .try_for_each(|(number, event)| hear(number, event));
        is_over.store(true, Ordering::Relaxed);
        heard
    })
}

/// Does an order on this thread.
///
/// ```
/// use pilotage_disk::workers::{Lent, do_here};
/// use pilotage_jobs::{DescribeMapOrder, JobEvent, MapSource};
///
/// let mut name = String::new();
/// let order = DescribeMapOrder(MapSource::world("hall"));
/// do_here(order, &mut Lent::default().worker(), &mut |event| {
///     if let JobEvent::MapInfo(info) = event {
///         name = info.name;
///     }
///     Ok(())
/// })?;
/// assert!(!name.is_empty());
/// # Ok::<(), String>(())
/// ```
///
/// `hear` is told its events; the last is `Finished` or `Failed`.
///
/// # Errors
/// Whatever `hear` says; the rest of the order is not done then.
pub fn do_here<O: Order>(
    order: O,
    worker: &mut WorkerState,
    hear: &mut dyn FnMut(JobEvent) -> Result<(), String>,
) -> Result<(), String> {
    let heard = RefCell::new(Ok(()));
    let goes_on = || heard.borrow().is_ok();
    finish(order, worker, &goes_on, &mut |event| {
        if goes_on() {
            let told = hear(event);
            *heard.borrow_mut() = told;
        }
    });
    heard.into_inner()
}

/// Works on an order until it is done, or nobody wants it to go on.
fn finish<O: Order>(
    order: O,
    worker: &mut WorkerState,
    goes_on: &dyn Fn() -> bool,
    tell: &mut dyn FnMut(JobEvent),
) {
    let begun = Instant::now();
    let clock = || begun.elapsed().as_secs_f64() * 1e3;
    let mut job = order.begin(worker);
    while goes_on() {
        match job.advance(worker, &clock, tell) {
            Ok(Advance::More) => {}
            Ok(Advance::Done) => return,
            Err(why) => return tell(JobEvent::Failed(why)),
        }
    }
}

/// Does `work` on a thread of its own while this one asks every 20 ms by `waits` whether it is still waited for. Where it is
/// not, that is told at once; the work is told when it next asks whether it goes on, and is left to itself until then.
///
/// ```
/// use pilotage_disk::workers::while_waited_for;
///
/// assert_eq!(while_waited_for(|_| 6 * 7, &mut || Ok::<(), String>(())), Ok(42));
/// let endless = |goes_on: pilotage_disk::workers::GoesOn<'_>| while goes_on().is_ok() {};
/// assert_eq!(while_waited_for(endless, &mut || Err("enough")), Err("enough"));
/// ```
///
/// # Errors
/// Whatever `waits` says.
pub fn while_waited_for<T: Send + 'static, E>(
    work: impl FnOnce(GoesOn<'_>) -> T + Send + 'static,
    waits: &mut dyn FnMut() -> Result<(), E>,
) -> Result<T, E> {
    let is_over = Arc::new(AtomicBool::new(false));
    let is_told = Arc::clone(&is_over);
    let (ends, end) = channel::<()>();
    let worker = std::thread::spawn(move || {
        // Dropped however the work ends.
        let _ends = ends;
        work(&mut || {
            if is_told.load(Ordering::Relaxed) {
                return Err("nobody waits for it any more".to_owned());
            }
            Ok(())
        })
    });
    while end.recv_timeout(ASKED_EVERY) == Err(RecvTimeoutError::Timeout) {
        waits().inspect_err(|_| is_over.store(true, Ordering::Relaxed))?;
    }
    worker
        .join()
        .map_err(|panic| std::panic::resume_unwind(panic))
}

/// Events that came before their turn.
#[derive(Default)]
struct InOrder {
    /// Number of the order whose turn it is.
    turn: usize,
    waiting: BTreeMap<usize, Vec<JobEvent>>,
}

impl InOrder {
    /// Passes an event on, and what waited for it; or keeps it until its turn.
    fn take(
        &mut self,
        number: usize,
        event: JobEvent,
        hear: &mut dyn FnMut(usize, JobEvent) -> Result<(), String>,
    ) -> Result<(), String> {
        if number != self.turn {
            let waiting = self.waiting.entry(number).or_default();
            // Of what is told late, how far it was once does not matter.
            if matches!(event, JobEvent::Progress(..)) {
                waiting.retain(|event| !matches!(event, JobEvent::Progress(..)));
            }
            waiting.push(event);
            return Ok(());
        }
        let mut is_last = event.is_last();
        hear(number, event)?;
        while is_last {
            self.turn += 1;
            is_last = false;
            for event in self.waiting.remove(&self.turn).unwrap_or_default() {
                is_last |= event.is_last();
                hear(self.turn, event)?;
            }
        }
        Ok(())
    }
}

/// The same photos, taken by a thread of their own.
fn elsewhere(photos: TrainingPhotos) -> TrainingPhotos {
    let (send, receive) = channel();
    std::thread::spawn(move || {
        for photo in photos {
            if send.send(photo).is_err() {
                break;
            }
        }
    });
    Box::new(receive.into_iter())
}

#[cfg(test)]
mod tests {
    use pilotage_jobs::{RunningJob, Urgency, WorkerRole};

    use super::*;

    /// Order that takes so many slices and tells each; `None` fails.
    struct Slices(Option<usize>);

    struct Left(Option<usize>);

    impl RunningJob for Left {
        fn advance(
            &mut self,
            _: &mut WorkerState,
            _: &dyn Fn() -> f64,
            emit: &mut dyn FnMut(JobEvent),
        ) -> Result<Advance, String> {
            let left = self.0.as_mut().ok_or("it cannot be done")?;
            emit(JobEvent::of_figures(left)?);
            std::thread::sleep(std::time::Duration::from_millis(1));
            if *left == 0 {
                emit(JobEvent::Finished);
                return Ok(Advance::Done);
            }
            *left -= 1;
            Ok(Advance::More)
        }
    }

    impl Order for Slices {
        const URGENCY: Urgency = Urgency::Slow;

        fn role(&self) -> WorkerRole {
            WorkerRole::Flight
        }

        fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
            Box::new(Left(self.0))
        }
    }

    /// Everything that is heard on so many threads: number of the order and slices left.
    fn heard(threads: usize, slices: &[Option<usize>]) -> Vec<(usize, Result<usize, String>)> {
        let mut all = Vec::new();
        let orders = slices.iter().map(|count| Slices(*count)).collect();
        run_on(threads, orders, &Lent::default(), &mut |number, event| {
            match event {
                JobEvent::Finished => {}
                JobEvent::Failed(why) => all.push((number, Err(why))),
                figures => all.push((number, Ok(figures.read_figures()?))),
            }
            Ok(())
        })
        .expect("orders that are done");
        all
    }

    #[test]
    fn what_is_heard_does_not_depend_on_the_number_of_threads() {
        let slices = [Some(9), Some(0), None, Some(3), Some(1), Some(0)];
        let alone = heard(1, &slices);
        assert_eq!(alone.len(), 10 + 1 + 1 + 4 + 2 + 1);
        assert_eq!(alone[11], (2, Err("it cannot be done".to_owned())));
        for threads in [2, 3, 8] {
            assert_eq!(heard(threads, &slices), alone, "{threads} threads");
        }
    }

    #[test]
    fn what_is_done_is_heard_at_once_by_who_does_not_wait_for_its_turn() {
        let long = 300;
        let orders = [Some(long), Some(0), Some(0)].map(Slices).into();
        let (mut before, mut done) = (0, Vec::new());
        let heard = run_as_done(2, orders, &Lent::default(), &mut |number, event| {
            match event {
                JobEvent::Finished => done.push(number),
                _ if done.is_empty() => before += 1,
                _ => {}
            }
            Ok(())
        });
        assert_eq!(heard, Ok(()));
        // The short ones were heard while the long one was under way.
        assert!(done == [1, 2, 0] && before < long, "{done:?} {before}");
    }

    #[test]
    fn work_that_nobody_waits_for_is_told_so_and_what_it_came_to_or_broke_by_is_told() {
        let (send, told) = channel();
        let begun = Instant::now();
        let mut asked = 0;
        let given_up = while_waited_for(
            move |goes_on| {
                while goes_on().is_ok() {
                    std::thread::sleep(Duration::from_millis(1));
                }
                send.send("ended").ok();
            },
            &mut || {
                asked += 1;
                if asked == 3 { Err("enough") } else { Ok(()) }
            },
        );
        assert_eq!((given_up, asked), (Err("enough"), 3));
        assert_eq!(told.recv_timeout(Duration::from_mins(1)), Ok("ended"));
        // Work that does not ask holds nobody up.
        let sleeps = |_: GoesOn<'_>| std::thread::sleep(Duration::from_mins(1));
        assert_eq!(while_waited_for(sleeps, &mut || Err(())), Err(()));
        assert!(begun.elapsed() < Duration::from_secs(50));
        let breaks = |_: GoesOn<'_>| -> usize { panic!("it broke") };
        let broken = std::panic::catch_unwind(|| while_waited_for(breaks, &mut || Ok::<_, ()>(())));
        let why = broken.expect_err("it broke");
        assert_eq!(why.downcast_ref::<&str>(), Some(&"it broke"));
    }

    #[test]
    fn orders_that_are_left_are_given_up_once_somebody_has_enough() {
        let orders = (0..100_000).map(|_| Slices(Some(0))).collect();
        let mut last = 0;
        let enough = run_on(2, orders, &Lent::default(), &mut |number, _| {
            last = number;
            if number == 3 {
                return Err("enough".to_owned());
            }
            Ok(())
        });
        assert_eq!((enough, last), (Err("enough".to_owned()), 3));
    }

    #[test]
    fn an_order_on_this_thread_is_heard_to_its_end_or_until_somebody_has_enough() {
        let mut worker = Lent::default().worker();
        let mut heard = |slices, most: usize| {
            let mut events = 0;
            let done = do_here(Slices(slices), &mut worker, &mut |event| {
                events += 1;
                match event {
                    JobEvent::Failed(why) => Err(why),
                    _ if events > most => Err("enough".to_owned()),
                    _ => Ok(()),
                }
            });
            (done, events)
        };
        assert_eq!(heard(Some(3), 9), (Ok(()), 5));
        assert_eq!(heard(Some(3), 1), (Err("enough".to_owned()), 2));
        assert_eq!(heard(None, 9), (Err("it cannot be done".to_owned()), 1));
    }
}
