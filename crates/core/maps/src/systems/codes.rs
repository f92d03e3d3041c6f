//! Systems by EPSG code and by name.

use pilotage_base::frames::ReferenceSystem;

use super::SystemError;
use super::code_table::{self, codes_of, rows, stepped, unit_of};
use super::datums::{self, plain_name};
use super::made::of_numbers;

/// The system with that EPSG code, of WGS 84 or another datum.
///
/// ```
/// use pilotage_maps::frames::Geodetic;
/// use pilotage_maps::systems::by_code;
///
/// // ETRS89 / UTM zone 32N: x is 500 km on the meridian of 9° E.
/// let system = by_code(25_832)?;
/// let place = Geodetic::from_degrees(48.0, 9.0, 0.0);
/// let (x, _) = system.coordinates(&place).ok_or("beyond the system")?;
/// assert!((x - 500_000.0).abs() < 0.01);
/// assert!(by_code(1).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn by_code(code: u32) -> Result<ReferenceSystem, SystemError> {
    let own = ReferenceSystem::from_epsg(code);
    own.or_else(|| system(code))
        .ok_or_else(|| SystemError::unknown(format!("EPSG:{code}")))
}

/// The system with that code.
fn system(code: u32) -> Option<ReferenceSystem> {
    of_numbers(Some(code), code_table::numbers(code)?).ok()
}

/// The system that is called so, by the name of EPSG or of ESRI.
pub(super) fn named(text: &str) -> Option<ReferenceSystem> {
    let wanted = plain_name(text);
    if let Some(datum) = datums::named(text) {
        let known = datums::DATUMS.iter().find(|known| known.datum == datum)?;
        return by_code(known.code).ok();
    }
    let code = rows().find_map(|(codes, name, _)| {
        // Most rows are decided by their first letters.
        let start = plain_name(name.split('{').next().unwrap_or(name));
        if !wanted.contains(&start) {
            return None;
        }
        codes_of(codes).find_map(|(first, last, datum, unit)| {
            (first..=last).find(|code| {
                let rest = stepped(name, code - first).unwrap_or_default();
                let rest = plain_name(&rest) + unit_of(unit).1.trim_matches([' ', '(', ')']);
                let rest = rest.to_uppercase();
                let before = wanted.strip_suffix(rest.as_str());
                before.is_some_and(|before| {
                    let is_meant = datums::by_code(datum);
                    datums::named(before).is_some_and(|found| Some(found) == is_meant)
                })
            })
        })
    });
    by_code(code?).ok()
}
