//! `pilotage replay` beside the page: one code flies for both.

use pilotage_core::frames::Geodetic;
use pilotage_core::mission::{Mission, write_mission};
use pilotage_core::navigator::{Run, StepTiming, decode_run};
use pilotage_core::simulate::SimulationChoice;
use pilotage_jobs::{
    FlightSource, FlyOrder, InlineWorkers, Job, JobEvent, MapSource, OpenOrder, ProvideOrder,
    SimulationOptions,
};
use pilotage_tests::logs::dataflash::Form;
use pilotage_tests::logs::made;

use super::folder::Folder;

/// The run of the page, which has the flight's own mission flown.
fn by_the_page(options: SimulationOptions) -> Run {
    let mut workers = InlineWorkers::new();
    workers.start(Job::Fly(FlyOrder {
        map: options.map(),
        flight: FlightSource::Simulated(options),
        mission: None,
    }));
    let mut run = None;
    while workers.busy() {
        for (_, event) in workers.events() {
            match event {
                JobEvent::RunStarted(head) => run = Some(*head),
                JobEvent::Steps(mut steps) => {
                    let run: &mut Run = run.as_mut().expect("a run that has begun");
                    run.steps.append(&mut steps);
                }
                JobEvent::CannotNavigate(why) | JobEvent::Failed(why) => panic!("{why}"),
                _ => {}
            }
        }
    }
    run.expect("a run")
}

/// The run but for how long it took.
fn timeless(mut run: Run) -> Run {
    for step in &mut run.steps {
        step.timing = StepTiming::default();
    }
    run
}

#[test]
fn terminal_and_page_fly_the_same_flight_to_the_bit_in_a_world_beside_the_country() {
    let folder = Folder::new("replay");
    let flown = folder.run(&[
        "replay",
        "--scenario",
        "indoor-hall",
        "--seed",
        "4",
        "--out",
        "hall.run",
    ]);
    let summary: serde_json::Value =
        serde_json::from_str(&flown.expect("it is flown")).expect("the summary is JSON");
    let bytes = std::fs::read(folder.0.join("hall.run")).expect("the run was written");
    let told = decode_run("hall.run", &bytes).expect("a run");
    let shown = by_the_page(SimulationOptions {
        scenario: "indoor-hall".to_owned(),
        seed: 4,
        ..SimulationOptions::demo()
    });
    assert!(shown.steps.len() > 100, "{} steps", shown.steps.len());
    assert!(timeless(told) == timeless(shown), "the runs differ");
    assert!(
        summary["position_error_m"]["rms"].as_f64() < Some(1.0),
        "{summary}"
    );
}

/// All that the page's workers answer to a job.
fn answers(workers: &mut InlineWorkers, job: Job) -> Vec<JobEvent> {
    workers.start(job);
    let mut all = Vec::new();
    while workers.busy() {
        all.extend(workers.events().into_iter().map(|(_, event)| event));
    }
    all
}

/// Verdicts of the page: that there is a mission among files with a log, and that the log is flown by one.
fn by_the_page_of_files(files: &[(&str, &[u8])]) -> [bool; 2] {
    let mut workers = InlineWorkers::new();
    let key = "drop".to_owned();
    let files = files
        .iter()
        .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec().into()));
    let files = files.collect();
    answers(
        &mut workers,
        Job::Provide(ProvideOrder {
            key: key.clone(),
            files,
        }),
    );
    let order = OpenOrder {
        key: key.clone(),
        near: None,
        origin: place(),
    };
    let opened = answers(&mut workers, Job::Open(order));
    let opened = opened.into_iter().find_map(|event| match event {
        JobEvent::Opened(opened) => Some(*opened),
        _ => None,
    });
    let mission = opened.expect("the files open").mission;
    let has_mission = mission.is_some();
    let order = FlyOrder {
        flight: FlightSource::Files(key),
        map: MapSource::Nothing,
        mission,
    };
    let flown = answers(&mut workers, Job::Fly(order));
    // The mission that it had to make itself.
    let is_bare = |event: &JobEvent| matches!(event, JobEvent::Mission(_));
    [has_mission, !flown.iter().any(is_bare)]
}

/// The place of the made log.
fn place() -> Geodetic {
    Geodetic::from_degrees(-37.96, 144.76, 0.0)
}

/// A fence as any program writes it.
const FENCE: &str = r#"{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
    {"type": "Polygon", "coordinates": [[[144.764, -37.959], [144.765, -37.959], [144.765, -37.96], [144.764, -37.959]]]}}]}"#;

