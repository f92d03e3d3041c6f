//! Jobs of the small program: simulated flights over the generated ground and in the hall, their maps,
//! pictures and questions about them.

use std::sync::Arc;

use pilotage_core::imagery::Blank;
use pilotage_core::simulate::IndoorHall;

use super::super::flights::OpenFlight;
use super::super::workshop::OpenedMap;
use super::super::{FlightSource, MapSource, Workshop, simulated};

/// Opens one of its maps.
pub fn open_map(workshop: &mut Workshop, source: &MapSource) -> OpenedMap {
    match source {
        MapSource::Scenery => Ok(Arc::new(workshop.scenery())),
        MapSource::Hall => Ok(Arc::new(IndoorHall::map())),
        MapSource::Nothing => Ok(Arc::new(Blank)),
        _ => Err("this worker does not open such maps; load the page again".to_owned()),
    }
}

/// Opens one of its flights.
pub fn open_flight(workshop: &mut Workshop, source: &FlightSource) -> Result<OpenFlight, String> {
    match source {
        FlightSource::Simulated(options) if options.is_indoors() => {
            Ok(simulated::open_hall(options))
        }
        FlightSource::Simulated(options) => simulated::open(options, &workshop.scenery()),
        FlightSource::Nothing => Err("no flight is open".to_owned()),
        FlightSource::Files(_) => {
            Err("this worker does not open files; load the page again".to_owned())
        }
    }
}
