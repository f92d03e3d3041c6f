//! The keys of a `GeoTIFF`: its reference system, and whether pixels are areas or points.
//!
//! After OGC 19-008r4, chapter 7.

use super::super::tiff::{Directory, Tag, TiffError};
use pilotage_base::frames::ReferenceSystem;

/// Kind of coordinates: 1 projected, 2 geographic.
const MODEL_TYPE: u64 = 1024;
/// 1: the coordinates are those of a pixel's corner, 2: of its centre.
const RASTER_TYPE: u64 = 1025;
/// Code of the geographic system.
const GEOGRAPHIC_TYPE: u64 = 2048;
/// Code of the projected system.
const PROJECTED_TYPE: u64 = 3072;
/// Code of the projection, if the system has none.
const PROJECTION: u64 = 3074;
/// Name of the projected or the whole system.
const CITATIONS: [u64; 3] = [3073, 1026, 2049];
/// Code of the unit of heights.
const VERTICAL_UNITS: u64 = 4099;
/// Code of the system of heights.
const VERTICAL_TYPE: u64 = 4096;
/// Name of the system of heights.
const VERTICAL_CITATION: u64 = 4097;
/// WGS 84 with heights above its ellipsoid, as a code of a geographic system.
const GEOGRAPHIC_3D: u64 = 4979;
/// A system that is described, not named.
const USER_DEFINED: u64 = 32_767;

/// What the keys say.
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
        let has_heights = number(GEOGRAPHIC_TYPE) == Some(GEOGRAPHIC_3D);
        keys.vertical_system = number(VERTICAL_TYPE)
            .filter(|code| *code != USER_DEFINED)
            .or(has_heights.then_some(GEOGRAPHIC_3D))
            .map(|code| code as u32);
        if keys.vertical_system.is_none() && number(VERTICAL_TYPE).is_some() {
            keys.vertical_name = entry(VERTICAL_CITATION).and_then(|e| text(directory, e));
        }
        keys.vertical_unit = number(VERTICAL_UNITS)
            .filter(|code| *code != USER_DEFINED)
            .map(|code| code as u32);
        let code = match number(MODEL_TYPE) {
            None if entries.is_empty() => return Ok(keys),
            Some(2) if has_heights => Some(4326),
            Some(2) => number(GEOGRAPHIC_TYPE),
            _ => number(PROJECTED_TYPE).or(number(GEOGRAPHIC_TYPE)),
        };
        let citation = CITATIONS
            .into_iter()
            .find_map(|key| text(directory, entry(key)?));
        keys.system = match code {
            Some(code) if code != USER_DEFINED => ReferenceSystem::from_epsg(code as u32),
            _ => number(PROJECTION)
                .filter(|_| matches!(number(GEOGRAPHIC_TYPE), None | Some(4326 | GEOGRAPHIC_3D)))
                .and_then(utm_projection)
                .or_else(|| ReferenceSystem::from_name(citation.as_deref()?)),
        };
        keys.system = keys.system.or(named);
        if keys.system.is_some() {
            return Ok(keys);
        }
        let found = match (code, citation) {
            (Some(code), Some(name)) if code != USER_DEFINED => format!("EPSG:{code} ({name})"),
            (Some(code), None) if code != USER_DEFINED => format!("EPSG:{code}"),
            (_, Some(name)) => format!("\"{name}\""),
            _ => "without a name".to_owned(),
        };
        Err(directory
            .blame(&Tag::GeoKeyDirectory.name())
            .unsupported(format!(
                "the reference system {found} is not known; warp the map to EPSG:4326, EPSG:3857 or a \
                 UTM zone of WGS 84 (EPSG:326xx, 327xx)"
            )))
    }
}

/// The text of a key.
fn text(directory: &Directory, entry: &[u64]) -> Option<String> {
    if entry[1] != Tag::GeoAsciiParams as u64 {
        return None;
    }
    let all = directory.text(Tag::GeoAsciiParams)?;
    let end = entry[3].checked_add(entry[2])?;
    let text = all.get(entry[3] as usize..(end as usize).min(all.len()))?;
    let text = text.trim_end_matches(['|', '\0']).trim();
    (!text.is_empty()).then(|| text.chars().take(120).collect())
}

/// UTM zones have codes of their own as projections: 16001-16060 north, 16101-16160 south.
fn utm_projection(code: u64) -> Option<ReferenceSystem> {
    let epsg = match code {
        16_001..=16_060 => 32_600 + code - 16_000,
        16_101..=16_160 => 32_700 + code - 16_100,
        _ => return None,
    };
    ReferenceSystem::from_epsg(epsg as u32)
}
