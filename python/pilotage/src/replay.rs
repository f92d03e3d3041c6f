//! The navigator over flights, as `pilotage replay` runs it.

use std::path::PathBuf;

use pilotage_core::navigator::{summarize, unused_pictures};
use pilotage_core::simulate::SimulationChoice;
use pilotage_disk::filter_options;
use pilotage_disk::replaying::{ReplayedSimulation, flight_at, over_map, replay_simulation};
use pilotage_disk::workers::{GoesOn, Lent};
use pilotage_jobs::SimulationOptions;
use pyo3::prelude::*;

use crate::error::refusal;
use crate::interruption::unless_interrupted;
use crate::log::named;
use crate::run::PythonRun;

/// Navigates a flight by its pictures over a map, with the landmarks of a mission file, or those of the mission in the
/// flight's folder unless `no_mission` says otherwise.
///
/// `path` is a flight folder, a log, tables or photos, `map` a picture with its georeference beside it, where none lies in
/// the folder; without one the instruments alone carry the estimate. `filter` are changes to the settings as `pilotage replay --filter` takes them ("alpha=0.5,vehicle=airplane-wind").
#[pyfunction]
#[pyo3(signature = (path, map = None, *, mission = None, no_mission = false, columns = None, vehicle = None, filter = ""))]
pub fn replay(
    py: Python<'_>,
    path: PathBuf,
    map: Option<PathBuf>,
    mission: Option<PathBuf>,
    no_mission: bool,
    columns: Option<PathBuf>,
    vehicle: Option<u32>,
    filter: &str,
) -> PyResult<PythonRun> {
    let filter = filter.to_owned();
    let told = [map.clone(), mission.clone()];
    let flown = path.clone();
    let fly = move |goes_on: GoesOn<'_>| -> Result<PythonRun, Box<dyn std::error::Error>> {
        let flight = flight_at(&flown, columns.as_deref(), vehicle)?;
        let map = flight.map(map.as_deref())?;
        let mission = flight.mission(mission.as_deref(), no_mission)?;
        let mut notes = flight.notes;
        let map = map.map(|map| {
            notes.extend(map.notes);
            map.map
        });
        let mut over = over_map(flight.open, map, mission, &filter)?;
        notes.extend(over.why.map(ToOwned::to_owned));
        let run = over.navigate_while(goes_on)?;
        notes.extend(unused_pictures(&run));
        let summary = summarize(&over.flight, &run, None);
        Ok(PythonRun::new(run, Some(summary), notes))
    };
    unless_interrupted(py, move |goes_on| {
        fly(goes_on).map_err(|failure| {
            // Whatever is wrong with map or mission says so.
            let words = failure.to_string();
            let is_named = told.iter().flatten().any(|file| {
                let name = file.file_name().map(|name| name.to_string_lossy());
                name.is_some_and(|name| words.contains(name.as_ref()))
            });
            let named = if is_named {
                words
            } else {
                named(&path, &words)
            };
            named.into()
        })
    })
}

/// Flies a built-in scenario and navigates it; `day` is that on which the camera sees the ground, "same" as the map's or
/// "other".
#[pyfunction]
#[pyo3(signature = (name, *, seed = 1, day = "other", filter = ""))]
pub fn replay_scenario(
    py: Python<'_>,
    name: &str,
    seed: u64,
    day: &str,
    filter: &str,
) -> PyResult<PythonRun> {
    let choice = SimulationChoice::named(name).ok_or_else(|| {
        let names = scenario_names().join(", ");
        refusal(format!("there is no scenario {name:?}; there are: {names}"))
    })?;
    let other_day = match day {
        "same" => false,
        "other" => true,
        _ => return Err(refusal(format!("day={day:?}: say \"same\" or \"other\""))),
    };
    let (title, filter) = (format!("{name}, seed {seed}"), filter.to_owned());
    let fly = move |goes_on: GoesOn<'_>| -> Result<PythonRun, Box<dyn std::error::Error>> {
        let mut mission = choice.mission().ok_or("it has no mission")?;
        filter_options::apply(&mut mission.navigator, &filter)?;
        let options = SimulationOptions {
            scenario: choice.name.to_owned(),
            seed,
            other_day,
            wind: None,
            height: None,
        };
        let ReplayedSimulation { flight, run } =
            replay_simulation(options, &mission, &Lent::default(), goes_on)?;
        let summary = summarize(&flight, &run, Some(&choice.navigator()));
        Ok(PythonRun::new(run, Some(summary), Vec::new()))
    };
    unless_interrupted(py, move |goes_on| {
        fly(goes_on).map_err(|failure| format!("{title}: {failure}").into())
    })
}

/// Names of the built-in scenarios, in any of the built-in worlds.
#[pyfunction]
pub fn scenario_names() -> Vec<&'static str> {
    let choices = SimulationChoice::all();
    choices.iter().map(|choice| choice.name).collect()
}
