//! The files beside a picture that say where it lies: world file, georeference in JSON, `.prj`.

use std::cell::OnceCell;
use std::collections::HashSet;

use crate::auxiliary_xml::AuxiliaryXml;
use crate::map_error::MapFileError;
use crate::map_options::MapOptions;
use crate::systems;
use pilotage_base::files::FileSet;
use pilotage_base::frames::{LocalFrame, ReferenceSystem};
use pilotage_base::georeference::Georeference;
use serde_json::{Map, Value};

/// Endings of world files, which take the place of a picture's own or follow it.
const WORLD_FILES: [&str; 11] = [
    ".jgw", ".jpgw", ".jpegw", ".pgw", ".pngw", ".tfw", ".tifw", ".tiffw", ".wpw", ".webpw", ".wld",
];
/// Endings of pictures that have a world file of their own kind.
const PICTURES: [&str; 6] = ["jpg", "jpeg", "png", "tif", "tiff", "webp"];
/// Endings of georeferences in JSON. Behind a picture's own ending such a file may be anything: photo services put what they
/// know of `a.jpg` into `a.jpg.json`.
const GEOREFERENCES: [&str; 4] = [
    "_georef.json",
    ".georef.json",
    ".georeference.json",
    ".json",
];

/// Members of a georeference in JSON; an object with none of them is something else.
const MEMBERS: [&str; 5] = ["plane_from_pixel", "origin_lat", "origin_lon", "R", "T"];

/// Ending of a picture's name, in small letters and without the dot.
fn ending_of(picture: &str) -> String {
    let ending = picture.rsplit_once('.').map_or("", |(_, ending)| ending);
    ending.to_lowercase()
}

/// Endings of the world files of pictures with that ending: its first and last letter with a w, or all of it.
fn own_world_files(ending: &str) -> [String; 2] {
    let mut letters = ending.chars();
    let first = letters.next();
    let ends: String = first.into_iter().chain(letters.next_back()).collect();
    [format!(".{ends}w"), format!(".{ending}w")]
}

/// Endings of world files of a picture, its own kind first, then the one for all kinds, last those of other kinds.
fn world_files_of(picture: &str) -> Vec<String> {
    let own = own_world_files(&ending_of(picture));
    let mut all = WORLD_FILES.map(str::to_owned);
    all.sort_by_key(|ending| (!own.contains(ending), ending != ".wld"));
    all.to_vec()
}

/// Whether a world file with that ending is that of another picture, which lies beside `picture`: `has` says which endings
/// of pictures there are.
fn is_of_another(world_file: &str, picture: &str, has: impl Fn(&str) -> bool) -> bool {
    let is_own = |of: &str| own_world_files(of).iter().any(|it| it == world_file);
    !is_own(&ending_of(picture)) && PICTURES.iter().any(|of| is_own(of) && has(of))
}

/// Those of `pictures` that have a world file beside them among all `names` of files, in any letters.
pub fn with_world_file(names: &[String], pictures: &[String]) -> Vec<String> {
    let names: HashSet<String> = names.iter().map(|name| name.to_lowercase()).collect();
    let is_placed = |picture: &&String| {
        let picture = picture.to_lowercase();
        let stem = picture.rsplit_once('.').map_or("", |(stem, _)| stem);
        let has = |of: &str| names.contains(&format!("{stem}.{of}"));
        WORLD_FILES.iter().any(|ending| {
            names.contains(&format!("{picture}{ending}"))
                || names.contains(&format!("{stem}{ending}"))
                    && !is_of_another(ending, &picture, has)
        })
    };
    pictures.iter().filter(is_placed).cloned().collect()
}

