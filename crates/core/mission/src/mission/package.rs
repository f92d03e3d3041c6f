//! The mission file: one zip with the mission, what goes with it, and the pictures that it needs.
//!
//! Version 1 was the mission's GeoJSON alone; it is read as well. docs/formats.md defines both.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Value, json};

use super::{Mission, MissionError, read_mission, write_mission};
use pilotage_base::files::{FileSet, FileSink, ZipFiles, ZipSink};

/// Version of the mission file that is written.
pub const PACKAGE_VERSION: u64 = 2;
/// Name of the file in the zip that states the version.
pub const PACKAGE_HEAD: &str = "pilotage.json";
/// Name of the file in the zip with the mission.
const MISSION: &str = "mission.json";
/// Folder in the zip with pictures and what lies beside them.
pub const PACKAGE_PICTURES: &str = "pictures/";
/// Member of the head with the version.
const VERSION_MEMBER: &str = "pilotage_file";

/// A mission and what goes with it.
#[derive(Clone, Debug, PartialEq)]
pub struct MissionPackage {
    /// The mission.
    pub mission: Mission,
    /// Other members of the head, by name, as JSON text: what was open beside the mission.
    pub settings: BTreeMap<String, String>,
    /// Pictures that the mission needs and the files beside them: path and contents.
    pub files: Vec<(String, Vec<u8>)>,
}

/// Why a mission file cannot be read or written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PackageError {
    /// The zip is damaged or lacks something.
    #[error("{0}")]
    Zip(String),
    /// A file in the zip is wrong.
    #[error("{file}: {cause}")]
    Inside {
        /// Its name in the zip.
        file: &'static str,
        /// Error of the file.
        cause: MissionError,
    },
    /// The head is not what it should be.
    #[error("{PACKAGE_HEAD}: {0}")]
    Head(String),
    /// It was written by a later version.
    #[error("{PACKAGE_HEAD}: version {0} of the mission file is not known; update the program")]
    Version(u64),
    /// It is a plain mission, and wrong.
    #[error(transparent)]
    Mission(#[from] MissionError),
}

/// Reads a mission file of any version.
pub fn read_package(bytes: &[u8]) -> Result<MissionPackage, PackageError> {
    if !bytes.starts_with(b"PK\x03\x04") {
        // Version 1: the mission alone.
        return Ok(MissionPackage {
            mission: read_mission(bytes)?,
            settings: BTreeMap::new(),
            files: Vec::new(),
        });
    }
    let zip = ZipFiles::open(bytes).map_err(PackageError::Zip)?;
    read_package_of(&zip)
}

/// Reads the mission file that is unpacked in a set of files.
pub fn read_package_of(files: &dyn FileSet) -> Result<MissionPackage, PackageError> {
    let lacking = |name: &str| PackageError::Zip(format!("there is no {name} in the mission file"));
    let head = files
        .read(PACKAGE_HEAD)
        .ok_or_else(|| lacking(PACKAGE_HEAD))?;
    let settings = read_head(&head)?;
    let mission = files.read(MISSION).ok_or_else(|| lacking(MISSION))?;
    let mission = read_mission(&mission).map_err(|cause| PackageError::Inside {
        file: MISSION,
        cause,
    })?;
    let mut names = files.names();
    names.sort();
    let pictures = names.into_iter().filter_map(|name| {
        let path = name.strip_prefix(PACKAGE_PICTURES)?.to_owned();
        Some((path, files.read(&name)?))
    });
    Ok(MissionPackage {
        mission,
        settings,
        files: pictures.collect(),
    })
}

/// Checks the head of a mission file and gives its other members, as JSON text.
pub fn read_head(head: &[u8]) -> Result<BTreeMap<String, String>, PackageError> {
    #[derive(Deserialize)]
    struct PackageHead<'a>(#[serde(borrow)] BTreeMap<String, &'a RawValue>);
    let wrong = |cause: serde_json::Error| PackageError::Head(cause.to_string());
    let PackageHead(mut members) = serde_json::from_slice(head).map_err(wrong)?;
    let version = members.remove(VERSION_MEMBER).map(RawValue::get);
    let version: Option<u64> = version.and_then(|text| text.parse().ok());
    match version {
        Some(PACKAGE_VERSION) => {}
        Some(other) => return Err(PackageError::Version(other)),
        None => {
            let cause = format!("`{VERSION_MEMBER}`, the version, is missing");
            return Err(PackageError::Head(cause));
        }
    }
    let text = |(name, value): (String, &RawValue)| (name, value.get().to_owned());
    Ok(members.into_iter().map(text).collect())
}

