//! Navigates the same flights by every estimator on two vehicle models, and prints one table: error, consistency,
//! time.
//!
//! `cargo run -p pilotage-core --example 10_compare_estimators`

use std::{error::Error, sync::Arc, time::Instant};

use nalgebra::{Matrix4, Vector4};
use pilotage_core::navigator::{EstimatorChoice, Navigator, VehicleChoice};
use pilotage_core::plan::{DetectionStatistics, ExpectedDetection, PlannedLandmark, as_stated};
use pilotage_core::simulate::{Overrides, Scenario};
use pilotage_core::study::{Contender, ContenderTally, EstimatorComparison};

/// Flights of each contender; take 20 for a verdict.
const FLIGHTS: u64 = 2;

fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::named("distinct-400ft-wind").ok_or("no such scenario")?;
    let mission = scenario.mission();
    // No pictures: landmarks are found as often and as well as is stated.
    let spread = Vector4::new(0.5, 0.5, 0.02, 0.02);
    let expected = ExpectedDetection {
        recognised: 0.9,
        per_frame: 0.7,
        covariance: Matrix4::from_diagonal(&spread.map(|sd: f64| sd * sd)),
    };
    let planned = mission.landmarks.iter().map(|landmark| PlannedLandmark {
        landmark: landmark.clone(),
        detection: DetectionStatistics::everywhere(expected),
    });
    let planned: Vec<PlannedLandmark> = planned.collect();

    let begun = Instant::now();
    let stopwatch = || begun.elapsed().as_secs_f64() * 1e3;
    let vehicles = [VehicleChoice::AirplaneWind, VehicleChoice::AirplaneFull];
    let mut tallies = Vec::new();
    // `EstimatorChoice::ALL` has the particle filter as well, whose steps take a hundred times as long.
    let estimators = [EstimatorChoice::Unscented, EstimatorChoice::Extended];
    for contender in Contender::all(&estimators, &vehicles) {
        let mut tally = ContenderTally::new(contender, false);
        for seed in 1..=FLIGHTS {
            let flight = Arc::new(scenario.fly(seed, &Overrides::default()));
            let settings = contender.settings(&mission.navigator, seed);
            let (detector, mut frames) = as_stated(&flight, &planned, seed).ok_or("no truth")?;
            let (given, detector) = (flight.clone(), Box::new(detector));
            let navigator =
                Navigator::with_detector(given, &mission.landmarks, detector, &settings)?;
            let run = navigator.fly(&mut frames, &stopwatch)?;
            tally.add(&flight, &run, &stopwatch)?;
        }
        tallies.push(tally);
    }

    println!(
        "{:63} RMS, m  NEES (2 is honest)  ms a step",
        "estimator, model"
    );
    for row in EstimatorComparison::of(&tallies).rows {
        let Contender { estimator, vehicle } = row.contender;
        let name = format!("{}, {}", estimator.label(), vehicle.label());
        let rms = row.position_error_m.ok_or("no truth")?.rms;
        let nees = row.nees.ok_or("no truth")?.mean;
        println!("{name:63} {rms:6.2}  {nees:18.2}  {:9.3}", row.ms_per_step);
        if rms > 10.0 || row.failed > 0 {
            return Err(format!("{name}: landmarks should keep the error below 10 m").into());
        }
    }
    Ok(())
}
