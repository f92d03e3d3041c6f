//! Flights of the disk, opened and laid over their maps, ready to be navigated.

use std::path::Path;
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::Run;
use pilotage_jobs::{
    BareMission, FlightSource, FlyOrder, JobEvent, MapSource, OpenFlight, SimulationOptions,
    WorkerState, mission_beside_flight,
};

use crate::files::{MAP_CACHE, open_map};
use crate::mission_file::OpenMission;
use crate::opening::{OpenedPath, folder_at, no_flight, open};
use crate::workers::{KEY, Lent, do_here};

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
    let opened = opened.into_flight()?;
    let (mut flight, notes) = opened.ok_or_else(|| no_flight(path, ""))?;
    if let Some(files) = folder_at(path)? {
        flight.mission = mission_beside_flight(files.as_ref())?;
    }
    Ok((flight, notes))
}

/// A flight over the map on which it is to be found.
pub struct FlightOverMap {
    /// The flight, as its mission has it flown.
    pub flight: Arc<Flight>,
    /// Landmarks, roads and settings: those of its mission, or of a [`BareMission`].
    pub mission: Mission,
    worker: WorkerState,
}

impl FlightOverMap {
    /// The flight that was opened, over a map that is known by `source` to whoever orders something of it.
    fn new(open: OpenFlight, mission: Mission, source: &MapSource, map: Arc<dyn Imagery>) -> Self {
        let flight = mission.flown(&open.flight);
        let mut worker = Lent::default().with_map(source.clone(), map).worker();
        worker.keep_flight(KEY, open);
        Self {
            flight,
            mission,
            worker,
        }
    }

    /// The flight, navigated to its end as the page has it flown.
    ///
    /// # Errors
    /// Settings that the flight does not allow, or a filter that broke.
    pub fn navigate(&mut self) -> Result<Run, Failure> {
        let order = FlyOrder {
            flight: Lent::flight(),
            map: Lent::map_of_file(),
            mission: Some(self.mission.clone()),
        };
        Ok(fly(order, &mut self.worker)?)
    }
}

/// Lays the flight that was read from `path` over the picture at `map`, with the landmarks of a mission file, or else those
/// of the mission beside it, and changes to the filter (`key=value,…`).
///
/// # Errors
/// A flight without pictures, a map or mission that cannot be read, a setting that is not there.
pub fn over_map(
    path: &Path,
    open: OpenFlight,
    map: &Path,
    mission: Option<&Path>,
    filter: &str,
) -> Result<FlightOverMap, Failure> {
    if open.flight.frames.is_empty() {
        return Err(format!(
            "{}: it has no pictures to be found on the map; leave out --map to navigate by instruments",
            path.display()
        )
        .into());
    }
    let imagery = open_map(map, open.flight.frame_on_globe, MAP_CACHE)?;
    let source = Lent::map_of_file();
    let stated = match mission {
        Some(path) => Some(OpenMission::read(path)?.package.mission),
        None => open.mission.clone(),
    };
    let mut mission = stated.unwrap_or_else(|| BareMission::of(&open.flight, &source).mission);
    crate::filter_options::apply(&mut mission.navigator, filter)?;
    Ok(FlightOverMap::new(open, mission, &source, imagery))
}

/// A simulated flight of one of the built-in worlds, navigated to its end.
pub struct ReplayedSimulation {
    /// The flight, as the mission has it flown.
    pub flight: Arc<Flight>,
    /// The run.
    pub run: Run,
}

/// Flies in a built-in world and navigates by a mission over its map.
///
/// # Errors
/// A flight that no world has, settings that the flight does not allow, or a filter that broke.
pub fn replay_simulation(
    options: SimulationOptions,
    mission: &Mission,
    lent: &Lent,
) -> Result<ReplayedSimulation, String> {
    let mut worker = lent.worker();
    let order = FlyOrder {
        map: options.map(),
        flight: FlightSource::Simulated(options),
        mission: Some(mission.clone()),
    };
    let open = worker.flight(&order.flight)?;
    let flight = mission.flown(&open.borrow().flight);
    let run = fly(order, &mut worker)?;
    Ok(ReplayedSimulation { flight, run })
}

/// The run of a flight that is flown to its end by the order of the page.
///
/// # Errors
/// Why it cannot be flown or navigated, in words.
pub fn fly(order: FlyOrder, worker: &mut WorkerState) -> Result<Run, String> {
    let mut flown = None;
    do_here(order, worker, &mut |event| {
        match event {
            JobEvent::CannotNavigate(why) | JobEvent::Failed(why) => return Err(why),
            JobEvent::RunStarted(head) => flown = Some(*head),
            JobEvent::Steps(mut steps) => {
                if let Some(run) = &mut flown {
                    run.steps.append(&mut steps);
                }
            }
            _ => {}
        }
        Ok(())
    })?;
    flown.ok_or_else(|| "nothing was flown".to_owned())
}
