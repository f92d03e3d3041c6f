//! Files of each kind opened after files of each kind: nothing of the flight before stays on screen, and nothing that
//! was being done about it goes on.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::Geodetic;
use pilotage_jobs::{Job, OpenedFiles};
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::open_map::a_map;
use super::outage::rounds;
use super::photos::{photo, town};
use super::reopen::nothing;
use super::support::flight::{flight, mission, run};
use super::support::{Rig, rig};

/// Kind of opened files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A flight log.
    Log,
    /// Sentences of a receiver.
    Sentences,
    /// A flight folder.
    Folder,
    /// Photos, which are laid on the map that is open.
    Photos,
    /// A map that lies elsewhere, which begins a plan of its own.
    FarMap,
    /// A mission.
    Mission,
    /// A saved run.
    Run,
    /// Routes and landmarks of another program.
    Places,
}

impl Kind {
    const ALL: [Self; 8] = [
        Self::Log,
        Self::Sentences,
        Self::Folder,
        Self::Photos,
        Self::FarMap,
        Self::Mission,
        Self::Run,
        Self::Places,
    ];

    /// Whether the flight that was open is left for it.
    fn takes_the_flights_place(self) -> bool {
        !matches!(
            self,
            Self::Photos | Self::Mission | Self::Run | Self::Places
        )
    }

    /// Files that are really read.
    fn files(self) -> Option<(&'static str, Vec<u8>)> {
        Some(match self {
            Self::Log => ("rounds.log", rounds()),
            Self::Sentences => ("walk.nmea", sentences()),
            Self::Photos => ("a.jpg", photo(&town(720, 600, 7), (60, 60), [0.0, 0.0])),
            Self::Places => ("barn.geojson", barn()),
            _ => return None,
        })
    }

    /// Contents that a worker is said to have found in files that nobody reads.
    fn said(self) -> OpenedFiles {
        match self {
            Self::Folder => OpenedFiles {
                flight: Some(flight()),
                ..nothing()
            },
            Self::FarMap => a_map(Some(Geodetic::from_degrees(46.86, -92.08, 0.0))),
            Self::Mission => OpenedFiles {
                mission: Some(mission()),
                ..nothing()
            },
            Self::Run => OpenedFiles {
                run: Some(run(&mission())),
                ..nothing()
            },
            _ => nothing(),
        }
    }

    fn open(self, rig: &mut Rig) {
        let (name, bytes) = self.files().unwrap_or(("opened.zip", vec![7; 3]));
        rig.host().really_open = self.files().is_some();
        rig.host().opens = Some(self.said());
        rig.host().opened.push(vec![OpenedFile {
            path: name.to_owned(),
            content: bytes.into(),
        }]);
        rig.settle();
        rig.settle();
    }
}

/// A walk to the north, a sentence a second.
fn sentences() -> Vec<u8> {
    let mut text = String::new();
    for second in 0..60 {
        let minutes = 0.01 * f64::from(second);
        let body = format!(
            "GPRMC,1200{second:02}.00,A,47{minutes:07.4},N,00800.0000,E,36.0,0.0,261126,,,A"
        );
        let sum = body.bytes().fold(0, |sum, byte| sum ^ byte);
        write!(text, "${body}*{sum:02X}\r\n").expect("memory");
    }
    text.into_bytes()
}

/// A landmark as GeoJSON has it.
fn barn() -> Vec<u8> {
    let text = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"Shed"},
        "geometry":{"type":"Point","coordinates":[8.001,47.001]}}]}"#;
    text.as_bytes().to_vec()
}

/// Leaves traces of the flight that is open wherever people can: bookmarks, a selected stretch, an outage, a contest, a
/// match that is explained, a proposal of a label.
fn leave_traces(rig: &mut Rig) {
    if rig.state()["workspace"] != "Replay" {
        rig.open_tab("Replay");
    }
    if rig.state()["timeline"].is_array() {
        let strip = rig.rect("/timeline");
        let at = |part: f32| egui::pos2(strip.left() + part * strip.width(), strip.center().y);
        rig.drag(at(0.45), at(0.5));
        rig.key(Key::B);
        rig.drag_with(Modifiers::SHIFT, at(0.3), at(0.6));
    }
    for (tab, button) in [
        ("GPS outage", "Cut GPS from"),
        ("Compare", "Fly by all estimators"),
    ] {
        let tabs = rig
            .harness
            .query_all_by_role_and_label(egui::accesskit::Role::Tab, tab);
        if tabs.count() != 1 {
            continue;
        }
        rig.open_tab(tab);
        if let Some(button) = rig.harness.query_by_label_contains(button) {
            button.click();
        }
        rig.settle();
    }
}

