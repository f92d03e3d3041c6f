use egui::Key;
use egui_kittest::kittest::Queryable as _;

use super::super::support::Rig;
use super::{choose, click, draw, number, planning, set};

fn command(rig: &mut Rig, words: &str) {
    rig.key_with(egui::Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text(words.into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
}

fn way_points(rig: &Rig, route: usize) -> usize {
    let state = rig.state();
    let list = state["plan"]["routes"][route]["way_points"].as_array();
    list.map_or(0, Vec::len)
}

#[test]
fn an_area_is_surveyed_by_passes_there_and_back_and_one_undo_takes_them_away() {
    let mut rig = planning();
    command(&mut rig, "survey an area");
    for (north, east) in [
        (-140.0, -250.0),
        (-140.0, 250.0),
        (100.0, 250.0),
        (100.0, -250.0),
    ] {
        click(&mut rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
    let state = rig.state();
    assert_eq!(state["plan"]["routes"][0]["pattern"], true);
    let count = way_points(&rig, 0);
    assert!(count >= 6 && count.is_multiple_of(2), "{count}");
    assert_eq!(state["plan"]["prediction"]["fine"], true);
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    assert_eq!(
        rig.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(0)
    );
}

#[test]
fn a_corridor_is_made_along_the_route_beside_it() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 0.0), (0.0, 300.0)]);
    command(&mut rig, "fly a corridor along the route");
    assert_eq!(
        rig.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(2)
    );
    assert_eq!(
        way_points(&rig, 1) % 3,
        0,
        "every pass has the bends of the line"
    );
    rig.key(Key::X);
    assert_eq!(rig.state()["plan"]["routes"][1]["pattern"], false);
}

#[test]
fn circles_at_a_way_point_lengthen_the_way_there() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let time = |rig: &Rig| {
        let label = std::cell::RefCell::new(String::new());
        let rows = rig.harness.query_all_by(|n| {
            let own = n.label().unwrap_or_default();
            let is_row = own.starts_with("Way-point 2:");
            if is_row {
                label.replace(own);
            }
            is_row
        });
        assert_eq!(rows.count(), 1);
        label.into_inner()
    };
    let before = time(&rig);
    rig.harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with("Way-point 2:")))
        .click();
    rig.frames(3);
    rig.harness
        .get_by_label("What is done at the way-point")
        .click();
    rig.frames(3);
    rig.harness.get_by_label("Circle").click();
    rig.frames(3);
    let after = time(&rig);
    assert!(
        after.contains("1 circle,") && before != after,
        "{before} {after}"
    );
}

#[test]
fn another_height_at_one_way_point_changes_the_prediction() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let before = number(&rig, "/prediction/mean_width");
    rig.harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with("Way-point 2:")))
        .click();
    rig.frames(3);
    rig.harness
        .get_by_label("Altitude of the way-point")
        .focus();
    rig.frames(2);
    for _ in 0..60 {
        rig.key(Key::ArrowUp);
    }
    rig.settle();
    let high = number(&rig, "/routes/0/way_points/1/altitude");
    let low = number(&rig, "/routes/0/way_points/0/altitude");
    assert!(high > low, "{high} {low}");
    assert!((number(&rig, "/prediction/mean_width") - before).abs() > 1e-6);
}

#[test]
fn the_strip_shows_the_heights_of_the_route() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Heights");
    let charts = rig.harness.query_all_by(|n| {
        n.label()
            .is_some_and(|l| l.starts_with("Heights along the route: lowest"))
    });
    assert_eq!(charts.count(), 1);
    rig.open_tab("Uncertainty");
}

#[test]
fn a_survey_that_is_flown_at_half_the_height_takes_twice_the_passes() {
    let mut rig = planning();
    command(&mut rig, "survey an area");
    for (north, east) in [
        (-140.0, -250.0),
        (-140.0, 250.0),
        (100.0, 250.0),
        (100.0, -250.0),
    ] {
        click(&mut rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
    let high = number(&rig, "/routes/0/way_points/0/altitude");
    let before = way_points(&rig, 0) / 2;
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", 0.5 * high);
    let after = way_points(&rig, 0) / 2;
    // Strips half as wide: the last one may be left out.
    assert!(
        after == 2 * before || after == 2 * before - 1,
        "{before} {after}"
    );
    let state = rig.state();
    assert_eq!(state["plan"]["routes"][0]["pattern"], true);
    let all = state["plan"]["routes"][0]["way_points"].as_array().cloned();
    let is_low = |w: &serde_json::Value| w["altitude"].as_f64() == Some(0.5 * high);
    assert!(all.expect("way-points").iter().all(is_low));
    rig.key_with(egui::Modifiers::COMMAND, Key::Z);
    assert_eq!(way_points(&rig, 0) / 2, before, "one undo step");
    // Another bank limit says that the passes are laid for wider turns.
    let stale = "They were laid for another height, camera or bank limit";
    assert!(rig.harness.query_by_label_contains(stale).is_none());
    set(&mut rig, "Bank limit", 12.0);
    rig.harness.get_by_label_contains(stale);
    rig.harness
        .get_by_label("Lay the passes anew")
        .click_accesskit();
    rig.settle();
    assert!(rig.harness.query_by_label_contains(stale).is_none());
}

#[test]
fn a_way_point_added_to_a_corridor_stays_when_its_altitude_is_set() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 0.0), (0.0, 300.0)]);
    command(&mut rig, "fly a corridor along the route");
    let count = way_points(&rig, 1);
    rig.key(Key::I);
    rig.settle();
    assert_eq!(way_points(&rig, 1), count + 1);
    assert_eq!(rig.state()["plan"]["routes"][1]["pattern"], false);
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", 90.0);
    assert_eq!(way_points(&rig, 1), count + 1);
}
