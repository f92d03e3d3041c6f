//! Reference systems beside those of WGS 84: by EPSG code, by well-known text, and by the keys of a
//! `GeoTIFF`.
//!
//! Formulas after IOGP Publication 373-7-2, "Coordinate Conversions and Transformations including
//! Formulas". They are the project's own because the crate `proj4rs` exports functions to JavaScript that
//! no program of the page can leave out.

mod code_table;
mod codes;
mod datums;
mod definition;
mod geo_keys;
pub(crate) mod keys;
mod made;
mod methods;
mod names;
mod proj_text;
mod system_error;
#[cfg(test)]
mod tests;
mod three_dimensional;
mod units;
mod unstated;
mod well_known_text;
mod well_known_text_out;

use pilotage_base::frames::{ProjectionMethod, ReferenceSystem, SystemNumbers};

use made::of_numbers;
use names::shortened;

pub use codes::by_code;
pub(crate) use geo_keys::{KeyValues, described};
pub use system_error::SystemError;
pub(crate) use three_dimensional::flat_code;
pub(crate) use units::length;

/// All codes of the table, beside those of WGS 84 that [`ReferenceSystem::from_epsg`] knows.
pub fn codes() -> Vec<u32> {
    code_table::all()
}

/// The system that a text names: "EPSG:25832", a bare code, a name like "WGS 84 / UTM zone 17N" or
/// "ETRS89 / UTM zone 32N", or well-known text of either version, as .prj files hold it, or a text of PROJ.
///
/// ```
/// use pilotage_maps::systems::{by_code, by_name};
///
/// assert_eq!(by_name("ETRS89 / UTM zone 32N")?, by_code(25_832)?);
/// assert_eq!(by_name("EPSG:3857")?.epsg(), Some(3857));
/// # Ok::<(), pilotage_maps::systems::SystemError>(())
/// ```
pub fn by_name(text: &str) -> Result<ReferenceSystem, SystemError> {
    let text = text
        .trim()
        .trim_start_matches('\u{feff}')
        .trim_end_matches('\0');
    let digits = text.rsplit(':').next().unwrap_or(text).trim();
    if text.len() < 40
        && let Ok(code) = digits.parse()
    {
        return by_code(code);
    }
    if text.starts_with('+') && (text.contains("+proj=") || text.contains("+init=")) {
        return proj_text::read(text);
    }
    if text.contains(['[', '(']) && text.contains(['"', '\u{201c}']) {
        // GDAL says of the web's Mercator projection only here that it is one of a sphere.
        let inner = text.split('"').find(|part| part.starts_with("+proj=merc "));
        if let Some(Ok(ReferenceSystem::WebMercator)) = inner.map(proj_text::read) {
            return Ok(ReferenceSystem::WebMercator);
        }
        match well_known_text::read(text) {
            Ok(system) => return Ok(system),
            // Some programs write only its beginning.
            Err(cause) => return ReferenceSystem::from_name(text).ok_or(cause),
        }
    }
    (codes::named(text).or_else(|| ReferenceSystem::from_name(text)))
        .ok_or_else(|| SystemError::unknown(format!("\"{}\"", shortened(text))))
}

/// The same system with coordinates in another unit of so many metres; a system in degrees stays.
pub(crate) fn in_unit(system: ReferenceSystem, metres: f64) -> ReferenceSystem {
    let numbers = match system {
        ReferenceSystem::Other(other) if other.numbers.method != ProjectionMethod::Geographic => {
            *other.numbers
        }
        ReferenceSystem::Utm { zone, is_south } => SystemNumbers {
            longitude_0: (6.0 * f64::from(zone) - 183.0).to_radians(),
            scale: 0.9996,
            offset: [500_000.0, if is_south { 1e7 } else { 0.0 }],
            ..code_table::plain_numbers(datums::WGS84, ProjectionMethod::TransverseMercator)
        },
        other => return other,
    };
    if (numbers.unit - metres).abs() < 1e-9 {
        return system;
    }
    let unit = SystemNumbers {
        unit: metres,
        ..numbers
    };
    of_numbers(None, unit).unwrap_or(system)
}
