//! The beginning of the flight without named landmarks, on another day than its map.

use std::sync::Arc;

use nalgebra::Vector2;
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::{KnownGround, Navigator, SightingReport};
use pilotage_core::simulate::{Overrides, Scenario};

/// Seconds that are flown: each picture is one more second of the test.
const FLOWN: f64 = 4.2;

/// Error of the believed place by the accepted pairs of a picture, metres north and east, which must agree on it.
fn by_the_pairs(sighting: &SightingReport) -> Vector2<f64> {
    let pairs = sighting.seen.iter().filter_map(|seen| {
        let pair = seen.pair.filter(|pair| pair.accepted)?;
        let known = &sighting.known[pair.known];
        assert_eq!(known.kind, seen.kind);
        assert!(seen.similar > 0 && pair.probability >= Some(0.9));
        Some(difference(seen.place, known.place))
    });
    let pairs: Vec<_> = pairs.collect();
    assert_eq!(pairs.len(), sighting.accepted());
    let mean = pairs.iter().sum::<Vector2<f64>>() / pairs.len() as f64;
    for pair in &pairs {
        assert!((pair - mean).norm() < 15.0, "{pair} among {mean}");
    }
    mean
}

fn difference(of: GroundPoint, than: GroundPoint) -> Vector2<f64> {
    of.to_vector() - than.to_vector()
}

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
    let mut told = 0;
    while let Some(step) = navigator.advance(&mut simulated.frames, &|| 0.0) {
        let step = step.unwrap();
        let fixes = step.updates.iter();
        accepted += fixes.filter(|update| update.gain.is_some()).count();
        let place = truth.position(step.time).unwrap();
        let sightings = step.sightings.iter();
        for sighting in sightings.filter(|sighting| sighting.accepted() > 0) {
            told += 1;
            let believed = step.frame.as_ref().unwrap().assumed_pose.position_in_world;
            let off = by_the_pairs(sighting);
            let error = believed.xy().coords - off - place.xy().coords;
            // The mount shakes by a degree per axis, which is 5.3 m from that height: four deviations.
            assert!(error.norm() < 21.3, "{:.1} s: {error}", step.time);
        }
        error = (step.after.position().to_vector() - place.xy().coords).norm();
        if step.time - *begun.get_or_insert(step.time) > FLOWN {
            break;
        }
    }
    println!("{accepted} fixes, {error:.1} m");
    assert!(accepted >= 4, "{accepted}");
    assert!(told >= accepted, "{told}");
    assert!(error < 10.0, "{error}");
}
