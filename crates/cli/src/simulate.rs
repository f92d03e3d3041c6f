//! `pilotage scenarios` and `pilotage simulate`.

use std::path::PathBuf;

use pilotage_core::flight::files::FileSink;
use pilotage_core::flight::write_flight;
use pilotage_core::imagery::{Georeference, Imagery, Window, WorldFile};
use pilotage_core::mission::{place_files, write_mission};
use pilotage_core::navigator::VehicleChoice;
use pilotage_core::raster::encode_png;
use pilotage_core::simulate::{IndoorHall, Overrides, SimulationChoice};

use crate::Outcome;
use crate::files::Directory;
use crate::scenario::{Day, scenario};

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
    #[arg(long, value_enum, default_value_t = Day::Other)]
    day: Day,
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
        if choice.is_indoors {
            println!(
                "    For the page, and for `pilotage simulate`, which writes its map and its mission beside it."
            );
        }
        println!();
    }
}

/// Flies a scenario, or over a map of one's own, and writes it.
pub fn run(arguments: &Arguments) -> Outcome {
    let is_hall = arguments.scenario.as_deref() == Some(IndoorHall::NAME);
    let hall = is_hall.then(IndoorHall::default);
    let mut flown = match (&hall, &arguments.scenario) {
        (Some(hall), _) => hall.simulate(arguments.seed),
        (None, Some(name)) => {
            let overrides = Overrides {
                day: Some(arguments.day.into()),
                ..Overrides::default()
            };
            scenario(name)?.simulate(arguments.seed, &overrides)
        }
        (None, None) => crate::own_map::fly(&arguments.own, arguments.seed, arguments.day.into())?,
    };
    std::fs::create_dir_all(&arguments.out)
        .map_err(|e| format!("{}: {e}", arguments.out.display()))?;
    let mut sink = Directory::open(&arguments.out)?;
    if let Some(hall) = &hall {
        write_hall(hall, &mut sink)?;
    }
    let mut shown = usize::MAX;
    write_flight(
        &flown.flight,
        Some(&mut flown.frames),
        &mut sink,
        &mut |done, all| {
            let percent = 100 * done / all.max(1);
            if percent / 10 != shown {
                shown = percent / 10;
                eprintln!("{percent:3} %  {done} of {all} files");
            }
            true
        },
    )?;
    println!(
        "wrote {} ({} frames)",
        arguments.out.display(),
        flown.flight.frames.len()
    );
    Ok(())
}

/// Writes the drawing of the floor with its place, and a mission for each process model.
fn write_hall(hall: &IndoorHall, sink: &mut dyn FileSink) -> Outcome {
    const MAP: &str = "map.png";
    let map = IndoorHall::map();
    let (bounds, gsd) = (map.bounds(), map.native_gsd());
    let pixels = map.window(&Window::covering(&bounds, gsd));
    sink.write(MAP, &encode_png(&pixels.map(|[r, g, b, _]| [r, g, b]))?)?;
    let place = Georeference::Metres(WorldFile {
        a: gsd,
        d: 0.0,
        b: 0.0,
        e: -gsd,
        c: bounds.west + 0.5 * gsd,
        f: bounds.north - 0.5 * gsd,
    });
    for (name, bytes) in place_files(MAP, &place) {
        sink.write(&name, &bytes)?;
    }
    for (name, vehicle) in [
        ("mission.geojson", VehicleChoice::Multirotor),
        ("mission-velocity.geojson", VehicleChoice::VelocityDriven),
    ] {
        sink.write(name, write_mission(&hall.mission(vehicle)).as_bytes())?;
    }
    Ok(())
}
