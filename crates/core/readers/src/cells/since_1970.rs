//! Times of flights.

/// Seconds since 1970 of flights: from 1990 to 2040.
const EPOCH: std::ops::Range<f64> = 6.3e8..2.3e9;

/// Whether a flight may have been so many seconds after the beginning of 1970.
pub(crate) fn is_since_1970(seconds: f64) -> bool {
    EPOCH.contains(&seconds)
}
