//! Estimators and vehicle models beside each other.

use serde::{Deserialize, Serialize};

use super::{ComparisonRow, Tally};

/// Estimators and models over the same flights, in one table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// A line per contender, and one more for its smoothed estimates where those were asked for.
    pub rows: Vec<ComparisonRow>,
}

impl Comparison {
    /// The table of what was tallied.
    pub fn of(tallies: &[Tally]) -> Self {
        Self {
            rows: tallies.iter().flat_map(Tally::rows).collect(),
        }
    }
}
