//! Files of each kind opened after files of each kind: nothing of the flight before stays on screen, and nothing that
//! was being done about it goes on.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::Geodetic;
use pilotage_jobs::{Job, JobId, OpenedFiles};
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

/// Leaves traces of the flight that is open wherever people can: bookmarks, a selected stretch, a match that is explained,
/// an outage, a contest.
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
    let has_tab = |rig: &Rig, tab: &str| {
        let role = egui::accesskit::Role::Tab;
        rig.harness.query_all_by_role_and_label(role, tab).count() == 1
    };
    if has_tab(rig, "Match") {
        rig.key(Key::End);
        rig.open_tab("Match");
        rig.settle();
    }
    for (tab, button) in [
        ("GPS outage", "Cut GPS from"),
        ("Compare", "Fly by all estimators"),
    ] {
        if !has_tab(rig, tab) {
            continue;
        }
        rig.open_tab(tab);
        if let Some(button) = rig.harness.query_by_label_contains(button) {
            button.click();
        }
        rig.settle();
    }
}

/// Parts of the state that are compared with nothing, and the reason. All others are of a flight, of what was found out about
/// it, or of what people do to it: a flight that takes the place of another one brings its own.
const LEFT_OUT: [(&str, &str); 23] = [
    ("undo", "counts steps back to the mission before, too"),
    ("run_generation", "counts every run of a visit"),
    ("toasts", "tell of whatever was opened"),
    ("time", "a map alone has none, and leaves the cursor alone"),
    ("drawn", "is a frame behind what is shown"),
    (
        "map",
        "is seen from where people looked, and holds their tiles",
    ),
    (
        "compare",
        "keeps trajectories of other flights; its contest stands apart",
    ),
    ("plan", "is of mission and map; its tab and its field stay"),
    ("workspace", "is where people work"),
    ("side_tab", "is what people look at"),
    ("speed", "is how people let flights play"),
    ("loop", "is how people let flights play"),
    ("dark", "is the look"),
    ("units", "are those of the people"),
    ("input_waits", "is of a frame"),
    ("dialogs", "are over everything"),
    ("simulate", "is a dialog that begins a flight"),
    ("web_map", "is a dialog that begins a map"),
    ("go_to", "is a mark of the people on the map"),
    ("exports", "has no state"),
    ("replay-film", "has no state"),
    ("screenshot", "has no state"),
    ("link", "has no state"),
];

/// State of everything that is of a flight, by name; the contest stands apart from what it is compared in.
fn of_flight(state: &Value) -> BTreeMap<String, Value> {
    let parts = state.as_object().expect("an object").iter();
    let is_left_out = |name: &str| LEFT_OUT.iter().any(|(left, _)| *left == name);
    let parts = parts.filter(|(name, _)| !is_left_out(name));
    let parts = parts.map(|(name, part)| (name.clone(), part.clone()));
    let contest = state["compare"]["contest"].clone();
    parts.chain([("contest".to_owned(), contest)]).collect()
}

/// Jobs begun so far that are neither over nor stopped; files that are given to workers have no end.
fn under_way(rig: &mut Rig) -> BTreeSet<String> {
    let host = rig.host();
    let goes_on = |id: &JobId| !host.cancelled.contains(id) && !host.over.contains(id);
    let jobs = host.jobs.iter();
    let jobs = jobs.filter(|(id, job)| goes_on(id) && !matches!(job, Job::Provide(_)));
    jobs.map(|(id, job)| format!("{id}: {job:.80?}").chars().take(120).collect())
        .collect()
}

