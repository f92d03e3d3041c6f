use egui::Key;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::support::{Rig, rig};

const NEXT: [&str; 3] = ["Take the tour", "Rehearse route", "Cut GPS"];

fn next(rig: &Rig) -> Vec<&str> {
    let is_there = |label: &&str| rig.harness.query_by_label(label).is_some();
    NEXT.into_iter().filter(is_there).collect()
}

#[test]
fn each_workspace_has_its_own_next_step() {
    let mut rig = rig();
    assert_eq!(next(&rig), ["Take the tour"]);
    rig.open_tab("Plan");
    assert_eq!(next(&rig), Vec::<&str>::new(), "nothing to rehearse");
    rig.key(Key::I);
    rig.key(Key::I);
    assert_eq!(next(&rig), ["Rehearse route"]);
    rig.open_tab("Learn");
    assert_eq!(next(&rig), Vec::<&str>::new());
}

#[test]
fn a_menu_is_opened_walked_and_left_by_keyboard() {
    let mut rig = rig();
    let item = "Simulate a flight…";
    rig.harness.get_by_label("Open").focus();
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(2);
    assert!(rig.harness.query_by_label(item).is_some());
    rig.key(Key::Escape);
    rig.frames(2);
    assert!(rig.harness.query_by_label(item).is_none());
    rig.harness.get_by_label("Open").focus();
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(2);
    rig.harness.get_by_label(item).focus();
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(2);
    assert_eq!(rig.state()["simulate"]["open"], true);
}

#[test]
fn what_cannot_be_saved_now_says_in_the_menu_what_is_missing() {
    let lacks = [
        "Print the mission brief (No route to print)",
        "Export the route as … (No route to export)",
        "Export the rally points as way-points (QGC WPL) (No rally points to export)",
    ];
    let shown = |rig: &mut Rig| {
        rig.harness.get_by_label("Save").click();
        rig.frames(3);
        let shown = lacks.map(|label| rig.harness.query_by_label(label).is_some());
        rig.key(Key::Escape);
        rig.frames(2);
        shown
    };
    let mut rig = rig();
    assert_eq!(shown(&mut rig), [true; 3]);
    rig.open_tab("Plan");
    rig.key(Key::I);
    rig.key(Key::I);
    assert_eq!(shown(&mut rig), [false, false, true]);
}

#[test]
fn tab_goes_through_the_bar_as_it_is_read() {
    let mut rig = rig();
    let order = ["Take the tour", "Open", "Save", "Filter settings", "View"];
    rig.harness.get_by_label(order[0]).focus();
    rig.frames(2);
    for pair in order.windows(2) {
        let left = |label: &str| rig.harness.get_by_label(label).rect().left();
        assert!(left(pair[0]) < left(pair[1]), "{pair:?}");
        rig.key(Key::Tab);
        assert!(
            rig.harness
                .get_by_label(pair[1])
                .accesskit_node()
                .is_focused(),
            "{pair:?}"
        );
    }
}
