//! The keys of a `GeoTIFF`: its reference system, and whether pixels are areas or points.
//!
//! After OGC 19-008r4, chapter 7.

use super::super::tiff::{Directory, Tag, TiffError};
use crate::systems::keys::{
    GEOGRAPHIC_CITATION, GEOGRAPHIC_TYPE, LINEAR_UNITS, MODEL_TYPE, USER_DEFINED,
};
use crate::systems::{self, KeyValues, SystemError};
use pilotage_base::frames::ReferenceSystem;

/// 1: the coordinates are those of a pixel's corner, 2: of its centre.
const RASTER_TYPE: u64 = 1025;
/// Code of the projected system.
const PROJECTED_TYPE: u64 = 3072;
/// Name of the projected or the whole system.
const CITATIONS: [u64; 3] = [3073, 1026, GEOGRAPHIC_CITATION];
/// Code of the unit of heights.
const VERTICAL_UNITS: u64 = 4099;
/// Code of the system of heights.
const VERTICAL_TYPE: u64 = 4096;
/// Name of the system of heights.
const VERTICAL_CITATION: u64 = 4097;
/// Keys that describe a projection: its name, its code, and that of its method.
const OF_PROJECTION: [u64; 3] = [3073, 3074, 3075];
/// Keys that describe a system of heights.
const OF_HEIGHTS: std::ops::RangeInclusive<u64> = VERTICAL_TYPE..=VERTICAL_UNITS;

/// Contents of the geographic keys of a `GeoTIFF`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GeoKeys {
    /// The reference system; without any keys there is none.
    pub system: Option<ReferenceSystem>,
    /// Whether coordinates are those of pixel centres.
    pub is_point: bool,
    /// EPSG code of the system of heights, where it is named.
    pub vertical_system: Option<u32>,
    /// Name of the system of heights, where it has no code.
    pub vertical_name: Option<String>,
    /// EPSG code of the unit of heights, where it is named.
    pub vertical_unit: Option<u32>,
    /// Whether numbers of heights in the tags of the place are scale and offset of the samples: where a file of `GeoTIFF` 1.1
    /// has a system of heights of its own.
    pub has_scaled_heights: bool,
}

impl GeoKeys {
    /// Reads the keys of a directory; a reference system that is not known is an error, unless `named`
    /// stands in for it.
    pub fn read(directory: &Directory, named: Option<ReferenceSystem>) -> Result<Self, TiffError> {
        let numbers = directory.numbers(Tag::GeoKeyDirectory)?;
        let mut keys = Self::default();
        // Header: version, revision, minor revision, number of keys; then four numbers a key.
        let entries: Vec<&[u64]> = (numbers.get(4..).unwrap_or_default())
            .chunks_exact(4)
            .collect();
        let entry = |key: u64| entries.iter().find(|entry| entry[0] == key);
        let number = |key: u64| {
            let entry = entry(key)?;
            (entry[1] == 0).then_some(entry[3])
        };
        keys.is_point = number(RASTER_TYPE) == Some(2);
        // The minor revision of 1.0 is 0. GDAL 3.10 does the same.
        let is_later = numbers.get(2).is_some_and(|minor| *minor >= 1);
        keys.has_scaled_heights =
            is_later && OF_HEIGHTS.into_iter().any(|key| entry(key).is_some());
        let geographic = number(GEOGRAPHIC_TYPE);
        let flat = geographic.and_then(|code| systems::flat_code(code as u32));
        keys.vertical_system = number(VERTICAL_TYPE)
            .filter(|code| *code != USER_DEFINED)
            .or(geographic.filter(|_| flat.is_some()))
            .map(|code| code as u32);
        if keys.vertical_system.is_none() && number(VERTICAL_TYPE).is_some() {
            keys.vertical_name = entry(VERTICAL_CITATION).and_then(|e| text(directory, e));
        }
        keys.vertical_unit = number(VERTICAL_UNITS)
            .filter(|code| *code != USER_DEFINED)
            .map(|code| code as u32);
        let values = KeyValues {
            number: &number,
            reals: &|key| entry(key).map_or(Vec::new(), |e| reals(directory, e)),
            text: &|key| text(directory, entry(key)?),
        };
        let code = match number(MODEL_TYPE) {
            None if entries.is_empty() => return Ok(keys),
            Some(2) => flat.map(u64::from).or(geographic),
            // The geographic system is that of the projection.
            _ if OF_PROJECTION.into_iter().any(|key| entry(key).is_some()) => {
                number(PROJECTED_TYPE)
            }
            _ => number(PROJECTED_TYPE).or(geographic),
        };
        let citation = CITATIONS.into_iter().find_map(values.text);
        keys.system = named;
        if keys.system.is_some() {
            return Ok(keys);
        }
        match system(
            code.filter(|code| *code != USER_DEFINED),
            citation.as_deref(),
            &values,
        ) {
            Ok(system) => keys.system = Some(system),
            Err(cause) => {
                return Err(directory
                    .blame(&Tag::GeoKeyDirectory.name())
                    .unsupported(cause.to_string()));
            }
        }
        Ok(keys)
    }
}

