use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::exchange::labels::read_labels;
use pilotage_jobs::Job;
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::support::{Rig, rig};

/// The app with the pictures of its flight open for labelling, at the first of them.
fn labelling() -> Rig {
    let mut rig = rig();
    rig.frames(6);
    rig.settle();
    rig.key(Key::Home);
    rig.key(Key::ArrowRight);
    rig.key(Key::K);
    rig.frames(3);
    rig
}

/// A place in the picture, by parts of its width and height.
fn place(rig: &Rig, x: f32, y: f32) -> Pos2 {
    let rect = rig.rect("/labelling/picture");
    rect.min + rect.size() * egui::vec2(x, y)
}

fn drag(rig: &mut Rig, from: (f32, f32), to: (f32, f32)) {
    let (from, to) = (place(rig, from.0, from.1), place(rig, to.0, to.1));
    rig.drag(from, to);
    rig.frames(2);
}

fn boxes(rig: &Rig) -> Vec<Value> {
    let state = rig.state();
    let frames = state["labels"].as_array().cloned().unwrap_or_default();
    let boxes = frames.iter().filter_map(|f| f["boxes"].as_array());
    boxes.flatten().cloned().collect()
}

#[test]
fn a_box_is_drawn_moved_sized_deleted_and_taken_back_one_step_each() {
    let mut rig = labelling();
    drag(&mut rig, (0.3, 0.3), (0.5, 0.6));
    let drawn = boxes(&rig);
    assert_eq!(drawn.len(), 1, "{}", rig.state()["labels"]);
    drag(&mut rig, (0.4, 0.45), (0.5, 0.45));
    let moved = boxes(&rig);
    let width = |b: &Value| b[2][0].as_f64().unwrap() - b[1][0].as_f64().unwrap();
    assert!(moved[0][1][0].as_f64() > drawn[0][1][0].as_f64());
    assert!(
        (width(&moved[0]) - width(&drawn[0])).abs() < 0.02,
        "{moved:?}"
    );
    drag(&mut rig, (0.6, 0.45), (0.8, 0.45));
    let sized = boxes(&rig);
    assert!(width(&sized[0]) > 1.5 * width(&moved[0]), "{sized:?}");
    assert_eq!(sized[0][1], moved[0][1], "the left edge stays");
    rig.key(Key::Delete);
    assert!(boxes(&rig).is_empty());
    for before in [sized, moved, drawn, Vec::new()] {
        rig.key_with(Modifiers::COMMAND, Key::Z);
        assert_eq!(boxes(&rig), before);
    }
}

#[test]
fn a_proposal_is_taken_with_enter_and_a_landmark_marked_as_not_there() {
    let mut rig = labelling();
    // To where the first landmark is in the picture.
    rig.key_times(Key::ArrowRight, 15);
    rig.frames(3);
    rig.key(Key::Q);
    rig.frames(2);
    let proposal = rig.state()["labelling"]["proposal"].clone();
    assert!(proposal.is_array(), "{proposal}");
    rig.key(Key::Enter);
    assert_eq!(boxes(&rig)[0][1], proposal[0], "the proposal is the label");
    rig.key(Key::O);
    let state = rig.state();
    assert!(boxes(&rig).is_empty());
    assert_eq!(
        state["labels"][0]["absent"].as_array().map(Vec::len),
        Some(1)
    );
}

#[test]
fn labels_are_saved_as_coco_and_added_again_from_that_file() {
    let mut rig = labelling();
    drag(&mut rig, (0.3, 0.3), (0.5, 0.6));
    let before = boxes(&rig);
    rig.harness.get_by_label("Save COCO").click();
    rig.frames(4);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    assert!(name.ends_with("labels-coco.json"), "{name}");
    assert_eq!(read_labels(&name, &bytes).unwrap().frames.len(), 1);
    rig.key(Key::Delete);
    assert!(boxes(&rig).is_empty());
    rig.host().really_open = true;
    rig.host().opened.push(vec![OpenedFile {
        path: name,
        content: bytes.into(),
    }]);
    rig.frames(6);
    assert_eq!(boxes(&rig), before);
}

#[test]
fn a_training_learns_from_labelled_frames_as_well() {
    let mut rig = labelling();
    drag(&mut rig, (0.3, 0.3), (0.5, 0.6));
    let label = boxes(&rig).remove(0);
    rig.key(Key::Escape);
    rig.open_tab("Plan");
    rig.settle();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Train all").click();
    rig.settle();
    let jobs = rig.host().jobs.iter();
    let orders: Vec<_> = jobs
        .filter_map(|(_, job)| match job {
            Job::Train(order) => Some(order.as_ref().clone()),
            _ => None,
        })
        .collect();
    assert_eq!(orders.len(), 2);
    for order in orders {
        let is_labelled = label[0] == order.landmark.name;
        let labels = order.labelled.map_or(0, |frames| frames.labels.len());
        assert_eq!(labels, usize::from(is_labelled), "{}", order.landmark.name);
    }
}

#[test]
fn escape_and_the_tab_of_replay_lead_back_to_the_flight() {
    let mut rig = labelling();
    assert!(rig.state()["labelling"].is_object());
    rig.key(Key::Escape);
    assert!(rig.state()["labelling"].is_null());
    rig.key(Key::K);
    rig.frames(3);
    assert!(rig.state()["labelling"].is_object());
    // From another workspace one comes back to the labels.
    rig.open_tab("Plan");
    rig.open_tab("Replay");
    assert!(rig.state()["labelling"].is_object());
    rig.open_tab("Replay");
    assert!(rig.state()["labelling"].is_null());
}
