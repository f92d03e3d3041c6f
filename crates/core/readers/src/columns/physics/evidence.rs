//! Samples of a table: knowledge of it besides its map.

use crate::columns::groups::ColumnGroup;
use crate::columns::rows::EvenRows;

/// Meaning that a column's name says for sure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::columns) struct Hint {
    /// Whether the table states its unit.
    pub is_stated: bool,
    /// Whether it is one of several that are called by the letters or numbers of axes, so that nobody knows which.
    pub is_axis: bool,
}

/// Knowledge of a table besides its map.
#[derive(Debug)]
pub(in crate::columns) struct TableEvidence {
    pub rows: EvenRows,
    pub hints: Vec<Hint>,
    pub groups: Vec<ColumnGroup>,
}