/// Georeference of a picture by the file beside it, with that file's name.
pub(crate) fn place_beside(
    files: &dyn FileSet,
    picture: &str,
    options: &MapOptions,
) -> Result<Option<(String, Georeference)>, MapFileError> {
    if let Some(place) = options.place {
        return Ok(Some((picture.to_owned(), place)));
    }
    let sides = SideFiles::of(files, picture);
    let world_files = world_files_of(picture);
    let world_file = world_files.iter().find_map(|it| sides.world_file(it));
    let stated =
        world_file.or_else(|| (GEOREFERENCES.iter()).find_map(|ending| sides.georeference(ending)));
    let (side, place) = if let Some((side, bytes)) = stated {
        let place = Georeference::from_text(&String::from_utf8_lossy(&bytes));
        let place = place.map_err(|cause| MapFileError::Georeference {
            file: side.clone(),
            cause,
        })?;
        (side, place)
    } else {
        let Some((side, Some(place))) = sides.auxiliary().map(|(name, said)| (name, said.place))
        else {
            return Ok(None);
        };
        (side, place)
    };
    let system = match options.system {
        Some(system) => Some(system),
        None => sides.system()?,
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

/// The reference system that a file beside a picture names.
pub(crate) fn system_beside(
    files: &dyn FileSet,
    picture: &str,
) -> Result<Option<ReferenceSystem>, MapFileError> {
    SideFiles::of(files, picture).system()
}

/// Name of the mask that GDAL wrote beside a picture.
pub(crate) fn mask_beside(files: &dyn FileSet, picture: &str) -> Option<String> {
    SideFiles::of(files, picture).name_with_ending(picture, ".msk")
}

/// Whether well-known text describes axes of nowhere in particular, as programs write it where nothing is known.
fn is_local(text: &str) -> bool {
    let text = text.trim_start();
    let begins = |word: &str| {
        text.get(..word.len())
            .is_some_and(|t| t.eq_ignore_ascii_case(word))
    };
    ["LOCAL_CS", "ENGCRS", "ENGINEERINGCRS"]
        .into_iter()
        .any(begins)
}

/// The system that the text of a side file names.
fn system_named(file: String, text: &str) -> Result<Option<ReferenceSystem>, MapFileError> {
    let system = systems::by_name(text);
    system
        .map(Some)
        .map_err(|cause| MapFileError::System { file, cause })
}

/// Files beside a picture.
struct SideFiles<'a> {
    files: &'a dyn FileSet,
    picture: &'a str,
    /// Names of all files, listed once some name was not found as it stands.
    names: OnceCell<Vec<String>>,
}

impl<'a> SideFiles<'a> {
    fn of(files: &'a dyn FileSet, picture: &'a str) -> Self {
        Self {
            files,
            picture,
            names: OnceCell::new(),
        }
    }

    /// The reference system that the .prj names, or QGIS' .qpj, or what GDAL wrote, if that can be read.
    fn system(&self) -> Result<Option<ReferenceSystem>, MapFileError> {
        let named = [".prj", ".qpj"].iter().find_map(|ending| self.find(ending));
        let Some((file, bytes)) = named else {
            let said = self.auxiliary();
            let said = said.and_then(|(file, said)| Some((file, said.system?)));
            let said = said.filter(|(_, text)| !is_local(text));
            return said.map_or(Ok(None), |(file, text)| system_named(file, &text));
        };
        system_named(file, &String::from_utf8_lossy(&bytes))
    }

    /// Auxiliary file of GDAL, with its name: as GDAL calls it first.
    fn auxiliary(&self) -> Option<(String, AuxiliaryXml)> {
        let found = self.with_ending(self.picture, ".aux.xml");
        let (name, bytes) = found.or_else(|| self.in_place(".aux.xml"))?;
        Some((name, AuxiliaryXml::read(&String::from_utf8_lossy(&bytes))))
    }

    /// Name and contents of the file that has `ending` in place of the picture's or behind it.
    fn find(&self, ending: &str) -> Option<(String, Vec<u8>)> {
        let found = self.in_place(ending);
        found.or_else(|| self.with_ending(self.picture, ending))
    }

    /// The same of a world file: in place of the picture's ending it may be that of another picture.
    fn world_file(&self, ending: &str) -> Option<(String, Vec<u8>)> {
        let is_own = || {
            let stem = self.picture.rsplit_once('.').map_or("", |(stem, _)| stem);
            let has = |of: &str| self.name_with_ending(stem, &format!(".{of}")).is_some();
            !is_of_another(ending, self.picture, has)
        };
        let found = self.in_place(ending).filter(|_| is_own());
        found.or_else(|| self.with_ending(self.picture, ending))
    }

    /// The same of the one that has `ending` in place of the picture's.
    fn in_place(&self, ending: &str) -> Option<(String, Vec<u8>)> {
        let (stem, _) = self.picture.rsplit_once('.')?;
        self.with_ending(stem, ending)
    }

    /// The same, unless it is JSON of another kind, as catalogues of elevation models and surveys put beside pictures.
    fn georeference(&self, ending: &str) -> Option<(String, Vec<u8>)> {
        let is_other = |bytes: &[u8]| {
            let members: Option<Map<String, Value>> = serde_json::from_slice(bytes).ok();
            members.is_some_and(|members| !MEMBERS.iter().any(|own| members.contains_key(*own)))
        };
        self.in_place(ending).filter(|(_, bytes)| !is_other(bytes))
    }

    /// The same of the one that has `ending` behind `stem`, in small letters or in capitals; where the files can be
    /// listed, in any letters.
    fn with_ending(&self, stem: &str, ending: &str) -> Option<(String, Vec<u8>)> {
        let wanted = format!("{stem}{ending}");
        let read = |name: String| self.files.read(&name).map(|bytes| (name, bytes));
        read(wanted.clone())
            .or_else(|| read(format!("{stem}{}", ending.to_uppercase())))
            .or_else(|| {
                let names = self.names.get_or_init(|| self.files.names());
                let found = names.iter().find(|name| name.eq_ignore_ascii_case(&wanted));
                read(found?.clone())
            })
    }

    /// Name of the file that has `ending` behind `stem`, in any letters, which is not read.
    fn name_with_ending(&self, stem: &str, ending: &str) -> Option<String> {
        let wanted = format!("{stem}{ending}");
        let names = self.names.get_or_init(|| self.files.names());
        let listed = names.iter().find(|name| name.eq_ignore_ascii_case(&wanted));
        // Not all sets can list their files.
        let is_listed = names.iter().any(|name| name == self.picture);
        let unlisted = || Some(wanted.clone()).filter(|name| self.files.source(name).is_some());
        listed
            .cloned()
            .or_else(|| if is_listed { None } else { unlisted() })
    }
}
