//! The rules of the house, as functions from source text to the places that break them.
//!
//! `tests/house/tests/house.rs` applies them to the repository; the tests beside each rule show it a
//! piece of bad source, so that a rule which can no longer fail is noticed. A package of its own that knows
//! none of the others, so that the rules are checked in seconds, before anything else is compiled.

pub mod additions;
pub mod circles;
pub mod docstrings;
pub mod drops;
pub mod layers;
pub mod manifest;
pub mod modules;
pub mod names;
pub mod papers;
pub mod reach;
pub mod shape;
pub mod sources;
pub mod tokens;

use std::fmt;

/// A place in the sources that breaks a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// File, relative to the root that was searched.
    pub file: String,
    /// Line, counted from one; 0 where the rule is about the whole file.
    pub line: usize,
    /// Complaint: the rule that is broken, and its remedy.
    pub complaint: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            file,
            line,
            complaint,
        } = self;
        write!(formatter, "{file}:{line}: {complaint}")
    }
}

/// Fails with one line for each violation.
///
/// # Panics
/// If there is any violation.
pub fn assert_none(violations: &[Violation]) {
    let lines: Vec<_> = violations.iter().map(ToString::to_string).collect();
    assert!(
        lines.is_empty(),
        "{} violation(s)\n{}",
        lines.len(),
        lines.join("\n")
    );
}
