//! `pilotage compare`: the same flights by several estimators and vehicle models, in one table.

use std::path::{Path, PathBuf};

use pilotage_core::filter::ConsistencySummary;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{ErrorFigures, EstimatorChoice, VehicleChoice};
use pilotage_core::simulate::SimulationChoice;
use pilotage_core::study::{ComparisonRow, Contender, ContenderTally, EstimatorComparison};
use pilotage_jobs::{BareMission, ContestOrder, FlightSource, JobEvent, MapSource};

use crate::CommandResult;
use crate::filter_options;
use crate::mission_file::OpenMission;
use crate::notes::{tell, told};
use crate::outcome::SeedFlights;
use crate::replaying::flight_at;
use crate::scenario::{DayChoice, ground_of, options, seed_range, simulation};
use crate::workers::{self, Lent};

/// Arguments of `pilotage compare`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A built-in scenario, or what was flown: a flight folder, a log, tables, photos.
    flight: String,
    /// Estimators, by comma: ukf, ekf, particle; all of them if none is said.
    #[arg(long, default_value = "")]
    estimators: String,
    /// Vehicle models, by comma; that of the mission if none is said.
    #[arg(long, default_value = "")]
    vehicles: String,
    /// Leave out the estimates after the flight, by the smoother.
    #[arg(long)]
    no_smoother: bool,
    /// Seeds of the scenario, A..B with B left out; 1..2 if none is said.
    #[arg(long, value_name = "A..B")]
    seeds: Option<String>,
    /// Day on which the camera sees the ground of the scenario; another one than that of its map if none is said.
    #[arg(long, value_enum)]
    day: Option<DayChoice>,
    /// Mission file (GeoJSON).
    #[arg(long)]
    mission: Option<PathBuf>,
    /// Fly without the mission that lies in the flight's folder: by whole frames where there is a map.
    #[arg(long, conflicts_with = "mission")]
    no_mission: bool,
    /// Map picture with its georeference beside it, if none lies in the folder.
    #[arg(long)]
    map: Option<PathBuf>,
    /// Changes to the filter, e.g. alpha=0.5,particles=5000; --help lists all keys.
    #[arg(long, default_value = "", value_name = "KEY=VALUE,…", long_help = filter_options::help())]
    filter: String,
    /// File for the table as JSON.
    #[arg(long)]
    out: Option<PathBuf>,
}

/// The table, and the flights that could not be flown.
type ComparedFlights = (EstimatorComparison, SeedFlights);

/// Compares what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    let (comparison, flown) = if Path::new(&arguments.flight).exists() {
        recorded(arguments)?
    } else {
        simulated(arguments, &simulation(&arguments.flight)?)?
    };
    print(&comparison);
    if let Some(path) = &arguments.out {
        crate::files::write_whole(path, serde_json::to_string_pretty(&comparison)?)?;
    }
    flown.all_done()
}

/// Who takes part; `usual` is the vehicle model of the mission.
fn contenders(arguments: &Arguments, usual: VehicleChoice) -> Result<Vec<Contender>, String> {
    let named = |text: &str| -> Vec<String> {
        let names = text.split(',').map(str::trim);
        names.filter(|n| !n.is_empty()).map(str::to_owned).collect()
    };
    let estimator = |name: &String| {
        EstimatorChoice::from_key(name).ok_or_else(|| {
            let keys = EstimatorChoice::ALL.map(EstimatorChoice::key);
            format!(
                "--estimators: there is no \"{name}\"; there are {}",
                keys.join(", ")
            )
        })
    };
    let estimators = named(&arguments.estimators);
    let estimators = estimators
        .iter()
        .map(estimator)
        .collect::<Result<Vec<_>, _>>()?;
    let estimators = if estimators.is_empty() {
        EstimatorChoice::ALL.to_vec()
    } else {
        estimators
    };
    let vehicles = named(&arguments.vehicles);
    let vehicles = vehicles
        .iter()
        .map(|name| VehicleChoice::from_key(name).map_err(|e| format!("--vehicles: {e}")));
    let mut vehicles = vehicles.collect::<Result<Vec<_>, _>>()?;
    if vehicles.is_empty() {
        vehicles.push(usual);
    }
    Ok(Contender::all(&estimators, &vehicles))
}

/// The contest of these flights, each with the seed of what estimators draw over it.
fn contest(
    arguments: &Arguments,
    mut mission: Mission,
    flights: Vec<FlightSource>,
    map: &MapSource,
    lent: &Lent,
) -> Result<ComparedFlights, Box<dyn std::error::Error>> {
    filter_options::apply(&mut mission.navigator, &arguments.filter)?;
    let contenders = contenders(arguments, mission.navigator.vehicle)?;
    let first = flights.first().map_or(0, FlightSource::estimator_seed);
    let mut flown = SeedFlights::of((first, first + flights.len() as u64));
    let order = |flight| {
        ContestOrder {
            contenders: contenders.clone(),
            smooth: !arguments.no_smoother,
            ..ContestOrder::of_all(flight, map.clone(), mission.clone())
        }
        .tallied()
    };
    let orders = flights.into_iter().map(order).collect();
    let mut tallies: Vec<ContenderTally> = Vec::new();
    workers::run(orders, lent, &mut |number, event| {
        let seed = flown.seed(number);
        match event {
            JobEvent::Failed(why) => flown.fail(number, &why),
            JobEvent::Remark(why) if flown.are_several() => eprintln!("seed {seed}, {why}"),
            JobEvent::Remark(why) => eprintln!("{why}"),
            JobEvent::Figures(_) => {
                let of_flight: Vec<ContenderTally> = event.read_figures()?;
                if tallies.is_empty() {
                    tallies = of_flight;
                } else {
                    let both = tallies.iter_mut().zip(of_flight);
                    both.for_each(|(tally, other)| tally.merge(other));
                }
                if flown.are_several() {
                    eprintln!("seed {seed} is done");
                }
            }
            _ => {}
        }
        Ok(())
    })?;
    flown.any()?;
    Ok((EstimatorComparison::of(&tallies), flown))
}

