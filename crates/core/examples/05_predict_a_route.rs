//! Predicts before take-off how well the position will be known along a route, and holds flights against it.
//!
//! `cargo run -p pilotage-core --example 05_predict_a_route`

use std::{error::Error, sync::Arc};

use nalgebra::{Matrix4, Vector4};
use pilotage_core::navigator::Navigator;
use pilotage_core::plan::{
    DetectionStatistics, ExpectedDetection, PlannedLandmark, PredictionRequest, Verification,
    as_stated, compare,
};
use pilotage_core::simulate::{Overrides, Scenario};

/// Flights that are held against the prediction.
const FLIGHTS: u64 = 6;

fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::named("distinct-400ft-wind").ok_or("no such scenario")?;
    let mission = scenario.mission();
    let settings = &mission.navigator;
    let plan = &scenario.plan(&Overrides::default());

    // Four landmarks of five can be recognised on the day, those in seven frames of ten, to half a metre.
    let spread = Vector4::new(0.5, 0.5, 0.02, 0.02);
    let expected = ExpectedDetection {
        recognised: 0.8,
        per_frame: 0.7,
        covariance: Matrix4::from_diagonal(&spread.map(|sd: f64| sd * sd)),
    };
    let planned = mission.landmarks.iter().map(|landmark| PlannedLandmark {
        landmark: landmark.clone(),
        detection: DetectionStatistics::everywhere(expected),
    });
    let landmarks = &planned.collect::<Vec<_>>();
    let prediction = PredictionRequest {
        plan,
        settings,
        landmarks,
        wind_deviation: settings.start.wind,
        worlds: 32,
        seed: 3,
        limit: 10.0,
    }
    .predict()?;
    println!("way, m  sigma, m  half width of the 95 % corridor, m  dead reckoning, m");
    for sample in prediction.samples.iter().step_by(20) {
        let (sigma, across) = (sample.corridor.sigma_major, sample.corridor.across);
        let (way, reckoned) = (sample.distance, sample.dead_reckoning);
        println!("{way:6.0}  {sigma:8.1}  {across:34.1}  {reckoned:17.0}");
    }
    for stretch in &prediction.over_limit {
        let (begin, end, sigma) = (stretch.begin, stretch.end, stretch.sigma);
        println!("over 10 m from {begin:.0} m to {end:.0} m of the way: {sigma:.1} m");
    }

    // The same route in winds, gusts and misses of their own, navigated.
    let mut flights = Vec::new();
    for seed in 1..=FLIGHTS {
        let in_wind = plan.in_wind_of(seed, settings.start.wind);
        let flight = Arc::new(in_wind.simulate(seed).ok_or("nothing to fly")?);
        let (detector, mut frames) = as_stated(&flight, landmarks, seed).ok_or("no truth")?;
        let (given, detector) = (flight.clone(), Box::new(detector));
        let navigator =
            Navigator::with_detector(given, &mission.landmarks, detector, settings)?.sparing();
        let run = navigator.fly(&mut frames, &|| 0.0)?;
        flights.push(compare(&flight, &run, &prediction));
    }
    let held = Verification::of(&flights);
    let (inside, frames) = (100.0 * held.inside_corridor, held.frames);
    println!("{FLIGHTS} flights: {inside:.0} % of {frames} frames lie in the corridor");
    if held.inside_corridor < 0.85 {
        return Err("a corridor of 95 % should hold at least 85 % of so few flights".into());
    }
    Ok(())
}
