//! Makes a very large map and times how it is read.
//!
//! `cargo run -p pilotage-tests --example large_map -- write FILE [--overviews]` streams a tiled
//! `GeoTIFF` of 22,167 × 25,100 pixels to disk, `… -- measure FILE` opens any `GeoTIFF` and prints how
//! long windows take and how much memory they cost.

mod measure;
mod writer;

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["write", file] => writer::write(Path::new(file), false)?,
        ["write", file, "--overviews"] => writer::write(Path::new(file), true)?,
        ["measure", file] => measure::measure(Path::new(file))?,
        _ => return Err("say: write FILE [--overviews], or measure FILE".into()),
    }
    Ok(())
}