/// Refuses an option that is said of what cannot follow it.
fn not_of(flown: &str, said: [(&str, bool); 2]) -> Result<(), String> {
    match said.into_iter().find(|(_, is_said)| *is_said) {
        Some((option, _)) => Err(format!("--{option} says nothing of {flown}; leave it out")),
        None => Ok(()),
    }
}

fn simulated(
    arguments: &Arguments,
    choice: &SimulationChoice,
) -> Result<ComparedFlights, Box<dyn std::error::Error>> {
    let mission = match &arguments.mission {
        Some(path) => OpenMission::read(path)?.package.mission,
        None => choice.mission().ok_or("this flight has no mission")?,
    };
    not_of(
        "a scenario",
        [
            ("map", arguments.map.is_some()),
            ("no-mission", arguments.no_mission),
        ],
    )?;
    let (first, end) = seed_range(arguments.seeds.as_deref().unwrap_or("1..2"))?;
    let day = arguments.day.unwrap_or(DayChoice::Other);
    let flown = |seed| FlightSource::Simulated(options(choice.name, seed, day));
    let flights = (first..end).map(flown).collect();
    let lent = ground_of(choice, day);
    contest(
        arguments,
        mission,
        flights,
        &MapSource::world(choice.world.key()),
        &lent,
    )
}

fn recorded(arguments: &Arguments) -> Result<ComparedFlights, Box<dyn std::error::Error>> {
    not_of(
        "a recorded flight",
        [
            ("seeds", arguments.seeds.is_some()),
            ("day", arguments.day.is_some()),
        ],
    )?;
    let flight = flight_at(Path::new(&arguments.flight), None, None)?;
    tell(&flight.notes);
    let map = flight.map(arguments.map.as_deref())?.map(told);
    let (source, lent) = Lent::over(map);
    let lent = lent.with_flight(&flight.open);
    let stated = flight.mission(arguments.mission.as_deref(), arguments.no_mission)?;
    let mission = stated.unwrap_or_else(|| BareMission::of(&flight.open.flight, &source).mission);
    contest(arguments, mission, vec![Lent::flight()], &source, &lent)
}

/// Name of a contender on the command line.
fn name(contender: Contender) -> String {
    let (estimator, vehicle) = (contender.estimator.key(), contender.vehicle.key());
    format!("{estimator} {vehicle}")
}

/// Prints the table for people.
fn print(comparison: &EstimatorComparison) {
    println!(
        "{:36} {:>7} {:>8} {:>8} {:>8}  {:>22}  {:>22} {:>8} {:>8} {:>10}",
        "position error, m:",
        "flights",
        "rms",
        "median",
        "max",
        "NEES [95 % of honest]",
        "NIS/dof [95 %]",
        "accepted",
        "refused",
        "ms a step"
    );
    for row in &comparison.rows {
        println!("{}", line(row));
    }
}

fn line(row: &ComparisonRow) -> String {
    let mut title = name(row.contender);
    if row.smoothed {
        title.push_str(", smoothed");
    }
    // Where nothing says where the aircraft really was, no error is known.
    let error = row.position_error_m;
    let metres = |of: fn(&ErrorFigures) -> f64| {
        error.map_or_else(
            || "\u{2013}".to_owned(),
            |error| format!("{:.3}", of(&error)),
        )
    };
    let consistency = |summary: &Option<ConsistencySummary>, per_degree: bool| {
        summary.map_or_else(String::new, |s| {
            let unit = if per_degree { s.dof } else { 1.0 };
            format!(
                "{:.2} [{:.2}, {:.2}]{}",
                s.mean / unit,
                s.lower_95 / unit,
                s.upper_95 / unit,
                if s.is_consistent() { " " } else { "!" }
            )
        })
    };
    let failed = if row.failed > 0 {
        format!("  {} stopped", row.failed)
    } else {
        String::new()
    };
    format!(
        "{title:36} {:>7} {:>8} {:>8} {:>8}  {:>22}  {:>22} {:>8} {:>8} {:10.4}{failed}",
        row.flights,
        metres(|error| error.rms),
        metres(|error| error.median),
        metres(|error| error.max),
        consistency(&row.nees, false),
        consistency(&row.nis, true),
        row.updates_accepted,
        row.updates_refused,
        row.ms_per_step,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_names_every_contender_and_marks_what_is_not_honest() {
        let contender = Contender {
            estimator: EstimatorChoice::Particles,
            vehicle: VehicleChoice::RandomWalk,
        };
        let summary = ConsistencySummary {
            count: 10,
            mean: 9.0,
            dof: 2.0,
            lower_95: 1.0,
            upper_95: 3.0,
            inside_95: 0.2,
        };
        let row = ComparisonRow {
            contender,
            smoothed: true,
            flights: 3,
            failed: 1,
            position_error_m: None,
            nees: Some(summary),
            nis: Some(summary),
            frames_with_update: 1,
            updates_accepted: 2,
            updates_refused: 3,
            ms_per_step: 0.5,
        };
        let line = line(&row);
        assert!(line.starts_with("particle random-walk, smoothed"), "{line}");
        assert!(line.contains("9.00 [1.00, 3.00]!"), "{line}");
        assert!(line.contains("4.50 [0.50, 1.50]!"), "{line}");
        assert!(line.ends_with("1 stopped"), "{line}");
        assert!(
            line.contains("–        –        –"),
            "an error that nobody knows is none of 0 m: {line}"
        );
    }
}
