//! Name of the format.

/// Name for people.
pub(in super::super) const NAME: &str = "DJI WPML";
