//! Simulates a flight without GPS in a wind that nobody told the filter, navigates it by the landmarks in its
//! pictures, and prints how far off the estimate is and how far off it says to be.
//!
//! `cargo run -p pilotage-core --example 01_fly_and_watch`

use std::{error::Error, sync::Arc};

use pilotage_core::imagery::CachedImagery;
use pilotage_core::navigator::{KnownGround, Navigator, summarize};
use pilotage_core::simulate::{
    FlightDay, FlightPlan, Overrides, Scenario, SensorSpec, SimulatedFrames,
};
use pilotage_core::vehicle::StateComponent;

/// Largest root mean square error where landmarks are in view that is taken for a success, metres.
const GOOD: f64 = 3.0;

fn main() -> Result<(), Box<dyn Error>> {
    // 40 s of a built-in scenario: nine buildings, wind from 307° at 10 kt; a picture a second.
    let scenario = Scenario::named("distinct-400ft-wind").ok_or("no such scenario")?;
    let sensors = SensorSpec {
        frame_rate: 1.0,
        ..SensorSpec::default()
    };
    let whole = scenario.plan(&Overrides {
        sensors: Some(sensors),
        ..Overrides::default()
    });
    let plan = FlightPlan {
        longest: 40.0,
        ..whole
    };
    let flight = Arc::new(plan.simulate(1).ok_or("there is nothing to fly")?);

    // The map, the landmarks on it, and settings that know the sensors but not the wind.
    let map = Scenario::map();
    let mission = scenario.mission_over(&map);
    let map = Arc::new(CachedImagery::new(Arc::new(map), 64));
    let mut frames = SimulatedFrames::new(&flight, FlightDay::Same, 1).over(map.clone());
    let settings = &mission.navigator;
    let ground = KnownGround::of(&mission, map);
    let mut navigator = Navigator::new(flight.clone(), &ground, settings)?;

    let truth = flight
        .truth
        .as_ref()
        .ok_or("a simulated flight has a truth")?;
    let mut run = navigator.run_head();
    let wind = run
        .state_index(StateComponent::WindNorth)
        .ok_or("no wind in the state")?;
    println!("time, s  error, m  sigma, m  wind north, m/s  wind east, m/s");
    let mut printed = f64::NEG_INFINITY;
    while let Some(step) = navigator.advance(&mut frames, &|| 0.0) {
        let step = step?;
        if step.frame.is_some() && step.time >= printed + 5.0 {
            printed = step.time;
            let place = truth.position(step.time).ok_or("no truth at that time")?;
            let error = (step.after.position().to_vector() - place.xy().coords).norm();
            let sigma = step.after.greatest_variance().sqrt();
            let [north, east] = [wind, wind + 1].map(|i| step.after.mean[i]);
            let time = step.time;
            println!("{time:7.1}  {error:8.2}  {sigma:8.2}  {north:15.2}  {east:14.2}");
        }
        run.steps.push(step);
    }

    let summary = summarize(&flight, &run, None);
    let errors = summary
        .corrected_position_error_m
        .ok_or("nothing was seen")?;
    let reckoned = summary.dead_reckoning_error_m.ok_or("there is no truth")?;
    println!(
        "after frames with landmarks {:.2} m RMS, {:.2} m at most; by dead reckoning alone {:.0} m",
        errors.rms, errors.max, reckoned.max
    );
    if errors.rms > GOOD || errors.max > reckoned.max {
        return Err(format!("landmarks should keep the error below {GOOD} m RMS").into());
    }
    Ok(())
}
