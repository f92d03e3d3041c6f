//! `pilotage roads fly`: a scenario by roads, judged across and along them.

use pilotage_core::filter::{Consistency, nearest_sample};
use pilotage_jobs::{JobEvent, MapSource, RoadFlight, RoadFlightOrder};
use serde::Serialize;

use crate::CommandResult;
use crate::files::write_whole;
use crate::filter_options;
use crate::outcome::SeedFlights;
use crate::scenario::{DayChoice, flown as source, scenario, scenery, seed_range};
use crate::workers;

/// Arguments of `pilotage roads fly`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A built-in scenario whose mission has roads.
    #[arg(default_value = "roads-400ft")]
    scenario: String,
    /// Seeds, A..B with B left out.
    #[arg(long, value_name = "A..B", default_value = "1..21")]
    seeds: String,
    /// Day on which the camera sees the ground.
    #[arg(long, value_enum, default_value_t = DayChoice::Other)]
    day: DayChoice,
    /// Changes to the filter, e.g. roads.map=1; --help lists all keys.
    #[arg(long, default_value = "", value_name = "KEY=VALUE,…", long_help = filter_options::help())]
    filter: String,
    /// File for the table as JSON.
    #[arg(long)]
    out: Option<std::path::PathBuf>,
}

/// Figures of one flight.
#[derive(Serialize)]
struct SeedFigures {
    seed: u64,
    #[serde(flatten)]
    figures: RoadFlight,
}

/// Flies what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    let scenario = scenario(&arguments.scenario)?;
    let (first, end) = seed_range(&arguments.seeds)?;
    let mut mission = scenario.mission();
    if mission.roads.is_empty() {
        return Err(format!(
            "{}: its mission has no roads; choose another",
            scenario.name
        )
        .into());
    }
    filter_options::apply(&mut mission.navigator, &arguments.filter)?;
    let order = |seed| RoadFlightOrder {
        flight: source(&scenario, seed, arguments.day),
        map: MapSource::world("countryside"),
        mission: mission.clone(),
    };
    let orders = (first..end).map(order).collect();
    let lent = scenery(&scenario, arguments.day);
    let mut nis = Consistency::default();
    let mut table = Vec::new();
    let mut flown = SeedFlights::of((first, end));
    println!(
        "seed  across  later  along | reckoned across  along | sigma along/reckoned | looks refused | NIS/dof  NEES across"
    );
    workers::run(orders, &lent, &mut |number, event| {
        match event {
            JobEvent::Failed(why) => flown.fail(number, &why),
            JobEvent::Figures(_) => {
                let (figures, looks): (RoadFlight, Consistency) = event.read_figures()?;
                nis.merge(&looks);
                let seed = flown.seed(number);
                let row = SeedFigures { seed, figures };
                print(&row);
                table.push(row);
            }
            _ => {}
        }
        Ok(())
    })?;
    flown.any()?;
    tell(&table, &nis);
    if let Some(path) = &arguments.out {
        write_whole(path, serde_json::to_string_pretty(&table)?)?;
    }
    flown.all_done()
}

fn print(SeedFigures { seed, figures: row }: &SeedFigures) {
    println!(
        "{seed:4} {:7.2} {:6.2} {:6.2} | {:15.2} {:6.2} | {:20.4} | {:5} {:7} | {:7.3} {:12.3}",
        row.across_m,
        row.across_later_m,
        row.along_m,
        row.reckoned_across_m,
        row.reckoned_along_m,
        row.along_sigma_ratio,
        row.corrected,
        row.refused,
        row.nis_sum / row.nis_degrees.max(1) as f64,
        row.nees_across
    );
}

/// Tells the medians and the greatest values over all flights, and the consistency of the aid.
fn tell(table: &[SeedFigures], nis: &Consistency) {
    let of = |value: fn(&RoadFlight) -> f64| {
        let mut values: Vec<f64> = table.iter().map(|row| value(&row.figures)).collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| nearest_sample(&values, share).unwrap_or(f64::NAN);
        format!(
            "median {:.3}, least {:.3}, greatest {:.3}",
            at(0.5),
            at(0.0),
            at(1.0)
        )
    };
    println!("across, m: {}", of(|row| row.across_m));
    println!(
        "across after the first third, m: {}",
        of(|row| row.across_later_m)
    );
    println!("along, m: {}", of(|row| row.along_m));
    println!(
        "across by dead reckoning, m: {}",
        of(|row| row.reckoned_across_m)
    );
    println!(
        "along by dead reckoning, m: {}",
        of(|row| row.reckoned_along_m)
    );
    println!(
        "least sigma along over that of dead reckoning: {}",
        of(|row| row.along_sigma_ratio)
    );
    println!(
        "squared error across over its variance: {}",
        of(|row| row.nees_across)
    );
    if let Some(nis) = nis.summary() {
        println!(
            "NIS per degree of freedom {:.3} of {} looks, mean {:.3} with {:.2} degrees, 95 % bounds of the mean {:.3} to {:.3}",
            nis.mean / nis.dof,
            nis.count,
            nis.mean,
            nis.dof,
            nis.lower_95,
            nis.upper_95,
        );
    }
}
