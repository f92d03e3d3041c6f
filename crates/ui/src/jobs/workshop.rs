//! What the jobs of one worker share: files, opened maps, flights, rendered frames.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::imagery::Imagery;

use super::explain::match_pictures;
use super::flights::OpenFlight;
use super::fly::Fly;
use super::running::Once;
use super::{FlightSource, Job, JobEvent, MapInfo, MapSource, RunningJob, simulated};

/// Files under a key: path and bytes of each.
pub type Files = Rc<Vec<(String, Vec<u8>)>>;

/// The store of a worker. Everything in it can be made anew from the files.
#[derive(Default)]
pub struct Workshop {
    files: BTreeMap<String, Files>,
    maps: BTreeMap<Vec<u8>, Arc<dyn Imagery>>,
    flights: BTreeMap<Vec<u8>, Rc<RefCell<OpenFlight>>>,
}

impl Workshop {
    /// An empty workshop.
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes a job ready to advance.
    pub fn start(&mut self, job: Job) -> Box<dyn RunningJob> {
        match job {
            Job::Provide { key, files } => {
                self.provide(key, files);
                once(|_, _| Ok(()))
            }
            Job::Open { key } => once(move |workshop, emit| {
                let _ = (workshop, emit);
                Err(format!("{key}: nothing here can be opened"))
            }),
            Job::Fly {
                flight,
                map,
                mission,
            } => Box::new(Fly::new(flight, map, mission)),
            Job::DescribeMap(source) => once(move |workshop, emit| {
                let map = workshop.map(&source)?;
                emit(JobEvent::MapInfo(describe(map.as_ref())));
                Ok(())
            }),
            Job::Tile { map, window } => once(move |workshop, emit| {
                let pixels = workshop.map(&map)?.window(&window);
                emit(JobEvent::Tile { window, pixels });
                Ok(())
            }),
            Job::Distinctness { .. } => once(|_, _| Err("there is no detector yet".to_owned())),
            Job::ExplainMatch {
                flight,
                map,
                mission,
                step,
                landmark,
            } => once(move |workshop, emit| {
                let pictures = match_pictures(workshop, &flight, &map, &mission, &step, landmark)?;
                emit(JobEvent::Match(Box::new(pictures)));
                Ok(())
            }),
        }
    }

    /// Keeps files under a key and forgets what was made of earlier ones.
    pub fn provide(&mut self, key: String, files: Vec<(String, Vec<u8>)>) {
        self.maps.remove(&cache_key(&MapSource::Files(key.clone())));
        self.flights
            .remove(&cache_key(&FlightSource::Files(key.clone())));
        self.files.insert(key, Rc::new(files));
    }

    /// The files under a key.
    pub fn files(&self, key: &str) -> Result<Files, String> {
        self.files
            .get(key)
            .cloned()
            .ok_or_else(|| format!("the files “{key}” are not here; open them again"))
    }

    /// Puts a map in place of the one that would be opened.
    pub fn insert_map(&mut self, source: &MapSource, map: Arc<dyn Imagery>) {
        self.maps.insert(cache_key(source), map);
    }

    /// A map, opened once.
    pub fn map(&mut self, source: &MapSource) -> Result<Arc<dyn Imagery>, String> {
        let key = cache_key(source);
        if let Some(map) = self.maps.get(&key) {
            return Ok(map.clone());
        }
        let map = match source {
            MapSource::Scenery => simulated::scenery_map(),
            MapSource::Files(key) => return Err(format!("{key}: there is no map here")),
        };
        self.maps.insert(key, map.clone());
        Ok(map)
    }

    /// A flight, opened once; the one before it is let go.
    pub fn flight(&mut self, source: &FlightSource) -> Result<Rc<RefCell<OpenFlight>>, String> {
        let key = cache_key(source);
        if let Some(open) = self.flights.get(&key) {
            return Ok(open.clone());
        }
        let open = match source {
            FlightSource::Simulated(options) => simulated::open(options)?,
            FlightSource::Files(key) => return Err(format!("{key}: there is no flight here")),
        };
        let open = Rc::new(RefCell::new(open));
        self.flights.clear();
        self.flights.insert(key, open.clone());
        Ok(open)
    }
}

fn once<F>(work: F) -> Box<dyn RunningJob>
where
    F: FnOnce(&mut Workshop, &mut dyn FnMut(JobEvent)) -> Result<(), String> + 'static,
{
    Box::new(Once(Some(work)))
}

fn describe(map: &dyn Imagery) -> MapInfo {
    MapInfo {
        name: map.name().to_owned(),
        bounds: map.bounds(),
        native_gsd: map.native_gsd(),
    }
}

/// Bytes that are equal for equal sources.
fn cache_key(source: &impl serde::Serialize) -> Vec<u8> {
    postcard::to_stdvec(source).unwrap_or_default()
}
