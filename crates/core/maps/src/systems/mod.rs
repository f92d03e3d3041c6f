//! Reference systems beside those of WGS 84: by EPSG code, by well-known text, and by the keys of a
//! `GeoTIFF`.
//!
//! Formulas after IOGP Publication 373-7-2, "Coordinate Conversions and Transformations including
//! Formulas". They are the project's own because the crate `proj4rs` exports functions to JavaScript that
//! no program of the page can leave out.

mod codes;
mod datums;
mod definition;
mod geo_keys;
mod methods;
#[cfg(test)]
mod tests;
mod units;
mod well_known_text;

use std::f64::consts::PI;
use std::sync::{Mutex, PoisonError};

use pilotage_base::frames::{
    Ellipsoid, Geodetic, OtherSystem, ProjectionMethod, ReferenceSystem, SystemMethods,
    SystemNumbers, wrap_pi,
};

pub(crate) use geo_keys::{KeyValues, described};
pub(crate) use units::length;

/// Reason why a reference system cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// It is not among those that are known.
    #[error(
        "the reference system {name} is not known; warp the map to EPSG:4326, EPSG:3857 or a UTM zone of WGS 84"
    )]
    Unknown {
        /// Its name in the file.
        name: String,
    },
    /// The shift of its datum to WGS 84 is not known.
    #[error(
        "the reference system {name} is on the datum \"{datum}\", whose shift to WGS 84 is not known; warp the map to EPSG:4326, EPSG:3857 or a UTM zone of WGS 84"
    )]
    Datum {
        /// Name of the system in the file.
        name: String,
        /// Name of the datum in the file.
        datum: String,
    },
    /// Its projection is not known.
    #[error(
        "the projection \"{method}\" of the reference system {name} is not known; warp the map to EPSG:4326, EPSG:3857 or a UTM zone of WGS 84"
    )]
    Method {
        /// Name of the system in the file.
        name: String,
        /// Name of the projection in the file.
        method: String,
    },
    /// A number of its description is missing or impossible.
    #[error("the reference system {name}: {cause}")]
    Number {
        /// Its name in the file.
        name: String,
        /// The fault.
        cause: String,
    },
}

impl SystemError {
    fn unknown(name: impl Into<String>) -> Self {
        Self::Unknown { name: name.into() }
    }
}

/// The system with that EPSG code, of WGS 84 or another datum.
pub fn by_code(code: u32) -> Result<ReferenceSystem, SystemError> {
    let own = ReferenceSystem::from_epsg(code);
    own.or_else(|| codes::system(code))
        .ok_or_else(|| SystemError::unknown(format!("EPSG:{code}")))
}

/// All codes of the table, beside those of WGS 84 that [`ReferenceSystem::from_epsg`] knows.
pub fn codes() -> Vec<u32> {
    codes::all()
}

/// The system that a text names: "EPSG:25832", a bare code, a name like "WGS 84 / UTM zone 17N" or
/// "ETRS89 / UTM zone 32N", or well-known text of either version, as .prj files hold it.
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
    if text.contains(['[', '(']) && text.contains(['"', '\u{201c}']) {
        match well_known_text::read(text) {
            Ok(system) => return Ok(system),
            // Some programs write only its beginning.
            Err(cause) => return ReferenceSystem::from_name(text).ok_or(cause),
        }
    }
    (ReferenceSystem::from_name(text).or_else(|| codes::named(text)))
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
            ..codes::plain_numbers(datums::WGS84, ProjectionMethod::TransverseMercator)
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

/// The system of these numbers, by its own type where it is one of WGS 84. The error says which number is
/// impossible.
fn of_numbers(code: Option<u32>, numbers: SystemNumbers) -> Result<ReferenceSystem, String> {
    checked(&numbers)?;
    let numbers =
        kept(&numbers).ok_or_else(|| format!("more than {MOST_SYSTEMS} systems were opened"))?;
    let other = OtherSystem {
        code,
        numbers,
        methods: &Methods,
    };
    Ok(simpler(&other).unwrap_or(ReferenceSystem::Other(other)))
}

/// Most systems that a program keeps: people have a handful.
const MOST_SYSTEMS: usize = 5000;

/// The same numbers for the life of the program; `None` if there are too many already.
fn kept(numbers: &SystemNumbers) -> Option<&'static SystemNumbers> {
    static KEPT: Mutex<Vec<&'static SystemNumbers>> = Mutex::new(Vec::new());
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    // A stated shift has an accuracy that is not a number and is equal to none, so bits are compared.
    let bits = |numbers: &SystemNumbers| {
        let mut plain = *numbers;
        let accuracy = plain.datum.accuracy.to_bits();
        plain.datum.accuracy = 0.0;
        (plain, accuracy)
    };
    let own = bits(numbers);
    if let Some(known) = kept.iter().find(|known| bits(known) == own) {
        return Some(known);
    }
    if kept.len() >= MOST_SYSTEMS {
        return None;
    }
    let new: &'static SystemNumbers = Box::leak(Box::new(*numbers));
    kept.push(new);
    Some(new)
}

/// The system of WGS 84 that is the same, where there is one.
fn simpler(other: &OtherSystem) -> Option<ReferenceSystem> {
    let numbers = other.numbers;
    if numbers.datum.accuracy != 0.0 || numbers.prime_meridian != 0.0 {
        return None;
    }
    let is_near = |a: f64, b: f64| (a - b).abs() < 1e-9 * b.abs().max(1.0);
    match numbers.method {
        ProjectionMethod::Geographic => {
            is_near(numbers.unit.to_degrees(), 1.0).then_some(ReferenceSystem::Geographic)
        }
        ProjectionMethod::TransverseMercator => {
            let zone = (numbers.longitude_0.to_degrees() + 183.0) / 6.0;
            let is_south = numbers.offset[1] > 0.0;
            let is_utm = is_near(zone, zone.round())
                && (1.0..=60.0).contains(&zone.round())
                && is_near(numbers.scale, 0.9996)
                && is_near(numbers.latitude_0, 0.0)
                && is_near(numbers.offset[0], 500_000.0)
                && (numbers.offset[1] == 0.0 || is_near(numbers.offset[1], 1e7))
                && is_near(numbers.unit, 1.0);
            is_utm.then_some(ReferenceSystem::Utm {
                zone: zone.round() as u8,
                is_south,
            })
        }
        _ => None,
    }
}