#[test]
fn beside_a_log_page_and_terminal_take_the_same_files_for_its_mission() {
    let log = made::modern(Form::Binary, 3, 700);
    let ours = write_mission(&Mission::new("ours".to_owned(), place()));
    for (beside, is_mission) in [(FENCE, false), (ours.as_str(), true)] {
        let folder = Folder::new(if is_mission { "log-ours" } else { "log-fence" });
        folder.write("flight.bin", &log);
        folder.write("beside.geojson", beside);
        let said = folder.call(&["replay", ".", "--summary", "s.json"]);
        let notes = String::from_utf8_lossy(&said.stderr);
        assert_eq!(!notes.contains("It has no pictures"), is_mission, "{notes}");
        let files = [
            ("flight.bin", &log[..]),
            ("beside.geojson", beside.as_bytes()),
        ];
        assert_eq!(by_the_page_of_files(&files), [is_mission; 2]);
    }
}

#[test]
fn outages_of_a_flight_over_its_map_are_shown_with_what_the_landmarks_say() {
    let folder = Folder::new("replay-outage");
    let said = folder.run(&[
        "replay",
        "--scenario",
        "distinct-400ft-wind",
        "--outage",
        "20",
        "--summary",
        "flown.json",
    ]);
    let said = said.expect("it is flown and cut");
    let ways: Vec<&str> = said.lines().skip(1).map(str::trim).collect();
    let is_there = |name: &str| ways.iter().any(|way| way.starts_with(name));
    assert!(is_there("Airspeed and wind  "), "{said}");
    assert!(is_there("Airspeed, wind, landmarks  "), "{said}");
    let summary = std::fs::read_to_string(folder.0.join("flown.json")).expect("the summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
    assert!(summary["frames_with_update"].as_u64() > Some(20));
}

#[test]
fn a_flight_that_no_world_has_is_refused_with_those_of_all_worlds() {
    let folder = Folder::new("replay-unknown");
    for command in [
        &["replay", "--scenario", "moon"][..],
        &["simulate", "moon", "--out", "x"],
    ] {
        let refused = folder.run(command).expect_err("there is none");
        for choice in SimulationChoice::all() {
            assert!(refused.contains(choice.name), "{command:?}: {refused}");
        }
    }
}

/// Nothing that is said is left undone without a word.
#[test]
fn what_a_flight_cannot_follow_is_refused_by_name() {
    let folder = Folder::new("unfollowed");
    folder.write("flight.bin", b"");
    for (words, named) in [
        ("replay --seed 3", "--scenario"),
        ("replay flight.bin --seed 3", "--seed"),
        ("replay flight.bin --seeds 1..5", "--seeds"),
        ("replay flight.bin --day same", "--day"),
        ("replay --scenario s --seeds 1..2 --out r.run", "--out"),
        ("replay --scenario s --seeds 1..2 --verbose", "--verbose"),
        ("replay --scenario s --vehicle 2", "--vehicle"),
        ("replay --scenario s --no-mission", "--no-mission"),
        ("compare flight.bin --seeds 1..9", "--seeds"),
        ("compare flight.bin --day same", "--day"),
        ("compare indoor-hall --map m.png", "--map"),
        ("compare indoor-hall --no-mission", "--no-mission"),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        let why = folder.run(&words).unwrap_err();
        assert!(why.contains(named), "{words:?}: {why}");
        assert!(!folder.0.join("r.run").exists(), "{words:?}");
    }
    let missions = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/flights/brighton/");
    for (file, option, what) in [
        ("mission.geojson", "--parameters", "a mission"),
        ("mission.geojson", "--counts", "a mission"),
        ("flight.json", "--parameters", "a flight"),
    ] {
        let why = folder.run(&["inspect", &format!("{missions}{file}"), option]);
        let why = why.unwrap_err();
        assert!(why.contains(option) && why.contains(what), "{file}: {why}");
    }
}

#[test]
fn numbers_with_which_nothing_flies_are_refused_by_name() {
    let folder = Folder::new("unflyable");
    for (words, named) in [
        (
            "replay --scenario distinct-400ft-calm --filter gate=99",
            "gate = 99",
        ),
        (
            "compare indoor-hall --estimators ekf --filter pixel=nan",
            "pixel = NaN",
        ),
        (
            "rehearse --scenario distinct-400ft-calm --height=-50",
            "height: -50",
        ),
        ("simulate --map m.tif --height=0 --out f", "height: 0"),
        ("roads lost r.geojson v.png --on-map 150", "--on-map: 150"),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        let why = folder.run(&words).unwrap_err();
        assert!(why.contains(named), "{words:?}: {why}");
    }
}
