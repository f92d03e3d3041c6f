//! The store that the jobs of one worker share (files, opened maps, flights, rendered frames), and the trait
//! of a job that works with it.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::expression::TimedSamples;
use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::log::Log;
use pilotage_core::imagery::{ByteSource, CachedImagery, Imagery, MapMemory};
use pilotage_core::mission::Mission;
use pilotage_core::plan::{
    EnvelopeSurvey, OtherDays, PictureDays, Proposal, Rehearsal, SceneryDays,
};
use pilotage_core::simulate::{FlightDay, LaidWorld, Overrides, SimulationChoice};
use pilotage_core::training::TrainingPhotos;

use super::fetched_tiles::{FetchedTiles, WEB_TILES};
use super::file_pool::FilePool;
use super::flights::OpenFlight;
use super::lent::{LentFiles, OpenAddress};
use super::samples::{KeptSamples, samples};
use super::{FileContent, FlightSource, JobEvent, MapInfo, MapSource, SeriesName};

/// Memory for what one job reads of a map, megabytes.
const CACHE_MEGABYTES: usize = 48;

/// The same ground on several days.
type Days = Vec<Arc<dyn Imagery>>;

/// Most maps that are kept open.
const MOST_MAPS: usize = 2;
/// Memory of a map: every worker that reads it takes as much, beside the textures of the page.
pub const MAP_MEMORY: MapMemory = MapMemory {
    tiles: 40 << 20,
    coarse: 24 << 20,
};

/// A map that is open.
struct KeptMap {
    source: MapSource,
    map: Arc<dyn Imagery>,
    /// Problems of it that were told.
    told: usize,
}

/// State of a job after a slice: more to do, or done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advance {
    /// Call again.
    More,
    /// The last event was sent.
    Done,
}

/// A job as a state machine: whoever owns it calls [`RunningJob::advance`] until it is done, and
/// drops it to cancel it.
pub trait RunningJob {
    /// Works for about a slice (25 ms by `clock`, milliseconds) and emits what came of it.
    ///
    /// # Errors
    /// Why it cannot go on, in words; its owner tells them as the job's last event.
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String>;
}

/// Takes photos beside the worker that asks for them, and gives them in the same order.
pub type Elsewhere = fn(TrainingPhotos) -> TrainingPhotos;

/// A map that was opened, or why not, in words.
pub type OpenedMap = Result<Arc<dyn Imagery>, String>;

/// Opens what jobs need, as far as the program of the worker can.
#[derive(Clone, Copy)]
pub struct Opens {
    /// Opens a map; the error says in words why not.
    pub map: fn(&mut WorkerState, &MapSource) -> OpenedMap,
    /// Opens a flight; the error says in words why not.
    pub flight: fn(&mut WorkerState, &FlightSource) -> Result<OpenFlight, String>,
    /// Lays out the world of a key, if there is one.
    pub world: fn(&str) -> Option<Arc<dyn LaidWorld>>,
}

/// The store of a worker. Everything in it can be made anew from the files.
pub struct WorkerState {
    opens: Opens,
    /// Files by key; a zip that cannot be read is told when the files are used.
    files: BTreeMap<String, Result<Arc<dyn FileSet>, String>>,
    lent: LentFiles,
    fetched: FetchedTiles,
    /// Opened maps, the one used last at the end.
    maps: Vec<KeptMap>,
    flights: BTreeMap<Vec<u8>, Rc<RefCell<OpenFlight>>>,
    /// The log read last: key of its files, its name among them, and what was read so far.
    log: Option<(String, String, Rc<RefCell<Log>>)>,
    /// Series of that log which were asked for last.
    samples: KeptSamples,
    /// Worlds that were laid out, by key.
    worlds: Vec<(String, Arc<dyn LaidWorld>)>,
    /// Mission of the scenario that was asked for last, by its name.
    scenario: Option<(String, Rc<Mission>)>,
    /// A map and how it looks on other days; of one map at a time.
    days: Option<(Vec<u8>, Days)>,
    /// A map with a seed, and the days on which its landmarks are rehearsed.
    rehearsal: Option<(Vec<u8>, Days)>,
    /// Generated ground as cameras see it, laid out by the host for all flights of a day.
    seen: Option<(FlightDay, Arc<CachedImagery>)>,
    /// Taker of photos beside this worker, where the host has a processor to spare.
    pub(super) elsewhere: Option<Elsewhere>,
}

