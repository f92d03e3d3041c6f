//! `pilotage study` as a user calls it: alone, shared out, killed and run again.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use pilotage_core::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Mission, Route, WayPoint, write_mission};
use pilotage_study::StudyPlan;
use pilotage_tests::data::repository;
use serde_json::Value;

use super::folder::Folder;

/// 28 flights of eight seconds.
const PLAN: &str = r#"
    name = "small"
    question = "Is it the same?"
    seed = 3
    draws = 14
    fixed = { seconds = 8, step = 0.25, scenario = "distinct-400ft-calm" }
    cross.vehicle = ["airplane-wind", "airplane-full"]
    draw.wind-speed = { uniform = [0, 6] }
    measure = [{ of = "error-rms" }, { of = "error-max", name = "near", at_most = 6 }]
"#;

impl Folder {
    fn with_plan(name: &str, plan: &str) -> Self {
        let folder = Self::new(&format!("study-{name}"));
        folder.write("plan.toml", plan);
        folder
    }

    fn study(&self, words: &[&str]) -> Result<String, String> {
        self.run(&[&["study", "plan.toml"], words].concat())
    }

    /// Outcome of the study in the folder `out`: rows, summary, table.
    fn outcome(&self, out: &str) -> [Vec<u8>; 3] {
        ["rows.parquet", "summary.json", "summary.txt"].map(|name| {
            let path = self.0.join(out).join(name);
            std::fs::read(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
        })
    }

    fn shards(&self, out: &str) -> usize {
        let there = std::fs::read_dir(self.0.join(out).join("shards"));
        let names = there.into_iter().flatten().flatten();
        let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
        names
            .filter(|name| name.ends_with(".parquet") && !name.starts_with('.'))
            .count()
    }
}

#[test]
fn one_two_and_seven_shards_and_a_study_that_was_killed_are_equal_to_the_bit() {
    let folder = Folder::with_plan("bits", PLAN);
    let table = folder.study(&["--out", "one", "--runs-per-shard", "28", "--threads", "1"]);
    let one = folder.outcome("one");
    assert_eq!(table.map(String::into_bytes), Ok(one[2].clone()));

    folder
        .study(&["--out", "two", "--runs-per-shard", "14", "--quiet"])
        .unwrap();
    assert!(folder.outcome("two") == one && folder.shards("two") == 2);

    // Seven shards by three programs, the last of which comes first; then they are merged.
    for share in ["2", "0", "1"] {
        let words = [
            "--out",
            "seven",
            "--runs-per-shard",
            "4",
            "--shares",
            "3",
            "--share",
            share,
        ];
        assert_eq!(folder.study(&words), Ok(String::new()));
    }
    folder
        .study(&["--out", "seven", "--runs-per-shard", "4", "--merge"])
        .unwrap();
    assert!(folder.outcome("seven") == one && folder.shards("seven") == 7);

    // Killed while it flies.
    let words = [
        "study",
        "plan.toml",
        "--out",
        "killed",
        "--runs-per-shard",
        "2",
    ];
    let mut program = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .current_dir(&folder.0)
        .args(words)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while folder.shards("killed") < 3 && begun.elapsed() < Duration::from_mins(1) {
        std::thread::sleep(Duration::from_millis(2));
    }
    program.kill().unwrap();
    program.wait().unwrap();
    let left = folder.shards("killed");
    assert!((3..14).contains(&left), "{left} shards");
    assert!(!folder.0.join("killed/rows.parquet").exists());
    folder.run(&words).unwrap();
    assert!(folder.outcome("killed") == one);
}

#[test]
fn a_study_is_given_up_when_its_input_ends_and_whole_shards_stay() {
    let folder = Folder::with_plan("input", PLAN);
    let words = [
        "study",
        "plan.toml",
        "--out",
        "given-up",
        "--runs-per-shard",
        "2",
        "--threads",
        "1",
        "--until",
        "input-ends",
    ];
    let mut program = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .current_dir(&folder.0)
        .args(words)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while folder.shards("given-up") < 3 && begun.elapsed() < Duration::from_mins(1) {
        std::thread::sleep(Duration::from_millis(2));
    }
    let flown = folder.shards("given-up");
    drop(program.stdin.take());
    let ended = program.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(1), "{said}");
    assert!(
        said.contains("Given up: the standard input has ended."),
        "{said}"
    );
    let left = folder.shards("given-up");
    assert!((flown..14).contains(&left), "{left} shards");
    assert!(!folder.0.join("given-up/rows.parquet").exists());
}

