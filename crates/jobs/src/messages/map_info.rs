//! Description of a map.

use pilotage_core::frames::{Geodetic, GroundRect};
use serde::{Deserialize, Serialize};

/// A picture that does not say where it lies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unplaced {
    /// Its name among the files.
    pub name: String,
    /// A file of control points beside it.
    pub points: Option<String>,
}

/// Description of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapInfo {
    /// Name for people.
    pub name: String,
    /// The ground that has pixels.
    pub bounds: GroundRect,
    /// Finest ground sample distance, metres per pixel.
    pub native_gsd: f64,
    /// Whether a coarser window of the same ground costs less than a fine one.
    pub is_coarse_cheap: bool,
    /// Origin of the world frame it lies in, if it has a place on the globe.
    pub origin: Option<Geodetic>,
    /// Who made it, where the map says so itself.
    pub attribution: Option<String>,
}
