//! Mission files of the disk, with the map that they hold or name.

use std::path::Path;
use std::sync::Arc;

use pilotage_core::flight::files::MemoryFiles;
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::mission::package::{MissionPackage, read_package};
use pilotage_core::mission::{MapOptions, MapReference};
use pilotage_core::simulate::Scenario;
use pilotage_jobs::{Beside, SimulationOptions, map_among};

/// A mission file that was read.
pub struct OpenMission {
    /// The mission and what goes with it.
    pub package: MissionPackage,
    name: String,
}

impl OpenMission {
    /// Reads the zip or the plain GeoJSON at `path`.
    ///
    /// ```
    /// use pilotage_disk::mission_file::OpenMission;
    ///
    /// // A square of 0.001° by 0.001° is a landmark, whoever wrote it.
    /// let path = std::env::temp_dir().join(format!("pilotage-square-{}.geojson", std::process::id()));
    /// let square = "[[[8, 47], [8.001, 47], [8.001, 47.001], [8, 47.001], [8, 47]]]";
    /// let geometry = format!(r#"{{"type": "Polygon", "coordinates": {square}}}"#);
    /// let feature = format!(r#"{{"type": "Feature", "properties": {{}}, "geometry": {geometry}}}"#);
    /// std::fs::write(&path, format!(r#"{{"type": "FeatureCollection", "features": [{feature}]}}"#))?;
    /// let opened = OpenMission::read(&path)?;
    /// assert_eq!((opened.package.mission.landmarks.len(), opened.is_over_scenery()), (1, false));
    /// std::fs::remove_file(&path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
        self.simulation().is_some()
    }

    /// The built-in flight that was open beside it when it was saved.
    pub fn simulation(&self) -> Option<SimulationOptions> {
        Beside::of_head(&self.package.settings)?.simulation
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
        let files = MemoryFiles(self.package.files.iter().cloned().collect());
        let options = MapOptions {
            frame: Some(frame),
            ..MapOptions::default()
        };
        let map = map_among(&files, &options).map_err(|e| format!("{}: {e}", self.name))?;
        if let Some((_, map)) = map {
            return Ok(Arc::new(CachedImagery::new(Arc::new(map), megabytes)));
        }
        if self.is_over_scenery() {
            let scenery = Arc::new(Scenario::map());
            return Ok(Arc::new(CachedImagery::new(scenery, megabytes)));
        }
        Err(format!("{} holds no map; say --map FILE", self.name).into())
    }
}
