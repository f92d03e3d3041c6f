use egui::accesskit::{Role, Toggled};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{By, NodeT as _, Queryable as _};

use super::support::{Rig, rig};

/// Every widget that can be used has a name.
fn everything_is_named(rig: &Rig, place: &str) {
    let nameless: Vec<String> = rig
        .harness
        .root()
        .query_all(By::new().predicate(|node| {
            matches!(
                node.role(),
                Role::Button
                    | Role::CheckBox
                    | Role::RadioButton
                    | Role::Slider
                    | Role::SpinButton
                    | Role::TextInput
                    | Role::ComboBox
                    | Role::Tab
                    | Role::Canvas
            ) && node.label().is_none_or(|l| l.trim().is_empty())
        }))
        .map(|n| format!("{:?} at {:?}", n.accesskit_node().role(), n.rect()))
        .collect();
    assert!(nameless.is_empty(), "{place}: {nameless:#?}");
}

#[test]
fn every_widget_has_a_name_for_screen_readers() {
    let mut rig = rig();
    for tab in ["Match", "Detector", "Filter", "Landmarks"] {
        rig.open_tab(tab);
        everything_is_named(&rig, tab);
    }
    rig.harness.get_by_label("Barn").click();
    rig.settle();
    everything_is_named(&rig, "a selected landmark");
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    everything_is_named(&rig, "settings");
    rig.menu("Open", "Simulate a flight…");
    rig.frames(3);
    everything_is_named(&rig, "the simulation");
    rig.key(Key::Escape);
    rig.key_with(Modifiers::COMMAND, Key::K);
    everything_is_named(&rig, "the palette");
    for workspace in ["Plan", "Learn"] {
        rig.key(Key::Escape);
        rig.open_tab(workspace);
        everything_is_named(&rig, workspace);
    }
}

#[test]
fn every_widget_of_a_plan_has_a_name() {
    let mut rig = rig();
    rig.open_tab("Plan");
    everything_is_named(&rig, "no route");
    rig.key(Key::I);
    rig.key(Key::I);
    everything_is_named(&rig, "a selected way-point");
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Barn: ").click();
    rig.settle();
    everything_is_named(&rig, "a landmark of a plan");
}

#[test]
fn only_buttons_that_stay_pressed_are_told_as_such() {
    let rig = rig();
    let pressed = |name: &str| {
        let button = rig.harness.get_by_role_and_label(Role::Button, name);
        button.accesskit_node().toggled()
    };
    assert_eq!(pressed("Zoom in"), None);
    assert_eq!(pressed("Follow the aircraft"), Some(Toggled::True));
}
