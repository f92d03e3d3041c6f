//! Sources of maps as sessions, mission files and the wire have them.

use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::Georeference;
use serde::{Deserialize, Serialize};

use super::WebMap;

/// A source of a map in the order and under the names that stored files have: two worlds are older than their keys.
#[derive(Serialize, Deserialize)]
pub enum StoredMap {
    Scenery,
    Files(String),
    Placed {
        key: String,
        origin: Geodetic,
    },
    Picture {
        key: String,
        name: String,
        origin: Option<Geodetic>,
        place: Georeference,
    },
    Web(WebMap),
    Nothing,
    Hall,
    World(String),
}
