use egui::{Key, Modifiers};
use pilotage_jobs::JobEvent;
use serde_json::Value;

use super::scrub::{HALF, half_flown};
use super::support::{Rig, rig};

fn film(rig: &mut Rig) {
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text("movie".into()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(2);
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn the_replay_is_filmed_from_its_beginning_and_the_film_ends_with_it() {
    let mut rig = rig();
    let [first, last] = [0, 1].map(|i| number(&rig.state()["span"][i]));
    film(&mut rig);
    assert_eq!(rig.host().films, ["begun"]);
    let state = rig.state();
    assert_eq!(state["playing"], true);
    assert!(number(&state["time"]) < first + 1.0);
    for _ in 0..((last - first) * 10.0) as usize + 20 {
        rig.host().now += 100.0;
        rig.frames(1);
    }
    let films = &rig.host().films;
    assert_eq!(films.len(), 2, "{films:?}");
    assert!(films[1].starts_with("Village-in-wind-0-00-0"), "{films:?}");
    assert!(films[1].contains(".webm"), "{films:?}");
    assert_eq!(rig.state()["playing"], false);
}

#[test]
fn a_film_ends_when_asked_for_again_or_when_the_replay_is_stopped() {
    for by_space in [true, false] {
        let mut rig = rig();
        film(&mut rig);
        rig.host().now += 300.0;
        rig.frames(2);
        if by_space {
            rig.key(Key::Space);
            rig.frames(2);
        } else {
            film(&mut rig);
        }
        assert_eq!(rig.host().films.len(), 2);
    }
}

#[test]
fn a_film_waits_for_what_is_still_flown() {
    let (mut rig, id, rest) = half_flown();
    let wait = |rig: &mut Rig, frames: usize| {
        for _ in 0..frames {
            rig.host().now += 100.0;
            rig.frames(1);
        }
    };
    film(&mut rig);
    wait(&mut rig, 300);
    assert_eq!(number(&rig.state()["time"]), HALF);
    assert_eq!(rig.host().films, ["begun"]);
    let events = [JobEvent::Steps(rest), JobEvent::Finished];
    rig.host().events.extend(events.map(|event| (id, event)));
    wait(&mut rig, 50);
    assert!(number(&rig.state()["time"]) > HALF + 1.0);
    assert_eq!(rig.host().films, ["begun"]);
    wait(&mut rig, 200);
    assert_eq!(rig.host().films.len(), 2);
}

#[test]
fn nothing_is_filmed_of_a_time_that_is_not_flown() {
    let (mut rig, ..) = half_flown();
    let strip = rig.rect("/timeline");
    let at = |part: f32| egui::pos2(strip.left() + part * strip.width(), strip.center().y);
    rig.drag_with(Modifiers::SHIFT, at(0.7), at(0.9));
    assert!(rig.state()["selected"].is_array());
    film(&mut rig);
    assert_eq!(rig.host().films, Vec::<String>::new());
    let told = rig.state()["toasts"].to_string();
    assert!(told.contains("flown up to 0:29"), "{told}");
}
