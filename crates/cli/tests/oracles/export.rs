//! `pilotage export` as a user calls it: every value of every log at hand beside the format's other readers.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use pilotage_tests::data::shared;
use pilotage_tests::logs::dataflash::Form;
use pilotage_tests::logs::made;
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Topics of a log that are compared as tables, too; every call reads the whole log again.
const TABLES: usize = 4;

#[derive(Serialize)]
struct Question<'a> {
    log: &'a Path,
    format: &'a str,
    json: &'a Path,
    tables: BTreeMap<String, [PathBuf; 2]>,
}

#[derive(Deserialize)]
struct Answer {
    topics: usize,
    rows: usize,
    values: usize,
    table_values: usize,
    differences: Vec<String>,
}

/// A folder for what is exported, which goes when it is dropped.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let name = format!("pilotage-export-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
        Self(folder)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

fn export(log: &Path, arguments: &[&str], out: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pilotage"));
    command.arg("export").arg(log).args(arguments).arg("--out");
    let done = command.arg(out).output().expect("the program starts");
    let told = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{told}");
}

/// Topics whose tables are compared: the first, the last and some between.
fn some_topics(exported: &Path) -> Vec<String> {
    let bytes = std::fs::read(exported).expect("it was written");
    let topics: BTreeMap<String, Value> = serde_json::from_slice(&bytes).expect("it is JSON");
    let step = topics.len().div_ceil(TABLES).max(1);
    topics.into_keys().step_by(step).collect()
}

/// Compares all that `export` writes of a log, and says how much that was.
fn compare(folder: &Scratch, log: &Path, format: &str) -> Option<Answer> {
    let begun = Instant::now();
    let exported = folder.0.join("all.json");
    export(log, &["--format", "json"], &exported);
    let tables = some_topics(&exported).into_iter().enumerate();
    let tables = tables.map(|(index, topic)| {
        let paths = ["csv", "parquet"].map(|form| {
            // The name of the file says the form.
            let path = folder.0.join(format!("{index}.{form}"));
            export(log, &["--topic", &topic], &path);
            path
        });
        (topic, paths)
    });
    let question = Question {
        log,
        format,
        json: &exported,
        tables: tables.collect(),
    };
    let answer: Answer = ask("export_values.py", &question)?;
    println!(
        "{}: {} topics, {} rows, {} values, {} of tables; {:.1} s",
        log.file_name().unwrap_or_default().to_string_lossy(),
        answer.topics,
        answer.rows,
        answer.values,
        answer.table_values,
        begun.elapsed().as_secs_f64()
    );
    let told = answer.differences.join("\n");
    assert!(told.is_empty(), "{}:\n{told}", log.display());
    assert!(answer.values > 500 && answer.table_values > 0);
    Some(answer)
}

/// Recorded logs of a folder of the shared data with an ending.
fn recorded(folder: &str, ending: &str) -> Vec<PathBuf> {
    let entries = shared(folder).and_then(|folder| std::fs::read_dir(folder).ok());
    let paths = entries.into_iter().flatten().flatten().map(|e| e.path());
    let is_it = |path: &PathBuf| {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(ending))
    };
    let mut found: Vec<PathBuf> = paths.filter(is_it).collect();
    found.sort();
    found
}

#[test]
fn every_value_of_recorded_logs_is_the_one_that_pyulog_reads() {
    let folder = Scratch::new("ulog");
    for log in recorded("px4_ulog", "ulg") {
        compare(&folder, &log, "ulog");
    }
}

#[test]
fn every_value_of_recorded_and_made_dataflash_logs_is_the_one_that_pymavlink_reads() {
    let folder = Scratch::new("dataflash");
    for log in recorded("ardupilot_bin", "bin") {
        compare(&folder, &log, "dataflash");
    }
    for (name, form, bytes) in [
        (
            "modern.bin",
            "dataflash",
            made::modern(Form::Binary, 1, 200),
        ),
        ("2013.bin", "dataflash", made::of_2013(Form::Binary, 100)),
        ("modern.log", "text", made::modern(Form::Text, 1, 200)),
        ("2013.log", "text", made::of_2013(Form::Text, 100)),
    ] {
        let log = folder.0.join(name);
        std::fs::write(&log, bytes).expect("the temporary folder can be written");
        compare(&folder, &log, form);
    }
}

#[test]
fn every_value_of_a_telemetry_log_with_every_message_is_the_one_that_pymavlink_reads() {
    let folder = Scratch::new("tlog");
    for (seed, version) in [(1, 1), (2, 2)] {
        let log = folder.0.join(format!("{version}.tlog"));
        let question = json!({ "path": log, "seed": seed, "version": version });
        if ask::<_, Value>("pymavlink_tlog.py", &question).is_some() {
            compare(&folder, &log, "tlog");
        }
    }
}

#[test]
fn every_value_of_an_mcap_file_is_the_one_that_its_own_libraries_read() {
    let folder = Scratch::new("mcap");
    let log = folder.0.join("every.mcap");
    let question = json!({ "path": log, "packing": "zstd", "chunks": true, "seed": 5 });
    if ask::<_, Value>("mcap_read.py", &question).is_some() {
        compare(&folder, &log, "mcap");
    }
}
