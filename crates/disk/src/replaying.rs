//! Flights of the disk, opened and laid over their maps, ready to be navigated.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::flight::files::FileSet;
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::{MapOptions, Mission};
use pilotage_core::navigator::Run;
use pilotage_jobs::{
    BareMission, FlightSource, FlyOrder, JobEvent, MapSource, OpenFlight, SimulationOptions,
    WorkerState, map_among, mission_beside_flight,
};

use crate::maps::{MAP_CACHE, MapOnDisk, open_map};
use crate::mission_file::OpenMission;
use crate::opening::{OpenedPath, directory_at, no_flight, open_among, unpacked};
use crate::read_files::ReadFiles;
use crate::workers::{GoesOn, KEY, Lent, do_here};

/// Failure in words that name the file and what to do.
type Failure = Box<dyn std::error::Error>;

/// A flight that was opened, and the files that it lies among.
pub struct FlightOnDisk {
    /// The flight.
    pub open: OpenFlight,
    /// Sentences on what was assumed of it or left out.
    pub notes: Vec<String>,
    /// Files of the disk that were read to open it; pictures are read when they are looked at.
    pub read: Vec<PathBuf>,
    /// Files of its folder, zip or MATLAB file.
    files: Option<Arc<dyn FileSet>>,
    /// Whether it is the flight of a folder, whose GeoJSON is its own, and not of a log or tables.
    is_folder: bool,
}

/// The flight at `path`; of telemetry logs that of the system `vehicle`, if one is stated.
///
/// # Errors
/// Files that cannot be read, or that hold no flight.
pub fn flight_at(
    path: &Path,
    columns: Option<&Path>,
    vehicle: Option<u32>,
) -> Result<FlightOnDisk, Failure> {
    let folder = directory_at(path)?.map(|files| Arc::new(ReadFiles::of(files)));
    let files = match &folder {
        Some(files) => Some(Arc::clone(files) as Arc<dyn FileSet>),
        None => unpacked(path)?,
    };
    let opened = open_among(path, files.as_ref(), columns)?.of_vehicle(vehicle)?;
    if let OpenedPath::Nothing(told) = &opened {
        return Err(no_flight(path, told).into());
    }
    let is_folder = matches!(&opened, OpenedPath::Folder(_));
    let opened = opened.into_flight()?;
    let (open, notes) = opened.ok_or_else(|| no_flight(path, ""))?;
    let read = folder.map_or_else(|| vec![path.to_owned()], |files| files.paths());
    Ok(FlightOnDisk {
        open,
        notes,
        read,
        files,
        is_folder,
    })
}

impl FlightOnDisk {
    /// The map that is stated, or else that among the files of the flight, in its world; `None` where there is none.
    ///
    /// # Errors
    /// A map that cannot be read, with the file's name.
    pub fn map(&self, stated: Option<&Path>) -> Result<Option<MapOnDisk>, Failure> {
        let frame = self.open.flight.frame_on_globe;
        if let Some(map) = stated {
            return Ok(Some(open_map(map, frame, MAP_CACHE)?));
        }
        let Some(files) = &self.files else {
            return Ok(None);
        };
        let options = MapOptions {
            frame,
            ..MapOptions::default()
        };
        let map = map_among(files.as_ref(), &options)?;
        Ok(map.map(|(_, map)| MapOnDisk::cached(map, MAP_CACHE)))
    }

    /// The mission that is stated, or else that among the files of the flight unless it shall fly without; `None` where
    /// there is none.
    ///
    /// # Errors
    /// A mission that cannot be read, with the file's name.
    pub fn mission(
        &self,
        stated: Option<&Path>,
        flies_without: bool,
    ) -> Result<Option<Mission>, Failure> {
        Ok(match (stated, &self.files) {
            (Some(path), _) => Some(OpenMission::read(path)?.package.mission),
            (None, Some(files)) if !flies_without => {
                mission_beside_flight(files.as_ref(), self.is_folder)?
            }
            (None, _) => None,
        })
    }
}

