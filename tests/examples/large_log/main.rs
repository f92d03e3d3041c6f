//! Makes a very large dataflash log and times how it is read.
//!
//! `cargo run --release -p pilotage-tests --example large_log -- write FILE [MEGABYTES]` streams a log as a
//! plane of today writes it to disk, `… -- measure FILE [PYTHON]` reads any log and prints how long that
//! took and how much memory, and beside it the time of pymavlink where a Python that has it is named.

mod measure;
mod writer;

use std::path::Path;

/// Size of the log if none is said, megabytes.
const MEGABYTES: u64 = 500;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["write", file] => writer::write(Path::new(file), MEGABYTES),
        ["write", file, size] => writer::write(Path::new(file), size.parse()?),
        ["measure", file] => measure::measure(Path::new(file), None),
        ["measure", file, python] => measure::measure(Path::new(file), Some(python)),
        _ => Err("say: write FILE [MEGABYTES], or measure FILE [PYTHON]".into()),
    }
}
