//! Times how a log is read, beside pymavlink.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use pilotage_core::flight::log::{HEAD, Log, recognise};

/// Bytes that the reader is fed at once.
const PIECE: usize = 1 << 20;
/// Runs of which the best counts.
const RUNS: usize = 3;

const SCRIPT: &str = r"
import sys, time
from pymavlink import DFReader
start = time.perf_counter()
log, count = DFReader.DFReader_binary(sys.argv[1]), 0
while log.recv_msg() is not None:
    count += 1
print(time.perf_counter() - start, count)
";

/// Reads `path` and prints how long that takes.
pub fn measure(path: &Path, python: Option<&str>) -> Result<(), Box<dyn std::error::Error>> {
    let megabytes = path.metadata()?.len() as f64 / 1e6;
    let mut best = f64::INFINITY;
    let mut messages = 0;
    for _ in 0..RUNS {
        let start = Instant::now();
        let log = read(path)?;
        best = best.min(start.elapsed().as_secs_f64());
        messages = log.report.messages;
        println!(
            "here: {:.2} s, {messages} messages, {} topics, log of {:.0} MB in memory, {} bytes skipped",
            start.elapsed().as_secs_f64(),
            log.topics.len(),
            log.memory() as f64 / 1e6,
            log.report.skipped_bytes,
        );
    }
    println!(
        "{megabytes:.0} MB at {:.0} MB/s; {}",
        megabytes / best,
        memory()
    );
    let Some(python) = python else {
        return Ok(());
    };
    let out = Command::new(python)
        .args(["-c", SCRIPT])
        .arg(path)
        .output()?;
    if !out.status.success() {
        return Err(String::from_utf8_lossy(&out.stderr).into_owned().into());
    }
    let said = String::from_utf8_lossy(&out.stdout);
    let (time, count) = said
        .trim()
        .split_once(' ')
        .ok_or("pymavlink said nothing")?;
    let time: f64 = time.parse()?;
    println!("pymavlink: {time:.1} s, {count} messages");
    println!("ratio {:.0}", time / best);
    if count.parse() == Ok(messages) {
        Ok(())
    } else {
        Err("pymavlink reads another number of messages".into())
    }
}

/// The log, read from the file in pieces.
fn read(path: &Path) -> Result<Log, Box<dyn std::error::Error>> {
    let mut file = File::open(path)?;
    let mut piece = vec![0; PIECE];
    let mut count = file.read(&mut piece)?;
    let info = recognise(&piece[..count.min(HEAD)]).ok_or("no log")?;
    let mut reader = (info.reader)();
    let mut log = Log::new(path.to_string_lossy(), info.format);
    while count > 0 {
        reader.feed(&piece[..count], &mut log);
        count = file.read(&mut piece)?;
    }
    reader.finish(&mut log);
    Ok(log)
}

/// Memory of this process, where the system tells it.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let peak = peak.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    peak.map_or_else(String::new, |kilobytes| {
        format!("memory at its peak {:.0} MB", kilobytes / 1e3)
    })
}
