//! Numbers with the user's units.

use serde::{Deserialize, Serialize};

/// Units that people read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Metres, metres per second.
    #[default]
    Metric,
    /// Feet, knots.
    Aviation,
}

impl Units {
    /// Factor from metres, and the unit's name.
    pub fn length(self) -> (f64, &'static str) {
        match self {
            Self::Metric => (1.0, "m"),
            Self::Aviation => (1.0 / 0.3048, "ft"),
        }
    }

    /// Factor from metres per second, and the unit's name.
    pub fn speed(self) -> (f64, &'static str) {
        match self {
            Self::Metric => (1.0, "m/s"),
            Self::Aviation => (3600.0 / 1852.0, "kt"),
        }
    }
}