impl WorkerState {
    /// Empty state of a worker whose program that can do this.
    pub fn new(opens: Opens) -> Self {
        Self {
            opens,
            files: BTreeMap::new(),
            lent: LentFiles::default(),
            fetched: FetchedTiles::default(),
            maps: Vec::new(),
            flights: BTreeMap::new(),
            log: None,
            samples: KeptSamples::default(),
            worlds: Vec::new(),
            scenario: None,
            days: None,
            rehearsal: None,
            seen: None,
            elsewhere: None,
        }
    }

    /// Shows cameras the generated ground of a day in this imagery, which hosts share among their workers.
    pub fn show_ground(&mut self, day: FlightDay, seen: Arc<CachedImagery>) {
        self.seen = Some((day, seen));
    }

    /// Imagery of that day which the host shares, if it does.
    pub(super) fn shown_ground(&self, day: FlightDay) -> Option<Arc<CachedImagery>> {
        let shown = self.seen.as_ref().filter(|(of, _)| *of == day);
        shown.map(|(_, seen)| Arc::clone(seen))
    }

    /// Says by whom photos are taken beside this worker, if anybody.
    pub fn take_photos_by(&mut self, elsewhere: Option<Elsewhere>) {
        self.elsewhere = elsewhere;
    }

    /// Lends a file that is read by pieces under a number.
    pub fn lend(&mut self, number: u32, source: Arc<dyn ByteSource>) {
        self.lent.files.insert(number, source);
    }

    /// Says how files of the web are opened.
    pub fn open_addresses_by(&mut self, open: OpenAddress) {
        self.lent.web = Some(open);
    }

    /// Keeps files under a key and forgets what was made of earlier ones.
    pub fn provide(&mut self, key: String, files: &[(String, FileContent)]) {
        if key == WEB_TILES {
            for (address, content) in files {
                if let FileContent::Bytes(bytes) = content {
                    self.fetched.keep(address, bytes.clone());
                }
            }
            return;
        }
        self.maps.retain(|kept| kept.source.key() != Some(&key));
        self.days = None;
        self.rehearsal = None;
        self.flights
            .remove(&cache_key(&FlightSource::Files(key.clone())));
        let pool = FilePool::new(files, &self.lent);
        let pool = pool.map(|pool| Arc::new(pool) as Arc<dyn FileSet>);
        self.files.insert(key, pool);
    }

    /// Keeps files that the host has opened itself under a key.
    pub fn keep_files(&mut self, key: &str, files: Arc<dyn FileSet>) {
        self.files.insert(key.to_owned(), Ok(files));
    }

    /// Lets go of all files but those under the keys `in_use`, and of what was made of them.
    pub fn let_go(&mut self, in_use: &BTreeSet<String>) {
        let is_used = |source: &MapSource| source.key().is_none_or(|key| in_use.contains(key));
        self.maps.retain(|kept| is_used(&kept.source));
        self.files.retain(|key, _| in_use.contains(key));
        if self
            .log
            .as_ref()
            .is_some_and(|(key, ..)| !in_use.contains(key))
        {
            self.log = None;
            self.samples.clear();
        }
        self.days = None;
        self.rehearsal = None;
        // A flight that is flown stays with its job; one that was made of a log is not made twice.
        let of_files = |key: &String| cache_key(&FlightSource::Files(key.clone()));
        let flights_in_use: BTreeSet<Vec<u8>> = in_use.iter().map(of_files).collect();
        self.flights.retain(|key, _| flights_in_use.contains(key));
    }

