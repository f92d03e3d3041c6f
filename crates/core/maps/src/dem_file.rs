//! Elevation models among files, by those beside them.

use crate::map_error::MapFileError;
use crate::map_file::{geo_tiff_file, missing};
use crate::map_options::{MapOptions, is_geo_tiff};
use crate::place_beside::system_beside;
use crate::terrain::Dem;
use pilotage_base::files::FileSet;
use pilotage_base::frames::{LocalFrame, ReferenceSystem};

/// The elevation model that is called `name` among files, by what it says itself of its place, or else by what lies beside
/// it: a world file, a `.prj`. The rest is as for [`Dem::open`].
///
/// # Errors
/// It is none, or does not lie anywhere.
pub fn open_dem(
    files: &dyn FileSet,
    name: &str,
    frame: Option<LocalFrame>,
    system: Option<ReferenceSystem>,
) -> Result<Dem, MapFileError> {
    if !is_geo_tiff(name) {
        let source = files.source(name).ok_or_else(|| missing(name))?;
        let system = match system {
            Some(system) => Some(system),
            // The shuttle's are in degrees, whatever lies beside them.
            None if name.to_ascii_lowercase().ends_with(".hgt") => None,
            None => system_beside(files, name)?,
        };
        return Ok(Dem::open(source, frame, system)?);
    }
    let options = MapOptions {
        frame,
        system,
        ..MapOptions::default()
    };
    let file = geo_tiff_file(files, name, &options)?;
    Ok(Dem::of_geo_tiff(&file, frame)?)
}
