//! The beginning of the flight without named landmarks, on another day than its map.

use std::sync::Arc;

use pilotage_core::navigator::{KnownGround, Navigator};
use pilotage_core::simulate::{Overrides, Scenario};

/// Seconds that are flown: each picture is one more second of the test.
const FLOWN: f64 = 4.2;

#[test]
fn a_start_forty_metres_off_is_found_by_buildings_and_trees_alone() {
    let scenario = Scenario::named("generic-1000ft").unwrap();
    let mut simulated = scenario.simulate(4, &Overrides::default());
    let mission = scenario.mission();
    assert!(mission.landmarks.is_empty());
    let mut flight = simulated.flight.clone();
    flight.start.position.north += 34.0;
    flight.start.position.east -= 21.0;
    flight.start.standard_deviation = 40.0;
    let truth = flight.truth.clone().unwrap();
    let ground = KnownGround::of(&mission, Arc::new(Scenario::map()));
    let mut navigator = Navigator::new(Arc::new(flight), &ground, &mission.navigator).unwrap();
    let (mut begun, mut accepted, mut error) = (None, 0, f64::INFINITY);
    while let Some(step) = navigator.advance(&mut simulated.frames, &|| 0.0) {
        let step = step.unwrap();
        let fixes = step.updates.iter();
        accepted += fixes.filter(|update| update.gain.is_some()).count();
        let place = truth.position(step.time).unwrap();
        error = (step.after.position().to_vector() - place.xy().coords).norm();
        if step.time - *begun.get_or_insert(step.time) > FLOWN {
            break;
        }
    }
    println!("{accepted} fixes, {error:.1} m");
    assert!(accepted >= 4, "{accepted}");
    assert!(error < 10.0, "{error}");
}
