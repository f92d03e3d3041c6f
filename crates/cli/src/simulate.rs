//! `pilotage scenarios` and `pilotage simulate`.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::files::{FileSet, FileSink};
use pilotage_core::flight::write_flight;
use pilotage_core::imagery::{ByteSource, Georeference, Imagery, Window, WorldFile};
use pilotage_core::mission::{MapOptions, MapReference, place_files, write_mission};
use pilotage_core::raster::encode_png;
use pilotage_core::simulate::{Scenario, SimulationChoice, lay_out_world};
use pilotage_jobs::{FlightSource, OpenFlight, map_among, mission_beside_flight};

use crate::CommandResult;
use crate::files::DirectoryFiles;
use crate::scenario::{DayChoice, options, simulation};
use crate::workers::Lent;

/// Arguments of `pilotage simulate`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Name of a scenario (see `pilotage scenarios`).
    #[arg(required_unless_present_any = ["map", "mission"], conflicts_with_all = ["map", "mission"])]
    scenario: Option<String>,
    #[command(flatten)]
    own: crate::own_map::OwnMap,
    /// Seed of gusts, sensors and pictures.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Day on which the camera sees the ground.
    #[arg(long, value_enum, default_value_t = DayChoice::Other)]
    day: DayChoice,
    /// Folder to write; made if missing.
    #[arg(long)]
    out: PathBuf,
}

/// Prints the scenarios.
pub fn list() {
    for choice in SimulationChoice::all() {
        println!(
            "{}\n    {}\n    {}",
            choice.name, choice.title, choice.description
        );
        // The other commands fly scenarios over the generated country.
        if Scenario::named(choice.name).is_none() {
            println!(
                "    For the page, `pilotage replay` and `compare`, and `pilotage simulate`, which writes its map and its mission beside it."
            );
        }
        println!();
    }
}

/// Flies a scenario, or over a map of one's own, and writes it.
pub fn run(arguments: &Arguments) -> CommandResult {
    let mut worker = Lent::default().worker();
    let (flown, beside) = if let Some(name) = &arguments.scenario {
        let choice = simulation(name)?;
        let options = options(choice.name, arguments.seed, arguments.day);
        let overrides = options.overrides();
        let world = lay_out_world(choice.world.key());
        let world = world.ok_or("this program does not know that world")?;
        let missions = world.missions(choice.name, &overrides);
        let written = missions.iter().flat_map(|(file, mission)| {
            let map = match &mission.map {
                Some(MapReference::Picture(name)) => Some(name.as_str()),
                _ => None,
            };
            map.into_iter().chain([*file])
        });
        refuse_others(&arguments.out, &written.collect::<Vec<_>>())?;
        let flown = worker.flight(&FlightSource::Simulated(options))?;
        (flown, Some((world, missions)))
    } else {
        let own = [&arguments.own.map, &arguments.own.mission];
        // What it is flown over and by may lie there.
        let is_beside = |path: &PathBuf| {
            let folder = path.parent().map(|folder| Path::new(".").join(folder));
            let same = |a: &Path, b: &Path| Some(a.canonicalize().ok()? == b.canonicalize().ok()?);
            folder.and_then(|folder| same(&folder, &arguments.out)) == Some(true)
        };
        if !own.into_iter().flatten().any(is_beside) {
            refuse_others(&arguments.out, &[])?;
        }
        let day = arguments.day.into();
        let flown = crate::own_map::fly(&arguments.own, arguments.seed, day)?;
        (Rc::new(RefCell::new(flown)), None)
    };
    let OpenFlight { flight, frames, .. } = &mut *flown.borrow_mut();
    std::fs::create_dir_all(&arguments.out)
        .map_err(|e| format!("{}: {e}", arguments.out.display()))?;
    let mut sink = DirectoryFiles::open(&arguments.out)?;
    if let Some((world, missions)) = &beside {
        let usual = missions
            .first()
            .and_then(|(_, mission)| mission.map.as_ref());
        if let Some(MapReference::Picture(map)) = usual {
            write_map(map, world.map().as_ref(), &mut sink)?;
            for (file, mission) in missions {
                sink.write(file, write_mission(mission).as_bytes())?;
            }
        }
    }
    let mut shown = usize::MAX;
    write_flight(flight, Some(frames), &mut sink, &mut |done, all| {
        let percent = 100 * done / all.max(1);
        if percent / 10 != shown {
            shown = percent / 10;
            eprintln!("{percent:3} %  {done} of {all} files");
        }
        true
    })?;
    println!(
        "wrote {} ({} frames)",
        arguments.out.display(),
        flight.frames.len()
    );
    Ok(())
}

/// Some files of a folder.
struct SomeFiles<'a> {
    folder: &'a DirectoryFiles,
    names: Vec<String>,
}

impl FileSet for SomeFiles<'_> {
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.folder.read(name)
    }

    fn source(&self, name: &str) -> Option<Arc<dyn ByteSource>> {
        self.folder.source(name)
    }
}

/// Refuses a folder with a map or mission beside those that are `written` anew: the flight would be replayed by them.
fn refuse_others(out: &Path, written: &[&str]) -> CommandResult {
    if !out.is_dir() {
        return Ok(());
    }
    let folder = &DirectoryFiles::open(out)?;
    let mut names = folder.names();
    names.retain(|name| !written.contains(&name.as_str()));
    let refuse = |name: &str| {
        Err(format!(
            "--out: \"{}\" holds {name}, by which this flight would be replayed; give another folder",
            out.display()
        )
        .into())
    };
    for name in &names {
        let alone = SomeFiles {
            folder,
            names: vec![name.clone()],
        };
        if mission_beside_flight(&alone, true)?.is_some() {
            return refuse(name);
        }
    }
    match map_among(&SomeFiles { folder, names }, &MapOptions::default())? {
        Some((name, _)) => refuse(&name),
        None => Ok(()),
    }
}

/// Writes a map as a picture with its place.
fn write_map(name: &str, map: &dyn Imagery, sink: &mut dyn FileSink) -> CommandResult {
    let (bounds, gsd) = (map.bounds(), map.native_gsd());
    let pixels = map.window(&Window::covering(&bounds, gsd));
    sink.write(name, &encode_png(&pixels.map(|[r, g, b, _]| [r, g, b]))?)?;
    let place = Georeference::Metres(WorldFile {
        a: gsd,
        d: 0.0,
        b: 0.0,
        e: -gsd,
        c: bounds.west + 0.5 * gsd,
        f: bounds.north - 0.5 * gsd,
    });
    for (name, bytes) in place_files(name, &place) {
        sink.write(&name, &bytes)?;
    }
    Ok(())
}
