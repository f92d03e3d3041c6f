//! `pilotage study results`: the section about studies of the measured results, made from their records.

use std::path::{Path, PathBuf};

use pilotage_study::StudyRecord;

use crate::CommandResult;
use crate::files::write_whole;

/// Line before what is made from records, and the line behind it.
const MARKS: [&str; 2] = [
    "<!-- made by `pilotage study results studies/records --write docs/results.md` -->",
    "<!-- end of what is made -->",
];

/// Head of the table.
const HEAD: &str = "| study, cell | flights | flown | means [95 %] |\n|---|---|---|---|\n";

/// Arguments of `pilotage study results`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of records, as `pilotage study PLAN --record FOLDER` writes them.
    records: PathBuf,
    /// Document whose lines between the two marks are made anew, in place of printing them.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
}

/// Prints or writes the section.
pub fn run(arguments: &Arguments) -> CommandResult {
    let section = section(&read(&arguments.records)?);
    let Some(path) = &arguments.write else {
        print!("{section}");
        return Ok(());
    };
    let blame = |why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let text = std::fs::read_to_string(path).map_err(|why| blame(&why))?;
    let made = with_section(&text, &section).map_err(|why| blame(&why))?;
    Ok(write_whole(path, made)?)
}

/// The file of the record of a study.
pub fn place(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.json"))
}

/// The records of a folder, by their names.
fn read(folder: &Path) -> Result<Vec<StudyRecord>, String> {
    let blame = |path: &Path, why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let entries = std::fs::read_dir(folder).map_err(|why| blame(folder, &why))?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path()));
    let mut paths: Vec<PathBuf> = paths
        .collect::<Result<_, _>>()
        .map_err(|why| blame(folder, &why))?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "json"));
    paths.sort();
    let records = paths.iter().map(|path| {
        let text = std::fs::read_to_string(path).map_err(|why| blame(path, &why))?;
        serde_json::from_str(&text).map_err(|why| blame(path, &why))
    });
    records.collect()
}

fn section(records: &[StudyRecord]) -> String {
    let lines: String = records.iter().map(StudyRecord::lines).collect();
    format!("{HEAD}{lines}")
}

/// `text` with `section` between its marks.
fn with_section(text: &str, section: &str) -> Result<String, String> {
    let [begin, end] = MARKS;
    let parts = text.split_once(begin).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(end)?;
        Some((before, after))
    });
    let Some((before, after)) = parts else {
        return Err(format!(
            "it has no line \"{begin}\" with \"{end}\" behind it"
        ));
    };
    Ok(format!("{before}{begin}\n\n{section}{end}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_between_the_marks_is_made_anew_and_the_rest_is_kept() {
        let [begin, end] = MARKS;
        let text = format!("# Results\n{begin}\nold\n{end}\nmore\n");
        let made = with_section(&text, "new\n").unwrap();
        assert_eq!(made, format!("# Results\n{begin}\n\nnew\n{end}\nmore\n"));
        assert_eq!(with_section(&made, "new\n"), Ok(made.clone()));
        assert!(with_section("# Results\n", "new\n").is_err());
    }
}
