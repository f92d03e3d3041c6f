//! `pilotage scenarios` and `pilotage simulate`.

use std::path::PathBuf;

use clap::ValueEnum;
use pilotage_core::flight::write_flight;
use pilotage_core::simulate::{FlightDay, Overrides, Scenario};

use crate::Outcome;
use crate::files::Directory;

/// Whether the camera sees the ground on the day of the map.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Day {
    /// The day of the map.
    Same,
    /// Another season, sun and traffic.
    Other,
}

impl From<Day> for FlightDay {
    fn from(day: Day) -> Self {
        match day {
            Day::Same => Self::Same,
            Day::Other => Self::Other,
        }
    }
}

/// What to fly.
#[derive(clap::Args)]
pub struct Arguments {
    /// Name of a scenario (see `pilotage scenarios`).
    scenario: String,
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

/// The scenario of that name, or an error that lists those there are.
pub fn scenario(name: &str) -> Result<Scenario, String> {
    Scenario::named(name).ok_or_else(|| {
        let names: Vec<&str> = Scenario::all().iter().map(|s| s.name).collect();
        format!(
            "there is no scenario \"{name}\"; there are: {}",
            names.join(", ")
        )
    })
}

/// Prints the scenarios.
pub fn list() {
    for scenario in Scenario::all() {
        println!(
            "{}\n    {}\n    {}\n",
            scenario.name, scenario.title, scenario.description
        );
    }
}

/// Flies a scenario and writes it.
pub fn run(arguments: &Arguments) -> Outcome {
    let scenario = scenario(&arguments.scenario)?;
    let overrides = Overrides {
        day: Some(arguments.day.into()),
        ..Overrides::default()
    };
    let mut flown = scenario.simulate(arguments.seed, &overrides);
    std::fs::create_dir_all(&arguments.out)
        .map_err(|e| format!("{}: {e}", arguments.out.display()))?;
    let mut sink = Directory::open(&arguments.out)?;
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