/// State of everything that is of a flight.
fn of_flight(state: &Value) -> Value {
    let names = [
        "flight",
        "frames",
        "pictures",
        "log",
        "outage",
        "camera_log",
        "photos",
        "bookmarks",
        "selected",
        "selection",
        "distinctness",
        "run_steps",
        "run_complete",
        "accepted",
        "laid",
        "candidates",
        "ghost_steps",
        "match",
        "detector",
        "span",
        "labelling",
        "title",
        "job",
        "origin",
    ];
    let mut all: serde_json::Map<_, _> = names
        .iter()
        .map(|name| ((*name).to_owned(), state[*name].clone()))
        .collect();
    all.insert("contest".to_owned(), state["compare"]["contest"].clone());
    Value::Object(all)
}

/// Jobs about a flight that are neither over nor cancelled, while the flight is another kind's.
fn under_way(rig: &mut Rig, old: Kind) -> BTreeSet<String> {
    if matches!(old, Kind::Log | Kind::Sentences) {
        // What is asked of a flight that is really read is answered at once.
        return BTreeSet::new();
    }
    let host = rig.host();
    let silent = |job: &Job| match job {
        // The scripted host says nothing of outages of invented flights.
        Job::Outage(order) => Some(format!("{:?}", order.flight)),
        _ => None,
    };
    let jobs = host
        .jobs
        .iter()
        .filter(|(id, _)| !host.cancelled.contains(id));
    jobs.filter_map(|(_, job)| silent(job)).collect()
}

#[test]
fn nothing_of_a_flight_stays_when_files_of_any_kind_take_its_place() {
    let mut left = Vec::new();
    for new in Kind::ALL
        .into_iter()
        .filter(|kind| kind.takes_the_flights_place())
    {
        let mut alone = rig();
        new.open(&mut alone);
        let expected = of_flight(&alone.state());
        for old in Kind::ALL {
            let mut rig = rig();
            old.open(&mut rig);
            leave_traces(&mut rig);
            if old == Kind::Log {
                let state = of_flight(&rig.state());
                for name in ["outage", "contest", "selected", "log"] {
                    assert!(!state[name].is_null(), "no trace of {name}");
                }
            }
            new.open(&mut rig);
            let found = of_flight(&rig.state());
            for (name, value) in expected.as_object().expect("an object") {
                // Photos that were opened before there was a map are laid on the one that comes.
                let is_awaited =
                    (new, old, name.as_str()) == (Kind::FarMap, Kind::Photos, "photos");
                if found[name] != *value && !is_awaited {
                    left.push(format!(
                        "{new:?} after {old:?}: {name} is {}, not {value}",
                        found[name]
                    ));
                }
            }
            let going_on = under_way(&mut rig, old);
            if !going_on.is_empty() {
                left.push(format!("{new:?} after {old:?}: {going_on:?} go on"));
            }
        }
    }
    assert!(left.is_empty(), "{}", left.join("\n"));
}

#[test]
fn what_was_found_out_about_a_flight_stays_when_something_is_opened_beside_it() {
    // A mission is flown again, so that what came of the run is another's.
    let of_log = ["flight", "log", "bookmarks"];
    let of_run = ["outage", "selected", "contest", "run_steps"];
    for (new, names) in [
        (
            Kind::Places,
            of_log.into_iter().chain(of_run).collect::<Vec<_>>(),
        ),
        (Kind::Mission, of_log.to_vec()),
    ] {
        for old in [Kind::Log, Kind::Sentences, Kind::Folder] {
            let mut rig = rig();
            old.open(&mut rig);
            leave_traces(&mut rig);
            let before = of_flight(&rig.state());
            new.open(&mut rig);
            let after = of_flight(&rig.state());
            for name in &names {
                assert_eq!(after[*name], before[*name], "{new:?} after {old:?}: {name}");
            }
        }
    }
}

#[test]
fn the_plots_show_all_of_a_flight_that_takes_the_place_of_one_of_which_a_part_was_shown() {
    let mut rig = rig();
    rig.harness.get_by_label("Less time").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label("All time").is_some());
    Kind::Folder.open(&mut rig);
    assert_eq!(rig.state()["title"], "Invented");
    assert!(rig.harness.query_by_label("All time").is_none());
}
