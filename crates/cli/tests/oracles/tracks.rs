//! Tracks that `pilotage export --track` writes, read by other programs and compared with the log.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use pilotage_tests::data::shared;
use pilotage_tests::oracle::ask;
use serde::Deserialize;
use serde_json::json;

#[derive(Deserialize)]
struct Answer {
    places: usize,
    colours: usize,
    differences: Vec<String>,
}

/// Writes a track in every format, and has it compared with the topic that tells it.
fn compare(kind: &str, topic: &str, fix: Option<&str>) {
    let Some(log) = shared("px4_ulog/sample-small.ulg") else {
        return;
    };
    let folder = std::env::temp_dir().join(format!("pilotage-track-{kind}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
    let channel = ["vehicle_acceleration", "xyz[0]"];
    let files = ["kml", "gpx", "geojson", "csv"].map(|format| {
        // The name of the file says the format.
        let path = folder.join(format!("track.{format}"));
        let done = Command::new(env!("CARGO_BIN_EXE_pilotage"))
            .arg("export")
            .arg(&log)
            .args(["--track", kind, "--channel", &channel.join("."), "-o"])
            .arg(&path)
            .output()
            .expect("the program starts");
        let told = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{told}");
        (format, path)
    });
    let files: BTreeMap<&str, PathBuf> = files.into_iter().collect();
    let question = json!({
        "log": log, "topic": topic, "fix": fix, "channel": channel, "files": files,
    });
    let answer: Option<Answer> = ask("track_read.py", &question);
    std::fs::remove_dir_all(&folder).ok();
    let Some(answer) = answer else { return };
    println!(
        "{kind}: {} places in each of four formats, {} colours",
        answer.places, answer.colours
    );
    assert!(answer.differences.is_empty(), "{:?}", answer.differences);
    assert!(answer.places > 30 && answer.colours > 1);
}

#[test]
fn the_track_of_the_receiver_is_that_of_the_log_in_every_format() {
    compare("gps", "vehicle_gps_position", Some("fix_type"));
}

#[test]
fn the_track_of_the_autopilot_is_its_own_estimate_in_every_format() {
    compare("ekf", "vehicle_global_position", None);
}
