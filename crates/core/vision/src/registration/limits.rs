//! Limits of the search, as people state them, and the standard deviation that searches so far.

/// Standard deviations to each side that are searched.
pub(super) const REACH: f64 = 2.5;

/// Standard deviation with which the search reaches `limit` to each side, in the unit of `limit`.
pub fn deviation_within(limit: f64) -> f64 {
    limit / REACH
}

/// Farthest that a standard deviation is searched to each side, in its unit.
pub fn limit_of(deviation: f64) -> f64 {
    REACH * deviation
}

/// Standard deviation of a natural logarithm with which the search reaches a value greater by `share` (0.2 is 20 %),
/// and as many times smaller.
pub fn log_deviation_within(share: f64) -> f64 {
    share.ln_1p() / REACH
}

/// Share by which a value whose logarithm has this standard deviation is exceeded at most.
pub fn share_of(log_deviation: f64) -> f64 {
    (REACH * log_deviation).exp_m1()
}
