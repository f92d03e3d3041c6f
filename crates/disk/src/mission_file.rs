//! Mission files of the disk, with the map that they hold or name.

use std::path::Path;

use pilotage_core::flight::files::MemoryFiles;
use pilotage_core::frames::LocalFrame;
use pilotage_core::mission::package::{MissionPackage, read_package};
use pilotage_core::mission::{MapOptions, MapReference};
use pilotage_jobs::{Beside, MapSource, SimulationOptions, map_among};

use crate::maps::MapOnDisk;
use crate::workers::Lent;

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
    /// assert_eq!((opened.package.mission.landmarks.len(), opened.world()), (1, None));
    /// std::fs::remove_file(&path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(path: &Path) -> Result<Self, String> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|e| format!("{name}: {e}"))?;
        let package = read_package(&bytes).map_err(|e| format!("{name}: {e}"))?;
        Ok(Self { package, name })
    }

    /// The generated world over which it was saved, if it was over one.
    pub fn world(&self) -> Option<MapSource> {
        let of_map = match &self.package.mission.map {
            Some(MapReference::Scenario(name)) => Some(SimulationOptions {
                scenario: name.clone(),
                ..SimulationOptions::demo()
            }),
            _ => None,
        };
        let simulation = of_map.or_else(|| self.simulation())?;
        Some(simulation.map())
    }

    /// The built-in flight that was open beside it when it was saved.
    pub fn simulation(&self) -> Option<SimulationOptions> {
        Beside::of_head(&self.package.settings)?.simulation
    }

    /// The map at `stated`, or else that in the file, or the generated world over which it was saved; and the source by
    /// which orders name it.
    ///
    /// # Errors
    /// A map that cannot be read, or none at all.
    pub fn map(
        &self,
        stated: Option<&Path>,
        frame: LocalFrame,
        megabytes: usize,
    ) -> Result<(MapSource, MapOnDisk), Box<dyn std::error::Error>> {
        if let Some(path) = stated {
            let map = crate::maps::open_map(path, Some(frame), megabytes)?;
            return Ok((Lent::map_of_file(), map));
        }
        let files = MemoryFiles(self.package.files.iter().cloned().collect());
        let options = MapOptions {
            frame: Some(frame),
            ..MapOptions::default()
        };
        let map = map_among(&files, &options).map_err(|e| format!("{}: {e}", self.name))?;
        if let Some((_, map)) = map {
            return Ok((Lent::map_of_file(), MapOnDisk::cached(map, megabytes)));
        }
        if let Some(world) = self.world() {
            let map = MapOnDisk {
                map: Lent::default().worker().cached_map(&world)?,
                frame: Some(frame),
                notes: Vec::new(),
                read: Vec::new(),
            };
            return Ok((world, map));
        }
        Err(format!("{} holds no map; say --map FILE", self.name).into())
    }
}
