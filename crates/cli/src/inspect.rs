//! `pilotage inspect`: what a file or folder is.

use std::path::PathBuf;

use pilotage_core::flight::Flight;

use crate::opening::{Opened, open};
use crate::{Outcome, inspect_log};

/// What to look at.
#[derive(clap::Args)]
pub struct Arguments {
    /// A flight log, a flight folder, tables of a flight, photos, a mission, or a saved run.
    path: PathBuf,
    /// What the columns of tables mean, as `pilotage columns --save` wrote it.
    #[arg(long, value_name = "MAP")]
    columns: Option<PathBuf>,
}

/// Says what the path holds.
pub fn run(arguments: &Arguments) -> Outcome {
    let path = &arguments.path;
    match open(path, arguments.columns.as_deref())? {
        Opened::Folder(folder) => {
            describe(&folder.flight);
            inspect_log::describe_folder(&folder);
            return Ok(());
        }
        Opened::Log(log, _) => {
            inspect_log::describe(&log);
            return Ok(());
        }
        Opened::Nothing => {}
    }
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    if let Ok(run) = pilotage_core::navigator::decode_run(&path.to_string_lossy(), &bytes) {
        println!(
            "run \"{}\": {} steps, {} landmarks",
            run.name,
            run.steps.len(),
            run.landmarks.len()
        );
        return Ok(());
    }
    let package = pilotage_core::mission::package::read_package(&bytes).map_err(|e| {
        format!(
            "{}: neither a flight log, a flight, a run nor a mission: {e}",
            path.display()
        )
    })?;
    let mission = package.mission;
    println!(
        "mission \"{}\": {} landmarks",
        mission.name,
        mission.landmarks.len()
    );
    for landmark in &mission.landmarks {
        println!(
            "    {:3} {:24} {:6.1} × {:6.1} m at north {:8.1}, east {:8.1} m",
            landmark.id,
            landmark.name,
            landmark.bounds.width(),
            landmark.bounds.height(),
            landmark.reference.north,
            landmark.reference.east
        );
    }
    Ok(())
}

fn describe(flight: &Flight) {
    let (begin, end) = flight.span();
    println!(
        "flight \"{}\": {:.1} s, {} frames",
        flight.name,
        end - begin,
        flight.frames.len()
    );
    println!(
        "    camera {} × {} px, focal length {:.1} px",
        flight.camera.width, flight.camera.height, flight.camera.focal
    );
    for channel in &flight.channels {
        println!(
            "    {:22} {} samples",
            channel.name.key(),
            channel.times.len()
        );
    }
    if let Some(truth) = &flight.truth {
        println!(
            "    truth: {} states, {} frames",
            truth.states.len(),
            truth.frames.len()
        );
    }
}
