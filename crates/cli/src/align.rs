//! `pilotage align`: a camera beside a log.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::calibration::{CameraEvidence, CameraPrior, CameraToLog, Estimated};
use pilotage_core::navigator::{Summary, summarize};
use pilotage_jobs::{BareMission, CalibrationOrder, FlyOrder, JobEvent, WorkerState};
use serde::Serialize;

use crate::CommandResult;
use crate::files::{MAP_CACHE, open_map};
use crate::notes::{tell, told};
use crate::replaying::{FlightOnDisk, flight_at, fly};
use crate::workers::{Lent, do_here};

/// Arguments of `pilotage align`: a flight and the map beside it.
#[derive(clap::Args)]
pub struct Arguments {
    /// Flight folder, or its flight.json.
    #[arg(long)]
    flight: PathBuf,
    /// Map picture with its georeference beside it.
    #[arg(long)]
    map: PathBuf,
    /// Times that the flight is flown again with what was found.
    #[arg(long, default_value_t = 2)]
    rounds: usize,
    /// Standard deviation of the camera's clock against the log's, seconds; three of them are searched.
    #[arg(long, default_value_t = 1.0)]
    clock: f64,
    /// Changes to the filter, e.g. frame-height=50,acceleration=3.
    #[arg(long, default_value = "")]
    filter: String,
    /// File for what was found.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Results of a round.
#[derive(Serialize)]
struct CalibrationRound {
    camera_to_log: CameraToLog,
    /// The run that it was found from, before the flight was changed so; errors in it are against the truth that
    /// the flight states, whatever that is of.
    summary: Summary,
}

/// Puts the camera of a flight beside its log.
pub fn run(arguments: &Arguments) -> CommandResult {
    let FlightOnDisk { open, notes, .. } = flight_at(&arguments.flight, None, None)?;
    tell(&notes);
    let source = Lent::map_of_file();
    let mut mission = BareMission::of(&open.flight, &source).mission;
    crate::filter_options::apply(&mut mission.navigator, &arguments.filter)?;
    let map = open_map(&arguments.map, open.flight.frame_on_globe, MAP_CACHE)?;
    let (_, lent) = Lent::over(Some(told(map)));
    let lent = lent.with_flight(&open);
    let mut flight = open.flight;
    let believed = CameraPrior {
        offset: arguments.clock,
        ..CameraPrior::default()
    };
    let mut rounds = Vec::new();
    for _ in 0..arguments.rounds.max(1) {
        let lent = lent.clone();
        let lent = lent.with_flight_changed(Arc::clone(&flight));
        let mut worker = lent.worker();
        let order = FlyOrder {
            flight: Lent::flight(),
            map: source.clone(),
            mission: Some(mission.clone()),
        };
        let run = fly(order, &mut worker)?;
        let order = CalibrationOrder {
            evidence: CameraEvidence::of(&flight, &run),
            believed,
        };
        let found = calibrated(order, &mut worker)?;
        rounds.push(CalibrationRound {
            camera_to_log: found,
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
    let degree = 1_f64.to_degrees();
    let line = |name: &str, number: &Estimated, factor: f64, unit: &str| {
        let told = if number.is_told {
            ""
        } else {
            "   (not told by this flight)"
        };
        println!(
            "  {name:<14} {:>9.3} ± {:<8.3} {unit}{told}",
            factor * number.value,
            factor * number.deviation
        );
    };
    line("time offset", &found.offset, 1.0, "s");
    line("clock drift", &found.drift, 1e6, "µs/s");
    line("mount roll", &found.roll, degree, "°");
    line("mount pitch", &found.pitch, degree, "°");
    line("mount yaw", &found.yaw, degree, "°");
    line("focal length", &found.log_focal, 100.0, "%");
    line("fixes north", &found.bias[0], 1.0, "m");
    line("fixes east", &found.bias[1], 1.0, "m");
}
