//! The files beside a picture that say where it lies: world file, georeference in JSON, `.prj`.

use crate::auxiliary_xml::AuxiliaryXml;
use crate::map_error::MapFileError;
use crate::map_options::MapOptions;
use crate::systems;
use pilotage_base::files::FileSet;
use pilotage_base::frames::{LocalFrame, ReferenceSystem};
use pilotage_base::georeference::Georeference;

/// Endings that take the place of a picture's own, or follow it, to name the file that says where the picture lies.
const SIDE_FILES: [&str; 15] = [
    ".jgw",
    ".jpgw",
    ".jpegw",
    ".pgw",
    ".pngw",
    ".tfw",
    ".tifw",
    ".tiffw",
    ".wpw",
    ".webpw",
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
    let (side, place) = if let Some((side, bytes)) = found {
        let place = Georeference::from_text(&String::from_utf8_lossy(&bytes));
        let place = place.map_err(|cause| MapFileError::Georeference {
            file: side.clone(),
            cause,
        })?;
        (side, place)
    } else {
        let auxiliary = auxiliary(files, picture);
        let Some((side, Some(place))) = auxiliary.map(|(name, said)| (name, said.place)) else {
            return Ok(None);
        };
        (side, place)
    };
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

/// Auxiliary file of GDAL beside a picture, with its name.
fn auxiliary(files: &dyn FileSet, picture: &str) -> Option<(String, AuxiliaryXml)> {
    let (name, bytes) = beside(files, picture, ".aux.xml")?;
    Some((name, AuxiliaryXml::read(&String::from_utf8_lossy(&bytes))))
}

/// The reference system that the .prj beside a picture names, or QGIS' .qpj, or what GDAL wrote.
pub(crate) fn system_beside(
    files: &dyn FileSet,
    picture: &str,
) -> Result<Option<ReferenceSystem>, MapFileError> {
    let named = [".prj", ".qpj"].iter().find_map(|ending| {
        let (file, bytes) = beside(files, picture, ending)?;
        Some((file, String::from_utf8_lossy(&bytes).into_owned()))
    });
    let of_gdal = || {
        let (file, said) = auxiliary(files, picture)?;
        Some((file, said.system?))
    };
    let Some((file, text)) = named.or_else(of_gdal) else {
        return Ok(None);
    };
    match systems::by_name(&text) {
        Ok(system) => Ok(Some(system)),
        Err(cause) => Err(MapFileError::System { file, cause }),
    }
}

/// Name and contents of the file that has `ending` in place of the picture's or behind it, in small letters or in
/// capitals; where the files can be listed, in any letters.
fn beside(files: &dyn FileSet, picture: &str, ending: &str) -> Option<(String, Vec<u8>)> {
    let (stem, _) = picture.rsplit_once('.')?;
    with_ending(files, stem, ending).or_else(|| with_ending(files, picture, ending))
}

fn with_ending(files: &dyn FileSet, stem: &str, ending: &str) -> Option<(String, Vec<u8>)> {
    let wanted = format!("{stem}{ending}");
    let read = |name: String| files.read(&name).map(|bytes| (name, bytes));
    read(wanted.clone())
        .or_else(|| read(format!("{stem}{}", ending.to_uppercase())))
        .or_else(|| {
            let mut names = files.names().into_iter();
            read(names.find(|name| name.eq_ignore_ascii_case(&wanted))?)
        })
}
