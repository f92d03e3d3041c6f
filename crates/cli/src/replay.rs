//! `pilotage replay`: flights through the estimator.

use std::path::{Path, PathBuf};

use pilotage_core::exchange::Format;
use pilotage_core::flight::Flight;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Run, Summary, passed_over, summarize, unused_pictures};
use pilotage_core::simulate::SimulationChoice;
use pilotage_jobs::{FlightSource, JobEvent, SummaryOrder};
use serde::Serialize;

use crate::CommandResult;
use crate::export_track::{FlownWhere, write_estimate};
use crate::filter_options;
use crate::mission_file::OpenMission;
use crate::notes::{learned_from, tell, told};
use crate::numbers::above_zero;
use crate::outcome::SeedFlights;
use crate::replay_frames::{print_frames, print_refusals};
use crate::replaying::{ReplayedSimulation, flight_at, over_map, replay_simulation};
use crate::scenario::{DayChoice, ground_of, options, seed_range, simulation};
use crate::statistics::{Quantiles, error_over_bound, print, table};
use crate::workers::{self, Lent};

/// Arguments of `pilotage replay`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Flight to replay: a flight folder, a log, tables, or a folder of photos, over the map that lies in the folder or
    /// --map. Without a map it is navigated by its instruments alone: through GPS outages all along, or once from the
    /// start where a run is asked for (--out, --track, --summary, --mission, --filter).
    #[arg(conflicts_with_all = ["scenario", "flight"])]
    path: Option<PathBuf>,
    /// A built-in scenario; by the landmarks of another mission over the same ground, if one is given.
    #[arg(long, conflicts_with_all = ["flight", "map", "columns", "vehicle", "no_mission"])]
    scenario: Option<String>,
    /// Seed of the scenario.
    #[arg(long, requires = "scenario", conflicts_with_all = ["path", "flight"], default_value_t = 1)]
    seed: u64,
    /// Several seeds, A..B with B left out; prints quantiles. Pictures in which no landmark may lie are
    /// not taken, and count as looked at in no time.
    #[arg(
        long,
        value_name = "A..B",
        requires = "scenario",
        conflicts_with_all = ["path", "flight", "seed"]
    )]
    seeds: Option<String>,
    /// Day on which the camera sees the ground of the scenario.
    #[arg(long, requires = "scenario", conflicts_with_all = ["path", "flight"], value_enum, default_value_t = DayChoice::Other)]
    day: DayChoice,
    /// Mission file (GeoJSON); a flight without one is navigated by whole frames alone.
    #[arg(long)]
    mission: Option<PathBuf>,
    /// Fly without the mission that lies in the flight's folder: by whole frames where there is a map.
    #[arg(long, conflicts_with = "mission")]
    no_mission: bool,
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
    /// Study GPS outages of that length all along the flight; of 60 s where there is no map and no run is asked for. Over
    /// a map also by what the pictures show.
    #[arg(long, value_name = "SECONDS", value_parser = above_zero, conflicts_with = "seeds")]
    outage: Option<f64>,
    /// Changes to the filter, e.g. alpha=0.5,vehicle=airplane-wind,gps-velocity=true,gps-velocity.noise=0.4; --help
    /// lists all keys.
    #[arg(long, default_value = "", value_name = "KEY=VALUE,…", long_help = filter_options::help())]
    filter: String,
    /// File for the run.
    #[arg(long, conflicts_with = "seeds")]
    out: Option<PathBuf>,
    /// File for the estimated track.
    #[arg(long, value_name = "FILE", conflicts_with = "seeds", help = track_help())]
    track: Option<PathBuf>,
    /// File for the summary.
    #[arg(long)]
    summary: Option<PathBuf>,
    /// Print every camera frame with what became of it, and what frames and landmarks were refused of, counted.
    #[arg(long, conflicts_with = "seeds")]
    verbose: bool,
}

/// Explanation of `--track`, with the endings of all formats that hold tracks.
fn track_help() -> String {
    let endings = Format::track_extensions();
    format!("File for the estimated track; its ending names the format: {endings}")
}

/// Length of GPS outages where nobody states one, seconds.
const OUTAGE: f64 = 60.0;

