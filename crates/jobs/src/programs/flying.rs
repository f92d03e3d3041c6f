//! Jobs of the small program: simulated flights over the generated ground and in the hall, their maps,
//! pictures and questions about them.

use std::sync::Arc;

use pilotage_core::imagery::Blank;
use pilotage_core::simulate::IndoorHall;

use super::super::flights::OpenFlight;
use super::super::worker_state::OpenedMap;
use super::super::{FlightSource, MapSource, WorkerState, simulated};

/// Opens one of its maps.
pub fn open_map(worker: &mut WorkerState, source: &MapSource) -> OpenedMap {
    match source {
        MapSource::Scenery => Ok(Arc::new(worker.scenery())),
        MapSource::Hall => Ok(Arc::new(IndoorHall::map())),
        MapSource::Nothing => Ok(Arc::new(Blank)),
        _ => Err("this worker does not open such maps; load the page again".to_owned()),
    }
}

/// Opens one of its flights.
pub fn open_flight(worker: &mut WorkerState, source: &FlightSource) -> Result<OpenFlight, String> {
    match source {
        FlightSource::Simulated(options) if options.is_indoors() => {
            Ok(simulated::open_hall(options))
        }
        FlightSource::Simulated(options) => simulated::open(options, &worker.scenery()),
        FlightSource::Nothing => Err("no flight is open".to_owned()),
        FlightSource::Files(_) => {
            Err("this worker does not open files; load the page again".to_owned())
        }
    }
}
