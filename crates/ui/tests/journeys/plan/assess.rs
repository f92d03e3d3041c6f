use egui::Vec2;
use egui_kittest::kittest::Queryable as _;
use pilotage_core::plan::{DetectionStatistics, UntestedDetection};
use pilotage_jobs::{InlineWorkers, Job, JobEvent};

use super::super::support::{Ahead, ScriptedHost, rig_on};
use super::{choose, draw, number, planning, set};

#[test]
fn a_measured_landmark_is_believed_instead_of_the_assumption() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.settle();
    rig.harness.get_by_label_contains(
        "landmarks is tested. Each counts like a box at random on fields, found in 18 % of pictures",
    );
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.harness
        .get_by_label("Test how well it is found")
        .click();
    rig.settle();
    assert_eq!(number(&rig, "/measured/0/id"), 2.0);
    assert!((number(&rig, "/measured/0/probability") - 0.45).abs() < 1e-9);
    rig.harness.get_by_label("weak");
    rig.harness.get_by_label("found in 45 % of pictures");
    rig.harness.get_by_label("wrong 3 %");
    rig.harness
        .get_by_label("place ±0.20 m towards 0°, ±0.20 m across");
    for strip in [
        "Found by heading: N 4 of 8, E 4 of 8, S 4 of 8, W 4 of 8",
        "Found by tilt error: under 0.3° 5 of 10, to 0.6° 5 of 10, over that 0 of 0",
        "Found by day: 1 4 of 8, 2 4 of 8, 3 4 of 8, 4 4 of 8",
    ] {
        rig.harness.get_by_label(strip);
    }
}

#[test]
fn a_landmark_is_looked_at_from_other_heights_and_with_other_tilts() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.harness.get_by_label("Best altitude").click();
    rig.settle();
    assert_eq!(number(&rig, "/envelopes/0/id"), 2.0);
    assert_eq!(number(&rig, "/envelopes/0/looks"), 12.0);
    rig.harness
        .get_by_label("Detection envelope: 2 heights by 2 tilts, 12 looks");
    // Another box is another landmark.
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::D);
    rig.settle();
    assert!(
        rig.harness
            .query_by_label_contains("Detection envelope")
            .is_none()
    );
}

#[test]
fn what_was_measured_is_there_after_a_reload() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    let measure = "Test how well it is found";
    rig.harness.get_by_label(measure).click();
    rig.settle();
    rig.harness.get_by_label("Best altitude").click();
    rig.settle();
    let host = ScriptedHost {
        stored: rig.host().stored.clone(),
        ..ScriptedHost::default()
    };
    let mut again = rig_on(host, Vec2::new(1440.0, 900.0));
    again.open_tab("Plan");
    again.settle();
    assert_eq!(number(&again, "/measured/0/id"), 2.0);
    assert_eq!(number(&again, "/envelopes/0/looks"), 12.0);
    let asked = again.host().jobs.iter();
    let measuring = asked.filter(|(_, job)| matches!(job, Job::Assess(_) | Job::Envelope(_)));
    assert_eq!(measuring.count(), 0, "it was measured anew");
}

#[test]
fn all_landmarks_are_measured_one_after_the_other() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Test all").click();
    for _ in 0..4 {
        rig.settle();
    }
    let measured = rig.state()["plan"]["measured"].as_array().map(Vec::len);
    assert_eq!(measured, Some(4));
}

#[test]
fn landmarks_for_which_something_else_is_often_taken_are_named_beside_the_prediction() {
    for (wrong, is_told) in [(1.0 / 32.0, false), (0.4, true)] {
        let mut rig = planning();
        rig.host().wrong = Some(wrong);
        draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
        rig.open_tab("Landmarks");
        rig.harness.get_by_label("Test all").click();
        for _ in 0..4 {
            rig.settle();
        }
        rig.open_tab("Route");
        rig.settle();
        let told = rig
            .harness
            .query_by_label_contains("Something else is often taken for");
        assert_eq!(told.is_some(), is_told, "{wrong}");
        rig.key_with(egui::Modifiers::COMMAND, egui::Key::P);
        rig.settle();
        let (_, brief) = rig.host().printed.take().expect("a brief");
        let warns = brief.contains("class=\"warning\">Something else is often taken for");
        assert_eq!(warns, is_told, "{wrong}");
    }
}

#[test]
fn a_landmark_that_is_drawn_is_measured_by_itself_once_it_rests() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    let measured = |rig: &super::Rig| rig.state()["plan"]["measured"].as_array().map(Vec::len);
    assert_eq!(
        measured(&rig),
        Some(0),
        "what was there is measured when people ask"
    );
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::D);
    assert_eq!(measured(&rig), Some(0));
    rig.settle();
    assert_eq!(measured(&rig), Some(1));
    let asked = rig
        .host()
        .jobs
        .iter()
        .filter(|(_, job)| matches!(job, Job::Assess(_)));
    assert_eq!(asked.count(), 1);
}

