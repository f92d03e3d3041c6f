use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::super::fixture::{Fixture, sighting};
use super::super::shown::{Shown, shown};
use super::*;

fn harness(time: f64) -> Harness<'static, Shown<CameraView>> {
    shown(
        [420.0, 320.0],
        time,
        |view: &mut CameraView, ui, context| {
            context.pictures = &|index| Some(index);
            view.show(ui, context);
        },
    )
}

/// A time whose frame shows a landmark that was used, with that landmark's id.
fn telling_time(fixture: &Fixture) -> (f64, u32) {
    fixture
        .run
        .steps
        .iter()
        .find_map(|s| {
            let frame = s.frame.as_ref()?;
            let candidate = frame.accepted().next()?;
            Some((s.time, candidate.landmark))
        })
        .expect("the fixture sees a landmark in its first seconds")
}

#[test]
fn a_thing_that_an_aid_saw_says_under_the_pointer_what_became_of_it() {
    let (time, _) = telling_time(&Fixture::lasting(20.0));
    let mut harness = harness(time);
    {
        let run = &mut harness.state_mut().fixture.run;
        let step = run.steps.iter_mut().find(|step| step.time == time).unwrap();
        step.frame.as_mut().unwrap().candidates.clear();
        step.sightings = vec![sighting()];
    }
    harness.run();
    let view = harness.get_by_label_contains("1 of 4 things paired with the map");
    let tree = harness
        .state()
        .view
        .placement(view.rect(), vec2(640.0, 480.0))
        .at(&sighting().seen[1].pixel);
    harness.hover_at(tree);
    harness.run();
    harness.get_by_label_contains("Tree, 6.00 m across: not used");
}

#[test]
fn a_click_on_a_found_landmark_selects_it() {
    let (time, landmark) = telling_time(&Fixture::lasting(20.0));
    let mut harness = harness(time);
    harness.run();
    let rect = harness.get_by_label_contains("Camera picture").rect();
    let (place, pixel) = {
        let state = harness.state();
        let step = state.fixture.run.frame_step_at(time).unwrap();
        let frame = step.frame.as_ref().unwrap();
        let candidate = frame.accepted().next().unwrap();
        let size = vec2(640.0, 480.0);
        (
            state.view.placement(rect, size),
            candidate.measured_pixel.unwrap(),
        )
    };
    let at = place.at(&pixel);
    harness.hover_at(at);
    harness.run();
    harness.drag_at(at);
    harness.drop_at(at);
    harness.run();
    assert!(
        harness
            .state()
            .commands
            .contains(&Command::SelectLandmark(Some(landmark)))
    );
}

#[test]
fn before_the_first_frame_the_view_says_so() {
    let mut harness = harness(0.0);
    harness.run();
    harness.get_by_label("No picture yet");
}

#[test]
fn a_flight_without_a_camera_promises_no_picture() {
    let mut harness = harness(5.0);
    harness.state_mut().fixture.flight.frames.clear();
    harness.run();
    harness.get_by_label("No pictures");
}

#[test]
fn a_frame_with_a_used_landmark_is_described_by_its_name() {
    let (time, _) = telling_time(&Fixture::lasting(20.0));
    let mut harness = harness(time);
    harness.run();
    harness.get_by_label_contains("Church used");
}

#[test]
fn a_frame_whose_place_as_a_whole_was_used_is_not_called_unused() {
    let (time, _) = telling_time(&Fixture::lasting(20.0));
    let mut harness = harness(time);
    for step in &mut harness.state_mut().fixture.run.steps {
        if let Some(frame) = &mut step.frame {
            frame.candidates.clear();
        }
    }
    harness.run();
    harness.get_by_label_contains("used as a whole");
}
