//! Matches of landmarks: why one was believed or not.

mod feature;

pub use feature::MatchFeature;
