//! `pilotage detect` as a user calls it.

use std::path::Path;
use std::process::{Command, Output};

use pilotage_tests::data::shared;
use serde_json::Value;

use super::folder::Folder;

fn detect(cascade: &Path, image: &Path, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .arg("detect")
        .arg("--cascade")
        .args([cascade, image])
        .args(more)
        .output()
        .expect("the program starts")
}

fn error(output: &Output) -> String {
    assert!(!output.status.success());
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn what_a_cascade_finds_is_told_as_opencv_finds_it() {
    let Some(folder) = shared("opencv_cascades") else {
        return;
    };
    let expected = std::fs::read(folder.join("expected_opencv_4.14.json")).unwrap();
    let expected: Value = serde_json::from_slice(&expected).unwrap();
    let cases = expected["cases"].as_array().unwrap();
    let with_faces = |case: &&Value| {
        case["xml"].as_str().unwrap().contains("frontalface")
            && case["grouped"].as_array().is_some_and(|g| !g.is_empty())
    };
    let case = cases.iter().find(with_faces).expect("one finds a face");
    let cascade = folder.join(case["xml"].as_str().unwrap());
    let image = folder.join("images").join(case["image"].as_str().unwrap());
    let step = case["scaleFactor"].to_string();

    let answer = |more: &[&str]| -> Value {
        let output = detect(
            &cascade,
            &image,
            &[&["--json", "--scale-step", &step], more].concat(),
        );
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        serde_json::from_slice::<Value>(&output.stdout).unwrap()[0].take()
    };
    let rectangles = |found: &[Value]| {
        let number = |v: &Value| v.as_i64().unwrap();
        let mut all: Vec<[i64; 4]> = (found.iter())
            .map(|d| ["x", "y", "width", "height"].map(|key| number(&d[key])))
            .collect();
        all.sort_unstable();
        all
    };
    let listed = |list: &Value| {
        let list = list.as_array().unwrap().iter();
        let mut all: Vec<[i64; 4]> = list
            .map(|r| [0, 1, 2, 3].map(|i| r[i].as_i64().unwrap()))
            .collect();
        all.sort_unstable();
        all
    };
    let groups = answer(&[]);
    let found = groups["detections"].as_array().unwrap();
    assert_eq!(rectangles(found), listed(&case["grouped"]));
    assert!(found.iter().all(|d| d["members"].as_u64().unwrap() > 3));
    assert!(found.iter().all(|d| d["score"].is_f64()));

    let raw = answer(&["--merge", "0"]);
    let windows = raw["detections"].as_array().unwrap();
    assert_eq!(rectangles(windows), listed(&case["raw"]));
    assert_eq!(raw["windows"].as_u64().unwrap() as usize, windows.len());

    let least = answer(&["--merge", "0", "--min", "60x60", "--max", "120x120"]);
    let sides = least["detections"].as_array().unwrap();
    let side = |d: &Value| d["width"].as_i64().unwrap();
    assert!(sides.iter().all(|d| (60..=120).contains(&side(d))));

    let soft = answer(&["--soft"]);
    let soft = soft["detections"].as_array().unwrap();
    assert!(!soft.is_empty() && soft.len() < windows.len());
    let best = &soft[0];
    let (x, width) = (best["x"].as_f64().unwrap(), best["width"].as_f64().unwrap());
    let centre = best["centre"][0].as_f64().unwrap();
    assert!((centre - x - 0.5 * width).abs() < 0.25 * width, "{best}");

    // One that is no picture takes nothing from the others.
    let output = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .args(["detect", "--json", "--scale-step", &step, "--cascade"])
        .args([&cascade, &folder.join("none.png"), &image])
        .output()
        .expect("the program starts");
    assert!(error(&output).contains("none.png"));
    assert!(error(&output).contains("1 of 2 pictures could not be read"));
    let answers: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(answers.as_array().map(Vec::len), Some(1));
    assert_eq!(answers[0]["detections"], groups["detections"]);

    // The same for people.
    let output = detect(&cascade, &image, &["--scale-step", &step]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        text.contains("stages in") && text.contains("score"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_read_or_done_is_named() {
    let nothing = Path::new("nothing.xml");
    assert!(error(&detect(nothing, Path::new("a.png"), &[])).contains("nothing.xml"));
    let steps = error(&detect(
        nothing,
        Path::new("a.png"),
        &["--scale-step", "0.9"],
    ));
    assert!(steps.contains("--scale-step: 0.9 is not over 1"), "{steps}");
    let sizes = error(&detect(nothing, Path::new("a.png"), &["--min", "24"]));
    assert!(sizes.contains("such as 24x24"), "{sizes}");
    let both = ["--merge", "2", "--soft"];
    assert!(error(&detect(nothing, Path::new("a.png"), &both)).contains("cannot be used with"));
    let folder = Folder::new("detect");
    let xml = "<opencv_storage><cascade></cascade></opencv_storage>";
    folder.write("broken.xml", xml);
    let broken = error(&detect(
        &folder.0.join("broken.xml"),
        Path::new("a.png"),
        &[],
    ));
    assert!(
        broken.contains("broken.xml") && broken.contains("cascade"),
        "{broken}"
    );
}
