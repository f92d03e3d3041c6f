use egui::Vec2;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use pilotage_jobs::{FlightSource, FlyOrder, Job};

use super::support::{Scheme, ScriptedHost, rig, rig_on};

#[test]
fn the_demo_is_flying_when_the_app_opens() {
    let mut rig = rig();
    let Some((
        _,
        Job::Fly(FlyOrder {
            flight, mission, ..
        }),
    )) = rig.host().last_flight().cloned()
    else {
        panic!("no flight was asked for");
    };
    let FlightSource::Simulated(options) = flight else {
        panic!("the demo is simulated");
    };
    assert_eq!(options.scenario, "distinct-400ft-wind");
    assert!(options.other_day && mission.is_none());
    let state = rig.state();
    assert_eq!(state["workspace"], "Replay");
    assert!(state["run_steps"].as_u64() > Some(100));
}

#[test]
fn playback_runs_by_itself_until_paused() {
    let mut rig = rig();
    let paused = rig.state()["time"].as_f64();
    rig.frames(5);
    assert_eq!(rig.state()["time"].as_f64(), paused);
    rig.key(egui::Key::Space);
    rig.frames(5);
    assert!(rig.state()["time"].as_f64() > paused);
}

#[test]
fn the_map_takes_most_of_a_usual_window() {
    let rig = rig();
    let map = rig.rect("/map/rect");
    assert!(map.area() > 0.44 * 1440.0 * 900.0, "{map:?}");
}

#[test]
fn map_and_timeline_fit_into_every_window() {
    for size in [[1440.0, 900.0], [1024.0, 700.0], [768.0, 1024.0]] {
        let size = Vec2::from(size);
        let rig = rig_on(ScriptedHost::default(), size);
        let window = egui::Rect::from_min_size(egui::Pos2::new(8.0, 8.0), size);
        let (map, timeline) = (rig.rect("/map/rect"), rig.rect("/timeline"));
        assert!(
            window.contains_rect(map) && window.contains_rect(timeline),
            "{size:?}"
        );
        assert!(!map.intersects(timeline), "{size:?}");
        assert!(
            map.width() > 400.0 && map.height() > 300.0,
            "{size:?} {map:?}"
        );
    }
}

#[test]
fn the_first_visit_has_the_colours_of_the_rest_of_the_screen_and_later_ones_those_that_were_chosen()
{
    let light = || ScriptedHost {
        scheme: Scheme::Light,
        ..ScriptedHost::default()
    };
    let size = Vec2::new(1440.0, 900.0);
    assert_eq!(rig().state()["dark"], true);
    let mut rig = rig_on(light(), size);
    assert_eq!(rig.state()["dark"], false);
    rig.menu("View", "Dark or light");
    rig.settle();
    assert_eq!(rig.state()["dark"], true);
    let stored = rig.host().stored.clone();
    let host = ScriptedHost { stored, ..light() };
    assert_eq!(rig_on(host, size).state()["dark"], true);
}

#[test]
fn while_the_first_flight_is_computed_nothing_says_that_there_is_none() {
    let host = ScriptedHost {
        silent_flights: true,
        ..ScriptedHost::default()
    };
    let rig = rig_on(host, Vec2::new(1440.0, 900.0));
    let shown = rig
        .harness
        .query_all_by_label_contains("Computing the flight");
    assert!(shown.count() >= 2, "plots and matches say so");
    for words in ["No run yet", "No flight yet"] {
        assert!(rig.harness.query_by_label_contains(words).is_none());
    }
}

#[test]
fn the_position_is_told_within_the_same_distance_on_the_map_and_to_screen_readers() {
    let rig = rig();
    let headline = rig
        .harness
        .get_by_label_contains("Position (95 %): within ");
    let node = headline.accesskit_node();
    let words = node.label().or_else(|| node.value()).expect("words");
    let radius = words.split("(95 %): ").nth(1).expect("a radius");
    let radius = radius.split(',').next().unwrap_or_default().to_owned();
    let app = rig.harness.state().app.as_ref().expect("the app");
    let summary = app.summary_text();
    assert!(
        summary.contains(&format!("its position {radius} (95 %).")),
        "{summary} beside {words}"
    );
}
