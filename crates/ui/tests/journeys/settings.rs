use egui_kittest::kittest::Queryable as _;
use pilotage_core::landmark::TemplateFeatures;
use pilotage_core::navigator::NavigatorSettings;
use pilotage_jobs::{FlyOrder, Job};

use super::support::{Rig, rig};

/// The settings of the last flight.
fn flown_with(rig: &mut Rig) -> NavigatorSettings {
    let Some((
        _,
        Job::Fly(FlyOrder {
            mission: Some(mission),
            ..
        }),
    )) = rig.host().last_flight().cloned()
    else {
        panic!("no mission was flown");
    };
    mission.navigator
}

/// The page with its filter settings open, laying whole pictures on the map.
fn laying() -> Rig {
    let mut rig = rig();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    rig.harness
        .get_by_label("Lay whole pictures on the map")
        .click();
    rig.frames(2);
    rig.settle();
    rig
}

#[test]
fn a_changed_setting_flies_again_and_undo_takes_it_back() {
    let mut rig = rig();
    let before = rig.host().flights();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    rig.harness
        .get_by_label("Draw the points anew after the process noise")
        .click();
    rig.frames(2);
    rig.settle();
    assert_eq!(rig.host().flights(), before + 1);
    let flown = flown_with(&mut rig);
    assert!(!flown.redraw);
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    rig.settle();
    let flown = flown_with(&mut rig);
    assert!(flown.redraw);
}

#[test]
fn opening_the_settings_changes_nothing() {
    let mut rig = rig();
    let before = rig.host().flights();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    rig.settle();
    assert_eq!(rig.host().flights(), before);
    assert_eq!(rig.state()["undo"], 0);
}

#[test]
fn another_estimator_is_chosen_and_flown_with() {
    let mut rig = rig();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    rig.harness.get_by_label("Estimator").click();
    rig.frames(3);
    rig.harness.get_by_label("Extended Kalman filter").click();
    rig.frames(2);
    rig.settle();
    let flown = flown_with(&mut rig);
    let chosen = flown.estimator.choice;
    assert_eq!(chosen.label(), "Extended Kalman filter");
}

#[test]
fn whole_pictures_are_laid_on_the_map_when_that_is_wanted() {
    let mut rig = laying();
    assert!(flown_with(&mut rig).whole_frames.unwrap().may_be_turned);
    rig.harness
        .get_by_label("Pictures may be stored turned by quarter turns")
        .click();
    rig.frames(2);
    rig.settle();
    assert!(!flown_with(&mut rig).whole_frames.unwrap().may_be_turned);
}

#[test]
fn how_far_pictures_are_searched_and_the_map_is_off_is_set_undone_and_kept() {
    let mut rig = laying();
    assert_eq!(flown_with(&mut rig).whole_frames.unwrap().farthest, None);
    rig.harness
        .get_by_label("Search no farther than a limit")
        .click();
    rig.frames(2);
    rig.settle();
    let flown = flown_with(&mut rig).whole_frames.unwrap();
    assert_eq!(flown.farthest, Some(100.0));
    for (name, text) in [
        ("Position, to each side", "40"),
        ("Heading, to each side", "15"),
        ("Height, up and down", "20"),
        ("Map is good to, σ", "3"),
    ] {
        type_number(&mut rig, name, text);
    }
    rig.settle();
    let flown = flown_with(&mut rig).whole_frames.unwrap();
    assert!((flown.farthest.unwrap() - 40.0).abs() < 1e-9, "{flown:?}");
    assert!((flown.heading_limit().to_degrees() - 15.0).abs() < 1e-9);
    assert!((flown.height_limit() - 0.2).abs() < 1e-9);
    assert!((flown.map_deviation - 3.0).abs() < 1e-9);
    // A mission keeps them.
    let settings = flown_with(&mut rig);
    let text = serde_json::to_string(&settings).unwrap();
    let read: NavigatorSettings = serde_json::from_str(&text).unwrap();
    assert_eq!(read, settings);
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    rig.settle();
    let flown = flown_with(&mut rig).whole_frames.unwrap();
    assert_eq!(flown.map_deviation, 0.0);
}

/// Types a number into the field beside the slider of this name.
fn type_number(rig: &mut Rig, name: &str, text: &str) {
    let role = egui::accesskit::Role::SpinButton;
    rig.harness.get_by_role_and_label(role, name).click();
    rig.frames(2);
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::A);
    rig.harness.event(egui::Event::Text(text.to_owned()));
    rig.frames(1);
    rig.key(egui::Key::Enter);
    rig.frames(3);
}

#[test]
fn landmarks_on_a_map_of_another_date_are_looked_for_by_edges() {
    let mut rig = rig();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    rig.harness
        .get_by_label("Landmarks are recognised by")
        .click();
    rig.frames(3);
    rig.harness
        .get_by_label("Edges: the map is of another date")
        .click();
    rig.frames(3);
    rig.settle();
    let detector = flown_with(&mut rig).detector;
    assert_eq!(detector.features, TemplateFeatures::Orientation);
    assert_eq!(detector.map_deviation, 3.0);
}

#[test]
fn escape_closes_the_settings_once_nothing_else_is_left_by_it() {
    let mut rig = rig();
    let is_open = |rig: &Rig| rig.state()["dialogs"]["settings"] == true;
    for workspace in ["Replay", "Plan"] {
        rig.open_tab(workspace);
        rig.harness.get_by_label("Filter settings").click();
        rig.frames(3);
        assert!(is_open(&rig), "{workspace}");
        rig.key_with(egui::Modifiers::COMMAND, egui::Key::K);
        rig.key(egui::Key::Escape);
        assert!(is_open(&rig), "{workspace}: the palette is closed first");
        rig.key(egui::Key::Escape);
        assert!(!is_open(&rig), "{workspace}");
    }
}
