use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use serde_json::Value;

use super::super::support::Rig;
use super::{click, planning, screen, type_number};
use pilotage_jobs::DistinctnessOrder;

fn landmarks(rig: &Rig) -> Vec<Value> {
    rig.state()["landmarks"]
        .as_array()
        .cloned()
        .expect("a list")
}

fn outline(rig: &mut Rig) {
    rig.key_with(Modifiers::SHIFT, Key::N);
    for (north, east) in [(-120.0, -120.0), (-120.0, 0.0), (-40.0, -60.0)] {
        click(rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
}

/// Clicks a row of the table of landmarks.
fn row(rig: &mut Rig, name: &str, keys: Modifiers) {
    let label = format!("{name}: ");
    let row = rig
        .harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with(&label)));
    let place = row.rect().center();
    rig.harness.event(egui::Event::PointerMoved(place));
    for pressed in [true, false] {
        rig.harness.event_modifiers(
            egui::Event::PointerButton {
                pos: place,
                button: egui::PointerButton::Primary,
                pressed,
                modifiers: keys,
            },
            keys,
        );
    }
    rig.frames(3);
}

#[test]
fn an_outline_is_drawn_by_clicks_and_its_corner_dragged_in_one_step() {
    let mut rig = planning();
    let before = landmarks(&rig).len();
    outline(&mut rig);
    let drawn = landmarks(&rig);
    assert_eq!(drawn.len(), before + 1);
    let corner = |rig: &Rig| landmarks(rig).last().expect("one")["outline"][2][0].as_f64();
    assert!((corner(&rig).expect("a corner") + 40.0).abs() < 2.0);
    // The field that names it is open.
    rig.key(Key::Enter);
    let (from, to) = (screen(&rig, -40.0, -60.0), screen(&rig, 10.0, -60.0));
    rig.drag(from, to);
    assert!((corner(&rig).expect("a corner") - 10.0).abs() < 3.0);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert!((corner(&rig).expect("a corner") + 40.0).abs() < 2.0);
}

#[test]
fn a_point_is_marked_by_one_click() {
    let mut rig = planning();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness
        .event(egui::Event::Text("landmark as a point".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    click(&mut rig, -140.0, 30.0);
    let list = landmarks(&rig);
    let last = list.last().expect("one");
    assert_eq!(last["point"], true);
    assert!((last["reference"][0].as_f64().expect("north") + 140.0).abs() < 2.0);
}

#[test]
fn several_landmarks_get_one_category_and_are_deleted_in_one_step_each() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    row(&mut rig, "Barn", Modifiers::NONE);
    row(&mut rig, "Pool", Modifiers::SHIFT);
    assert_eq!(
        rig.state()["plan"]["marked"].as_array().map(Vec::len),
        Some(3)
    );
    row(&mut rig, "Chapel", Modifiers::COMMAND);
    assert_eq!(
        rig.state()["plan"]["marked"].as_array().map(Vec::len),
        Some(2)
    );
    rig.harness.get_by_label("Category").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("old".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    let categories: Vec<String> = landmarks(&rig)
        .iter()
        .map(|l| format!("{} {}", l["name"], l["category"]))
        .collect();
    assert_eq!(
        categories,
        [
            "\"Barn\" \"old\"",
            "\"Chapel\" \"\"",
            "\"Pool\" \"old\"",
            "\"Mill\" \"\""
        ]
    );
    rig.harness.get_by_label("Delete").click();
    rig.frames(3);
    assert_eq!(landmarks(&rig).len(), 2);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig).len(), 4);
    assert_eq!(landmarks(&rig)[0]["category"], "old");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig)[0]["category"], "");
}

#[test]
fn the_table_shows_what_fits_the_filter() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Filter the landmarks").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("o".into()));
    rig.frames(3);
    let rows = rig
        .harness
        .query_all_by(|n| n.label().is_some_and(|l| l.ends_with(" metres")));
    assert_eq!(rows.count(), 1, "of the four only Pool has an o");
}

#[test]
fn notes_of_the_selected_landmark_are_kept() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    row(&mut rig, "Mill", Modifiers::NONE);
    rig.harness.get_by_label("Notes on the landmark").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("red roof".into()));
    rig.frames(2);
    rig.key(Key::Tab);
    rig.frames(2);
    assert_eq!(landmarks(&rig)[3]["notes"], "red roof");
}

fn rows(rig: &Rig) -> Vec<String> {
    let rows = rig
        .harness
        .query_all_by(|n| n.label().is_some_and(|l| l.ends_with(" metres")));
    let name = |label: String| label.split(':').next().unwrap_or_default().to_owned();
    let mut rows: Vec<(f32, String)> = rows
        .filter_map(|n| Some((n.rect().top(), name(n.accesskit_node().label()?))))
        .collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.into_iter().map(|r| r.1).collect()
}

