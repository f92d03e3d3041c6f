//! `pilotage roads fly`: a scenario by roads, judged across and along them.

use std::sync::Arc;

use nalgebra::Vector2;
use pilotage_core::filter::{Consistency, nearest_sample};
use pilotage_core::frames::GroundPoint;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::navigator::{KnownGround, Navigator, Run};
use pilotage_core::roads::{RoadJoining, RoadMap};
use pilotage_core::simulate::{Overrides, Scenario};
use serde::Serialize;

use crate::CommandResult;
use crate::files::{MAP_CACHE, write_whole};
use crate::filter_options;
use crate::scenario::{DayChoice, scenario, seed_range};

/// Distance from a road beyond which nothing is said about it, metres.
const BESIDE: f64 = 100.0;

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
    /// Changes to the filter, e.g. roads.map=1.
    #[arg(long, default_value = "")]
    filter: String,
    /// File for the table as JSON.
    #[arg(long)]
    out: Option<std::path::PathBuf>,
}

/// Figures of one flight.
#[derive(Serialize)]
struct RoadFlight {
    seed: u64,
    /// Root mean square of the error across the nearest road, metres: whole flight, and after its first third.
    across_m: f64,
    across_later_m: f64,
    /// The same along it.
    along_m: f64,
    /// The same by dead reckoning.
    reckoned_across_m: f64,
    reckoned_along_m: f64,
    /// Least ratio of the standard deviation along the road to that of dead reckoning.
    along_sigma_ratio: f64,
    /// Looks that corrected, and looks that were refused.
    corrected: usize,
    refused: usize,
    nis_sum: f64,
    nis_degrees: usize,
    /// Mean squared error across over its variance.
    nees_across: f64,
}

/// Flies what the arguments say.
pub fn run(arguments: &Arguments) -> CommandResult {
    let scenario = scenario(&arguments.scenario)?;
    let (first, end) = seed_range(&arguments.seeds)?;
    let scenery = Scenario::map();
    let mission = scenario.mission_over(&scenery);
    if mission.roads.is_empty() {
        return Err(format!(
            "{}: its mission has no roads; choose another",
            scenario.name
        )
        .into());
    }
    let roads = RoadMap::new(mission.roads.clone(), RoadJoining::SHARED_POINTS);
    let mut settings = mission.navigator.clone();
    filter_options::apply(&mut settings, &arguments.filter)?;
    let map: Arc<dyn Imagery> = Arc::new(CachedImagery::new(Arc::new(scenery), MAP_CACHE));
    let overrides = Overrides {
        day: Some(arguments.day.into()),
        ..Overrides::default()
    };
    let ground = KnownGround::of(&mission, map);
    let mut nis = Consistency::default();
    let mut table = Vec::new();
    println!(
        "seed  across  later  along | reckoned across  along | sigma along/reckoned | looks refused | NIS/dof  NEES across"
    );
    for seed in first..end {
        let mut simulated = scenario.simulate(seed, &overrides);
        let flight = Arc::new(simulated.flight.clone());
        let mut fly = |aided: bool| {
            let mut settings = settings.clone();
            if !aided {
                settings.aids.clear();
            }
            let navigator = Navigator::new(Arc::clone(&flight), &ground, &settings)?;
            // Without roads nobody looks at the pictures.
            navigator.sparing().fly(&mut simulated.frames, &|| 0.0)
        };
        let (aided, reckoned) = (fly(true)?, fly(false)?);
        let truth = flight.truth.as_ref().ok_or("the flight has no truth")?;
        let true_place = |time: f64| {
            let place = truth.position(time)?;
            Some(GroundPoint::new(place.x, place.y))
        };
        let row = judged(seed, &roads, true_place, (&aided, &reckoned), &mut nis);
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
        table.push(row);
    }
    tell(&table, &nis);
    if let Some(path) = &arguments.out {
        write_whole(path, serde_json::to_string_pretty(&table)?)?;
    }
    Ok(())
}

fn judged(
    seed: u64,
    roads: &RoadMap,
    true_place: impl Fn(f64) -> Option<GroundPoint>,
    (aided, reckoned): (&Run, &Run),
    nis: &mut Consistency,
) -> RoadFlight {
    let mut row = RoadFlight {
        seed,
        across_m: 0.0,
        across_later_m: 0.0,
        along_m: 0.0,
        reckoned_across_m: 0.0,
        reckoned_along_m: 0.0,
        along_sigma_ratio: f64::INFINITY,
        corrected: 0,
        refused: 0,
        nis_sum: 0.0,
        nis_degrees: 0,
        nees_across: 0.0,
    };
    let (mut count, mut later) = (0, 0);
    let steps = aided.steps.len();
    for (index, (step, other)) in aided.steps.iter().zip(&reckoned.steps).enumerate() {
        for update in step.updates.iter().filter(|update| update.aid == "roads") {
            nis.push(update.nis, update.degrees_of_freedom);
            row.nis_sum += update.nis;
            row.nis_degrees += update.degrees_of_freedom;
            *(if update.gain.is_some() {
                &mut row.corrected
            } else {
                &mut row.refused
            }) += 1;
        }
        let Some(truth) = true_place(step.time) else {
            continue;
        };
        let Some(near) = roads.nearest(truth, BESIDE) else {
            continue;
        };
        let (sin, cos) = near.heading.sin_cos();
        let (ahead, right) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let error = |place: GroundPoint| place.to_vector() - truth.to_vector();
        let (own, theirs) = (error(step.after.position()), error(other.after.position()));
        let variance = |axis: Vector2<f64>, estimate: &pilotage_core::navigator::Estimate| {
            axis.dot(&(estimate.position_covariance() * axis))
        };
        count += 1;
        row.across_m += right.dot(&own).powi(2);
        row.along_m += ahead.dot(&own).powi(2);
        row.reckoned_across_m += right.dot(&theirs).powi(2);
        row.reckoned_along_m += ahead.dot(&theirs).powi(2);
        row.nees_across += right.dot(&own).powi(2) / variance(right, &step.after);
        let ratio = (variance(ahead, &step.after) / variance(ahead, &other.after)).sqrt();
        row.along_sigma_ratio = row.along_sigma_ratio.min(ratio);
        if 3 * index > steps {
            later += 1;
            row.across_later_m += right.dot(&own).powi(2);
        }
    }
    let all = f64::from(count.max(1));
    row.nees_across /= all;
    row.across_later_m = (row.across_later_m / f64::from(later.max(1))).sqrt();
    for sum in [
        &mut row.across_m,
        &mut row.along_m,
        &mut row.reckoned_across_m,
        &mut row.reckoned_along_m,
    ] {
        *sum = (*sum / all).sqrt();
    }
    row
}

/// Tells the medians and the greatest values over all flights, and the consistency of the aid.
fn tell(table: &[RoadFlight], nis: &Consistency) {
    let of = |value: fn(&RoadFlight) -> f64| {
        let mut values: Vec<f64> = table.iter().map(value).collect();
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
