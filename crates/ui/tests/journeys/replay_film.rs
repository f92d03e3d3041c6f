use egui::{Key, Modifiers};
use serde_json::Value;

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
