//! Logs of several vehicles, one of which flies.

use std::path::PathBuf;
use std::process::Command;

use pilotage_tests::logs::tlog::of_systems_7_and_9;

/// What the program says, or why it fails.
fn run(arguments: &[&str], log: &PathBuf) -> Result<String, String> {
    let output = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .arg(arguments[0])
        .arg(log)
        .args(&arguments[1..])
        .output()
        .expect("the program starts");
    let words = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() {
        Ok(words(&output.stdout))
    } else {
        Err(words(&output.stderr))
    }
}

#[test]
fn the_vehicle_that_is_asked_for_flies_in_each_command_and_another_is_refused_with_those_there_are()
{
    let log = std::env::temp_dir().join(format!("pilotage-vehicles-{}.tlog", std::process::id()));
    std::fs::write(&log, of_systems_7_and_9(200)).expect("the temporary folder can be written");
    for (vehicle, longitude) in [("7", 8.0), ("9", 9.0)] {
        let table = run(&["export", "--track", "ekf", "--vehicle", vehicle], &log);
        let table = table.expect("the track is written");
        let mut lines = table.lines();
        let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let column = head
            .iter()
            .position(|name| name.starts_with("lon"))
            .expect("longitudes");
        let row: Vec<&str> = lines.next_back().unwrap_or_default().split(',').collect();
        let last: f64 = row[column].parse().expect("a number");
        assert!((last - longitude).abs() < 1e-6, "{table}");
        let told = run(&["inspect", "--vehicle", vehicle], &log).expect("it is looked into");
        assert!(told.contains(&format!("system {vehicle}")), "{told}");
    }
    for command in ["inspect", "export", "replay"] {
        let refused = run(&[command, "--vehicle", "8"], &log).expect_err("there is none");
        assert!(
            refused.contains("system 7, system 9"),
            "{command}: {refused}"
        );
    }
    std::fs::remove_file(&log).ok();
}
