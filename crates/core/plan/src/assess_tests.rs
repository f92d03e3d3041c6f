//! Tests of `assess`.

use super::*;
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::CachedImagery;
use pilotage_simulate::other_days::SceneryDays;
use pilotage_simulate::simulate::Scenario;

/// A rehearsal of the landmark of that name, moved by (north, east) metres.
fn assessor(name: &str, north: f64, east: f64) -> Assessor {
    let scenario = Scenario::named("distinct-400ft-calm").unwrap();
    let mission = scenario.mission();
    let landmark = mission.landmarks.iter().find(|l| l.name == name).unwrap();
    let center = landmark.bounds.center();
    let bounds = GroundRect::centered(
        GroundPoint::new(center.north + north, center.east + east),
        landmark.bounds.width(),
        landmark.bounds.height(),
    );
    let landmark = &Landmark::new(1, name, bounds);
    let map = Arc::new(CachedImagery::new(Arc::new(Scenario::map()), 64));
    let circumstances = Circumstances {
        camera: Scenario::camera(),
        height: scenario.height,
        position: 4.0,
        sensors: mission.navigator.sensors,
        detector: mission.navigator.detector,
        ground_down: 0.0,
        tilt: 0.0,
    };
    let days = SceneryDays {
        scenery: Scenario::map(),
    };
    let days = days.spread(Rehearsal::DAYS, 11);
    Assessor::new(landmark, map, &days, circumstances, 11)
}

fn rate(name: &str, north: f64, east: f64) -> (ExpectedDetection, f64) {
    let mut assessor = assessor(name, north, east);
    assessor.rehearse();
    assert_eq!(assessor.views().len(), Rehearsal::VIEWS);
    (assessor.expected().unwrap(), assessor.false_matches())
}

#[test]
fn views_that_two_share_by_days_are_those_that_one_takes_alone() {
    let mut alone = assessor("swimming pool", 0.0, 0.0);
    let mut shares = [0, 1].map(|_| assessor("swimming pool", 0.0, 0.0));
    for look in 0..4 {
        alone.look();
        for (part, share) in shares.iter_mut().enumerate() {
            if look % 2 == part {
                share.look();
            } else {
                assert!(share.pass_over());
            }
        }
    }
    let [even, odd] = shares.map(|share| share.views().to_vec());
    assert_eq!(alone.views(), [even[0], odd[0], even[1], odd[1]]);
}

#[test]
fn a_pool_is_found_more_often_than_a_piece_of_the_road_beside_it() {
    let (pool, wrong) = rate("swimming pool", 0.0, 0.0);
    let (road, _) = rate("swimming pool", 20.0, -30.0);
    println!("{pool:?} {road:?}");
    assert!(pool.probability() > 0.7, "{pool:?}");
    assert!(road.probability() < 0.7 * pool.probability(), "{road:?}");
    assert_eq!(wrong, 0.0);
}
