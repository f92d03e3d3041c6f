//! Sources of maps.

use pilotage_core::frames::Geodetic;
use pilotage_core::imagery::Georeference;
use pilotage_core::simulate::is_small_world;
use serde::{Deserialize, Serialize};

use super::WebMap;
use super::stored_map::StoredMap;

/// Source of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "StoredMap", into = "StoredMap")]
pub enum MapSource {
    /// Map of the built-in world of this key.
    World(String),
    /// Files that the page gave to the worker under this key (see [`crate::ProvideOrder`]).
    Files(String),
    /// The map among files of this key, put into the world frame around an origin.
    Placed {
        /// Key of the files.
        key: String,
        /// Origin of the world frame.
        origin: Geodetic,
    },
    /// A picture among files of this key whose place is known better than by the files.
    Picture {
        /// Key of the files.
        key: String,
        /// The picture.
        name: String,
        /// Origin of the world frame; its own if `None`.
        origin: Option<Geodetic>,
        /// Georeference of the picture's pixels.
        place: Georeference,
    },
    /// Tiles of the web.
    Web(WebMap),
    /// No map.
    Nothing,
}

impl MapSource {
    /// Map of the built-in world of a key.
    pub fn world(key: &str) -> Self {
        Self::World(key.to_owned())
    }

    /// Whether the small program opens it.
    pub fn is_small(&self) -> bool {
        match self {
            Self::World(key) => is_small_world(key),
            Self::Nothing => true,
            _ => false,
        }
    }

    /// Key of the files that it is made from, if it is.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::World(_) | Self::Web(_) | Self::Nothing => None,
            Self::Files(key) | Self::Placed { key, .. } | Self::Picture { key, .. } => Some(key),
        }
    }

    /// Origin of the world frame it was put into, if one was given.
    pub fn origin(&self) -> Option<Geodetic> {
        match self {
            Self::Placed { origin, .. } => Some(*origin),
            Self::Picture { origin, .. } => *origin,
            Self::Web(map) => Some(map.origin),
            Self::World(_) | Self::Files(_) | Self::Nothing => None,
        }
    }

    /// The same map in the world around another origin, if it can be put there.
    ///
    /// ```
    /// use pilotage_core::frames::Geodetic;
    /// use pilotage_jobs::MapSource;
    ///
    /// let [here, there] = [47.0, 48.0].map(|latitude| Geodetic::from_degrees(latitude, 8.0, 0.0));
    /// let town = MapSource::Placed { key: "town".to_owned(), origin: here };
    /// assert_eq!(town.moved(there).origin(), Some(there));
    /// // A built-in world is where it is.
    /// assert_eq!(MapSource::world("hall").moved(there), MapSource::world("hall"));
    /// ```
    #[must_use]
    pub fn moved(&self, to: Geodetic) -> Self {
        let mut moved = self.clone();
        match &mut moved {
            Self::Placed { origin, .. } => *origin = to,
            Self::Picture { origin, .. } => *origin = Some(to),
            Self::Web(map) => map.origin = to,
            Self::World(_) | Self::Files(_) | Self::Nothing => {}
        }
        moved
    }
}

impl From<MapSource> for StoredMap {
    fn from(map: MapSource) -> Self {
        match map {
            MapSource::World(key) => match key.as_str() {
                "countryside" => Self::Scenery,
                "hall" => Self::Hall,
                _ => Self::World(key),
            },
            MapSource::Files(key) => Self::Files(key),
            MapSource::Placed { key, origin } => Self::Placed { key, origin },
            MapSource::Picture {
                key,
                name,
                origin,
                place,
            } => Self::Picture {
                key,
                name,
                origin,
                place,
            },
            MapSource::Web(map) => Self::Web(map),
            MapSource::Nothing => Self::Nothing,
        }
    }
}

impl From<StoredMap> for MapSource {
    fn from(map: StoredMap) -> Self {
        match map {
            StoredMap::Scenery => Self::world("countryside"),
            StoredMap::Hall => Self::world("hall"),
            StoredMap::World(key) => Self::World(key),
            StoredMap::Files(key) => Self::Files(key),
            StoredMap::Placed { key, origin } => Self::Placed { key, origin },
            StoredMap::Picture {
                key,
                name,
                origin,
                place,
            } => Self::Picture {
                key,
                name,
                origin,
                place,
            },
            StoredMap::Web(map) => Self::Web(map),
            StoredMap::Nothing => Self::Nothing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::simulate::WORLDS;

    #[test]
    fn worlds_older_than_keys_are_stored_under_their_names_and_each_is_one_that_there_is() {
        for (stored, key) in [("\"Scenery\"", "countryside"), ("\"Hall\"", "hall")] {
            let map: MapSource = serde_json::from_str(stored).unwrap();
            assert_eq!(map, MapSource::world(key));
            assert_eq!(serde_json::to_string(&map).unwrap(), stored);
            assert!(WORLDS.iter().any(|world| world.key() == key));
        }
        let other = MapSource::world("another");
        let stored = serde_json::to_string(&other).unwrap();
        assert_eq!(stored, r#"{"World":"another"}"#);
        assert_eq!(serde_json::from_str::<MapSource>(&stored).unwrap(), other);
        // The order of the variants is that of the wire.
        let hall = postcard::to_stdvec(&MapSource::world("hall")).unwrap();
        assert_eq!(hall, [6]);
    }
}