/// A flight over the map on which it is to be found, if there is one.
pub struct FlightOverMap {
    /// The flight, as its mission has it flown.
    pub flight: Arc<Flight>,
    /// Landmarks, roads and settings: those of its mission, or of a [`BareMission`].
    pub mission: Mission,
    /// Universal time at its zero, seconds since 1970, where that is known.
    pub utc_at_zero: Option<f64>,
    /// Sentence for people that says by what it is navigated, and why, where no mission says it.
    pub why: Option<&'static str>,
    source: MapSource,
    worker: WorkerState,
}

impl FlightOverMap {
    /// The flight, navigated to its end as the page has it flown.
    ///
    /// # Errors
    /// Settings that the flight does not allow, or a filter that broke.
    pub fn navigate(&mut self) -> Result<Run, Failure> {
        self.navigate_while(&mut || Ok(()))
    }

    /// As [`Self::navigate`], as long as `goes_on`, which is asked after every few steps, does not refuse.
    ///
    /// # Errors
    /// Settings that the flight does not allow, a filter that broke, or the refusal.
    pub fn navigate_while(&mut self, goes_on: GoesOn<'_>) -> Result<Run, Failure> {
        let order = FlyOrder {
            flight: Lent::flight(),
            map: self.source.clone(),
            mission: Some(self.mission.clone()),
        };
        Ok(fly(order, &mut self.worker, goes_on)?)
    }
}

/// Lays a flight over a map, or over nothing, to be navigated by a mission, or else as the page does without one; with
/// changes to the filter (`key=value,…`).
///
/// # Errors
/// A setting that is not there.
pub fn over_map(
    open: OpenFlight,
    map: Option<Arc<dyn Imagery>>,
    mission: Option<Mission>,
    filter: &str,
) -> Result<FlightOverMap, Failure> {
    let (source, lent) = Lent::over(map);
    let (mut mission, why) = if let Some(mission) = mission {
        (mission, None)
    } else {
        let BareMission { mission, why } = BareMission::of(&open.flight, &source);
        (mission, Some(why))
    };
    crate::filter_options::apply(&mut mission.navigator, filter)?;
    let flight = mission.flown(&open.flight);
    let utc_at_zero = open.utc_at_zero;
    let mut worker = lent.worker();
    worker.keep_flight(KEY, open);
    Ok(FlightOverMap {
        flight,
        mission,
        utc_at_zero,
        why,
        source,
        worker,
    })
}

/// A simulated flight of one of the built-in worlds, navigated to its end.
pub struct ReplayedSimulation {
    /// The flight, as the mission has it flown.
    pub flight: Arc<Flight>,
    /// The run.
    pub run: Run,
}

/// Flies in a built-in world and navigates by a mission over its map, as long as `goes_on`, which is asked after every few
/// steps, does not refuse.
///
/// # Errors
/// A flight that no world has, settings that the flight does not allow, a filter that broke, or the refusal.
pub fn replay_simulation(
    options: SimulationOptions,
    mission: &Mission,
    lent: &Lent,
    goes_on: GoesOn<'_>,
) -> Result<ReplayedSimulation, String> {
    let mut worker = lent.worker();
    let order = FlyOrder {
        map: options.map(),
        flight: FlightSource::Simulated(options),
        mission: Some(mission.clone()),
    };
    let open = worker.flight(&order.flight)?;
    let flight = mission.flown(&open.borrow().flight);
    let run = fly(order, &mut worker, goes_on)?;
    Ok(ReplayedSimulation { flight, run })
}

/// The run of a flight that is flown to its end by the order of the page.
///
/// # Errors
/// Why it cannot be flown or navigated, in words, or what `goes_on` refuses with.
pub fn fly(order: FlyOrder, worker: &mut WorkerState, goes_on: GoesOn<'_>) -> Result<Run, String> {
    let mut flown = None;
    do_here(order, worker, &mut |event| {
        goes_on()?;
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