/// A mission file of the present version.
///
/// ```
/// use pilotage_base::frames::Geodetic;
/// use pilotage_mission::mission::Mission;
/// use pilotage_mission::mission::package::{MissionPackage, read_package, write_package};
///
/// let package = MissionPackage {
///     mission: Mission::new("River", Geodetic::from_degrees(46.8, -92.0, 183.0)),
///     settings: [("theme".to_owned(), "\"dark\"".to_owned())].into(),
///     files: vec![("map.jgw".to_owned(), b"0.5".to_vec())],
/// };
/// let bytes = write_package(&package)?;
/// assert_eq!(&bytes[..2], b"PK"); // a zip
/// let read = read_package(&bytes)?;
/// assert_eq!((read.settings, read.files), (package.settings, package.files));
/// # Ok::<(), pilotage_mission::mission::package::PackageError>(())
/// ```
pub fn write_package(package: &MissionPackage) -> Result<Vec<u8>, PackageError> {
    let mut head = json!({ VERSION_MEMBER: PACKAGE_VERSION });
    for (name, text) in &package.settings {
        let value: Value = serde_json::from_str(text)
            .map_err(|cause| PackageError::Head(format!("{name}: {cause}")))?;
        head[name] = value;
    }
    let mut zip = ZipSink::default();
    let mut write = |name: &str, bytes: &[u8]| zip.write(name, bytes).map_err(PackageError::Zip);
    write(PACKAGE_HEAD, head.to_string().as_bytes())?;
    write(MISSION, write_mission(&package.mission).as_bytes())?;
    for (path, bytes) in &package.files {
        write(&format!("{PACKAGE_PICTURES}{path}"), bytes)?;
    }
    zip.finish().map_err(PackageError::Zip)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mission file of version 1, as it was saved.
    const PLAIN: &str = r#"{
  "type": "FeatureCollection",
  "pilotage_mission": 1,
  "name": "Old",
  "origin": { "latitude_deg": 47.0, "longitude_deg": 8.0, "height_m": 400.0 },
  "weather": "fine",
  "features": [
    { "type": "Feature",
      "geometry": { "type": "Polygon", "coordinates": [[[8.0, 47.0], [8.0003, 47.0], [8.0003, 47.0002], [8.0, 47.0002], [8.0, 47.0]]] },
      "properties": { "id": 4, "name": "Barn", "height_m": 3.5, "enabled": false, "owner": "Ann" } }
  ]
}"#;

    fn package() -> MissionPackage {
        let mut package = read_package(PLAIN.as_bytes()).unwrap();
        let settings = [("bookmarks", "[1.5,2.0]"), ("map", "\"Scenery\"")];
        package.settings = settings.map(|(n, v)| (n.to_owned(), v.to_owned())).into();
        package.files = vec![
            ("ortho.jgw".to_owned(), b"0.5\n0\n".to_vec()),
            ("ortho.jpg".to_owned(), vec![0xff, 0xd8, 0, 1, 2]),
        ];
        package
    }

    #[test]
    fn a_mission_of_the_first_version_becomes_one_of_the_second_with_all_that_is_in_it() {
        let old = read_package(PLAIN.as_bytes()).unwrap();
        assert_eq!(old.mission.landmarks[0].properties["owner"], "\"Ann\"");
        assert_eq!(old.mission.properties["weather"], "\"fine\"");
        let new = read_package(&write_package(&old).unwrap()).unwrap();
        assert_eq!(write_mission(&new.mission), write_mission(&old.mission));
        assert_eq!(new.settings, old.settings);
    }

    #[test]
    fn pictures_and_settings_come_back_as_they_were() {
        let bytes = write_package(&package()).unwrap();
        assert!(bytes.starts_with(b"PK"));
        let (back, wanted) = (read_package(&bytes).unwrap(), package());
        // Places are written in degrees, to a tenth of a millimetre.
        assert_eq!(write_mission(&back.mission), write_mission(&wanted.mission));
        assert_eq!((back.settings, back.files), (wanted.settings, wanted.files));
    }

    #[test]
    fn a_later_version_is_refused_with_what_to_do() {
        let error = read_head(br#"{ "pilotage_file": 9 }"#).unwrap_err();
        assert_eq!(error, PackageError::Version(9));
        assert!(error.to_string().contains("update the program"));
    }

    #[test]
    fn a_zip_without_a_mission_and_one_cut_short_are_named() {
        let mut zip = ZipSink::default();
        zip.write("readme.txt", b"hello").unwrap();
        let error = read_package(&zip.finish().unwrap()).unwrap_err();
        assert!(error.to_string().contains("pilotage.json"), "{error}");
        let bytes = write_package(&package()).unwrap();
        for length in [4, 40, bytes.len() / 2, bytes.len() - 1] {
            assert!(read_package(&bytes[..length]).is_err(), "{length} bytes");
        }
    }
}
