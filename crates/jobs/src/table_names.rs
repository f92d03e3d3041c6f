//! Tables among files, by their names.

use pilotage_core::flight::columns::{GuessedTable, guess_tables};
use pilotage_core::flight::files::{FileSet, has_ending, names_ending_in};
use pilotage_core::flight::log::recognise;
use pilotage_core::imagery::ByteSource;

use super::log_flights::{foreign_kind, head};

/// Endings of the names of tables.
pub const TABLES: [&str; 5] = ["csv", "tsv", "txt", "pos", "llh"];

/// Endings under which some programs write tables, and others what is none.
const PERHAPS: [&str; 2] = ["log", "dat"];

/// Names of the files that may be tables, in order: by their endings, and text under some others that is no log.
///
/// ```
/// use pilotage_core::flight::files::MemoryFiles;
/// use pilotage_jobs::table_names;
///
/// let file = |(name, bytes): (&str, &[u8])| (name.to_owned(), bytes.to_vec());
/// let table = &b"time,lat,lon\n0,47,8\n1,47,8\n"[..];
/// let files = [("a.csv", table), ("b.log", table), ("c.log", b"\xa3\x95\x80"), ("d.jpg", table)];
/// assert_eq!(table_names(&MemoryFiles(files.map(file).into())), ["a.csv", "b.log"]);
/// ```
pub fn table_names(pool: &dyn FileSet) -> Vec<String> {
    let mut names = names_ending_in(pool, &TABLES);
    let others = names_ending_in(pool, &PERHAPS);
    let is_text = |name: &String| {
        pool.source(name)
            .is_some_and(|it| is_text_table(it.as_ref()))
    };
    names.extend(others.into_iter().filter(is_text));
    names.sort();
    names
}

/// Whether a file is text that may be a table, whatever it is called, and neither a log nor of another kind that is known.
pub fn is_text_table(source: &dyn ByteSource) -> bool {
    if has_ending(source.name(), &TABLES) {
        return true;
    }
    let Some(head) = head(source).filter(|head| recognise(head).is_none()) else {
        return false;
    };
    let is_text = |byte: &u8| *byte >= b' ' || byte.is_ascii_whitespace();
    head.split(|byte| *byte == b'\n').count() > 2
        && head.iter().all(is_text)
        && foreign_kind(source).is_none()
}

/// The tables among files, with what their columns are guessed to mean.
pub(super) fn tables_among(pool: &dyn FileSet) -> Vec<GuessedTable> {
    guess_tables(pool, &table_names(pool))
}
