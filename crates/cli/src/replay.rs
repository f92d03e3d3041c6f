//! `pilotage replay`: flights through the estimator.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::imagery::CachedImagery;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{KnownGround, Run, Summary, summarize};
use pilotage_core::simulate::{Overrides, Scenario, SensorSpec};
use pilotage_jobs::{JobEvent, MapSource, SummaryOrder};
use serde::Serialize;

use crate::CommandResult;
use crate::files::MAP_CACHE;
use crate::mission_file::OpenMission;
use crate::replay_frames::{print_frames, print_refusals};
use crate::replaying::{flight_at, navigate, over_map};
use crate::scenario::{DayChoice, flown, scenario, scenery, seed_range};
use crate::statistics::{Quantiles, error_over_bound, print, table};
use crate::workers;

/// Arguments of `pilotage replay`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Flight to replay: a flight folder, a log, tables, or a folder of photos. Without --map it is navigated by its
    /// instruments alone, through GPS outages all along.
    #[arg(conflicts_with_all = ["scenario", "flight"])]
    path: Option<PathBuf>,
    /// A built-in scenario; by the landmarks of another mission over the same ground, if one is given.
    #[arg(long, conflicts_with_all = ["flight", "map", "columns"])]
    scenario: Option<String>,
    /// Seed of the scenario.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Several seeds, A..B with B left out; prints quantiles. Pictures in which no landmark may lie are
    /// not taken, and count as looked at in no time.
    #[arg(long, value_name = "A..B", conflicts_with = "seed")]
    seeds: Option<String>,
    /// Day on which the camera sees the ground.
    #[arg(long, value_enum, default_value_t = DayChoice::Other)]
    day: DayChoice,
    /// Mission file (GeoJSON); a flight without one is navigated by whole frames alone.
    #[arg(long)]
    mission: Option<PathBuf>,
    /// Flight folder, or its flight.json.
    #[arg(long, requires = "map")]
    flight: Option<PathBuf>,
    /// Map picture with its georeference beside it.
    #[arg(long)]
    map: Option<PathBuf>,
    /// Meaning of the columns of tables, as `pilotage columns --save` wrote it.
    #[arg(long, value_name = "MAP")]
    columns: Option<PathBuf>,
    /// Fly another vehicle of a telemetry log, by the number of its system.
    #[arg(long, value_name = "SYSTEM")]
    vehicle: Option<u32>,
    /// Length of the GPS outages, where there is no map.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    outage: f64,
    /// Changes to the filter, e.g. alpha=0.5,vehicle=airplane-wind,gps-velocity=true,gps-velocity.noise=0.4.
    #[arg(long, default_value = "")]
    filter: String,
    /// File for the run.
    #[arg(long)]
    out: Option<PathBuf>,
    /// File for the estimated track; its ending names the format: .kml, .kmz, .gpx, .geojson or .csv.
    #[arg(long, value_name = "FILE", conflicts_with = "seeds")]
    track: Option<PathBuf>,
    /// File for the summary.
    #[arg(long)]
    summary: Option<PathBuf>,
    /// Print every camera frame with what became of it, and what frames and landmarks were refused of, counted.
    #[arg(long)]
    verbose: bool,
}

/// The summary of many runs.
#[derive(Serialize)]
struct RunStudy {
    quantiles: Vec<Quantiles>,
    /// Root mean squares over all runs: error over the Cramér-Rao bound.
    error_over_bound: Option<f64>,
    runs: Vec<Summary>,
}

/// Replays what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    if let Some(name) = &arguments.scenario {
        return replay_scenario(&scenario(name)?, arguments);
    }
    let Some(path) = arguments.path.as_ref().or(arguments.flight.as_ref()) else {
        return Err("say what was flown, or --scenario NAME".into());
    };
    let (open, notes) = flight_at(path, arguments.columns.as_deref(), arguments.vehicle)?;
    let (flight, mut frames) = (open.flight, open.frames);
    for note in &notes {
        eprintln!("note: {note}");
    }
    let Some(map) = &arguments.map else {
        return crate::outage::study(&flight, arguments.outage);
    };
    let over = over_map(
        path,
        flight,
        map,
        arguments.mission.as_deref(),
        &arguments.filter,
    )?;
    let run = navigate(&over.flight, &over.ground, &over.settings, &mut frames)?;
    let summary = summarize(&over.flight, &run, None);
    report(arguments, &over.flight, &run, &summary)
}

