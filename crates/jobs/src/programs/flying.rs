//! Jobs of the small program: simulated flights over the generated ground and in the hall, their maps,
//! pictures and questions about them.

use std::sync::Arc;

use pilotage_core::imagery::{Blank, Imagery, Window};
use pilotage_core::raster::decode_picture;
use pilotage_core::simulate::IndoorHall;

use super::super::explain::explained;
use super::super::flights::OpenFlight;
use super::super::fly::Fly;
use super::super::predict::Predict;
use super::super::running::once;
use super::super::workshop::{OpenedMap, describe};
use super::super::{
    FlightSource, Job, JobEvent, MapSource, RunningJob, Workshop, distinct, simulated,
};

/// Whether the small program does a job.
pub fn does(job: &Job) -> bool {
    match job {
        Job::Fly { flight, map, .. } | Job::ExplainMatch { flight, map, .. } => {
            flies(flight) && opens(map)
        }
        Job::DescribeMap(map) | Job::Tile { map, .. } | Job::Distinctness { map, .. } => opens(map),
        Job::Predict(_) | Job::DecodePicture { .. } => true,
        _ => false,
    }
}

/// Whether it opens a map.
fn opens(map: &MapSource) -> bool {
    matches!(
        map,
        MapSource::Scenery | MapSource::Hall | MapSource::Nothing
    )
}

/// Whether it opens a flight.
fn flies(flight: &FlightSource) -> bool {
    matches!(flight, FlightSource::Simulated(_) | FlightSource::Nothing)
}

/// Makes one of its jobs ready to advance.
pub fn begin(_: &mut Workshop, job: Job) -> Box<dyn RunningJob> {
    match job {
        Job::LetGo { keys } => once(move |workshop, _| {
            workshop.let_go(&keys.into_iter().collect());
            Ok(())
        }),
        Job::Fly {
            flight,
            map,
            mission,
        } => Box::new(Fly::new(flight, map, mission)),
        Job::DescribeMap(source) => once(move |workshop, emit| {
            let map = workshop.map(&source)?;
            let mut info = describe(map.as_ref());
            info.origin = source.origin();
            emit(JobEvent::MapInfo(info));
            Ok(())
        }),
        Job::Tile { map, window } => {
            once(move |workshop, emit| send_tile(workshop, &map, window, emit))
        }
        Job::Distinctness {
            map,
            bounds,
            radius,
        } => once(move |workshop, emit| {
            let map = workshop.map(&map)?;
            let found = distinct::examine(map.as_ref(), bounds, radius);
            emit(JobEvent::Distinctness(Box::new(found)));
            Ok(())
        }),
        Job::Predict(order) => Box::new(Predict(*order)),
        Job::ExplainMatch { .. } => once(move |workshop, emit| {
            emit(explained(workshop, &job)?);
            Ok(())
        }),
        Job::DecodePicture { encoded } => once(move |_, emit| decode(&encoded, emit)),
        _ => once(|_, _| Err("this worker cannot do that; load the page again".to_owned())),
    }
}

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

/// Says the pixels of an encoded picture.
fn decode(encoded: &[u8], emit: &mut dyn FnMut(JobEvent)) -> Result<(), String> {
    let picture = decode_picture(encoded).map_err(|cause| cause.to_string())?;
    let opaque = |[r, g, b]: &[u8; 3]| [*r, *g, *b, u8::MAX];
    emit(JobEvent::Picture {
        width: picture.width(),
        pixels: picture.pixels().iter().flat_map(opaque).collect(),
    });
    Ok(())
}

/// Pixels of a window of a map, and what went wrong with it.
fn send_tile(
    workshop: &mut Workshop,
    map: &MapSource,
    window: Window,
    emit: &mut dyn FnMut(JobEvent),
) -> Result<(), String> {
    let (pixels, whole) = workshop.map(map)?.window_so_far(&window);
    emit(JobEvent::Tile {
        window,
        pixels,
        whole,
    });
    for problem in workshop.new_problems(map) {
        emit(JobEvent::Remark(problem));
    }
    Ok(())
}
