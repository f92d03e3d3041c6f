//! The recorded flight over Brighton Beach, by the program as a user calls it.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Landmarks were picked on the orthophoto and gates fixed before the run; satellite navigation gives
/// the first position only. Truth is the place of each picture in the orthophoto by SIFT.
#[test]
fn brighton_beach_is_navigated_by_ten_landmarks() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let map = root.join("../shared/data/brighton_beach/ortho.jpg");
    if !map.exists() {
        println!("skipped: no shared data");
        return;
    }
    let summary =
        std::env::temp_dir().join(format!("pilotage-brighton-{}.json", std::process::id()));
    let flight = root.join("tests/flights/brighton");
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
    let updated = summary["frames_with_update"].as_u64().expect("a count");
    let error = &summary["corrected_position_error_m"];
    let figure = |name: &str| error[name].as_f64().expect("a figure");
    println!(
        "{updated} of 18 frames, median {:.2} m, worst {:.2} m",
        figure("median"),
        figure("max")
    );
    assert_eq!(summary["frames"], 18);
    assert!(updated >= 16, "{updated} frames updated");
    assert!(figure("median") <= 0.7, "median {} m", figure("median"));
    assert!(figure("max") <= 3.5, "worst {} m", figure("max"));
    assert_eq!(summary["updates_wrong"], 0);
}
