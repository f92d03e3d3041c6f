//! Photos to be laid on a map, each by itself.

use pilotage_core::flight::photo::{PhotoAnswer, PhotoRows, PhotoSearch, RegisteredPhoto};
use pilotage_core::frames::{Geodetic, GroundRect};
use serde::{Deserialize, Serialize};

use super::MapSource;

/// Photos to be laid on a map one after the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotosOrder {
    /// Key of the files that the photos are among.
    pub key: String,
    /// Their names, in order.
    pub names: Vec<String>,
    /// The map.
    pub map: MapSource,
    /// Origin of the map's world frame, if it has a place on the globe.
    pub origin: Option<Geodetic>,
    /// Ground over which a photo is searched of which no place is known.
    pub ground: GroundRect,
    /// Prior of the pose, and the range around it that is searched.
    pub search: PhotoSearch,
    /// Places of the photos in tables beside them, by their names; looked for among the files if `None`.
    pub rows: Option<PhotoRows>,
}

/// Result of laying a photo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoReport {
    /// Its number in the order.
    pub number: usize,
    /// Place of the photo, or why it was not laid.
    pub answer: PhotoAnswer,
    /// Time of the search, without reading the photo, milliseconds.
    pub computed: f64,
}

/// A laid photo to be shown on the map in its own colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DrapeOrder {
    /// Key of the files that it is among.
    pub key: String,
    /// Its name.
    pub name: String,
    /// Search with which the photo was laid.
    pub search: PhotoSearch,
    /// Place of the photo.
    pub laid: RegisteredPhoto,
}
