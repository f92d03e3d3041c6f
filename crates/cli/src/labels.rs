//! Files of labels, Pascal VOC and COCO: what is in them, and one made of the other.

use std::collections::BTreeMap;
use std::path::Path;

use pilotage_core::exchange::labels::{FoundLabels, LabelFormat, write_labels};
use pilotage_core::flight::files::MemoryFiles;
use pilotage_jobs::labels;

use crate::CommandResult;
use crate::files::DirectoryFiles;
use crate::opening::{has_ending, unpacked};

/// The labels at a path: a file, a zip or a folder of them, with the format of the first. `None` if there are none.
///
/// # Errors
/// A file of labels that cannot be read.
pub fn read(path: &Path) -> Result<Option<(LabelFormat, FoundLabels)>, Box<dyn std::error::Error>> {
    if path.is_dir() {
        return Ok(labels(&DirectoryFiles::open(path)?)?);
    }
    if has_ending(path, &["zip"]) {
        let files = unpacked(path)?;
        return Ok(files.map_or(Ok(None), |files| labels(files.as_ref()))?);
    }
    if !has_ending(path, &["xml", "json"]) {
        return Ok(None);
    }
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|e| format!("{name}: {e}"))?;
    Ok(labels(&MemoryFiles([(name, bytes)].into()))?)
}

/// Prints what labels there are.
pub fn describe(format: LabelFormat, labels: FoundLabels) {
    let (frames, notes) = labels.numbered();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for label in frames.iter().flat_map(|frame| &frame.boxes) {
        *counts.entry(&label.name).or_default() += 1;
    }
    println!(
        "{} labels: {} boxes in {} pictures",
        format.name(),
        counts.values().sum::<usize>(),
        frames.len()
    );
    for (name, count) in counts {
        println!("    {name:32} {count:6} boxes");
    }
    for note in notes {
        println!("note: {note}");
    }
}

/// Writes labels to a file: COCO where it ends in .json, Pascal VOC where in .zip.
pub fn convert(labels: FoundLabels, to: &Path) -> CommandResult {
    let format = if has_ending(to, &["json"]) {
        LabelFormat::Coco
    } else if has_ending(to, &["zip"]) {
        LabelFormat::Voc
    } else {
        return Err(format!(
            "{}: labels are written to .json (COCO) or .zip (Pascal VOC)",
            to.display()
        )
        .into());
    };
    let (frames, notes) = labels.numbered();
    let written = write_labels(format, &frames, &[])?;
    crate::files::write_whole(to, written.bytes)?;
    for note in notes {
        eprintln!("note: {note}");
    }
    println!(
        "{}: {}: {}",
        to.display(),
        format.name(),
        written.notes.join("; ")
    );
    Ok(())
}