/// The system with a code, or that which the keys describe, or which a citation names.
fn system(
    code: Option<u64>,
    citation: Option<&str>,
    values: &KeyValues,
) -> Result<ReferenceSystem, SystemError> {
    let short = |text: &str| text.chars().take(80).collect::<String>();
    if let Some(code) = code {
        let known = systems::by_code(code as u32).map_err(|_| SystemError::Unknown {
            name: match citation {
                Some(name) => format!("EPSG:{code} ({})", short(name)),
                None => format!("EPSG:{code}"),
            },
        })?;
        // A file may count in another unit than the system of that code does.
        let metres = (values.number)(LINEAR_UNITS).and_then(systems::length);
        return Ok(metres.map_or(known, |metres| systems::in_unit(known, metres)));
    }
    let name = match citation {
        Some(name) => format!("\"{}\"", short(name)),
        None => "without a name".to_owned(),
    };
    // Programs of ESRI put their own text beside keys that say less.
    let own = citation.and_then(|text| text.split_once("PE String = "));
    let own = own.map(|(_, text)| systems::by_name(text));
    if let Some(Ok(found)) = own {
        return Ok(found);
    }
    match (systems::described(&name, values), own) {
        (Some(Ok(found)), _) => Ok(found),
        // What is described but not known is not what its name says to others.
        (_, Some(wrong)) | (Some(wrong), None) => wrong,
        (None, None) => (citation.and_then(|text| systems::by_name(text).ok()))
            .ok_or(SystemError::Unknown { name }),
    }
}

/// The real numbers of a key.
fn reals(directory: &Directory, entry: &[u64]) -> Vec<f64> {
    if entry[1] != Tag::GeoDoubleParams as u64 {
        return Vec::new();
    }
    let all = directory.reals(Tag::GeoDoubleParams).unwrap_or_default();
    let first = entry[3] as usize;
    let end = first.saturating_add(entry[2] as usize).min(all.len());
    all.get(first..end).unwrap_or_default().to_vec()
}

/// The text of a key.
fn text(directory: &Directory, entry: &[u64]) -> Option<String> {
    if entry[1] != Tag::GeoAsciiParams as u64 {
        return None;
    }
    // Counted in bytes, which letters of other programs' code pages are one of, too.
    let all = directory.bytes(Tag::GeoAsciiParams);
    let end = entry[3].checked_add(entry[2])?;
    let text = all.get(entry[3] as usize..(end as usize).min(all.len()))?;
    let text = String::from_utf8_lossy(text);
    let text = text.trim_end_matches(['|', '\0']).trim();
    (!text.is_empty()).then(|| text.chars().take(4000).collect())
}
