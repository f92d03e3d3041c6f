//! Flights of the disk, opened and laid over their maps, ready to be navigated.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use pilotage_core::flight::{Flight, FrameSource};
use pilotage_core::navigator::{KnownGround, Navigator, NavigatorSettings, Run};
use pilotage_jobs::OpenFlight;

use crate::files::{MAP_CACHE, open_map};
use crate::mission_file::OpenMission;
use crate::opening::{OpenedPath, no_flight, open};

/// Failure in words that name the file and what to do.
type Failure = Box<dyn std::error::Error>;

/// The flight at `path`, and what was assumed or left out, in sentences; of telemetry logs that of the system
/// `vehicle`, if one is stated.
///
/// # Errors
/// Files that cannot be read, or that hold no flight.
pub fn flight_at(
    path: &Path,
    columns: Option<&Path>,
    vehicle: Option<u32>,
) -> Result<(OpenFlight, Vec<String>), Failure> {
    let opened = open(path, columns)?.of_vehicle(vehicle)?;
    if let OpenedPath::Nothing(told) = &opened {
        return Err(no_flight(path, told).into());
    }
    Ok(opened.into_flight()?.ok_or_else(|| no_flight(path, ""))?)
}

/// A flight over the map on which it is to be found.
pub struct FlightOverMap {
    /// The flight, as its mission has it flown.
    pub flight: Arc<Flight>,
    /// The map, with the mission's landmarks and roads.
    pub ground: KnownGround,
    /// Settings of the mission, or of whole frames without one.
    pub settings: NavigatorSettings,
}

/// Lays the `flight` that was read from `path` over the picture at `map`, with the landmarks of a mission file and
/// changes to the filter (`key=value,…`).
///
/// # Errors
/// A flight without pictures, a map or mission that cannot be read, a setting that is not there.
pub fn over_map(
    path: &Path,
    flight: Arc<Flight>,
    map: &Path,
    mission: Option<&Path>,
    filter: &str,
) -> Result<FlightOverMap, Failure> {
    if flight.frames.is_empty() {
        return Err(format!(
            "{}: it has no pictures to be found on the map; leave out --map to navigate by instruments",
            path.display()
        )
        .into());
    }
    let imagery = open_map(map, flight.frame_on_globe, MAP_CACHE)?;
    let (flight, ground, mut settings) = if let Some(path) = mission {
        let mission = OpenMission::read(path)?.package.mission;
        let ground = KnownGround::of(&mission, imagery);
        (mission.flown(&flight), ground, mission.navigator)
    } else {
        let settings = NavigatorSettings::without_mission(&flight, true);
        (flight, KnownGround::new(imagery), settings)
    };
    crate::filter_options::apply(&mut settings, filter)?;
    Ok(FlightOverMap {
        flight,
        ground,
        settings,
    })
}

/// Navigates a flight to its end.
///
/// # Errors
/// Settings that the flight does not allow, or a filter that broke.
pub fn navigate(
    flight: &Arc<Flight>,
    ground: &KnownGround,
    settings: &NavigatorSettings,
    frames: &mut dyn FrameSource,
) -> Result<Run, Failure> {
    let begun = Instant::now();
    let stopwatch = || begun.elapsed().as_secs_f64() * 1e3;
    let navigator = Navigator::new(Arc::clone(flight), ground, settings)?;
    Ok(navigator.fly(frames, &stopwatch)?)
}
