//! Heights that no ground has.

/// Heights beyond are marks for missing data that a file does not declare, metres.
const HIGHEST: f64 = 12_000.0;

/// Whether a number of metres may be a height; `false` for what is no number.
pub(super) fn may_be_height(metres: f64) -> bool {
    metres.abs() <= HIGHEST
}
