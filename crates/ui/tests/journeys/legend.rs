use egui_kittest::kittest::Queryable as _;

use super::log::rig_with_a_log;
use super::support::rig;

#[test]
fn the_legend_is_a_chip_until_it_is_opened() {
    let mut rig = rig();
    let chip = rig.harness.get_by_label("Legend").rect();
    assert!(chip.width() < 100.0 && chip.height() <= 32.0, "{chip:?}");
    assert!(rig.harness.query_by_label("True track").is_none());
    rig.harness.get_by_label("Legend").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label("True track").is_some());
}

#[test]
fn a_recorded_track_is_not_called_true() {
    let mut rig = rig_with_a_log();
    rig.harness.get_by_label("Legend").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label("Recorded track").is_some());
    assert!(rig.harness.query_by_label("True track").is_none());
    assert!(rig.harness.query_by_label_contains("True error").is_none());
}