/// The Plan workspace over a host whose workers have time.
fn with_time() -> super::Rig {
    let host = ScriptedHost {
        ahead: Ahead::Done,
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, Vec2::new(1440.0, 900.0));
    rig.open_tab("Plan");
    rig
}

/// Ids of the landmarks that were measured though nobody asked, in their order.
fn measured_ahead(rig: &mut super::Rig) -> Vec<u32> {
    let ahead = rig.host().jobs.iter().filter_map(|(_, job)| match job {
        Job::AssessAhead(order) => Some(order.0.landmark.id),
        _ => None,
    });
    ahead.collect()
}

#[test]
fn while_workers_have_time_the_selected_landmark_is_tested_first_and_then_all_others() {
    let mut rig = rig_on(ScriptedHost::default(), Vec2::new(1440.0, 900.0));
    rig.open_tab("Plan");
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    assert_eq!(rig.state()["plan"]["untested"][1], 0);
    assert_eq!(measured_ahead(&mut rig), [0; 0]);
    let selected = rig.state()["selection"].as_u64().expect("one is selected") as u32;
    rig.harness.state_mut().host.ahead = Ahead::Done;
    for _ in 0..8 {
        rig.settle();
    }
    let ahead = measured_ahead(&mut rig);
    assert_eq!(ahead.first(), Some(&selected));
    assert!(ahead.len() >= 3, "{ahead:?}");
    let mut once = ahead.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ahead.len(), "one was tested twice");
    assert!(rig.harness.query_by_label_contains("Not tested").is_none());
}

#[test]
fn a_box_at_random_stands_for_what_is_not_tested() {
    let mut rig = with_time();
    for _ in 0..8 {
        rig.settle();
    }
    let asked = rig.host().jobs.iter();
    let asked = asked.filter(|(_, job)| matches!(job, Job::Untested(_)));
    assert_eq!(asked.count(), 1, "the map is asked once");
    assert!((number(&rig, "/untested/0") - 0.25).abs() < 1e-9);
}

#[test]
fn testing_ahead_ends_where_people_switch_it_off() {
    let mut rig = rig_on(ScriptedHost::default(), Vec2::new(1440.0, 900.0));
    rig.open_tab("Plan");
    rig.open_tab("Landmarks");
    rig.harness
        .get_by_label("Test landmarks automatically")
        .click();
    rig.settle();
    rig.harness.state_mut().host.ahead = Ahead::Done;
    rig.settle();
    assert_eq!(measured_ahead(&mut rig), [0; 0]);
    rig.harness
        .get_by_label("Test landmarks automatically")
        .click();
    rig.settle();
    assert!(!measured_ahead(&mut rig).is_empty());
}

/// Texts on the screen, each with its right edge and that of what is shown of it, points.
fn texts(rig: &super::Rig) -> Vec<(String, f32, f32)> {
    let shapes = rig.harness.output().shapes.iter();
    let texts = shapes.filter_map(|s| match &s.shape {
        egui::Shape::Text(text) => {
            let right = text.pos.x + text.galley.size().x;
            Some((text.galley.text().to_owned(), right, s.clip_rect.right()))
        }
        _ => None,
    });
    texts.collect()
}

#[test]
fn a_test_under_way_tells_no_share_among_those_of_pictures_and_is_not_offered_again() {
    let mut rig = planning();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    let offer = "Test how well it is found";
    rig.harness.get_by_label(offer).click();
    let is_asked = |rig: &mut super::Rig| {
        let mut jobs = rig.host().jobs.iter();
        jobs.any(|(_, job)| matches!(job, Job::Assess(_)))
    };
    while !is_asked(&mut rig) {
        rig.frames(1);
    }
    // The worker has done half of it.
    let events = &mut rig.host().events;
    events.retain(|(_, event)| matches!(event, JobEvent::Progress(..)));
    rig.frames(3);
    let texts = texts(&rig);
    assert!(texts.iter().any(|(text, ..)| text == "testing …"));
    assert!(texts.iter().all(|(text, ..)| text != "50 % …"));
    assert!(rig.harness.query_by_label(offer).is_none());
}

#[test]
fn the_legend_of_a_test_is_whole_in_a_narrow_column() {
    let mut rig = rig_on(ScriptedHost::default(), Vec2::new(1000.0, 1400.0));
    rig.open_tab("Plan");
    rig.settle();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.harness
        .get_by_label("Test how well it is found")
        .click();
    rig.settle();
    rig.frames(3);
    let texts = texts(&rig);
    for words in [
        "Found: never",
        "always",
        "not looked for",
        "a wrong place believed",
    ] {
        let mut drawn = texts.iter().filter(|(text, ..)| text == words);
        assert!(drawn.clone().count() > 0, "{words} is not drawn");
        assert!(drawn.all(|(_, right, end)| right <= end), "{words} is cut");
    }
}

/// The plan with a route and all of its four landmarks tested at the usual height, where none is tested unasked.
fn tested() -> super::Rig {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Landmarks");
    rig.harness.get_by_label("Test all").click();
    for _ in 0..4 {
        rig.settle();
    }
    rig.open_tab("Route");
    rig.settle();
    rig.harness
        .get_by_label("All 4 landmarks in use are tested.");
    rig
}

