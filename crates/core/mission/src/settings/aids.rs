//! Aids beside pictures that people switch on.

use serde::{Deserialize, Serialize};

/// An aid that is switched on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChosenAid {
    /// Name of the aid in files.
    pub key: String,
    /// Names and values of its numbers that are not the usual ones, SI.
    #[serde(default)]
    pub numbers: Vec<(String, f64)>,
}

impl ChosenAid {
    /// The aid of that name with its usual numbers.
    pub fn usual(key: &str) -> Self {
        Self {
            key: key.to_owned(),
            numbers: Vec::new(),
        }
    }

    /// The same with one of its numbers set, SI.
    #[must_use]
    pub fn with(mut self, number: &str, value: f64) -> Self {
        self.numbers.retain(|(name, _)| name != number);
        self.numbers.push((number.to_owned(), value));
        self
    }
}