impl Arguments {
    /// Whether something is asked for that only a run has.
    fn asks_for_a_run(&self) -> bool {
        let files = [&self.mission, &self.out, &self.track, &self.summary];
        files.iter().any(|it| it.is_some()) || !self.filter.is_empty() || self.verbose
    }
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
        return replay_scenario(&simulation(name)?, arguments);
    }
    let Some(path) = arguments.path.as_ref().or(arguments.flight.as_ref()) else {
        return Err("say what was flown, or --scenario NAME".into());
    };
    let flight = flight_at(path, arguments.columns.as_deref(), arguments.vehicle)?;
    tell(&flight.notes);
    let map = flight.map(arguments.map.as_deref())?.map(told);
    let is_studied = map.is_none() && !arguments.asks_for_a_run();
    if is_studied {
        let length = arguments.outage.unwrap_or(OUTAGE);
        return crate::outage::study(&flight.open.flight, None, length);
    }
    let mission = flight.mission(arguments.mission.as_deref(), arguments.no_mission)?;
    let mut over = over_map(flight.open, map, mission, &arguments.filter)?;
    if let Some(why) = over.why {
        eprintln!("note: {why}");
    }
    tell(&learned_from(&over.mission, &over.flight));
    let run = over.navigate()?;
    let summary = summarize(&over.flight, &run, None);
    let at = FlownWhere {
        origin: over.mission.origin,
        utc_at_zero: over.utc_at_zero,
    };
    report(arguments, &over.flight, &run, &summary, at)
}

fn replay_scenario(choice: &SimulationChoice, arguments: &Arguments) -> CommandResult {
    let mut mission = match &arguments.mission {
        Some(path) => OpenMission::read(path)?.package.mission,
        None => choice.mission().ok_or("this flight has no mission")?,
    };
    filter_options::apply(&mut mission.navigator, &arguments.filter)?;
    let lent = ground_of(choice, arguments.day);
    let Some(seeds) = &arguments.seeds else {
        return replay_seed(choice, &mission, &lent, arguments);
    };
    let (first, end) = seed_range(seeds)?;
    let order = |seed| {
        let options = options(choice.name, seed, arguments.day);
        SummaryOrder {
            map: options.map(),
            flight: FlightSource::Simulated(options),
            mission: mission.clone(),
            true_noise: Some(choice.navigator()),
        }
    };
    let orders = (first..end).map(order).collect();
    let mut flown = SeedFlights::of((first, end));
    let mut runs: Vec<Summary> = Vec::new();
    workers::run(orders, &lent, &mut |number, event| {
        let seed = flown.seed(number);
        match event {
            JobEvent::Failed(why) => flown.fail(number, &why),
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
    flown.any()?;
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
    flown.all_done()
}

/// Flies a scenario once, and tells everything of it.
fn replay_seed(
    choice: &SimulationChoice,
    mission: &Mission,
    lent: &Lent,
    arguments: &Arguments,
) -> CommandResult {
    let options = options(choice.name, arguments.seed, arguments.day);
    let ReplayedSimulation { flight, run } =
        replay_simulation(options, mission, lent, &mut || Ok(()))
            .map_err(|e| format!("seed {}: {e}", arguments.seed))?;
    let summary = summarize(&flight, &run, Some(&choice.navigator()));
    let at = FlownWhere {
        origin: mission.origin,
        utc_at_zero: None,
    };
    report(arguments, &flight, &run, &summary, at)
}

fn report(
    arguments: &Arguments,
    flight: &Flight,
    run: &Run,
    summary: &Summary,
    at: FlownWhere,
) -> CommandResult {
    if arguments.verbose {
        print_frames(flight, run);
        print_refusals(summary);
    }
    if let Some(why) = unused_pictures(run) {
        eprintln!("{why}");
    }
    for found in run.findings().iter().chain(&passed_over(flight, run)) {
        eprintln!("note: {}. {}", found.title, found.text);
    }
    match arguments.outage {
        Some(length) => crate::outage::study(flight, Some(run), length)?,
        None => println!("{}", serde_json::to_string_pretty(summary)?),
    }
    if let Some(path) = &arguments.summary {
        write_json(path, summary)?;
    }
    if let Some(path) = &arguments.out {
        let bytes = pilotage_core::navigator::encode_run(run)?;
        crate::files::write_whole(path, bytes)?;
    }
    if let Some(path) = &arguments.track {
        write_estimate(flight, run, at, path)?;
    }
    Ok(())
}

fn write_json(path: &Path, value: &impl Serialize) -> CommandResult {
    Ok(crate::files::write_whole(
        path,
        serde_json::to_string_pretty(value)?,
    )?)
}
