//! Jobs of the whole program beyond those of the small one.

use std::sync::Arc;

use pilotage_core::flight::files::FileSet;
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::{MapOptions, open_map_with};

use super::super::flights::OpenFlight;
use super::super::worker_state::{MAP_MEMORY, OpenedMap};
use super::super::{FlightSource, MapSource, WorkerState, opening, studied, tables};
use super::flying;

/// Opens a map.
pub fn open_map(worker: &mut WorkerState, source: &MapSource) -> OpenedMap {
    match source {
        MapSource::World(_) | MapSource::Nothing => flying::open_map(worker, source),
        MapSource::Web(map) => Ok(Arc::new(map.open(worker.fetched()))),
        MapSource::Files(key) => {
            let files = worker.files(key)?;
            let frame = match tables::flight_folder(&files)? {
                Some(folder) => folder.flight.frame_on_globe,
                None => None,
            };
            map_among(files.as_ref(), frame)
        }
        MapSource::Placed { key, origin } => {
            let files = worker.files(key)?;
            map_among(files.as_ref(), Some(LocalFrame::new(*origin)))
        }
        MapSource::Picture {
            key,
            name,
            origin,
            place,
        } => {
            let options = MapOptions {
                frame: origin.map(LocalFrame::new),
                place: Some(*place),
                memory: MAP_MEMORY,
                ..MapOptions::default()
            };
            let files = worker.files(key)?;
            let map = open_map_with(files.as_ref(), name, &options);
            Ok(Arc::new(map.map_err(|cause| cause.to_string())?))
        }
    }
}

/// The map among files, in the world frame `frame` or else its own.
fn map_among(files: &dyn FileSet, frame: Option<LocalFrame>) -> Result<Arc<dyn Imagery>, String> {
    let options = MapOptions {
        frame,
        memory: MAP_MEMORY,
        ..MapOptions::default()
    };
    let map = opening::map(files, &options)?;
    let (_, map) = map.ok_or("there is no map among the files")?;
    Ok(Arc::new(map))
}

/// Opens a flight.
pub fn open_flight(worker: &mut WorkerState, source: &FlightSource) -> Result<OpenFlight, String> {
    match source {
        FlightSource::Files(key) => {
            let files = worker.files(key)?;
            let open = opening::flight(&files)?;
            Ok(open.ok_or("there is no flight among the files")?)
        }
        FlightSource::Studied(flight) => studied::open(worker, flight),
        FlightSource::Simulated(_) | FlightSource::Rehearsed(_) | FlightSource::Nothing => {
            flying::open_flight(worker, source)
        }
    }
}
