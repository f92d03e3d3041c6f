//! Tables among files, by their names.

use pilotage_core::flight::columns::{GuessedTable, guess_tables};
use pilotage_core::flight::files::{FileSet, names_ending_in};

/// Endings of the names of tables.
pub const TABLES: [&str; 5] = ["csv", "tsv", "txt", "pos", "llh"];

/// Names of the files that may be tables, in order.
pub fn table_names(pool: &dyn FileSet) -> Vec<String> {
    names_ending_in(pool, &TABLES)
}

/// The tables among files, with what their columns are guessed to mean.
pub(super) fn tables_among(pool: &dyn FileSet) -> Vec<GuessedTable> {
    guess_tables(pool, &table_names(pool))
}
