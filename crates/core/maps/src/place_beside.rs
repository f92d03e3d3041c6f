//! The files beside a picture that say where it lies: world file, georeference in JSON, `.prj`.

use crate::map_error::MapFileError;
use crate::map_options::MapOptions;
use crate::systems;
use pilotage_base::files::FileSet;
use pilotage_base::frames::{LocalFrame, ReferenceSystem};
use pilotage_base::georeference::Georeference;

/// Endings that take the place of a picture's own to name the file that says where the picture lies.
const SIDE_FILES: [&str; 11] = [
    ".jgw",
    ".jpgw",
    ".pgw",
    ".pngw",
    ".tfw",
    ".tifw",
    ".wld",
    "_georef.json",
    ".georef.json",
    ".georeference.json",
    ".json",
];

/// Georeference of a picture by the file beside it, with that file's name.
pub(crate) fn place_beside(
    files: &dyn FileSet,
    picture: &str,
    options: &MapOptions,
) -> Result<Option<(String, Georeference)>, MapFileError> {
    if let Some(place) = options.place {
        return Ok(Some((picture.to_owned(), place)));
    }
    let found = (SIDE_FILES.iter()).find_map(|ending| beside(files, picture, ending));
    let Some((side, bytes)) = found else {
        return Ok(None);
    };
    let place = Georeference::from_text(&String::from_utf8_lossy(&bytes));
    let place = place.map_err(|cause| MapFileError::Georeference {
        file: side.clone(),
        cause,
    })?;
    let system = match options.system {
        Some(system) => Some(system),
        None => system_beside(files, picture)?,
    };
    let place = system.map_or(place, |system| place.with_system(system));
    Ok(Some((side, place)))
}

/// Refuses metres that cannot be those of the world's own frame, where nothing says of which reference
/// system they are; the question offers the UTM zone of the world that is open. `picture` is the file whose
/// place it is.
pub(crate) fn refuse_unnamed(
    place: &Georeference,
    picture: &str,
    options: &MapOptions,
) -> Result<(), MapFileError> {
    let Georeference::Metres(file) = place else {
        return Ok(());
    };
    if options.place.is_some() || !file.is_beyond_a_world() {
        return Ok(());
    }
    let world = options.frame.or(options.near.map(|(frame, _)| frame));
    let zone = |frame: &LocalFrame| ReferenceSystem::utm_around(&frame.origin);
    let stem = picture.rsplit_once('.').map_or(picture, |(stem, _)| stem);
    Err(MapFileError::UnnamedSystem {
        file: picture.to_owned(),
        x: file.c,
        y: file.f,
        prj: format!("{stem}.prj"),
        example: match world.as_ref().map(zone).and_then(|zone| zone.epsg()) {
            Some(code) => format!("EPSG:{code}, the UTM zone of the open world"),
            None => "EPSG:32632 for the UTM zone 32 north".to_owned(),
        },
    })
}

/// The reference system that the .prj beside a picture names.
pub(crate) fn system_beside(
    files: &dyn FileSet,
    picture: &str,
) -> Result<Option<ReferenceSystem>, MapFileError> {
    let Some((file, bytes)) = beside(files, picture, ".prj") else {
        return Ok(None);
    };
    let text = String::from_utf8_lossy(&bytes);
    match systems::by_name(&text) {
        Ok(system) => Ok(Some(system)),
        Err(cause) => Err(MapFileError::System { file, cause }),
    }
}

/// Name and contents of the file that has `ending` in place of the picture's, in small letters or in
/// capitals; where the files can be listed, in any letters.
fn beside(files: &dyn FileSet, picture: &str, ending: &str) -> Option<(String, Vec<u8>)> {
    let (stem, _) = picture.rsplit_once('.')?;
    let wanted = format!("{stem}{ending}");
    let read = |name: String| files.read(&name).map(|bytes| (name, bytes));
    read(wanted.clone())
        .or_else(|| read(format!("{stem}{}", ending.to_uppercase())))
        .or_else(|| {
            let mut names = files.names().into_iter();
            read(names.find(|name| name.eq_ignore_ascii_case(&wanted))?)
        })
}
