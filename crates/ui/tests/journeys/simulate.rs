use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{FlightSource, FlyOrder, Job, MapSource};

use super::support::rig;

#[test]
fn a_scenario_is_chosen_and_flown() {
    let mut rig = rig();
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness.get_by_label("Village, calm").click();
    rig.frames(6);
    rig.harness.get_by_label("The same day").click();
    rig.frames(2);
    rig.harness.get_by_label("Fly").click();
    rig.frames(4);
    let Some((
        _,
        Job::Fly(FlyOrder {
            flight: FlightSource::Simulated(options),
            ..
        }),
    )) = rig.host().last_flight().cloned()
    else {
        panic!("nothing was simulated");
    };
    assert_eq!(options.scenario, "distinct-400ft-calm");
    assert!(!options.other_day);
    assert_eq!(rig.state()["ghost_steps"], 0);
}

#[test]
fn the_hall_is_flown_over_its_floor_as_it_is() {
    let mut rig = rig();
    rig.menu("Open", "Simulate a flight…");
    rig.frames(8);
    rig.harness
        .get_by_label("Another height than the scenario’s")
        .click();
    rig.frames(2);
    rig.harness.get_by_label("Quadcopter in a hall").click();
    rig.frames(6);
    for other in ["The same day", "Another height than the scenario’s"] {
        assert!(rig.harness.query_by_label(other).is_none(), "{other}");
    }
    rig.harness.get_by_label("Fly").click();
    rig.frames(4);
    let flown = rig.host().last_flight().cloned();
    let Some((_, Job::Fly(FlyOrder { flight, map, .. }))) = flown else {
        panic!("nothing was simulated");
    };
    let FlightSource::Simulated(options) = flight else {
        panic!("{flight:?}");
    };
    assert_eq!(options.scenario, "indoor-hall");
    assert_eq!((options.other_day, options.height), (false, None));
    assert_eq!(map, MapSource::world("hall"));
}

#[test]
fn a_flight_under_way_can_be_stopped() {
    let mut rig = rig();
    rig.host().silent_flights = true;
    rig.key(egui::Key::R);
    rig.frames(2);
    assert!(rig.state()["job"].is_object());
    rig.harness.get_by_label("Stop computing").click();
    rig.frames(3);
    assert!(rig.state()["job"].is_null());
    assert_eq!(rig.host().cancelled.len(), 1);
    assert!(
        rig.state()["run_steps"].as_u64() > Some(0),
        "the old run stays"
    );
}