#[test]
fn the_table_is_sorted_by_a_click_on_its_head_the_other_way_by_a_second_and_not_by_a_third() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    let given = rows(&rig);
    let mut sorted = given.clone();
    sorted.sort();
    assert_ne!(given, sorted, "the test needs another order");
    let mut click = || {
        rig.harness.get_by_label("Sort by landmark").click();
        rig.frames(3);
        rows(&rig)
    };
    assert_eq!(click(), sorted);
    sorted.reverse();
    assert_eq!(click(), sorted);
    assert_eq!(click(), given);
}

#[test]
fn height_direction_and_reference_point_of_a_landmark_are_set_and_each_is_one_step() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    row(&mut rig, "Mill", Modifiers::NONE);
    let before = landmarks(&rig)[3].clone();
    type_number(&mut rig, "Height of the reference point", "12");
    assert_eq!(landmarks(&rig)[3]["height"], 12.0);
    let direction = "Direction of the landmark, degrees from north";
    type_number(&mut rig, direction, "90");
    let turned = landmarks(&rig)[3]["orientation"].as_f64();
    assert!((turned.expect("a direction") - 90.0).abs() < 1e-9);
    let set = "Set the reference point on the map";
    rig.harness.get_by_label(set).scroll_to_me();
    rig.frames(4);
    rig.harness.get_by_label(set).click();
    rig.frames(3);
    let middle = |i: usize| before["reference"][i].as_f64().expect("metres");
    click(&mut rig, middle(0) + 6.0, middle(1) - 4.0);
    let moved = |rig: &Rig| landmarks(rig)[3]["reference"][0].as_f64().expect("metres");
    assert!((moved(&rig) - middle(0) - 6.0).abs() < 1.0);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(moved(&rig), middle(0));
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert!(landmarks(&rig)[3]["orientation"].is_null());
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig)[3], before);
}

#[test]
fn all_are_marked_and_duplicated_in_one_step() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Mark all").click();
    rig.frames(3);
    let marked = |rig: &Rig| rig.state()["plan"]["marked"].as_array().map(Vec::len);
    assert_eq!(marked(&rig), Some(4));
    rig.key_with(Modifiers::COMMAND, Key::D);
    let list = landmarks(&rig);
    assert_eq!(list.len(), 8);
    assert_eq!(list[4]["name"], "Barn, copy");
    assert_eq!(marked(&rig), Some(4), "the copies are marked");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(landmarks(&rig).len(), 4);
}

#[test]
fn the_look_alike_is_told_with_its_margin_and_marked_on_the_map() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    row(&mut rig, "Mill", Modifiers::NONE);
    rig.settle();
    rig.harness.get_by_label("margin 0.44");
    rig.harness
        .get_by_label("look-alike 0.41, refused from 0.85");
    let shapes = &rig.harness.output().shapes;
    let mut words = shapes.iter().filter_map(|s| match &s.shape {
        egui::Shape::Text(text) => Some(text.galley.text()),
        _ => None,
    });
    assert!(words.any(|w| w == "look-alike 0.41, refused from 0.85"));
    // As far around as the detector comes to look for it.
    let radius = |rig: &Rig| {
        let jobs = rig.harness.state().host.jobs.iter().rev();
        let mut asked = jobs.filter_map(|(_, job)| match job {
            pilotage_jobs::Job::Distinctness(DistinctnessOrder { radius, .. }) => Some(*radius),
            _ => None,
        });
        asked.next().expect("a question")
    };
    let usual = radius(&rig);
    rig.open_tab("Ground");
    type_number(&mut rig, "Uncertainty of the position", "30");
    rig.settle();
    assert!(
        usual < 60.0 && radius(&rig) > 100.0,
        "{usual} {}",
        radius(&rig)
    );
}

#[test]
fn backspace_takes_a_corner_back_and_leaves_the_selected_landmark() {
    for key in [Key::Backspace, Key::Delete] {
        let mut rig = planning();
        rig.key_with(Modifiers::SHIFT, Key::N);
        for (north, east) in [(-120.0, -120.0), (-120.0, 0.0)] {
            click(&mut rig, north, east);
        }
        let before = landmarks(&rig);
        rig.open_tab("Landmarks");
        row(&mut rig, "Barn", Modifiers::NONE);
        rig.settle();
        let state = rig.state();
        assert_eq!(state["plan"]["marking"]["corners"], 2);
        assert!(!state["selection"].is_null());
        rig.key(key);
        rig.settle();
        assert_eq!(rig.state()["plan"]["marking"]["corners"], 1);
        assert_eq!(landmarks(&rig).len(), before.len());
    }
}
