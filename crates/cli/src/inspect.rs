//! `pilotage inspect`: what a file or folder is.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::flight::columns::{flight_of_tables, guess_tables};
use pilotage_core::flight::files::{FileSet, MemoryFiles};
use pilotage_core::flight::log::read_log;
use pilotage_core::flight::photo::read_photos;
use pilotage_core::flight::{Flight, FlightFolder, FolderError, read_flight};

use crate::files::{Directory, DiskFile};
use crate::{Outcome, inspect_log};

/// Endings of tables.
const TABLES: [&str; 3] = ["csv", "tsv", "txt"];

/// What to look at.
#[derive(clap::Args)]
pub struct Arguments {
    /// A flight log, a flight folder, tables of a flight, photos, a mission, or a saved run.
    path: PathBuf,
}

/// Says what the path holds.
pub fn run(arguments: &Arguments) -> Outcome {
    let path = &arguments.path;
    if path.is_dir() || path.file_name().is_some_and(|n| n == "flight.json") {
        let files: Arc<dyn FileSet> = Arc::new(Directory::open(path)?);
        let folder = open(&files)?;
        describe(&folder.flight);
        inspect_log::describe_folder(&folder);
        return Ok(());
    }
    let file = DiskFile::open(path, &path.to_string_lossy());
    let file = file.map_err(|e| format!("{}: {e}", path.display()))?;
    if let Some(log) = read_log(&file)? {
        inspect_log::describe(&log);
        return Ok(());
    }
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    if has_ending(path, &TABLES) {
        let files = [(path.to_string_lossy().into_owned(), bytes)];
        let files: Arc<dyn FileSet> = Arc::new(MemoryFiles(files.into()));
        let folder = open(&files)?;
        describe(&folder.flight);
        inspect_log::describe_folder(&folder);
        return Ok(());
    }
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

/// The flight among files: that of a flight folder, else of the tables that are likely to be one, as their columns are
/// guessed, else of photos.
fn open(files: &Arc<dyn FileSet>) -> Result<FlightFolder, FolderError> {
    match read_flight(Arc::clone(files)) {
        Err(FolderError::NoFlightFile) => {}
        other => return other,
    }
    let mut names = files.names();
    names.retain(|name| has_ending(Path::new(name), &TABLES));
    names.sort();
    let tables = guess_tables(files.as_ref(), &names).into_iter();
    let maps: Vec<_> = tables.filter(|t| t.is_proposed).map(|t| t.map).collect();
    if !maps.is_empty() {
        return flight_of_tables(files, &maps);
    }
    read_photos(files).ok_or(FolderError::NoFlightFile)
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| endings.iter().any(|e| ending.eq_ignore_ascii_case(e)))
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
