//! A test program, as cargo tells of it, and what is known of how long it takes.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

use serde_json::Value;

/// Programs that take longest, which begin before the others and which `--quick` leaves out.
pub const LONG: [&str; 4] = ["whole_frames", "across_dates", "hostile_data", "scenarios"];
/// Programs that take longest beside them, and begin next: none of them must be what everybody waits for at
/// the end.
const EARLY: [&str; 14] = [
    "oracles",
    "oracle_frames",
    "pilotage_jobs",
    "pilotage_ui",
    "landmarks_across_dates",
    "pilotage_readers",
    "sequences",
    "journeys",
    "pilotage_navigator",
    "recorded_flight",
    "pilotage_plan",
    "flights",
    "golden",
    "train",
];

/// The program that a terminal runs.
const TERMINAL: &str = "pilotage";

/// Packages that link all others, whose tests `--quick` runs where their own sources changed since they passed: what
/// changed below them has tests of its own, and the lints compile them against it.
pub const SURFACES: [&str; 3] = ["pilotage-jobs", "pilotage-ui", "pilotage-cli"];

/// A test program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CheckProgram {
    /// Package and target, such as `pilotage-tests/scenarios`.
    pub name: String,
    /// The file that is run.
    pub executable: PathBuf,
    /// The folder of its package, in which its tests expect to be run.
    pub folder: PathBuf,
    /// Words that it is given.
    pub arguments: Vec<String>,
    /// Variables that it finds beside those of all.
    pub environment: Vec<(&'static str, OsString)>,
}

impl CheckProgram {
    /// Its place in the order in which they begin.
    pub fn rank(&self) -> usize {
        let target = self.name.rsplit('/').next();
        let mut order = LONG.iter().chain(&EARLY);
        let place = order.position(|early| Some(*early) == target);
        place.unwrap_or(LONG.len() + EARLY.len())
    }

    /// Whether it asks other people's programs.
    pub fn asks_oracles(&self) -> bool {
        let target = self.name.rsplit('/').next();
        target.is_some_and(|target| target.starts_with("oracle"))
    }

    /// Whether the program takes so long that `--quick` leaves it out.
    pub fn takes_long(&self) -> bool {
        self.rank() < LONG.len()
    }
}

/// The test program that a message of cargo tells of.
pub fn of_message(line: &str) -> Option<CheckProgram> {
    let message: Value = serde_json::from_str(line).ok()?;
    message["profile"]["test"].as_bool().filter(|test| *test)?;
    program(&message)
}

/// The program of the terminal, if cargo's `messages` tell of it.
pub fn terminal(messages: &str) -> Option<CheckProgram> {
    let mut found = messages
        .lines()
        .filter_map(|line| named_in_message(TERMINAL, line));
    found.next()
}

/// The program `name`, which is no test, if it is what a message of cargo tells of.
fn named_in_message(name: &str, line: &str) -> Option<CheckProgram> {
    let message: Value = serde_json::from_str(line).ok()?;
    let is_named = message["target"]["name"] == name && message["target"]["kind"][0] == "bin";
    let is_test = message["profile"]["test"].as_bool()?;
    (is_named && !is_test).then(|| program(&message))?
}

fn program(message: &Value) -> Option<CheckProgram> {
    let executable = PathBuf::from(message["executable"].as_str()?);
    let folder = Path::new(message["manifest_path"].as_str()?).parent()?;
    let target = message["target"]["name"].as_str()?;
    // `path+file:///…/crates/ui#pilotage-ui@0.1.0`, or without a name where the folder has it
    let id = message["package_id"].as_str()?.rsplit('#').next()?;
    let package = match id.split_once('@') {
        Some((name, _)) => name.to_owned(),
        None => folder.file_name()?.to_str()?.to_owned(),
    };
    Some(CheckProgram {
        name: format!("{package}/{target}"),
        executable,
        folder: folder.to_owned(),
        arguments: Vec::new(),
        environment: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_are_read_from_what_cargo_says() {
        let line = r#"{"reason":"compiler-artifact","package_id":"path+file:///r/crates/core/plan#pilotage-plan@0.1.0","manifest_path":"/r/crates/core/plan/Cargo.toml","target":{"name":"scenarios"},"profile":{"test":true},"executable":"/r/target/debug/deps/scenarios-1"}"#;
        let program = of_message(line).unwrap();
        assert_eq!(program.name, "pilotage-plan/scenarios");
        assert_eq!(program.folder, Path::new("/r/crates/core/plan"));
        assert!(program.takes_long());
        let unnamed = line.replace("#pilotage-plan@0.1.0", "#0.1.0");
        assert_eq!(of_message(&unnamed).unwrap().name, "plan/scenarios");
        for other in [
            line.replace("\"test\":true", "\"test\":false"),
            line.replace("\"/r/target/debug/deps/scenarios-1\"", "null"),
            r#"{"reason":"build-finished","success":true}"#.to_owned(),
            String::new(),
        ] {
            assert_eq!(of_message(&other), None, "{other}");
        }
        assert!(!program.asks_oracles());
    }

    #[test]
    fn a_program_is_told_from_the_tests_of_it() {
        let tests = r#"{"reason":"compiler-artifact","package_id":"path+file:///r/crates/cli#pilotage-cli@0.2.0","manifest_path":"/r/crates/cli/Cargo.toml","target":{"kind":["bin"],"name":"pilotage"},"profile":{"test":true},"executable":"/r/target/debug/deps/pilotage-1"}"#;
        let itself = tests.replace("\"test\":true", "\"test\":false");
        assert_eq!(named_in_message("pilotage", tests), None);
        assert_eq!(named_in_message("pilot", &itself), None);
        let found = named_in_message("pilotage", &itself).unwrap();
        assert_eq!(found.name, "pilotage-cli/pilotage");
    }
}
