//! Settings and figures of routes in the column.

use egui::Key;
use egui_kittest::kittest::Queryable as _;

use super::super::support::Rig;
use super::{choose, count, draw, number, planning, set};

const BEND: [(f64, f64); 3] = [(0.0, -300.0), (60.0, 0.0), (0.0, 300.0)];

fn routes(rig: &Rig) -> Vec<serde_json::Value> {
    rig.state()["plan"]["routes"]
        .as_array()
        .cloned()
        .unwrap_or_default()
}

fn way_points(rig: &Rig, route: usize) -> usize {
    routes(rig)[route]["way_points"]
        .as_array()
        .map_or(0, Vec::len)
}

#[test]
fn a_way_point_is_deleted_and_comes_back_by_undo() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    choose(&mut rig, 2);
    rig.harness
        .get_by_label("Delete the way-point")
        .click_accesskit();
    rig.settle();
    assert_eq!(way_points(&rig, 0), 2);
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    assert_eq!(way_points(&rig, 0), 3);
    choose(&mut rig, 2);
    rig.key(Key::Delete);
    assert_eq!(way_points(&rig, 0), 2);
}

#[test]
fn a_leg_flown_slower_takes_longer_until_it_is_flown_in_cruise_again() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let before = number(&rig, "/prediction/dead_reckoning");
    choose(&mut rig, 2);
    set(&mut rig, "Airspeed on the leg to it", 11.0);
    assert_eq!(number(&rig, "/routes/0/way_points/1/speed"), 11.0);
    assert!(number(&rig, "/prediction/dead_reckoning") > before);
    rig.harness.get_by_label("Cruise speed").click();
    rig.settle();
    assert!(routes(&rig)[0]["way_points"][1]["speed"].is_null());
    assert_eq!(number(&rig, "/prediction/dead_reckoning"), before);
}

#[test]
fn a_route_is_split_where_a_way_point_is_chosen() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    choose(&mut rig, 2);
    rig.harness
        .get_by_label("Split the route here")
        .click_accesskit();
    rig.settle();
    assert_eq!((way_points(&rig, 0), way_points(&rig, 1)), (2, 2));
    let ends = |r: usize, w: usize| routes(&rig)[r]["way_points"][w]["north"].clone();
    assert_eq!(ends(0, 1), ends(1, 0));
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    assert_eq!((routes(&rig).len(), way_points(&rig, 0)), (1, 3));
}

#[test]
fn a_route_is_duplicated_and_named() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    rig.harness.get_by_label("Duplicate the route").click();
    rig.settle();
    assert_eq!(routes(&rig).len(), 2);
    assert_eq!(routes(&rig)[1]["name"], "Route 1, copy");
    assert_eq!(way_points(&rig, 1), 3);
    rig.harness.get_by_label("Name of the route").click();
    rig.frames(2);
    rig.key_with(egui::Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Home".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(routes(&rig)[1]["name"], "Home");
    assert_eq!(routes(&rig)[0]["name"], "Route 1");
}

#[test]
fn a_lower_limit_marks_a_stretch_and_says_how_long_it_is() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    set(&mut rig, "Limit (1σ)", 5000.0);
    assert_eq!(number(&rig, "/prediction/stretches"), 0.0);
    assert_eq!(count(&rig, "Nowhere over your limit of 5000 m."), 1);
    set(&mut rig, "Limit (1σ)", 1.0);
    assert!(number(&rig, "/prediction/stretches") >= 1.0);
    assert!(number(&rig, "/prediction/over") > 0.0);
    assert_eq!(count(&rig, "Over your limit of 1.0 m"), 1);
    let readouts = |rig: &Rig| {
        let nowhere =
            |text: Option<String>| text.is_some_and(|t| t.contains("Too uncertain: nowhere"));
        let found = rig
            .harness
            .query_all_by(|n| nowhere(n.label()) || nowhere(n.value()));
        found.count()
    };
    assert_eq!(readouts(&rig), 0);
    set(&mut rig, "Limit (1σ)", 5000.0);
    assert_eq!(readouts(&rig), 1);
}

