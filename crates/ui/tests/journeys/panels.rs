use egui::{Key, pos2};

use super::support::{Rig, ScriptedHost, rig, rig_on};

fn map_width(rig: &Rig) -> f32 {
    rig.rect("/map/rect").width()
}

/// Draws the column's edge to the left.
fn widen_column(rig: &mut Rig) {
    let map = rig.rect("/map/rect");
    let edge = pos2(map.right() + 0.5, map.center().y);
    rig.drag(edge, edge - egui::vec2(100.0, 0.0));
    rig.frames(3);
}

#[test]
fn each_workspace_has_panels_of_its_own_which_come_back_at_the_next_visit() {
    let mut rig = rig();
    let usual = map_width(&rig);
    widen_column(&mut rig);
    let narrow = map_width(&rig);
    assert!(narrow < usual - 80.0, "{narrow} of {usual}");
    rig.open_tab("Plan");
    assert_eq!(map_width(&rig), usual);
    rig.key(Key::V);
    assert!(
        map_width(&rig) > usual + 200.0,
        "the plan is without a column"
    );
    rig.open_tab("Replay");
    assert_eq!(map_width(&rig), narrow);
    rig.settle();
    let stored = rig.host().stored.clone();
    let host = ScriptedHost {
        stored,
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, egui::vec2(1440.0, 900.0));
    assert_eq!(map_width(&rig), narrow, "after a reload");
    rig.open_tab("Plan");
    assert!(map_width(&rig) > usual + 200.0);
    rig.open_tab("Replay");
    rig.key(Key::A);
    assert_eq!(rig.state()["map"]["follow"], false);
    rig.menu("View", "Reset view");
    assert_eq!(map_width(&rig), usual);
    assert_eq!(rig.state()["map"]["follow"], true);
}
