use egui_kittest::kittest::Queryable as _;
use pilotage_core::navigator::NavigatorSettings;
use pilotage_ui::jobs::Job;

use super::support::{Rig, rig};

/// The settings of the last flight.
fn flown_with(rig: &mut Rig) -> NavigatorSettings {
    let Some((
        _,
        Job::Fly {
            mission: Some(mission),
            ..
        },
    )) = rig.host().last_flight().cloned()
    else {
        panic!("no mission was flown");
    };
    mission.navigator
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
    let mut rig = rig();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    rig.harness
        .get_by_label("Lay whole pictures on the map")
        .click();
    rig.frames(2);
    rig.settle();
    assert!(flown_with(&mut rig).whole_frames.unwrap().may_be_turned);
    rig.harness
        .get_by_label("Pictures may be stored turned by quarter turns")
        .click();
    rig.frames(2);
    rig.settle();
    assert!(!flown_with(&mut rig).whole_frames.unwrap().may_be_turned);
}
