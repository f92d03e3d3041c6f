//! `pilotage align`: a camera beside a log.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::calibration::{
    CameraAdjustment, CameraEvidence, CameraPrior, CameraToLog, camera_numbers,
};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Summary, summarize};
use pilotage_jobs::{BareMission, CalibrationOrder, FlyOrder, JobEvent, WorkerState};
use serde::Serialize;

use crate::CommandResult;
use crate::filter_options;
use crate::notes::{tell, told};
use crate::numbers::above_zero;
use crate::replaying::{flight_at, fly};
use crate::workers::{Lent, do_here};

/// Arguments of `pilotage align`: a flight and the map beside it.
#[derive(clap::Args)]
pub struct Arguments {
    /// Flight folder, or its flight.json.
    #[arg(long)]
    flight: PathBuf,
    /// Map picture with its georeference beside it, if none lies in the folder.
    #[arg(long)]
    map: Option<PathBuf>,
    /// Mission file (GeoJSON) by whose landmarks and settings it is flown, if none lies in the folder.
    #[arg(long)]
    mission: Option<PathBuf>,
    /// Leave out the mission in the folder.
    #[arg(long, conflicts_with = "mission")]
    no_mission: bool,
    /// Times that the flight is flown again with what was found.
    #[arg(long, default_value_t = 2)]
    rounds: usize,
    /// Standard deviation of the camera's clock against the log's, seconds; three of them are searched.
    #[arg(long, default_value_t = 1.0, value_parser = above_zero)]
    clock: f64,
    /// Changes to the filter, e.g. frame-height=50,acceleration=3; --help lists all keys.
    #[arg(long, default_value = "", value_name = "KEY=VALUE,…", long_help = filter_options::help())]
    filter: String,
    /// File for what was found.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Results of a round.
#[derive(Serialize)]
struct CalibrationRound {
    /// Found in this round, beyond what the rounds before had changed.
    camera_to_log: CameraToLog,
    /// All that is to be changed of the flight as it was opened.
    change: CameraAdjustment,
    /// The run that it was found from, before the flight was changed so; errors in it are against the truth that
    /// the flight states, whatever that is of.
    summary: Summary,
}

/// Puts the camera of a flight beside its log.
pub fn run(arguments: &Arguments) -> CommandResult {
    let on_disk = flight_at(&arguments.flight, None, None)?;
    tell(&on_disk.notes);
    let map = on_disk.map(arguments.map.as_deref())?;
    let map = map.ok_or("there is no map on which its pictures could be laid; name it by --map")?;
    let stated = on_disk.mission(arguments.mission.as_deref(), arguments.no_mission)?;
    let open = on_disk.open;
    let (source, lent) = Lent::over(Some(told(map)));
    let mut mission = match stated {
        // The flight as it was opened is what is put right.
        Some(mission) => Mission {
            navigator: mission.navigator.clone().laying_pictures_of(&open.flight),
            camera_to_log: None,
            ..mission
        },
        None => BareMission::of(&open.flight, &source).mission,
    };
    filter_options::apply(&mut mission.navigator, &arguments.filter)?;
    let lent = lent.with_flight(&open);
    let mut flight = open.flight;
    let believed = CameraPrior {
        offset: arguments.clock,
        ..CameraPrior::default()
    };
    let (mut rounds, mut change) = (Vec::new(), None::<CameraAdjustment>);
    for _ in 0..arguments.rounds.max(1) {
        let lent = lent.clone();
        let lent = lent.with_flight_changed(Arc::clone(&flight));
        let mut worker = lent.worker();
        let order = FlyOrder {
            flight: Lent::flight(),
            map: source.clone(),
            mission: Some(mission.clone()),
        };
        let run = fly(order, &mut worker, &mut || Ok(()))?;
        let order = CalibrationOrder {
            evidence: CameraEvidence::of(&flight, &run),
            believed,
        };
        let found = calibrated(order, &mut worker)?;
        let more = found.adjustment();
        let all = change.map_or(more, |before| before.then(&more));
        change = Some(all);
        rounds.push(CalibrationRound {
            camera_to_log: found,
            change: all,
            summary: summarize(&flight, &run, None),
        });
        flight = Arc::new(found.apply(&flight));
    }
    for (number, round) in rounds.iter().enumerate() {
        print(number + 1, round);
    }
    if let Some(path) = &arguments.out {
        crate::files::write_whole(path, serde_json::to_string_pretty(&rounds)?)?;
    }
    Ok(())
}

/// The camera beside its log, by the order of the page.
fn calibrated(order: CalibrationOrder, worker: &mut WorkerState) -> Result<CameraToLog, String> {
    let mut found = None;
    do_here(order, worker, &mut |event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::CameraCalibrated(camera) => found = Some(*camera),
            _ => {}
        }
        Ok(())
    })?;
    found.ok_or_else(|| "nothing was found".to_owned())
}

fn print(number: usize, round: &CalibrationRound) {
    let found = &round.camera_to_log;
    println!(
        "round {number}: {} of {} frames on the map; satellite navigation {:.2} m about them, then {:.2} m",
        found.frames, round.summary.frames, found.place_deviation[0], found.place_deviation[1]
    );
    for number in camera_numbers(&round.change, found) {
        let told = if number.is_told {
            ""
        } else {
            "   (not told by this flight)"
        };
        println!(
            "  {:<14} {:>9.3} ± {:<8.3} {}{told}",
            number.name, number.value, number.deviation, number.unit
        );
    }
}
