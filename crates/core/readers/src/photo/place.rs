//! Place of a photo, and who tells it.

use serde::{Deserialize, Serialize};

/// Place at which a photo was taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoPlace {
    /// Radians, north positive.
    pub latitude: f64,
    /// Radians, east positive.
    pub longitude: f64,
    /// Metres above sea level, or what the camera takes for it, where it says so.
    pub altitude: Option<f64>,
}

/// Source of the place of a photo, and of what it does not say itself of its height and angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PhotoPlaceSource {
    /// The photo's own file.
    #[default]
    Photo,
    /// A table beside it.
    Table,
}
