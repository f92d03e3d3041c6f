//! Flights out of text of other kinds, brought into tables: the receiver's sentences, the subtitles of films.

use std::fmt::Write as _;
use std::sync::Arc;

use crate::columns::{flight_of_tables, guess_table};
use crate::folder::{FlightFolder, FolderError};
use pilotage_base::files::{FileSet, MemoryFiles};

/// The flight of the first file with the ending that `read` finds one in, by name; `None` if there is none. Files behind it
/// are left out with a note that says `because`.
///
/// # Errors
/// Those of `read`.
pub fn first_flight(
    files: &dyn FileSet,
    ending: &str,
    because: &str,
    read: impl Fn(&str, &[u8]) -> Result<Option<FlightFolder>, FolderError>,
) -> Result<Option<FlightFolder>, FolderError> {
    let mut names = files.names();
    names.retain(|name| name.to_lowercase().ends_with(ending));
    names.sort();
    let mut found: Option<FlightFolder> = None;
    for name in names {
        let Some(bytes) = files.read(&name) else {
            continue;
        };
        if let Some(first) = &mut found {
            let note = format!("{name} was left out: {because}");
            first.notes.push(note);
            continue;
        }
        found = read(&name, &bytes)?;
    }
    Ok(found)
}

/// A table of rows, whose times are text in the column `time`, with those columns in which any row has a value.
pub fn table<const N: usize>(
    time: &str,
    columns: [&str; N],
    rows: &[(String, [Option<f64>; N])],
) -> String {
    let is_told = |column: &usize| rows.iter().any(|(_, values)| values[*column].is_some());
    let told: Vec<usize> = (0..N).filter(is_told).collect();
    let names: Vec<&str> = told.iter().map(|column| columns[*column]).collect();
    let mut table = format!("{time},{}\n", names.join(","));
    for (time, values) in rows {
        let cell = |column: &usize| values[*column].map_or_else(String::new, |v| v.to_string());
        let cells: Vec<String> = told.iter().map(cell).collect();
        let _ = writeln!(table, "{time},{}", cells.join(","));
    }
    table
}

/// The flight of the table that the file `name` was brought into; `None` if it says nothing of one. `findings` are told of
/// it.
///
/// # Errors
/// A table of which no flight can be made.
pub fn flight_of_table(
    name: &str,
    table: String,
    findings: Vec<String>,
) -> Result<Option<FlightFolder>, FolderError> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let file = format!("{stem}.csv");
    let Some(mut map) = guess_table(&file, table.as_bytes()) else {
        return Ok(None);
    };
    map.findings.extend(findings);
    let files: Arc<dyn FileSet> = Arc::new(MemoryFiles([(file, table.into_bytes())].into()));
    flight_of_tables(&files, &[map]).map(Some)
}
