//! `pilotage train` and `pilotage evaluate` as a user calls them.

use std::path::PathBuf;
use std::process::{Command, Output};

use pilotage_core::mission::package::read_package;
use pilotage_core::mission::write_mission;

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = format!("pilotage-train-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(folder);
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
        Self(folder)
    }

    fn pilotage(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_pilotage"))
            .current_dir(&self.0)
            .args(arguments)
            .output()
            .expect("the program starts")
    }

    fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

fn words(output: &Output) -> String {
    let both = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
    String::from_utf8_lossy(&both).into_owned()
}

const SCENARIO: [&str; 2] = ["--scenario", "distinct-400ft-calm"];

#[test]
fn a_landmark_is_trained_and_evaluated_on_days_that_it_has_not_seen() {
    let folder = Folder::new("whole");
    let few = [
        "--positives",
        "30",
        "--negatives",
        "200",
        "--held-out",
        "30",
    ];
    // What is not there is named, with what is.
    let output = folder.pilotage(&[&["evaluate"], &SCENARIO[..], &["--landmark", "?"]].concat());
    let said = words(&output);
    let names = said
        .split("there are: ")
        .nth(1)
        .expect("the landmarks are named");
    let name = names.trim().split(", ").next().unwrap();
    let to = [
        "--landmark",
        name,
        "--out",
        "cascades",
        "--write-mission",
        "m.geojson",
    ];
    let output = folder.pilotage(&[&["train"], &SCENARIO[..], &few, &to].concat());
    let said = words(&output);
    assert!(output.status.success(), "{said}");
    assert!(
        said.contains("hit rate") && said.contains("held-out photos"),
        "{said}"
    );
    let told = format!("looks for \"{name}\" by cascade from now on, no longer by template");
    assert!(said.contains(&told), "{said}");
    let file = format!("cascades/{}.xml", name.replace(' ', "-"));
    assert!(folder.text(&file).contains("<featureType>HOG"));

    let to = ["--csv", "e.csv", "--svg", "plots", "--json", "e.json"];
    let few = [
        "--mission",
        "m.geojson",
        "--photos",
        "40",
        "--days",
        "5",
        "--height",
        "122",
    ];
    let output = folder.pilotage(&[&["evaluate"], &few[..], &to].concat());
    let said = words(&output);
    assert!(output.status.success(), "{said}");
    assert!(
        said.contains("at 0.01 false alarms per picture") && said.contains("as flown: found "),
        "{said}"
    );
    let csv = folder.text("e.csv");
    assert!(
        csv.starts_with("landmark,curve,x,y,low,high,threshold\n"),
        "{csv}"
    );
    assert!(csv.contains("found_by_height_m"));
    let json: serde_json::Value = serde_json::from_str(&folder.text("e.json")).unwrap();
    assert_eq!(json[0]["looks"].as_array().unwrap().len(), 40);
    let found = json[0]["in_use"]["found"]["happened"].as_u64().unwrap();
    assert!(found >= 20, "{found} of 32: {said}");
    let plots = std::fs::read_dir(folder.0.join("plots")).unwrap().count();
    assert!(plots >= 4, "{plots} plots");
    one_of_two_is_kept(&folder, name);
}

/// Of a landmark that fits into no picture it is told why; the detector of the other is there all the same.
fn one_of_two_is_kept(folder: &Folder, name: &str) {
    let mut mission = read_package(folder.text("m.geojson").as_bytes())
        .expect("a mission")
        .mission;
    mission.landmarks.truncate(2);
    assert_eq!(mission.landmarks[0].name, name);
    let wide = &mut mission.landmarks[1];
    wide.reshape(wide.bounds.grown(700.0));
    let wide = wide.name.clone();
    std::fs::write(folder.0.join("two.geojson"), write_mission(&mission)).expect("a folder");
    let few = [
        "--positives",
        "12",
        "--negatives",
        "100",
        "--held-out",
        "12",
        "--height",
        "122",
    ];
    let names = ["--landmark", name, "--landmark", &wide];
    let to = ["--write-mission", "kept.geojson", "--summary", "kept.json"];
    let source = ["train", "--mission", "two.geojson"];
    let output = folder.pilotage(&[&source, &few[..], &names, &to].concat());
    let said = words(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("1 of 2 landmarks could not be trained"),
        "{said}"
    );
    assert!(said.contains("does not fit into a picture"), "{said}");
    assert!(!said.contains("from now on"), "{said}");
    let kept = read_package(folder.text("kept.geojson").as_bytes())
        .expect("a mission")
        .mission;
    let trained = kept
        .landmarks
        .iter()
        .map(pilotage_core::landmark::Landmark::is_trained);
    assert_eq!(trained.collect::<Vec<_>>(), [true, false]);
    let summary: serde_json::Value = serde_json::from_str(&folder.text("kept.json")).expect("JSON");
    assert_eq!(summary.as_array().map(Vec::len), Some(1));
    // From 10 m no picture holds it: it is told, and counted.
    let low = [
        "evaluate",
        "--mission",
        "m.geojson",
        "--height",
        "10",
        "--json",
        "low.json",
    ];
    let output = folder.pilotage(&low);
    let said = words(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("1 of 1 detectors could not be judged"),
        "{said}"
    );
    assert_eq!(folder.text("low.json"), "[]");
}

#[test]
fn what_is_not_there_is_named() {
    let folder = Folder::new("errors");
    let output =
        folder.pilotage(&[&["train"], &SCENARIO[..], &["--landmark", "Atlantis"]].concat());
    assert!(!output.status.success());
    assert!(words(&output).contains("\"Atlantis\""));
    let output = folder.pilotage(&["train"]);
    assert!(words(&output).contains("say --scenario NAME or --mission FILE"));
    let output = folder.pilotage(&[&["evaluate"], &SCENARIO[..]].concat());
    assert!(!output.status.success());
    assert!(words(&output).contains("no landmark has a detector; pilotage train"));
    let output = folder.pilotage(&[&["evaluate"], &SCENARIO[..], &["--landmark", "1"]].concat());
    assert!(words(&output).contains("has no detector that was trained for its box"));
}