#[test]
fn a_study_that_may_stop_does_so_at_the_same_flight_however_it_is_cut() {
    let plan = format!("{PLAN}\nstop = {{ measure = \"near\", half_width = 0.3, every = 4 }}\n");
    let folder = Folder::with_plan("stop", &plan);
    folder
        .study(&["--out", "one", "--runs-per-shard", "28"])
        .unwrap();
    let one = folder.outcome("one");
    let summary: Value = serde_json::from_slice(&one[1]).unwrap();
    assert_eq!(summary["is_stopped"], true);
    let draws = summary["draws"].as_u64().unwrap();
    assert!(draws < 14 && draws.is_multiple_of(4), "{draws}");
    folder
        .study(&["--out", "many", "--runs-per-shard", "3", "--threads", "2"])
        .unwrap();
    assert!(folder.outcome("many") == one);
    // What is not needed is not flown.
    assert!(folder.shards("many") < 10);
    let said = folder
        .study(&["--out", "many", "--runs-per-shard", "3", "--describe"])
        .unwrap();
    let said: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(
        (&said["is_complete"], &said["missing"]),
        (&true.into(), &Vec::<u64>::new().into())
    );
    // Who asks for shards alone gets all of them, needed or not.
    let only = [
        "--out",
        "only",
        "--runs-per-shard",
        "3",
        "--only",
        "0,1,2,3,4,5,6,7,8,9",
    ];
    folder.study(&only).unwrap();
    assert_eq!(folder.shards("only"), 10);
    // Shards of which nothing says what they are of are nobody's.
    std::fs::remove_file(folder.0.join("many/study.json")).unwrap();
    let why = folder
        .study(&["--out", "many", "--runs-per-shard", "3"])
        .unwrap_err();
    assert!(
        why.contains("many has shards, and no study.json") && why.contains("that folder"),
        "{why}"
    );
}

#[test]
fn what_cannot_be_done_is_told_with_a_remedy() {
    let folder = Folder::with_plan("refused", &PLAN.replace("airplane-wind", "zeppelin"));
    let why = folder.study(&[]).unwrap_err();
    assert!(
        why.contains("plan.toml: cross.vehicle") && why.contains("airplane-gust"),
        "{why}"
    );
    folder.write("plan.toml", PLAN);
    let why = folder.study(&["--merge"]).unwrap_err();
    assert!(
        why.contains("1 of 1 shards are missing in small.study"),
        "{why}"
    );
    let begun = ["--out", "begun", "--quiet"];
    folder.study(&begun).unwrap();
    let other = [&begun[..], &["--runs-per-shard", "9"]].concat();
    let why = folder.study(&other).unwrap_err();
    assert!(
        why.contains("was begun with another plan") && why.contains("--out"),
        "{why}"
    );
    let why = folder
        .study(&["--shares", "3", "--share", "3"])
        .unwrap_err();
    assert!(why.contains("3 shares, from 0"), "{why}");
    // A file for each of so many shards would be more than a folder, or memory, can have.
    let many = PLAN.replace("draws = 14", "draws = 400000000");
    folder.write("plan.toml", many.as_str());
    let why = folder.study(&["--out", "many"]).unwrap_err();
    assert!(why.contains("give --runs-per-shard 800 or more"), "{why}");
    assert!(!folder.0.join("many").exists());
    let settings = folder.run(&["study", "settings"]).unwrap();
    assert!(settings.contains("wind-speed") && settings.contains("error-rms"));
}

#[test]
fn every_plan_of_the_repository_can_be_followed_and_is_named_as_its_file() {
    let plans = std::fs::read_dir(repository().join("studies")).unwrap();
    let mut count = 0;
    let files = plans.map(|entry| entry.unwrap().path());
    for file in files.filter(|file| file.is_file()) {
        let text = std::fs::read_to_string(&file).unwrap();
        let plan = StudyPlan::read(&text).unwrap_or_else(|why| panic!("{}: {why}", file.display()));
        assert_eq!(file.file_stem(), Some(plan.name.as_ref()));
        count += 1;
    }
    assert!(count >= 5, "{count} plans");
}

