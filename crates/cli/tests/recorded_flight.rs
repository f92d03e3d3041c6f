//! The recorded flights, by the program as a user calls it.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn pilotage() -> Command {
    Command::new(env!("CARGO_BIN_EXE_pilotage"))
}

fn run(command: &mut Command) {
    let done = command.output().expect("the program starts");
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
}

/// The flight folder of `site` and its `map`; `None`, loudly, without the shared data.
fn flown(site: &str, map: &str) -> Option<(PathBuf, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let map = root.join("../shared/data").join(map);
    if !map.exists() {
        println!("skipped: no shared data");
        return None;
    }
    Some((root.join("tests/flights").join(site), map))
}

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("pilotage-{}-{name}", std::process::id()))
}

/// The summary of a replay of the flight by the landmarks of a mission.
fn replay(mission: &Path, flight: &Path, map: &Path) -> Value {
    let last = |path: &Path| path.file_name().map(|n| n.to_string_lossy().into_owned());
    let name = last(flight).expect("a folder");
    let summary = scratch(&format!("{name}-{}.json", last(mission).expect("a file")));
    run(pilotage()
        .arg("replay")
        .arg("--mission")
        .arg(mission)
        .arg("--flight")
        .arg(flight)
        .arg("--map")
        .arg(map)
        .arg("--summary")
        .arg(&summary));
    let text = std::fs::read_to_string(&summary).expect("a summary was written");
    std::fs::remove_file(&summary).ok();
    let summary: Value = serde_json::from_str(&text).expect("the summary is JSON");
    println!(
        "{name}: {} of {} frames, median {:.2} m, worst {:.2} m",
        updated(&summary),
        summary["frames"],
        error(&summary, "median"),
        error(&summary, "max")
    );
    summary
}

/// The summary of a replay of `site` over its orthophoto by the landmarks picked by hand; `None`, loudly,
/// without the shared data.
fn replayed(site: &str, map: &str) -> Option<Value> {
    let (flight, map) = flown(site, map)?;
    Some(replay(&flight.join("mission.geojson"), &flight, &map))
}

/// The same by `count` boxes of `side` metres that the planner proposes along the survey lines, from the
/// orthophoto alone, on rehearsal days of `seed`.
fn proposed(site: &str, map: &str, (count, side): (u32, f64), seed: u64) -> Option<Value> {
    let (flight, map) = flown(site, map)?;
    let mission = scratch(&format!("{site}-{seed}.geojson"));
    run(pilotage()
        .arg("plan")
        .arg("--mission")
        .arg(flight.join("route.geojson"))
        .arg("--flight")
        .arg(&flight)
        .arg("--map")
        .arg(&map)
        .args(["--suggest", &count.to_string()])
        .args(["--side", &side.to_string()])
        .args(["--seed", &seed.to_string()])
        .arg("--out")
        .arg(&mission));
    let summary = replay(&mission, &flight, &map);
    std::fs::remove_file(&mission).ok();
    Some(summary)
}

fn updated(summary: &Value) -> u64 {
    summary["frames_with_update"].as_u64().expect("a count")
}

fn error(summary: &Value, figure: &str) -> f64 {
    let errors = &summary["corrected_position_error_m"];
    errors[figure].as_f64().expect("a figure")
}

/// Landmarks were picked on the orthophoto and gates fixed before the run; satellite navigation gives
/// the first position only. Truth is the place of each picture in the orthophoto by SIFT.
#[test]
fn brighton_beach_is_navigated_by_ten_landmarks() {
    let Some(summary) = replayed("brighton", "brighton_beach/ortho.jpg") else {
        return;
    };
    assert_eq!(summary["frames"], 18);
    assert!(updated(&summary) >= 16);
    assert!(error(&summary, "median") <= 0.7);
    assert!(error(&summary, "max") <= 3.5);
    assert_eq!(summary["updates_wrong"], 0);
}

