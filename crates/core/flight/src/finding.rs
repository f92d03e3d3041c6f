//! What looks wrong, in words.

use serde::{Deserialize, Serialize};

/// How much a finding matters.
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
    /// How much it matters.
    pub severity: Severity,
    /// What it is, in a few words.
    pub title: String,
    /// What was measured and what follows, in a sentence or two.
    pub text: String,
    /// When, seconds in the log's time base, where it has a time.
    pub span: Option<(f64, f64)>,
}