fn replay_scenario(scenario: &Scenario, arguments: &Arguments) -> CommandResult {
    let mut mission = match &arguments.mission {
        Some(path) => OpenMission::read(path)?.package.mission,
        None => scenario.mission(),
    };
    crate::filter_options::apply(&mut mission.navigator, &arguments.filter)?;
    let Some(seeds) = &arguments.seeds else {
        return replay_seed(scenario, &mission, arguments);
    };
    let (first, end) = seed_range(seeds)?;
    let order = |seed| SummaryOrder {
        flight: flown(scenario, seed, arguments.day),
        map: MapSource::world("countryside"),
        mission: mission.clone(),
        true_noise: Some(scenario.navigator(&SensorSpec::default())),
    };
    let orders = (first..end).map(order).collect();
    let lent = scenery(scenario, arguments.day);
    let mut runs: Vec<Summary> = Vec::new();
    workers::run(orders, &lent, &mut |number, event| {
        let seed = first + number as u64;
        match event {
            JobEvent::Failed(why) => return Err(format!("seed {seed}: {why}")),
            JobEvent::Figures(_) => {
                let summary: Summary = event.read_figures()?;
                eprintln!(
                    "seed {seed}: rms {:.2} m, {} of {} frames updated",
                    summary.position_error_m.map_or(f64::NAN, |e| e.rms),
                    summary.frames_with_update,
                    summary.frames
                );
                runs.push(summary);
            }
            _ => {}
        }
        Ok(())
    })?;
    let study = RunStudy {
        quantiles: table(&runs),
        error_over_bound: error_over_bound(&runs),
        runs,
    };
    print(&study.quantiles);
    if let Some(ratio) = study.error_over_bound {
        println!("error over the Cramér-Rao bound, root mean squares over all runs: {ratio:.3}");
    }
    if let Some(path) = &arguments.summary {
        write_json(path, &study)?;
    }
    Ok(())
}

/// Flies a scenario once, and tells everything of it.
fn replay_seed(scenario: &Scenario, mission: &Mission, arguments: &Arguments) -> CommandResult {
    let overrides = Overrides {
        day: Some(arguments.day.into()),
        ..Overrides::default()
    };
    let mut simulated = scenario.simulate(arguments.seed, &overrides);
    let map = Arc::new(CachedImagery::new(Arc::new(Scenario::map()), MAP_CACHE));
    let flight = mission.flown(&Arc::new(simulated.flight));
    let run = navigate(
        &flight,
        &KnownGround::of(mission, map),
        &mission.navigator,
        &mut simulated.frames,
    )
    .map_err(|e| format!("seed {}: {e}", arguments.seed))?;
    let true_noise = scenario.navigator(&SensorSpec::default());
    let summary = summarize(&flight, &run, Some(&true_noise));
    report(arguments, &flight, &run, &summary)
}

fn report(arguments: &Arguments, flight: &Flight, run: &Run, summary: &Summary) -> CommandResult {
    if arguments.verbose {
        print_frames(flight, run);
        print_refusals(summary);
    }
    println!("{}", serde_json::to_string_pretty(summary)?);
    if let Some(path) = &arguments.summary {
        write_json(path, summary)?;
    }
    if let Some(path) = &arguments.out {
        let bytes = pilotage_core::navigator::encode_run(run)?;
        crate::files::write_whole(path, bytes)?;
    }
    if let Some(path) = &arguments.track {
        crate::export_track::write_estimate(flight, run, path)?;
    }
    Ok(())
}

fn write_json(path: &Path, value: &impl Serialize) -> CommandResult {
    Ok(crate::files::write_whole(
        path,
        serde_json::to_string_pretty(value)?,
    )?)
}
