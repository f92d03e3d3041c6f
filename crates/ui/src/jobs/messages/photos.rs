//! Photos to be laid on a map, each by itself.

use pilotage_core::flight::photo::{LaidPhoto, PhotoAnswer, PhotoSearch};
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
    /// What is known and how far around it is searched.
    pub search: PhotoSearch,
}

/// What came of a photo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoReport {
    /// Its number in the order.
    pub number: usize,
    /// Where it lies, or why it was not laid.
    pub answer: PhotoAnswer,
    /// How long it was looked for, without reading it, milliseconds.
    pub computed: f64,
}

/// A laid photo to be shown on the map in its own colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DrapeOrder {
    /// Key of the files that it is among.
    pub key: String,
    /// Its name.
    pub name: String,
    /// What it was laid with.
    pub search: PhotoSearch,
    /// Where it lies.
    pub laid: LaidPhoto,
}
