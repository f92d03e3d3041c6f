//! The map that is shown.

use pilotage_jobs::{MapInfo, MapSource};

use super::OpenedTerrain;

/// Map below the flight.
#[derive(Debug)]
pub struct MapDocument {
    /// Its source.
    pub source: MapSource,
    /// Its description, once it is there.
    pub info: Option<MapInfo>,
    /// The height of the ground.
    pub terrain: OpenedTerrain,
}

impl MapDocument {
    /// A map of which only the source is known.
    pub fn of_source(source: MapSource) -> Self {
        Self {
            source,
            info: None,
            terrain: OpenedTerrain::default(),
        }
    }

    /// Whether it shows ground that was photographed.
    pub fn is_real(&self) -> bool {
        !matches!(self.source, MapSource::Nothing | MapSource::World(_))
    }

    /// Who made it, to be shown with it; `None` if nobody said.
    pub fn attribution(&self) -> Option<&str> {
        match &self.source {
            MapSource::Web(map) => Some(&map.template.attribution),
            _ => self.info.as_ref()?.attribution.as_deref(),
        }
    }
}
