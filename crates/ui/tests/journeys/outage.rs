//! Satellite navigation is cut out of a recorded flight.

use std::fmt::Write as _;

use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{AidedResult, Job, JobEvent, Outage, OutageReport};
use pilotage_ui::host::OpenedFile;

use super::support::{Rig, rig};

/// Rounds at 20 m/s through the air in a wind of 5 m/s from the west, three minutes long, as a text log.
pub fn rounds() -> Vec<u8> {
    let mut log = String::from(
        "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
         FMT, 1, 23, ATT, Qfff, TimeUS,Roll,Pitch,Yaw\n\
         FMT, 2, 27, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n\
         FMT, 3, 27, ARSP, Qf, TimeUS,Airspeed\n",
    );
    let (mut north, mut east) = (0.0_f64, 0.0_f64);
    for i in 0..1800_u32 {
        let time = 0.1 * f64::from(i);
        let heading = 0.09 * time;
        let (vn, ve) = (20.0 * heading.cos(), 20.0 * heading.sin() + 5.0);
        (north, east) = (north + 0.1 * vn, east + 0.1 * ve);
        let stamp = 1_000_000 + 100_000 * i;
        let yaw = heading.to_degrees().rem_euclid(360.0);
        let latitude = 47.0 + north / 111_170.0;
        let longitude = 8.0 + east / 76_050.0;
        let (speed, course) = (vn.hypot(ve), ve.atan2(vn).to_degrees().rem_euclid(360.0));
        writeln!(log, "ATT, {stamp}, 0, 0, {yaw:.4}").expect("memory");
        writeln!(log, "ARSP, {stamp}, 20").expect("memory");
        writeln!(
            log,
            "GPS, {stamp}, 3, {latitude:.8}, {longitude:.8}, 600, {speed:.4}, {course:.4}"
        )
        .expect("memory");
    }
    log.into_bytes()
}

fn rig_with_rounds() -> Rig {
    rig_with(rounds())
}

/// The same without airspeed.
fn rig_without_airspeed() -> Rig {
    let log = String::from_utf8(rounds()).expect("a text log");
    let lines = log.lines().filter(|line| !line.contains("ARSP"));
    rig_with(lines.collect::<Vec<_>>().join("\n").into_bytes())
}

fn rig_with(log: Vec<u8>) -> Rig {
    let mut rig = rig();
    rig.host().really_open = true;
    rig.host().opened.push(vec![OpenedFile {
        path: "rounds.log".to_owned(),
        content: log.into(),
    }]);
    rig.settle();
    rig.open_tab("GPS outage");
    rig
}

#[test]
fn an_outage_from_the_cursor_says_how_the_error_grows() {
    let mut rig = rig_with_rounds();
    let strip = rig.rect("/timeline");
    let middle = strip.center();
    rig.drag(middle - egui::vec2(20.0, 0.0), middle);
    rig.harness.get_by_label("Cut 30 s from here").click();
    rig.settle();
    let state = rig.state();
    let results = state["outage"]["results"].as_array().expect("results");
    assert!(results.len() >= 3, "{}", state["outage"]);
    let alone = &results[0];
    assert_eq!(alone["label"], "Airspeed and wind");
    assert!(alone["end_error"].as_f64() < Some(15.0), "{alone}");
    assert!(
        alone["radius"].as_f64() > alone["end_error"].as_f64(),
        "{alone}"
    );
    let winds = &state["outage"]["winds"];
    let last = winds["by_gps"]
        .as_array()
        .expect("winds")
        .last()
        .expect("one");
    assert!(
        (last[2].as_f64().expect("east") - 5.0).abs() < 0.5,
        "{last}"
    );
    assert!(winds["from_least_squares"].as_f64() < Some(1.0), "{winds}");
    rig.harness.get_by_label("Wind over time, m/s");
    rig.harness.get_by_label("Clear").click();
    rig.frames(3);
    assert!(rig.state()["outage"].is_null());
}

#[test]
fn an_outage_at_the_very_beginning_begins_in_the_air_and_says_why_and_one_past_the_end_ends_with_the_flight()
 {
    let mut rig = rig_with_rounds();
    rig.key(egui::Key::Home);
    let (begin, end) = span(&rig);
    rig.harness.get_by_label("Cut 120 s from here").click();
    rig.settle();
    let outage = rig.state()["outage"].clone();
    let from = outage["span"][0].as_f64().expect("a beginning");
    assert!(from > begin && from < begin + 15.0, "{outage}");
    assert!(outage["trouble"].is_null(), "{outage}");
    let why = "The outage begins a second after take-off";
    assert!(rig.harness.query_by_label_contains(why).is_some());
    let strip = rig.rect("/timeline");
    let near_end = egui::pos2(strip.right() - 0.1 * strip.width(), strip.center().y);
    rig.drag(near_end - egui::vec2(20.0, 0.0), near_end);
    rig.harness.get_by_label("Cut 120 s from here").click();
    rig.settle();
    let to = rig.state()["outage"]["span"][1].as_f64().expect("an end");
    assert!(to <= end, "it lasts until {to}, the flight until {end}");
    assert!(rig.harness.query_by_label_contains(why).is_none());
    // Nothing is left of the flight.
    rig.key(egui::Key::End);
    rig.harness.get_by_label("Cut 30 s from here").click();
    rig.settle();
    let trouble = rig.state()["outage"]["trouble"].to_string();
    assert!(
        trouble.contains("the aircraft does not fly then"),
        "{trouble}"
    );
}

