//! Cascades over a picture beside OpenCV's, in one run.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use pilotage_core::landmark::cascade::{Cascade, ScanSettings, scan};
use pilotage_core::raster::{decode_picture, luminance};

use crate::CommandResult;

/// Runs of which the best counts.
const RUNS: usize = 7;
/// Text where nothing was timed.
const NONE: &str = "–";

const SCRIPT: &str = r"
import sys, time, cv2
cv2.setNumThreads(1)
g = cv2.imread(sys.argv[1], cv2.IMREAD_GRAYSCALE)
c = cv2.CascadeClassifier(sys.argv[3]); best = float('inf')
for _ in range(int(sys.argv[2])):
    s = time.perf_counter(); r = c.detectMultiScale(g, 1.1, 0)
    best = min(best, time.perf_counter() - s)
print(best * 1e3, len(r))
";

/// All cascades (`.xml`) in the folders below `folder`, by name.
fn files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for below in fs::read_dir(folder)? {
        let below = below?.path();
        if below.is_dir() {
            for entry in fs::read_dir(below)? {
                files.push(entry?.path());
            }
        }
    }
    files.retain(|path| path.extension().is_some_and(|e| e == "xml"));
    files.sort();
    Ok(files)
}

/// Milliseconds and windows found by OpenCV.
fn theirs(
    python: &str,
    picture: &Path,
    file: &Path,
) -> Result<(f64, usize), Box<dyn std::error::Error>> {
    let out = Command::new(python)
        .args(["-c", SCRIPT])
        .arg(picture)
        .arg(RUNS.to_string())
        .arg(file)
        .output()?;
    if !out.status.success() {
        return Err(String::from_utf8_lossy(&out.stderr).into_owned().into());
    }
    let said = String::from_utf8_lossy(&out.stdout);
    let (time, count) = said.trim().split_once(' ').ok_or("OpenCV said nothing")?;
    Ok((time.parse()?, count.parse()?))
}

/// Prints a row for each cascade below `folder` over `picture`, beside OpenCV's times where there is a
/// `python` and our own in WebAssembly where they are given (milliseconds by name).
pub fn run(
    folder: &Path,
    picture: &Path,
    python: Option<&str>,
    wasm: Option<&BTreeMap<String, f64>>,
) -> CommandResult {
    let files = files(folder)?;
    let gray = decode_picture(&fs::read(picture)?)?.map(|colour| luminance(colour).round() as u8);
    println!(
        "{:44} {:>11} {:>11} {:>8} {:>11} {:>9}",
        "cascade, every scale by 1.1", "ours, ms", "theirs, ms", "ratio", "wasm, ms", "to native"
    );
    for path in &files {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let cascade = Cascade::read(&name, &fs::read_to_string(path)?)?;
        let (mut best, mut found) = (f64::INFINITY, 0);
        for _ in 0..RUNS {
            let start = Instant::now();
            found = scan(&cascade, &gray, &ScanSettings::default()).len();
            best = best.min(start.elapsed().as_secs_f64() * 1e3);
        }
        // One right after the other: what else the machine does concerns both.
        let theirs = python.map(|python| theirs(python, picture, path));
        let (time, ratio, note) = match theirs.transpose()? {
            Some((time, count)) => {
                let note = if count == found { "" } else { "  finds others" };
                (format!("{time:.1}"), format!("{:.2}", time / best), note)
            }
            None => (NONE.to_owned(), NONE.to_owned(), ""),
        };
        let (in_wasm, slower) = match wasm.and_then(|times| times.get(name.as_ref())) {
            Some(time) => (format!("{time:.1}"), format!("{:.2}", time / best)),
            None => (NONE.to_owned(), NONE.to_owned()),
        };
        println!("{name:44} {best:11.1} {time:>11} {ratio:>8} {in_wasm:>11} {slower:>9}{note}");
    }
    Ok(())
}
