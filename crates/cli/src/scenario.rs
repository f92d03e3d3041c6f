//! Arguments that name a built-in scenario, its day and its seeds.

use std::sync::Arc;

use clap::ValueEnum;
use pilotage_core::imagery::CachedImagery;
use pilotage_core::simulate::scenery::{DEMO_SEED, Scenery};
use pilotage_core::simulate::{FlightDay, Scenario, SimulationChoice};
use pilotage_jobs::{FlightSource, MapSource, SimulationOptions};

use crate::maps::MAP_CACHE;
use crate::workers::Lent;

/// Memory for the ground below a flight that is flown again and again, megabytes.
const GROUND_CACHE: usize = 256;

/// Day on which the camera sees the ground.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum DayChoice {
    /// The day of the map.
    Same,
    /// Another season, sun and traffic.
    Other,
}

impl From<DayChoice> for FlightDay {
    fn from(day: DayChoice) -> Self {
        match day {
            DayChoice::Same => Self::Same,
            DayChoice::Other => Self::Other,
        }
    }
}

/// The scenario of that name, or an error that lists those there are.
pub fn scenario(name: &str) -> Result<Scenario, String> {
    Scenario::named(name).ok_or_else(|| unknown(name))
}

/// The error about a name that no scenario has.
pub fn unknown(name: &str) -> String {
    let names: Vec<&str> = Scenario::all().iter().map(|s| s.name).collect();
    not_among(name, &names)
}

fn not_among(name: &str, names: &[&str]) -> String {
    let names = names.join(", ");
    format!("there is no scenario \"{name}\"; there are: {names}")
}

/// The flight of that name in any of the built-in worlds, or an error that lists those there are.
pub fn simulation(name: &str) -> Result<SimulationChoice, String> {
    SimulationChoice::named(name).ok_or_else(|| {
        let names: Vec<&str> = SimulationChoice::all().iter().map(|s| s.name).collect();
        not_among(name, &names)
    })
}

/// Options of a simulated flight as it is without changes, on a day.
pub fn options(name: &str, seed: u64, day: DayChoice) -> SimulationOptions {
    SimulationOptions {
        scenario: name.to_owned(),
        seed,
        other_day: matches!(day, DayChoice::Other),
        wind: None,
        height: None,
    }
}

/// Flight of a scenario, by the source that orders name.
pub fn flown(scenario: &Scenario, seed: u64, day: DayChoice) -> FlightSource {
    FlightSource::Simulated(options(scenario.name, seed, day))
}

/// Map of a scenario and the ground as the camera sees it, for workers that fly it again and again.
pub fn scenery(scenario: &Scenario, day: DayChoice) -> Lent {
    let day = FlightDay::from(day);
    let map = CachedImagery::new(Arc::new(Scenario::map()), MAP_CACHE);
    let ground = Scenery::new(DEMO_SEED, scenario.seen_on(day).day());
    let ground = CachedImagery::new(Arc::new(ground), GROUND_CACHE);
    Lent::default()
        .with_map(MapSource::world("countryside"), Arc::new(map))
        .with_ground(day, Arc::new(ground))
}

/// Map of the world of a flight, and the ground as the camera sees it where that is drawn by the day.
pub fn ground_of(choice: &SimulationChoice, day: DayChoice) -> Lent {
    match Scenario::named(choice.name) {
        Some(scenario) => scenery(&scenario, day),
        None => Lent::default(),
    }
}

/// The seeds "A..B".
pub fn seed_range(text: &str) -> Result<(u64, u64), String> {
    text.split_once("..")
        .and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)))
        .filter(|(a, b)| a < b)
        .ok_or_else(|| format!("--seeds: \"{text}\" is not A..B with A < B"))
}
