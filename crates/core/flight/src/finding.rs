//! Findings: something that looks wrong, in words.

use serde::{Deserialize, Serialize};

/// Weight of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// Results may suffer.
    Warning,
    /// Results cannot be trusted while it stays.
    Trouble,
}

/// Something that looks wrong.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its weight.
    pub severity: Severity,
    /// Its name, in a few words.
    pub title: String,
    /// The measurement and its consequence, in a sentence or two; times in it are moments
    /// ([`moment`](crate::moment)).
    pub text: String,
    /// Its time, seconds in the log's time base, where it has a time.
    pub span: Option<(f64, f64)>,
}