    /// Keeps a log that is being read, or was, in place of the one before.
    pub fn keep_log(&mut self, key: &str, file: &str, log: Rc<RefCell<Log>>) {
        self.log = Some((key.to_owned(), file.to_owned(), log));
        self.samples.clear();
    }

    /// More of the log was read: what was asked of it before may be another answer now.
    pub fn log_grew(&mut self) {
        self.samples.clear();
    }

    /// A series of the log `file` among the files under `key`.
    ///
    /// # Errors
    /// The log is not the one that was read last; within, why the log has no such series.
    pub fn samples(
        &mut self,
        key: &str,
        file: &str,
        series: &SeriesName,
    ) -> Result<Result<Rc<TimedSamples>, String>, String> {
        let log = self.log(key, file);
        let log = log.ok_or_else(|| format!("{file}: it is not read yet"))?;
        let log = log.clone();
        Ok(self.samples.get(series, || samples(&log.borrow(), series)))
    }

    /// The log `file` among the files under `key`, if it is the one that was read last.
    pub fn log(&self, key: &str, file: &str) -> Option<&Rc<RefCell<Log>>> {
        let (kept_key, kept_file, log) = self.log.as_ref()?;
        (kept_key == key && kept_file == file).then_some(log)
    }

    /// Keeps the flight among the files under `key`, which is not to be made again.
    pub fn keep_flight(&mut self, key: &str, open: OpenFlight) {
        let source = FlightSource::Files(key.to_owned());
        self.flights.clear();
        self.flights
            .insert(cache_key(&source), Rc::new(RefCell::new(open)));
    }

    /// The files under a key.
    pub fn files(&self, key: &str) -> Result<Arc<dyn FileSet>, String> {
        let lost = || Err("the files are not here any more; open them again".to_owned());
        self.files.get(key).cloned().unwrap_or_else(lost)
    }

    /// Puts a map in place of the one that would be opened.
    pub fn insert_map(&mut self, source: &MapSource, map: Arc<dyn Imagery>) {
        self.maps.retain(|kept| kept.source != *source);
        if self.maps.len() >= MOST_MAPS {
            self.maps.remove(0);
        }
        self.maps.push(KeptMap {
            source: source.clone(),
            map,
            told: 0,
        });
    }

    /// The map of a source, with what is read of it kept for one job that looks at the same ground often.
    pub fn cached_map(&mut self, source: &MapSource) -> Result<Arc<dyn Imagery>, String> {
        Ok(Arc::new(CachedImagery::new(
            self.map(source)?,
            CACHE_MEGABYTES,
        )))
    }

    /// A map, opened once.
    pub fn map(&mut self, source: &MapSource) -> Result<Arc<dyn Imagery>, String> {
        if let Some(at) = self.maps.iter().position(|kept| kept.source == *source) {
            let kept = self.maps.remove(at);
            let map = kept.map.clone();
            self.maps.push(kept);
            return Ok(map);
        }
        let map = (self.opens.map)(self, source)?;
        self.insert_map(source, map.clone());
        Ok(map)
    }

    /// Problems in reading a map that came up since the last call, in words.
    pub fn new_problems(&mut self, source: &MapSource) -> Vec<String> {
        let Some(kept) = self.maps.iter_mut().find(|kept| kept.source == *source) else {
            return Vec::new();
        };
        let mut problems = kept.map.problems();
        let new = problems.split_off(kept.told.min(problems.len()));
        kept.told += new.len();
        new
    }

    /// Looks of a map on `count` other days, laid out once and kept where it was looked at.
    pub fn other_days(&mut self, source: &MapSource, count: usize) -> Result<Days, String> {
        let key = cache_key(source);
        if let Some((of, days)) = &self.days
            && *of == key
            && days.len() == count
        {
            return Ok(days.clone());
        }
        let others = self.others(source)?;
        let days: Vec<_> = (0..count as u64).map(|d| others.day(1 + d)).collect();
        self.days = Some((key, days.clone()));
        Ok(days)
    }