#[test]
fn every_part_of_the_state_that_a_list_names_is_there() {
    let state = rig().state();
    let compared = of_flight(&state);
    let brought = Kind::ALL.iter().flat_map(|kind| kind.brings());
    for name in brought {
        assert!(compared.contains_key(*name), "nothing is compared: {name}");
    }
    for (name, _) in LEFT_OUT {
        assert!(state.get(name).is_some(), "no part of the state: {name}");
    }
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
            let traces: &[_] = match old {
                Kind::Log => &["outage", "contest", "selected", "log"],
                Kind::Folder | Kind::Mission | Kind::Run => &["match", "contest", "selected"],
                _ => &[],
            };
            let state = of_flight(&rig.state());
            for name in traces {
                assert!(!state[*name].is_null(), "{old:?}: no trace of {name}");
            }
            let before = under_way(&mut rig);
            new.open(&mut rig);
            let found = of_flight(&rig.state());
            for (name, expected) in &expected {
                // Photos that were opened before there was a map are laid on the one that comes.
                let is_awaited =
                    (new, old, name.as_str()) == (Kind::FarMap, Kind::Photos, "photos");
                if found[name] != *expected && !is_awaited {
                    left.push(format!(
                        "{new:?} after {old:?}: {name} is {}, not {expected}",
                        found[name]
                    ));
                }
            }
            let going_on = under_way(&mut rig);
            let going_on: Vec<_> = going_on.intersection(&before).collect();
            if !going_on.is_empty() {
                left.push(format!("{new:?} after {old:?}: {going_on:?} go on"));
            }
        }
    }
    assert!(left.is_empty(), "{}", left.join("\n"));
}

impl Kind {
    /// Parts of the state that become others when such files are opened beside a flight, which stays. A mission is flown,
    /// so that what came of the run is another's, and so it is of another run; the cursor goes on meanwhile.
    fn brings(self) -> &'static [&'static str] {
        match self {
            Self::Photos => &["photos", "step"],
            Self::Places => &["landmarks", "title", "step", "playing"],
            Self::Mission => &[
                "landmarks",
                "title",
                "origin",
                "accepted",
                "candidates",
                "run_landmarks",
                "ghost_steps",
                "match",
                "step",
            ],
            Self::Run => &[
                "run_steps",
                "run_complete",
                "run_landmarks",
                "accepted",
                "candidates",
                "ghost_steps",
                "match",
                "step",
                "span",
            ],
            Self::Log | Self::Sentences | Self::Folder | Self::FarMap => &[],
        }
    }
}

#[test]
fn what_was_found_out_about_a_flight_stays_when_something_is_opened_beside_it() {
    let mut changed = Vec::new();
    for new in Kind::ALL
        .into_iter()
        .filter(|kind| !kind.takes_the_flights_place())
    {
        let mut alone = rig();
        new.open(&mut alone);
        let alone = of_flight(&alone.state());
        for old in Kind::ALL {
            let mut rig = rig();
            old.open(&mut rig);
            leave_traces(&mut rig);
            let before = of_flight(&rig.state());
            let begun = under_way(&mut rig);
            new.open(&mut rig);
            let after = of_flight(&rig.state());
            let stays = before
                .iter()
                .filter(|(name, _)| !new.brings().contains(&name.as_str()));
            for (name, before) in stays {
                // A flight that could not be navigated is begun anew with a mission, as if it were another.
                let is_anew =
                    (new, old, name.as_str()) == (Kind::Mission, Kind::Sentences, "outage");
                if after[name] != *before && !is_anew {
                    changed.push(format!(
                        "{new:?} after {old:?}: {name} is {}, not {before}",
                        after[name]
                    ));
                }
            }
            // Jobs about the run before are over with it; an outage is of the flight, and says of which run.
            let going_on = under_way(&mut rig);
            let going_on = going_on.intersection(&begun);
            let going_on: Vec<_> = going_on.filter(|job| !job.contains("Outage(")).collect();
            if matches!(new, Kind::Mission | Kind::Run) && !going_on.is_empty() {
                changed.push(format!("{new:?} after {old:?}: {going_on:?} go on"));
            }
            // What came of a run that is opened is that run's, or it was not opened.
            let is_of = |state: &BTreeMap<_, _>| {
                let mut of_run = ["accepted", "candidates", "run_steps"].iter();
                of_run.all(|name| after[*name] == state[*name])
            };
            if new == Kind::Run && !is_of(&alone) && !is_of(&before) {
                changed.push(format!("{new:?} after {old:?}: parts of two runs"));
            }
            // A match is of its run alone.
            let of_run = &after["match"];
            if !of_run.is_null() && *of_run != before["match"] {
                changed.push(format!("{new:?} after {old:?}: the match is {of_run}"));
            }
        }
    }
    assert!(changed.is_empty(), "{}", changed.join("\n"));
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
