//! Keys of a `GeoTIFF` that tell its system by a code, and those that tell it by its parts. After OGC 19-008r4,
//! chapter 7.

/// Kind of coordinates: 1 projected, 2 geographic.
pub(crate) const MODEL_TYPE: u64 = 1024;
/// Code of the geographic system.
pub(crate) const GEOGRAPHIC_TYPE: u64 = 2048;
/// Name of the geographic system.
pub(crate) const GEOGRAPHIC_CITATION: u64 = 2049;
/// Code of the unit of lengths.
pub(crate) const LINEAR_UNITS: u64 = 3076;
/// Value in the place of a code: the system or unit is described, not named.
pub(crate) const USER_DEFINED: u64 = 32_767;
