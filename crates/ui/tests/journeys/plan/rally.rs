//! Rally points marked on the map, moved, named, deleted.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use super::super::support::Rig;
use super::{click, draw, planning, screen};

fn points(rig: &Rig) -> Vec<(String, f64, f64)> {
    let state = rig.state();
    let list = state["plan"]["rally"].as_array().cloned();
    let point = |point: serde_json::Value| {
        let number = |name: &str| point[name].as_f64().unwrap_or(f64::NAN).round();
        let name = point["name"].as_str().unwrap_or_default().to_owned();
        (name, number("north"), number("east"))
    };
    list.unwrap_or_default().into_iter().map(point).collect()
}

#[test]
fn a_rally_point_is_marked_by_a_click_and_moved_by_a_drag_and_both_are_undone() {
    let mut rig = planning();
    rig.key_with(Modifiers::SHIFT, Key::I);
    assert_eq!(rig.state()["plan"]["marking"]["purpose"], "Rally");
    click(&mut rig, 90.0, -150.0);
    rig.settle();
    assert_eq!(points(&rig), [("Rally 1".to_owned(), 90.0, -150.0)]);
    assert!(rig.state()["plan"]["marking"].is_null());
    let (from, to) = (screen(&rig, 90.0, -150.0), screen(&rig, 40.0, -90.0));
    rig.drag(from, to);
    rig.settle();
    let (name, north, east) = points(&rig).remove(0);
    assert!(
        (north - 40.0).abs() < 3.0 && (east + 90.0).abs() < 3.0,
        "{name} {north} {east}"
    );
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(points(&rig), [("Rally 1".to_owned(), 90.0, -150.0)]);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(points(&rig), []);
}

#[test]
fn a_rally_point_is_deleted_in_the_column() {
    let mut rig = planning();
    for east in [-100.0, 100.0] {
        rig.key_with(Modifiers::SHIFT, Key::I);
        click(&mut rig, 60.0, east);
        rig.settle();
    }
    assert_eq!(points(&rig).len(), 2);
    rig.harness.get_by_label("Delete Rally 1").click();
    rig.settle();
    assert_eq!(points(&rig), [("Rally 2".to_owned(), 60.0, 100.0)]);
}

#[test]
fn rally_points_are_exported_in_a_file_of_their_own_and_make_an_emergency_page() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    let export = |rig: &mut Rig| {
        rig.harness.get_by_label("Export").click();
        rig.frames(3);
        let name = "Export the rally points as way-points (QGC WPL)";
        let offered = rig
            .harness
            .query_by_label(name)
            .map(|button| button.click());
        rig.settle();
        offered.is_some()
    };
    assert!(!export(&mut rig), "there is none yet");
    rig.key(Key::Escape);
    rig.harness
        .get_by_label("Return to the start at the end")
        .click_accesskit();
    rig.key_with(Modifiers::SHIFT, Key::I);
    click(&mut rig, 90.0, -150.0);
    rig.settle();
    assert!(export(&mut rig));
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    assert!(name.ends_with("-rally.waypoints"), "{name}");
    let text = String::from_utf8(bytes).expect("plain text");
    assert!(text.starts_with("QGC WPL 110\n0\t0\t3\t5100\t"), "{text}");
    rig.key_with(Modifiers::COMMAND, Key::P);
    rig.settle();
    let (_, body) = rig.host().printed.take().expect("a page");
    for words in [
        "return to the start</td><td>270°</td>",
        ">home</text>",
        "<h1>Emergency",
        "Rally 1",
        "<td>1 to 2</td>",
        "<td>2 to home</td><td>Rally 1</td>",
    ] {
        assert!(body.contains(words), "{words}");
    }
}

#[test]
fn a_rally_point_that_undo_brings_back_while_another_is_dragged_is_not_moved_in_its_place() {
    let mut rig = planning();
    for east in [-150.0, 0.0] {
        rig.key_with(Modifiers::SHIFT, Key::I);
        click(&mut rig, 60.0, east);
        rig.settle();
    }
    rig.harness.get_by_label("Delete Rally 1").click();
    rig.settle();
    let (from, to) = (screen(&rig, 60.0, 0.0), screen(&rig, -40.0, 90.0));
    rig.harness.hover_at(from);
    rig.frames(2);
    rig.harness.drag_at(from);
    rig.frames(2);
    rig.harness.hover_at(from.lerp(to, 0.5));
    rig.frames(2);
    assert_ne!(points(&rig)[0].1, 60.0, "it is dragged");
    // Twice in a frame: the drag is one step, and the deletion another.
    for pressed in [true, false, true, false] {
        rig.harness.input_mut().events.push(egui::Event::Key {
            key: Key::Z,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::COMMAND,
        });
    }
    rig.frames(2);
    let undone = points(&rig);
    assert_eq!(undone.len(), 2, "both are there again: {undone:?}");
    rig.harness.hover_at(to);
    rig.frames(2);
    rig.harness.drop_at(to);
    rig.settle();
    assert_eq!(points(&rig), undone);
}