    /// The days, drawn by `seed`, on which landmarks of a map are rehearsed, laid out once.
    pub fn rehearsal_days(&mut self, source: &MapSource, seed: u64) -> Result<Days, String> {
        let key = cache_key(&(source, seed));
        if let Some((of, days)) = &self.rehearsal
            && *of == key
        {
            return Ok(days.clone());
        }
        let days = Rehearsal::days(self.others(source)?.as_ref(), seed);
        self.rehearsal = Some((key, days.clone()));
        Ok(days)
    }

    /// The days on which an envelope is measured, evenly spread; not kept.
    pub fn envelope_days(&mut self, source: &MapSource, seed: u64) -> Result<Days, String> {
        let others = self.others(source)?;
        Ok(others.spread(EnvelopeSurvey::DAYS, seed))
    }

    /// The days on which places are rehearsed before landmarks are proposed; not kept.
    pub fn proposal_days(&mut self, source: &MapSource, seed: u64) -> Result<Days, String> {
        Ok(Proposal::days(self.others(source)?.as_ref(), seed))
    }

    /// Source of a map's looks on other days.
    pub(super) fn others(&mut self, source: &MapSource) -> Result<Box<dyn OtherDays>, String> {
        let scenery = match source {
            MapSource::World(key) => self.world(key)?.scenery(),
            _ => None,
        };
        Ok(match scenery {
            Some(scenery) => Box::new(SceneryDays { scenery }),
            None => Box::new(PictureDays::new(self.map(source)?)),
        })
    }

    /// Tiles of the web that were handed in.
    pub(super) fn fetched(&self) -> &FetchedTiles {
        &self.fetched
    }

    /// The world of a key, laid out once.
    pub(super) fn world(&mut self, key: &str) -> Result<Arc<dyn LaidWorld>, String> {
        if let Some((_, world)) = self.worlds.iter().find(|(own, _)| own == key) {
            return Ok(world.clone());
        }
        let world = (self.opens.world)(key);
        let world = world.ok_or("this worker does not know that world; load the page again")?;
        self.worlds.push((key.to_owned(), world.clone()));
        Ok(world)
    }

    /// Mission of a scenario of the built-in worlds, made once; the one before it is let go.
    pub(super) fn scenario(&mut self, name: &str) -> Result<Rc<Mission>, String> {
        if let Some((_, mission)) = self.scenario.as_ref().filter(|(of, _)| of == name) {
            return Ok(mission.clone());
        }
        let unknown = || format!("there is no scenario “{name}”");
        let choice = SimulationChoice::named(name).ok_or_else(unknown)?;
        let world = self.world(choice.world.key())?;
        let missions = world.missions(name, &Overrides::default());
        let (_, mission) = missions.into_iter().next().ok_or_else(unknown)?;
        let mission = Rc::new(mission);
        self.scenario = Some((name.to_owned(), mission.clone()));
        Ok(mission)
    }

    /// A flight, opened once; the one before it is let go.
    pub fn flight(&mut self, source: &FlightSource) -> Result<Rc<RefCell<OpenFlight>>, String> {
        let key = cache_key(source);
        if let Some(open) = self.flights.get(&key) {
            return Ok(open.clone());
        }
        let open = (self.opens.flight)(self, source)?;
        let open = Rc::new(RefCell::new(open));
        self.flights.clear();
        self.flights.insert(key, open.clone());
        Ok(open)
    }
}

/// Description of a map.
pub fn describe(map: &dyn Imagery) -> MapInfo {
    MapInfo {
        name: map.name().to_owned(),
        bounds: map.bounds(),
        native_gsd: map.native_gsd(),
        is_coarse_cheap: map.is_coarse_cheap(),
        origin: None,
        attribution: map.attribution().map(str::to_owned),
    }
}

/// Bytes that are equal for equal sources.
fn cache_key(source: &impl serde::Serialize) -> Vec<u8> {
    postcard::to_stdvec(source).unwrap_or_default()
}