/// First and last time of the flight, seconds.
fn span(rig: &Rig) -> (f64, f64) {
    let span = &rig.state()["span"];
    let [begin, end] = [0, 1].map(|i| span[i].as_f64().expect("a time"));
    (begin, end)
}

#[test]
fn the_heads_of_the_table_of_outages_have_room() {
    let mut rig = rig_with_rounds();
    rig.harness
        .get_by_label("Outages of 30 s all along")
        .click();
    rig.settle();
    rig.harness.get_by_label("median 90 % inside");
    // An outage that is let go of leaves them.
    rig.harness.get_by_label("Cut 30 s from here").click();
    rig.settle();
    rig.harness.get_by_label("Clear").click();
    rig.frames(3);
    assert!(rig.state()["outage"]["span"].is_null());
    rig.harness.get_by_label("median 90 % inside");
}

#[test]
fn the_selected_stretch_is_cut() {
    let mut rig = rig_with_rounds();
    let strip = rig.rect("/timeline");
    let at = |share: f32| egui::pos2(strip.left() + share * strip.width(), strip.center().y);
    rig.drag_with(egui::Modifiers::SHIFT, at(0.4), at(0.6));
    rig.frames(3);
    let selected = rig.state()["selected"].clone();
    rig.harness.get_by_label_contains("Cut GPS from").click();
    rig.settle();
    assert!(selected.is_array());
    assert_eq!(rig.state()["outage"]["span"], selected);
}

#[test]
fn what_the_run_saw_of_landmarks_is_a_way_through_an_outage() {
    let mut rig = rig();
    rig.settle();
    rig.open_tab("GPS outage");
    rig.harness.get_by_label("Cut 30 s from here").click();
    rig.frames(3);
    let host = rig.host();
    let order = host.jobs.iter().find_map(|(_, job)| match job {
        Job::Outage(order) => Some(order),
        _ => None,
    });
    let (label, fixes) = order.expect("an outage").seen.clone().expect("landmarks");
    assert_eq!(label, "Airspeed, wind, landmarks");
    assert!(fixes.len() > 3, "{}", fixes.len());
}

#[test]
fn a_cut_with_landmarks_of_the_run_before_says_so() {
    const OF_BEFORE: &str = "Of the run before";
    let mut rig = rig();
    rig.settle();
    rig.open_tab("GPS outage");
    rig.harness.get_by_label("Cut 30 s from here").click();
    rig.frames(3);
    let jobs = &rig.host().jobs;
    let cut = jobs.iter().find(|(_, job)| matches!(job, Job::Outage(_)));
    let (job, _) = cut.expect("a cut");
    let report = OutageReport {
        span: (1.0, 31.0),
        results: vec![AidedResult {
            label: "Airspeed, wind, landmarks".to_owned(),
            growth: Vec::new(),
            places: Vec::new(),
        }],
        remarks: Vec::new(),
        winds: None,
    };
    let events = [JobEvent::OutageMade(Box::new(report)), JobEvent::Finished];
    let events = events.map(|event| (*job, event));
    rig.host().events.extend(events);
    rig.frames(3);
    assert_eq!(rig.state()["outage"]["of_run_before"], false);
    assert!(rig.harness.query_by_label_contains(OF_BEFORE).is_none());
    rig.key(egui::Key::R);
    rig.settle();
    assert_eq!(rig.state()["outage"]["of_run_before"], true);
    rig.harness.get_by_label_contains(OF_BEFORE);
    rig.harness.get_by_label("Work it out again").click();
    rig.frames(3);
    let jobs = rig.host().jobs.iter();
    let spans: Vec<_> = jobs
        .filter_map(|(_, job)| match job {
            Job::Outage(order) => Some(order.outage),
            _ => None,
        })
        .collect();
    assert_eq!(spans.last(), Some(&Outage::Stretch(1.0, 31.0)));
}

#[test]
fn a_simulated_flight_has_a_true_track_and_a_log_a_recorded_one() {
    let mut simulated = rig();
    simulated.open_tab("GPS outage");
    let told = |rig: &Rig, words: &str| rig.harness.query_by_label_contains(words).is_some();
    assert!(told(&simulated, "is compared with the true track"));
    let mut recorded = rig_with_rounds();
    assert!(told(&recorded, "is compared with the recorded track"));
    for (rig, words) in [
        (&mut simulated, "Keep the true track"),
        (&mut recorded, "Keep the recorded track"),
    ] {
        rig.open_tab("Compare");
        assert!(told(rig, words), "{words}");
    }
    assert!(told(&simulated, "Show Distance from truth"));
    recorded.harness.get_by_label("Plots of the run").click();
    recorded.frames(3);
    assert!(told(&recorded, "Show Distance from recorded track"));
}

#[test]
fn a_log_without_airspeed_is_not_urged_to_be_cut_and_says_what_an_outage_goes_by() {
    let told = |rig: Rig, by: &str, is_urged: bool| {
        let is_there = |words: &str| rig.harness.query_by_label_contains(words).is_some();
        assert!(is_there(by), "{by}");
        assert_eq!(is_there("This flight has no airspeed"), !is_urged);
        let button = rig.harness.query_by_label("Cut GPS");
        assert_eq!(button.is_some(), is_urged, "{by}");
    };
    told(rig_with_rounds(), "goes on by airspeed and heading", true);
    told(
        rig_without_airspeed(),
        "goes on by mean speed and heading",
        false,
    );
}