/// As above; heading and height come from the same registration of the pictures as the truth, which is
/// good to some metres itself: nothing else was recorded.
#[test]
fn caliterra_is_navigated_by_twenty_four_landmarks() {
    let Some(summary) = replayed("caliterra", "caliterra/ortho.png") else {
        return;
    };
    assert_eq!(summary["frames"], 75);
    assert!(updated(&summary) >= 62);
    assert!(error(&summary, "median") <= 4.5);
    assert!(error(&summary, "max") <= 15.0);
}

/// The planner knows the survey lines, the camera and the orthophoto, and nothing of the pictures. With the
/// seed that everybody gets it does as well as the eye; with others by how its choice among places that
/// are about as good falls.
#[test]
fn brighton_beach_is_navigated_by_ten_boxes_that_the_planner_proposes() {
    for (seed, least) in [(1, 18), (2, 17)] {
        let Some(summary) = proposed("brighton", "brighton_beach/ortho.jpg", (10, 9.0), seed)
        else {
            return;
        };
        assert_eq!(summary["frames"], 18);
        assert!(updated(&summary) >= least);
        assert!(error(&summary, "median") <= 0.8);
        assert!(error(&summary, "max") <= 2.0);
        assert_eq!(summary["updates_wrong"], 0);
    }
}

/// Counts by key, of lines "COUNT  KEY: …" under a headline.
fn counted(text: &str, headline: &str) -> std::collections::BTreeMap<String, u64> {
    let lines = text.lines().skip_while(|line| !line.starts_with(headline));
    let counts = lines.skip(1).map_while(|line| {
        let (count, rest) = line.trim().split_once("  ")?;
        let (key, _) = rest.split_once(": ")?;
        Some((key.to_owned(), count.parse().ok()?))
    });
    counts.collect()
}

/// Every refused look and frame has a line of its own with its reason, and the counts are of those lines.
#[test]
fn what_was_refused_is_told_line_by_line_and_counted() {
    let Some((flight, map)) = flown("brighton", "brighton_beach/ortho.jpg") else {
        return;
    };
    let replay = |mission: Option<PathBuf>| {
        let mut command = pilotage();
        command
            .args(["replay", "--verbose"])
            .arg("--flight")
            .arg(&flight);
        command.arg("--map").arg(&map);
        match mission {
            Some(mission) => command.arg("--mission").arg(mission),
            None => command.arg("--no-mission"),
        };
        let done = command.output().expect("the program starts");
        assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        let text = String::from_utf8_lossy(&done.stdout).into_owned();
        let begin = text.find("\n{").expect("a summary");
        let summary: Value = serde_json::from_str(&text[begin..]).expect("JSON");
        (text, summary)
    };
    let lines = |text: &str, part: &str| {
        let count = text.lines().filter(|line| line.contains(part)).count();
        u64::try_from(count).expect("few lines")
    };
    let (text, summary) = replay(Some(flight.join("mission.geojson")));
    let counts = counted(&text, "looks at landmarks refused:");
    let stated = summary["updates_refused"].as_object().expect("counts");
    for (key, count) in stated {
        assert_eq!(
            count.as_u64(),
            Some(counts.get(key).copied().unwrap_or(0)),
            "{key}"
        );
    }
    let refused: u64 = counts.values().sum();
    assert!(refused > 0);
    assert_eq!(lines(&text, " m refused: "), refused);
    let accepted = summary["updates_accepted"].as_u64().expect("a count");
    assert_eq!(lines(&text, " m accepted"), accepted);
    let (text, summary) = replay(None);
    let laid = summary["frames_laid"].as_u64().expect("a count");
    let refused = summary["frames_refused"].as_object().expect("counts");
    let refused: u64 = refused.values().filter_map(Value::as_u64).sum();
    assert_eq!(laid + refused, 18);
    assert_eq!(lines(&text, "    laid by "), laid);
    assert_eq!(lines(&text, "    not laid: "), refused);
    assert_eq!(
        counted(&text, "whole frames refused:")
            .values()
            .sum::<u64>(),
        refused
    );
}