/// A mission of five landmarks along one of its two routes, 120 m above the ground.
fn mission() -> String {
    let altitude = Altitude::new(120.0, AltitudeFrame::AboveGround);
    let route = |name: &str, east: f64| Route {
        name: name.to_owned(),
        way_points: [0.0, 400.0]
            .map(|north| WayPoint::new(GroundPoint::new(north, east), altitude))
            .into(),
        ..Route::default()
    };
    let mut mission = Mission::new("Barns", Geodetic::from_degrees(46.8, -92.0, 183.0));
    for id in 1..6 {
        let at = GroundPoint::new(80.0 * f64::from(id), 0.0);
        let bounds = GroundRect::centered(at, 30.0, 30.0);
        mission
            .landmarks
            .push(Landmark::new(id, format!("Barn {id}"), bounds));
    }
    mission.routes = vec![route("Over the barns", 0.0), route("Beside them", 900.0)];
    write_mission(&mission)
}

#[test]
fn routes_of_a_mission_beside_the_plan_are_compared_and_the_packed_plan_needs_no_other_file() {
    let plan = r#"
        name = "routes"
        question = "Which way is better known?"
        draws = 4
        fixed = { mission = "barns.geojson", step = 0.25, wind-scatter = 2 }
        cross.route = ["Over the barns", "Beside them"]
        measure = [{ of = "error-rms" }, { of = "frames-used" }]
    "#;
    let folder = Folder::with_plan("mission", plan);
    let refused = folder.study(&["--out", "none"]).unwrap_err();
    assert!(
        refused.contains("plan.toml") && refused.contains("barns.geojson"),
        "{refused}"
    );
    folder.write("barns.geojson", mission());
    folder
        .study(&["--out", "beside", "--quiet", "--runs-per-shard", "3"])
        .unwrap();
    let beside = folder.outcome("beside");
    let summary: Value = serde_json::from_slice(&beside[1]).unwrap();
    let mean = |cell: usize, measure: usize| {
        summary["cells"][cell]["measures"][measure]["mean"]["mean"]
            .as_f64()
            .unwrap()
    };
    // Cells come in the order of the plan: the route over the barns first.
    assert!(
        mean(0, 0) < mean(1, 0) && mean(0, 1) > 0.0 && mean(1, 1) == 0.0,
        "{summary}"
    );

    // On another machine there is the packed plan alone.
    folder.study(&["--pack", "packed.toml"]).unwrap();
    let packed = std::fs::read_to_string(folder.0.join("packed.toml")).unwrap();
    let elsewhere = Folder::with_plan("mission-packed", &packed);
    elsewhere.study(&["--out", "there", "--quiet"]).unwrap();
    assert!(elsewhere.outcome("there") == beside);

    // A mission that is changed is another study.
    folder.write("barns.geojson", mission().replace("Barn 5", "Barn five"));
    let other = folder
        .study(&["--out", "beside", "--runs-per-shard", "3"])
        .unwrap_err();
    assert!(other.contains("begun with another plan"), "{other}");
}

#[test]
fn who_only_looks_at_a_study_writes_nothing() {
    let folder = Folder::with_plan("looks", PLAN);
    let there = || -> Vec<String> {
        let entries = std::fs::read_dir(&folder.0).unwrap();
        let names = entries.map(|it| it.unwrap().file_name().to_string_lossy().into_owned());
        names.collect()
    };
    let before = there();
    let said = folder.study(&["--describe"]).unwrap();
    let said: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(said["missing"].as_array().map(Vec::len), Some(1));
    let lacking = folder.study(&["--merge"]).unwrap_err();
    assert!(lacking.contains("1 of 1 shards are missing"), "{lacking}");
    folder.run(&["study", "settings"]).unwrap();
    assert_eq!(there(), before);
    // What it says that a folder is begun with is what it is begun with.
    folder.study(&["--quiet", "--out", "flown"]).unwrap();
    let begun = std::fs::read_to_string(folder.0.join("flown/study.json")).unwrap();
    assert_eq!(said["begun"], begun.as_str());
    let other = folder.study(&["--out", "flown", "--runs-per-shard", "7", "--describe"]);
    assert!(other.unwrap_err().contains("begun with another plan"));
}
