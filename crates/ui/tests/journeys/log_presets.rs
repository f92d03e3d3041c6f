//! Arrangements of plots: built-in ones, and own ones that are saved for every log.

use egui::Key;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::log::{panels, rig_with_a_log};
use super::support::Rig;

fn open_presets(rig: &mut Rig) {
    rig.harness.get_by_label("Presets of plots").click();
    rig.frames(4);
}

/// Saves the plots as they are.
fn save(rig: &mut Rig, name: &str) {
    rig.harness.get_by_label("Name of a new preset").focus();
    rig.frames(2);
    rig.harness
        .get_by_label("Name of a new preset")
        .type_text(name);
    rig.frames(2);
    rig.harness
        .get_by_label("Save these plots as a preset")
        .click();
    rig.frames(4);
}

fn click(rig: &mut Rig, label: &str) {
    rig.harness.get_by_label(label).click();
    rig.frames(4);
}

#[test]
fn a_built_in_preset_shows_what_the_log_has_of_it() {
    let mut rig = rig_with_a_log();
    open_presets(&mut rig);
    let vibration = rig.harness.get_by_label("Show preset Vibration");
    assert!(vibration.accesskit_node().is_disabled(), "the log has none");
    click(&mut rig, "Show preset Attitude");
    rig.settle();
    assert_eq!(panels(&rig), [["Roll"], ["Pitch"], ["Heading"]]);
    open_presets(&mut rig);
    click(&mut rig, "Show preset Navigation");
    rig.settle();
    assert_eq!(panels(&rig)[0], ["Latitude"]);
    assert_eq!(rig.state()["log"]["against"][0], "Longitude");
}

#[test]
fn an_own_preset_is_saved_kept_and_shown_again() {
    let mut rig = rig_with_a_log();
    let first = panels(&rig);
    open_presets(&mut rig);
    save(&mut rig, "Mine");
    assert_eq!(rig.state()["log"]["presets"], serde_json::json!(["Mine"]));
    let stored = rig.host().stored.get("plots").cloned();
    let stored = String::from_utf8(stored.expect("stored")).expect("text");
    assert!(stored.contains("\"Mine\""), "{stored}");
    click(&mut rig, "Show preset Attitude");
    assert_ne!(panels(&rig), first);
    open_presets(&mut rig);
    click(&mut rig, "Show preset Mine");
    assert_eq!(panels(&rig), first);
}

#[test]
fn an_own_preset_is_renamed_deleted_and_brought_back() {
    let mut rig = rig_with_a_log();
    open_presets(&mut rig);
    save(&mut rig, "Mine");
    click(&mut rig, "Rename preset Mine");
    rig.key(Key::End);
    rig.harness
        .get_by_label("New name of the preset")
        .type_text(" too");
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(3);
    let names = |rig: &Rig| rig.state()["log"]["presets"].clone();
    assert_eq!(names(&rig), serde_json::json!(["Mine too"]));
    click(&mut rig, "Delete preset Mine too");
    assert_eq!(names(&rig), serde_json::json!([]));
    click(&mut rig, "Take back the last change");
    assert_eq!(names(&rig), serde_json::json!(["Mine too"]));
}