/// Plans all way-points at a height above ground, metres.
fn plan_at(rig: &mut super::Rig, metres: f64) {
    rig.open_tab("Route");
    if rig.state()["plan"]["way_point"].is_null() {
        choose(rig, 1);
    }
    set(rig, "Altitude of the way-point", metres);
    rig.harness
        .get_by_label("This altitude for all way-points")
        .click_accesskit();
    rig.settle();
    assert_eq!(number(rig, "/routes/0/way_points/1/altitude"), metres);
}

/// Number of landmarks of which a test is told.
fn told(rig: &super::Rig) -> Option<usize> {
    rig.state()["plan"]["measured"].as_array().map(Vec::len)
}

#[test]
fn a_test_counts_only_for_plans_that_are_flown_from_about_its_height() {
    let mut rig = tested();
    let usual = number(&rig, "/routes/0/way_points/0/altitude");
    // A tenth more is the same test; four times as high is another.
    plan_at(&mut rig, 1.1 * usual);
    assert_eq!(number(&rig, "/measured/3/probability"), 0.45);
    plan_at(&mut rig, 4.0 * usual);
    assert_eq!(told(&rig), Some(0));
    rig.harness
        .get_by_label_contains("None of 4 landmarks is tested. Each counts like a box at random");
    // It is predicted as where nobody tested any.
    let predicted = rig.host().jobs.iter().rev().find_map(|(_, job)| match job {
        Job::Predict(order) => Some(order.landmarks.clone()),
        _ => None,
    });
    let untested = DetectionStatistics::everywhere(UntestedDetection::of_any_map().expected);
    let predicted = predicted.expect("a prediction");
    assert!(predicted.iter().all(|(_, expected)| *expected == untested));
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.harness
        .get_by_label_contains("Tested, but not from this height with this camera");
    // What is tested from there is another test, and neither takes the place of the other.
    rig.harness.state_mut().host.per_frame = Some(0.8);
    rig.harness
        .get_by_label("Test how well it is found")
        .click();
    rig.settle();
    assert!((number(&rig, "/measured/0/probability") - 0.72).abs() < 1e-9);
    plan_at(&mut rig, usual);
    assert_eq!(number(&rig, "/measured/0/probability"), 0.45);
    assert_eq!(number(&rig, "/measured/3/probability"), 0.45);
    // Both are there at the next visit.
    let host = ScriptedHost {
        stored: rig.host().stored.clone(),
        ..ScriptedHost::default()
    };
    let mut again = rig_on(host, Vec2::new(1440.0, 900.0));
    again.open_tab("Plan");
    again.settle();
    assert_eq!(told(&again), Some(4));
    plan_at(&mut again, 4.0 * usual);
    assert_eq!(told(&again), Some(1));
}

#[test]
fn a_test_counts_only_while_the_settings_are_those_that_it_was_made_with() {
    let mut rig = tested();
    rig.harness.get_by_label("Filter settings").click();
    rig.frames(3);
    set(&mut rig, "Camera tilt σ", 3.0);
    assert_eq!(told(&rig), Some(0));
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    rig.settle();
    assert_eq!(told(&rig), Some(4));
}

#[test]
fn a_landmark_that_is_too_large_for_a_picture_is_tried_again_from_higher_up() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (0.0, 300.0)]);
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains("Chapel: ").click();
    rig.settle();
    rig.host().left = Some(|job| matches!(job, Job::Assess(_) | Job::AssessAhead(_)));
    rig.harness
        .get_by_label("Test how well it is found")
        .click();
    rig.settle();
    let asked = rig.host().jobs.last().cloned();
    let Some((id, Job::Assess(order))) = asked else {
        panic!("a test was asked for, not {asked:?}");
    };
    // What is said is what a worker really says, of a box that is wider than any picture from there.
    let mut large = order.clone();
    large.landmark.bounds = large.landmark.bounds.grown(2.0 * order.height);
    let mut workers = InlineWorkers::new();
    workers.start(Job::Assess(large));
    while workers.busy() {
        let told = workers.events().into_iter();
        rig.host().events.extend(told.map(|(_, event)| (id, event)));
    }
    rig.settle();
    rig.harness
        .get_by_label("Not tested: counted as never found.");
    rig.open_tab("Route");
    rig.settle();
    let never = "1 does not fit into a picture from this height and counts as never found.";
    rig.harness.get_by_label_contains(never);
    // From higher up it is again one that nobody tested, and is tested without being asked for.
    rig.host().left = None;
    plan_at(&mut rig, 2.0 * order.height);
    assert!(rig.harness.query_by_label_contains(never).is_none());
    rig.harness
        .get_by_label_contains("None of 4 landmarks is tested. Each counts like a box");
    plan_at(&mut rig, order.height);
    rig.harness.get_by_label_contains(never);
    plan_at(&mut rig, 2.0 * order.height);
    rig.harness.state_mut().host.ahead = Ahead::Done;
    rig.settle();
    assert!(measured_ahead(&mut rig).contains(&order.landmark.id));
}
