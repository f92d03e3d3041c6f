//! The recorded flights, by the program as a user calls it.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// The summary of a replay of `site` over its orthophoto; `None`, loudly, without the shared data.
fn replayed(site: &str, map: &str) -> Option<Value> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let map = root.join("../shared/data").join(map);
    if !map.exists() {
        println!("skipped: no shared data");
        return None;
    }
    let summary = std::env::temp_dir().join(format!("pilotage-{site}-{}.json", std::process::id()));
    let flight = root.join("tests/flights").join(site);
    let status = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .arg("replay")
        .arg("--mission")
        .arg(flight.join("mission.geojson"))
        .arg("--flight")
        .arg(&flight)
        .arg("--map")
        .arg(&map)
        .arg("--summary")
        .arg(&summary)
        .output()
        .expect("the program starts");
    assert!(
        status.status.success(),
        "{}",
        String::from_utf8_lossy(&status.stderr)
    );
    let text = std::fs::read_to_string(&summary).expect("a summary was written");
    std::fs::remove_file(&summary).ok();
    let summary: Value = serde_json::from_str(&text).expect("the summary is JSON");
    println!(
        "{site}: {} of {} frames, median {:.2} m, worst {:.2} m",
        updated(&summary),
        summary["frames"],
        error(&summary, "median"),
        error(&summary, "max")
    );
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
