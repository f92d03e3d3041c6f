use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::plan::{Aim, BudgetOf};
use pilotage_jobs::Job;

use super::super::support::Rig;
use super::{choose, click, draw, draw_area, number, planning, screen, scroll, set};

#[test]
fn a_route_is_found_beside_the_straight_line_accepted_and_undone() {
    let mut rig = planning();
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    assert_eq!(number(&rig, "/find/from/1").round(), -300.0);
    assert_eq!(number(&rig, "/find/to/1").round(), 300.0);
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    let (straight, found) = (
        number(&rig, "/find/shortest/worst"),
        number(&rig, "/find/surest/worst"),
    );
    assert!(found <= straight + 1e-6, "{straight} {found}");
    assert!((number(&rig, "/find/shortest/length") - 600.0).abs() < 12.0);
    assert!(
        number(&rig, "/find/surest/length") <= 1.3 * number(&rig, "/find/shortest/length") + 1.0
    );
    scroll(&mut rig, 2000.0);
    rig.harness.get_by_label("Make it a route").click();
    rig.settle();
    assert_eq!(rig.state()["plan"]["routes"][0]["name"], "Found route");
    rig.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    rig.settle();
    assert_eq!(
        rig.state()["plan"]["routes"].as_array().map(Vec::len),
        Some(0)
    );
}

#[test]
fn both_ends_are_chosen_by_keyboard_in_the_middle_of_the_map() {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::F);
    rig.settle();
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::Canvas, "Map")
        .focus();
    rig.frames(2);
    rig.key(Key::Enter);
    rig.key(Key::ArrowRight);
    rig.key(Key::Enter);
    let (from, to) = (number(&rig, "/find/from/1"), number(&rig, "/find/to/1"));
    assert!(to > from, "{from}, {to}");
}

#[test]
fn a_no_fly_area_is_drawn_flown_around_and_undone() {
    let mut rig = planning();
    draw_area(&mut rig);
    assert_eq!(rig.state()["plan"]["no_fly"][0], 4);
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    assert!(number(&rig, "/find/shortest/way_points") > 2.0);
    assert!(number(&rig, "/find/shortest/length") > 640.0);
    // Dead reckoning in a wind that nobody knows: the line keeps its distance, the aircraft may not.
    let reached = "The 95 % corridor reaches into No-fly area 1 from ";
    let said = rig.harness.query_all_by_label_contains(reached).count();
    assert!((1..=3).contains(&said), "{said}");
    rig.harness.get_by_label("Name of No-fly area 1").click();
    rig.frames(2);
    rig.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    rig.harness.event(egui::Event::Text("Airfield".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.settle();
    let corner = |north, east| screen(&rig, north, east);
    let (from, to) = (corner(120.0, 60.0), corner(160.0, 90.0));
    rig.drag(from, to);
    rig.settle();
    let moved = number(&rig, "/areas/0/corners/2/0");
    assert!((moved - 160.0).abs() < 3.0, "{moved}");
    rig.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    rig.settle();
    let back = number(&rig, "/areas/0/corners/2/0");
    assert!((back - 120.0).abs() < 3.0, "the drag is one step: {back}");
    rig.harness.get_by_label("Delete Airfield").click();
    rig.settle();
    assert_eq!(
        rig.state()["plan"]["no_fly"].as_array().map(Vec::len),
        Some(0)
    );
    rig.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    rig.settle();
    assert_eq!(
        rig.state()["plan"]["no_fly"].as_array().map(Vec::len),
        Some(1)
    );
}

#[test]
fn the_mean_may_be_kept_small_and_the_budget_may_be_of_length() {
    let mut rig = planning();
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    rig.harness.get_by_label("the mean").click();
    rig.harness.get_by_label("length").click();
    rig.settle();
    set(&mut rig, "Budget over the shortest route", 10.0);
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    let asked = rig.host().jobs.iter().rev().find_map(|(_, job)| match job {
        Job::Find(order) => Some((order.aim, order.budget_of, order.budget)),
        _ => None,
    });
    let (aim, of, budget) = asked.expect("a search");
    assert_eq!((aim, of), (Aim::Mean, BudgetOf::Length));
    assert!((budget - 1.1).abs() < 1e-9);
    let of = |which: &str| number(&rig, &format!("/find/{which}"));
    assert!(of("surest/length") <= 1.1 * of("shortest/length") + 1.0);
    assert!(of("surest/mean") <= of("shortest/mean") + 1e-6);
}

#[test]
fn a_click_on_the_last_corner_again_as_the_first_of_a_double_one_adds_no_corner() {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::A);
    rig.settle();
    let corners = [(-40.0, -40.0), (40.0, -40.0), (40.0, 40.0), (-40.0, 40.0)];
    for (north, east) in corners {
        click(&mut rig, north, east);
    }
    click(&mut rig, -40.0, 40.0);
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(rig.state()["plan"]["no_fly"][0], 4);
}

/// The plan with a route found from west to east while `height` metres above ground are planned, its card in view.
fn found_at(height: f64) -> Rig {
    let mut rig = planning();
    draw(&mut rig, &[(-100.0, -300.0), (-100.0, 300.0)]);
    choose(&mut rig, 1);
    set(&mut rig, "Altitude of the way-point", height);
    rig.key_with(Modifiers::SHIFT, Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    assert!(number(&rig, "/find/surest/length") > 500.0);
    rig
}

/// Begin of the warning that the plan has changed.
const SINCE: &str = "The plan has changed since";

#[test]
fn a_found_route_is_flown_as_high_as_it_was_searched_for() {
    let mut rig = found_at(300.0);
    assert!(rig.harness.query_by_label_contains(SINCE).is_none());
    // Another route is selected, at the usual height.
    draw(&mut rig, &[(-60.0, -300.0), (-60.0, 300.0)]);
    rig.open_tab("Ground");
    rig.settle();
    rig.harness.get_by_label_contains(SINCE);
    rig.harness
        .get_by_label_contains("flown at 300 m above ground");
    rig.harness
        .get_by_label("Make it a route")
        .click_accesskit();
    rig.settle();
    assert_eq!(rig.state()["plan"]["routes"][2]["name"], "Found route");
    for index in 0..2 {
        let at = format!("/routes/2/way_points/{index}/altitude");
        assert_eq!(number(&rig, &at), 300.0);
    }
}

#[test]
fn figures_of_a_found_route_say_when_they_are_of_an_earlier_plan() {
    let mut rig = found_at(150.0);
    set(&mut rig, "Budget over the shortest route", 50.0);
    rig.harness.get_by_label_contains(SINCE);
    set(&mut rig, "Budget over the shortest route", 30.0);
    assert!(rig.harness.query_by_label_contains(SINCE).is_none());
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.key(Key::Delete);
    rig.open_tab("Ground");
    rig.settle();
    rig.harness.get_by_label_contains(SINCE);
}