#[test]
fn the_wind_that_is_stated_counts_until_the_flights_own_is_taken_again() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let row = |rig: &Rig| {
        let found = rig
            .harness
            .query_all_by(|n| n.label().is_some_and(|l| l.starts_with("Way-point 2:")))
            .next()
            .and_then(|n| egui_kittest::kittest::NodeT::accesskit_node(&n).label());
        found.expect("a row")
    };
    let before = row(&rig);
    set(&mut rig, "Wind speed", 10.0);
    set(&mut rig, "Wind from", 90.0);
    let against = row(&rig);
    assert_ne!(before, against);
    set(&mut rig, "Wind speed", 40.0);
    assert!(row(&rig).contains("no way"), "{}", row(&rig));
    rig.harness
        .get_by_label("Use the flight's wind")
        .click_accesskit();
    rig.settle();
    assert_eq!(row(&rig), before);
}

#[test]
fn a_gentle_bank_makes_a_leg_too_short_for_its_turns_and_widens_the_predicted_turn() {
    let mut rig = planning();
    draw(
        &mut rig,
        &[(0.0, -300.0), (0.0, 0.0), (90.0, 0.0), (90.0, 300.0)],
    );
    set(&mut rig, "Bank limit", 50.0);
    let tight = |rig: &Rig| {
        rig.harness
            .query_all_by(|n| {
                n.label()
                    .is_some_and(|l| l.ends_with("too short for its turns"))
            })
            .count()
    };
    assert_eq!(tight(&rig), 0);
    let length = number(&rig, "/prediction/length");
    set(&mut rig, "Bank limit", 12.0);
    assert_eq!(tight(&rig), 1);
    assert!((number(&rig, "/prediction/length") - length).abs() > 5.0);
}

#[test]
fn stated_energy_is_counted_down_along_the_legs() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    set(&mut rig, "Power in cruise", 180.0);
    set(&mut rig, "Energy on board", 60.0);
    let rows = rig
        .harness
        .query_all_by(|n| n.label().is_some_and(|l| l.contains(" Wh left")));
    assert_eq!(rows.count(), 2, "both legs say what is left");
    rig.harness
        .get_by_label("Do not state: energy on board")
        .click_accesskit();
    rig.settle();
    let rows = rig
        .harness
        .query_all_by(|n| n.label().is_some_and(|l| l.contains(" Wh left")));
    assert_eq!(rows.count(), 0);
}

#[test]
fn circles_lengthen_what_is_predicted() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    assert_eq!(count(&rig, "Circles and waiting"), 0);
    let before = number(&rig, "/prediction/length");
    choose(&mut rig, 2);
    rig.harness
        .get_by_label("What is done at the way-point")
        .click_accesskit();
    rig.frames(3);
    rig.harness.get_by_label("Circle").click();
    rig.settle();
    assert_eq!(count(&rig, "Circles and waiting are predicted"), 1);
    // A circle of 80 m around the way-point, entered and left along its tangents.
    let longer = number(&rig, "/prediction/length") - before;
    let circle = std::f64::consts::TAU * 80.0;
    assert!((0.7 * circle..1.5 * circle).contains(&longer), "{longer} m");
}

#[test]
fn a_name_is_that_of_the_route_whose_field_it_was_typed_in_whatever_is_clicked_next() {
    let mut rig = planning();
    draw(&mut rig, &BEND);
    draw(&mut rig, &[(-90.0, -300.0), (-90.0, 300.0)]);
    let names = |rig: &Rig| {
        let names = routes(rig).into_iter().map(|it| it["name"].clone());
        names.collect::<Vec<_>>()
    };
    let chip = |rig: &mut Rig, name: &str| {
        rig.harness.get_by_label(name).click();
        rig.frames(3);
    };
    chip(&mut rig, "Route 1");
    // Nothing is typed.
    rig.harness.get_by_label("Name of the route").click();
    rig.frames(3);
    chip(&mut rig, "Route 2");
    assert_eq!(names(&rig), ["Route 1", "Route 2"]);
    rig.harness.get_by_label("Name of the route").click();
    rig.frames(3);
    rig.key_with(egui::Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Field".into()));
    rig.frames(2);
    chip(&mut rig, "Route 1");
    assert_eq!(names(&rig), ["Route 1", "Field"]);
    rig.harness.get_by_label("Name of the route").click();
    rig.frames(3);
    rig.key(Key::End);
    rig.harness.event(egui::Event::Text(", home".into()));
    rig.frames(2);
    rig.open_tab("Replay");
    rig.settle();
    let state = rig.state();
    assert_eq!(
        state["workspace"], "Replay",
        "a name brings nobody back to the plan"
    );
    assert_eq!(names(&rig), ["Route 1, home", "Field"]);
}
