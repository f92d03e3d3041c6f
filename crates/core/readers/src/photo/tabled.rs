//! Photos without a place that a table beside them tells of.

use std::collections::HashSet;

use super::read::Photo;
use pilotage_base::files::{FileSet, file_of, names_ending_in};

/// Endings of tables.
const TABLES: [&str; 3] = ["csv", "tsv", "txt"];

/// Whether a table among `files` names more of the `pictures` that are no photo with a place than there are such photos: the
/// flight is that of the table then, beside whose frames some originals lie.
pub(super) fn are_of_a_table(pictures: &[String], photos: &[Photo], files: &dyn FileSet) -> bool {
    let placed = photos.iter().filter(|photo| photo.place.is_some());
    let placed: HashSet<&str> = placed.map(|photo| &*photo.name).collect();
    let others = pictures.iter().filter(|name| !placed.contains(&***name));
    let others: Vec<&str> = others.map(|name| file_of(name)).collect();
    if others.len() <= placed.len() {
        return false;
    }
    let names = names_ending_in(files, &TABLES);
    names
        .iter()
        .filter_map(|name| files.read(name))
        .any(|table| {
            let table = String::from_utf8_lossy(&table);
            let is_between = |c: char| matches!(c, ',' | ';' | '\t' | '|' | '"' | '\r' | '\n');
            let cells: HashSet<&str> = table
                .split(is_between)
                .map(|cell| file_of(cell.rsplit('\\').next().unwrap_or(cell).trim()))
                .collect();
            others.iter().filter(|name| cells.contains(*name)).count() > placed.len()
        })
}
