//! Estimators and vehicle models beside each other.

use serde::{Deserialize, Serialize};

use super::{ComparisonRow, ContenderTally};

/// Estimators and models over the same flights, in one table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EstimatorComparison {
    /// A line per contender, and one more for its smoothed estimates where those were asked for.
    pub rows: Vec<ComparisonRow>,
}

impl EstimatorComparison {
    /// The table of what was tallied.
    pub fn of(tallies: &[ContenderTally]) -> Self {
        Self {
            rows: tallies.iter().flat_map(ContenderTally::rows).collect(),
        }
    }
}
