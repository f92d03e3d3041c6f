//! Classes of whole tiles by their words, for `pilotage classes`.

use std::path::{Path, PathBuf};

use pilotage_core::raster::{Gray, decode_picture};
use pilotage_core::training::words::{WordClassifier, WordTraining, WordWindow};

use crate::CommandResult;
use crate::files::write_whole;

/// Ranges of probabilities over which their truth is counted.
const RANGES: usize = 10;

/// Learns the folders of `folder`, a class each.
pub fn train(folder: &Path, seed: u64, out: &Path) -> CommandResult {
    let names = class_names(folder)?;
    let mut windows = Vec::new();
    for (class, name) in names.iter().enumerate() {
        for picture in pictures(&folder.join(name))? {
            windows.push(WordWindow::of(&picture, class));
        }
    }
    println!("{} tiles of {}", windows.len(), names.join(", "));
    let training = WordTraining {
        seed,
        ..WordTraining::default()
    };
    write_whole(out, training.train(&windows, &names)?.to_bytes())?;
    println!("wrote {}", out.display());
    Ok(())
}

/// Prints how the folders of `folder` are told.
pub fn judge(folder: &Path, weights: &Path) -> CommandResult {
    let bytes = std::fs::read(weights).map_err(|e| format!("{}: {e}", weights.display()))?;
    let classifier = WordClassifier::from_bytes(&bytes)?;
    let names = classifier.names();
    let mut ranges = [(0.0, 0.0); RANGES];
    let (mut all, mut right) = (0_u32, 0_u32);
    println!("tiles by class (rows) as told: {}", names.join(", "));
    for (class, name) in names.iter().enumerate() {
        let mut row = vec![0_usize; names.len()];
        for picture in pictures(&folder.join(name))? {
            let told = classifier.probabilities(&WordWindow::of(&picture, class).descriptors);
            let likeliest = (0..told.len()).max_by(|a, b| told[*a].total_cmp(&told[*b]));
            let likeliest = likeliest.unwrap_or_default();
            row[likeliest] += 1;
            let is_right = likeliest == class;
            let range = ((told[likeliest] * RANGES as f64) as usize).min(RANGES - 1);
            ranges[range].0 += told[likeliest];
            ranges[range].1 += f64::from(u8::from(is_right));
            all += 1;
            right += u32::from(is_right);
        }
        println!("{name}: {row:?}");
    }
    let apart: f64 = ranges
        .iter()
        .map(|(said, true_)| (said - true_).abs())
        .sum();
    let count = f64::from(all.max(1));
    println!(
        "right {:.4} of {all} tiles, calibration error {:.4}",
        f64::from(right) / count,
        apart / count
    );
    Ok(())
}

/// Names of the folders, in their order.
fn class_names(folder: &Path) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let mut names = Vec::new();
    for path in entries(folder)?.into_iter().filter(|path| path.is_dir()) {
        let name = path.file_name().and_then(|name| name.to_str());
        names.extend(name.map(str::to_owned));
    }
    if names.len() < 2 {
        let folder = folder.display();
        return Err(format!("{folder}: there are not two folders, one for each class").into());
    }
    Ok(names)
}

/// Brightness of the pictures of a folder.
fn pictures(folder: &Path) -> Result<Vec<Gray>, Box<dyn std::error::Error>> {
    let mut pictures = Vec::new();
    for path in entries(folder)? {
        let bytes = std::fs::read(&path)?;
        let picture = decode_picture(&bytes).map_err(|e| format!("{}: {e}", path.display()))?;
        pictures.push(picture.to_gray());
    }
    Ok(pictures)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn std::error::Error>> {
    let all = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut paths: Vec<PathBuf> = all.map(|e| e.map(|e| e.path())).collect::<Result<_, _>>()?;
    paths.sort();
    Ok(paths)
}
