//! Mission files of the disk, with the map that they hold or name.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use pilotage_core::flight::files::MemoryFiles;
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::mission::package::{MissionPackage, read_package};
use pilotage_core::mission::{MapFileError, MapReference, open_map};
use pilotage_core::simulate::Scenario;

/// Endings of files in a mission file that can be its map, the likeliest first.
const MAPS: [&str; 6] = [".tif", ".tiff", ".pmtiles", ".jpg", ".jpeg", ".png"];
/// Member of the head with what was open beside the mission, and the built-in flight in it.
const BUILT_IN: (&str, &str) = ("open", "simulation");

/// A mission file that was read.
pub struct OpenMission {
    /// The mission and what goes with it.
    pub package: MissionPackage,
    name: String,
}

impl OpenMission {
    /// Reads the zip or the plain GeoJSON at `path`.
    pub fn read(path: &Path) -> Result<Self, String> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|e| format!("{name}: {e}"))?;
        let package = read_package(&bytes).map_err(|e| format!("{name}: {e}"))?;
        Ok(Self { package, name })
    }

    /// Whether it was saved over the generated scenery.
    pub fn is_over_scenery(&self) -> bool {
        if let Some(MapReference::Scenario(_)) = self.package.mission.map {
            return true;
        }
        let (member, flight) = BUILT_IN;
        let text = self.package.settings.get(member);
        let open: Option<serde_json::Value> = text.and_then(|t| serde_json::from_str(t).ok());
        open.is_some_and(|open| open.get(flight).is_some_and(|f| !f.is_null()))
    }

    /// The map at `stated`, or else that in the file, or the generated scenery if it was saved there.
    pub fn map(
        &self,
        stated: Option<&Path>,
        frame: LocalFrame,
        megabytes: usize,
    ) -> Result<Arc<dyn Imagery>, Box<dyn std::error::Error>> {
        if let Some(path) = stated {
            return crate::files::open_map(path, Some(frame), megabytes);
        }
        let files: BTreeMap<String, Vec<u8>> = self.package.files.iter().cloned().collect();
        let files = MemoryFiles(files);
        let ending_in = |ending: &&str| {
            let names = files.0.keys();
            let found = names.filter(|name| name.to_lowercase().ends_with(*ending));
            found.cloned().collect::<Vec<_>>()
        };
        for name in MAPS.iter().flat_map(ending_in) {
            match open_map(&files, &name, Some(frame)) {
                // Another picture may be the map.
                Err(MapFileError::NoGeoreference { .. }) => {}
                map => {
                    let map = map.map_err(|e| format!("{}: {e}", self.name))?;
                    return Ok(Arc::new(CachedImagery::new(Arc::new(map), megabytes)));
                }
            }
        }
        if self.is_over_scenery() {
            let scenery = Arc::new(Scenario::map());
            return Ok(Arc::new(CachedImagery::new(scenery, megabytes)));
        }
        Err(format!("{} holds no map; say --map FILE", self.name).into())
    }
}
