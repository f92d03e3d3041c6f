//! Figures of the plotted fields over the selected time, and the same as a table to be saved.

use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable as _;

use super::log::rig_with_a_log;
use super::support::Rig;

/// Selects the last tenth of the flight: seconds 27.91 to 30.9 of the log, samples 270 to 299.
fn select_the_end(rig: &mut Rig) {
    let track = rig.rect("/timeline");
    let at = |part: f32| Pos2::new(track.left() + part * track.width(), track.center().y);
    rig.drag_with(Modifiers::SHIFT, at(0.9), at(0.999));
    rig.settle();
}

#[test]
fn figures_of_the_selected_time_are_exact_and_follow_it() {
    let mut rig = rig_with_a_log();
    rig.key_with(Modifiers::SHIFT, Key::S);
    rig.settle();
    rig.harness.get_by_label_contains("Shown: 0:00.0 to");
    rig.harness.get_by_label("Samples, Ground speed: 300");
    rig.harness.get_by_label("Samples, Roll: 300, Pitch: 300");
    // Roll goes 0 to 6 and around: 42 whole rounds of 0 to 6, and 0 to 5.
    rig.harness.get_by_label_contains("Mean, Roll: 2.99");
    rig.harness
        .get_by_label_contains("Greatest, Roll: 6, Pitch: 4");
    select_the_end(&mut rig);
    rig.harness.get_by_label_contains("Selected: 0:26.9 to");
    rig.harness.get_by_label("Samples, Roll: 29, Pitch: 29");
    rig.key(Key::Escape);
    rig.settle();
    rig.harness.get_by_label("Samples, Roll: 300, Pitch: 300");
}

#[test]
fn the_selected_time_of_the_plotted_fields_is_saved_with_units_and_every_digit() {
    let mut rig = rig_with_a_log();
    rig.key_with(Modifiers::SHIFT, Key::S);
    rig.settle();
    select_the_end(&mut rig);
    rig.harness
        .get_by_label("Save the plotted fields of this span as CSV")
        .click();
    rig.settle();
    let (name, bytes) = rig.host().saved.last().expect("a file").clone();
    assert_eq!(name, "east-28s-31s.csv");
    let text = String::from_utf8(bytes).expect("text");
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("time [s],GPS height [m],Ground speed [m/s],Roll [deg],Pitch [deg]")
    );
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len(), 29);
    // Sample 280 of the log, as the log has it: in single precision.
    let row = rows.iter().find(|row| row.starts_with("29,"));
    let cells: Result<Vec<f64>, _> = row.expect("second 29").split(',').map(str::parse).collect();
    assert_eq!(
        cells.expect("numbers"),
        [29.0, 780.0, f64::from(20.1_f32), 0.0, 0.0]
    );
}