/// The error names the first number with which no place can be computed.
fn checked(numbers: &SystemNumbers) -> Result<(), String> {
    let Ellipsoid {
        semi_major,
        flattening,
    } = numbers.datum.ellipsoid;
    let latitudes = [
        numbers.latitude_0,
        numbers.parallels[0],
        numbers.parallels[1],
    ];
    let wrong = |what: &str| Err(format!("{what} is missing or impossible"));
    if !(6.3e6..=6.4e6).contains(&semi_major) || !(0.0..=0.01).contains(&flattening) {
        return wrong("the size of its ellipsoid");
    }
    if !latitudes.iter().all(|v| v.abs() <= PI / 2.0 + 1e-12) {
        return wrong("a latitude of its origin or parallels");
    }
    if !(numbers.longitude_0.abs() <= 2.0 * PI && numbers.prime_meridian.abs() <= PI) {
        return wrong("a longitude of its origin");
    }
    if !(0.01..=10.0).contains(&numbers.scale) {
        return wrong("its scale factor");
    }
    if !numbers.offset.iter().all(|v| v.abs() <= 1e9) {
        return wrong("a false easting or northing");
    }
    let unit = numbers.unit;
    if !(unit.is_finite() && unit > 0.0 && unit <= 1e5) {
        return wrong("its unit");
    }
    if !numbers.datum.shift.iter().all(|v| v.abs() <= 1e4) {
        return wrong("its shift to WGS 84");
    }
    let is_cone = matches!(
        numbers.method,
        ProjectionMethod::LambertConformal | ProjectionMethod::Albers
    );
    if is_cone && (numbers.parallels[0] + numbers.parallels[1]).abs() < 1e-6 {
        return wrong("a standard parallel");
    }
    let is_polar = (numbers.latitude_0.abs() - PI / 2.0).abs() < 1e-9;
    if (numbers.method == ProjectionMethod::PolarStereographic) != is_polar
        && matches!(
            numbers.method,
            ProjectionMethod::PolarStereographic
                | ProjectionMethod::ObliqueStereographic
                | ProjectionMethod::SwissOblique
        )
    {
        return wrong("the latitude of its origin");
    }
    Ok(())
}

/// The formulas of this module.
struct Methods;

impl SystemMethods for Methods {
    fn geodetic(&self, system: &OtherSystem, x: f64, y: f64) -> Option<Geodetic> {
        let numbers = system.numbers;
        let (x, y) = (x * numbers.unit, y * numbers.unit);
        let (latitude, longitude) = if numbers.method == ProjectionMethod::Geographic {
            (y, x)
        } else {
            let (x, y) = (x - numbers.offset[0], y - numbers.offset[1]);
            let (latitude, longitude) = methods::unproject(numbers, x, y)?;
            (latitude, longitude + numbers.longitude_0)
        };
        let is_place = latitude.abs() <= 90.6_f64.to_radians() && longitude.abs() <= 4.0 * PI;
        if !is_place {
            return None;
        }
        let latitude = latitude.clamp(-PI / 2.0, PI / 2.0);
        let place = datums::to_wgs84(&numbers.datum, latitude, longitude + numbers.prime_meridian);
        Some(Geodetic {
            latitude: place.0,
            longitude: place.1,
            height: 0.0,
        })
    }

    fn coordinates(&self, system: &OtherSystem, place: &Geodetic) -> Option<(f64, f64)> {
        let numbers = system.numbers;
        let (latitude, longitude) =
            datums::from_wgs84(&numbers.datum, place.latitude, place.longitude);
        let longitude = longitude - numbers.prime_meridian;
        let (x, y) = if numbers.method == ProjectionMethod::Geographic {
            (wrap_pi(longitude), latitude)
        } else {
            let from_middle = wrap_pi(longitude - numbers.longitude_0);
            let (x, y) = methods::project(numbers, latitude, from_middle)?;
            (x + numbers.offset[0], y + numbers.offset[1])
        };
        let (x, y) = (x / numbers.unit, y / numbers.unit);
        (x.is_finite() && y.is_finite()).then_some((x, y))
    }

    fn name(&self, system: &OtherSystem) -> String {
        if let Some(name) = system.code.and_then(codes::name) {
            return name;
        }
        let numbers = system.numbers;
        let degrees = |radians: f64| (radians.to_degrees() * 1e6).round() / 1e6;
        let datum = numbers.datum.name;
        match numbers.method {
            ProjectionMethod::Geographic => format!("{datum}, longitude and latitude"),
            method => format!(
                "{datum}, {} around {}°, {}°",
                methods::name(method),
                degrees(numbers.latitude_0),
                degrees(numbers.longitude_0 + numbers.prime_meridian),
            ),
        }
    }

    fn well_known_text(&self, system: &OtherSystem) -> String {
        well_known_text::write(system, &self.name(system))
    }
}

fn shortened(text: &str) -> String {
    text.trim().chars().take(60).collect()
}

/// Letters and digits in capitals.
fn plain(text: &str) -> String {
    (text.chars())
        .filter(char::is_ascii_alphanumeric)
        .map(|c| c.to_ascii_uppercase())
        .collect()
}
