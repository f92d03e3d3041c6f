//! Jobs of the small program: simulated flights in the worlds that it links, their maps,
//! pictures and questions about them.

use std::sync::Arc;

use pilotage_core::imagery::Blank;

use super::super::flights::OpenFlight;
use super::super::worker_state::OpenedMap;
use super::super::{FlightSource, MapSource, WorkerState, rehearse, simulated};

/// Opens one of its maps.
pub fn open_map(worker: &mut WorkerState, source: &MapSource) -> OpenedMap {
    match source {
        MapSource::World(key) => Ok(worker.world(key)?.map()),
        MapSource::Nothing => Ok(Arc::new(Blank)),
        _ => Err("this worker does not open such maps; load the page again".to_owned()),
    }
}

/// Opens one of its flights.
pub fn open_flight(worker: &mut WorkerState, source: &FlightSource) -> Result<OpenFlight, String> {
    match source {
        FlightSource::Simulated(options) => {
            let world = worker.world(simulated::choice(options)?.world.key())?;
            let shown = worker.shown_ground(options.day());
            simulated::open(options, world.as_ref(), shown)
        }
        FlightSource::Rehearsed(flight) => rehearse::open(worker, flight),
        FlightSource::Nothing => Err("no flight is open".to_owned()),
        FlightSource::Files(_) | FlightSource::Studied(_) => {
            Err("this worker does not open such flights; load the page again".to_owned())
        }
    }
}
