//! `pilotage scenarios` and `pilotage simulate`.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

use pilotage_core::flight::files::FileSink;
use pilotage_core::flight::write_flight;
use pilotage_core::imagery::{Georeference, Imagery, Window, WorldFile};
use pilotage_core::mission::{MapReference, place_files, write_mission};
use pilotage_core::raster::encode_png;
use pilotage_core::simulate::{Scenario, SimulationChoice, lay_out_world};
use pilotage_jobs::{FlightSource, OpenFlight};

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
        let flown = worker.flight(&FlightSource::Simulated(options))?;
        let world = lay_out_world(choice.world.key());
        let world = world.ok_or("this program does not know that world")?;
        let missions = world.missions(choice.name, &overrides);
        (flown, Some((world, missions)))
    } else {
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
