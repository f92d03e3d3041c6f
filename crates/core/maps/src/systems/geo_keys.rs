//! A reference system out of the keys of a `GeoTIFF`, where they give no code for it.
//!
//! Keys and codes of projections after OGC 19-008r4, annex B.

use pilotage_base::frames::{Datum, Ellipsoid, ProjectionMethod, ReferenceSystem};

use super::definition::{ParameterRole, ProjectedDefinition};
use super::keys::{GEOGRAPHIC_CITATION, GEOGRAPHIC_TYPE, LINEAR_UNITS, MODEL_TYPE, USER_DEFINED};
use super::made::of_numbers;
use super::names::shortened;
use super::{SystemError, code_table, datums};

const DATUM: u64 = 2050;
const ANGULAR_UNITS: u64 = 2054;
const ANGULAR_UNIT_SIZE: u64 = 2055;
const ELLIPSOID: u64 = 2056;
const SEMI_MAJOR: u64 = 2057;
const SEMI_MINOR: u64 = 2058;
const INVERSE_FLATTENING: u64 = 2059;
const PRIME_MERIDIAN_LONGITUDE: u64 = 2061;
const TO_WGS84: u64 = 2062;
/// UTM zones have codes of their own as projections: 16001-16060 north, 16101-16160 south.
const PROJECTION: u64 = 3074;
const TRANSFORMATION: u64 = 3075;
const LINEAR_UNIT_SIZE: u64 = 3077;

/// Keys that hold a number of each role, by what the projections call them.
const ROLES: &[(ParameterRole, &[u64])] = &[
    (ParameterRole::Latitude, &[3081, 3085, 3089]),
    (ParameterRole::Longitude, &[3080, 3084, 3088, 3095]),
    (ParameterRole::FirstParallel, &[3078]),
    (ParameterRole::SecondParallel, &[3079]),
    (ParameterRole::Scale, &[3092, 3093]),
    (ParameterRole::Easting, &[3082, 3086, 3090]),
    (ParameterRole::Northing, &[3083, 3087, 3091]),
    (ParameterRole::Azimuth, &[3094]),
];

/// Codes of projections.
const TRANSFORMATIONS: &[(u64, ProjectionMethod)] = &[
    (1, ProjectionMethod::TransverseMercator),
    (7, ProjectionMethod::Mercator),
    (8, ProjectionMethod::LambertConformal),
    (9, ProjectionMethod::LambertConformal),
    (10, ProjectionMethod::LambertAzimuthal),
    (11, ProjectionMethod::Albers),
    (15, ProjectionMethod::PolarStereographic),
    (16, ProjectionMethod::ObliqueStereographic),
];

/// Names of projections that are not read, by their codes.
const UNREAD: &[(u64, &str)] = &[
    (3, "Oblique Mercator"),
    (12, "Azimuthal Equidistant"),
    (13, "Equidistant Conic"),
    (14, "Stereographic"),
    (17, "Equirectangular"),
    (18, "Cassini-Soldner"),
    (19, "Gnomonic"),
    (20, "Miller Cylindrical"),
    (21, "Orthographic"),
    (22, "Polyconic"),
    (23, "Robinson"),
    (24, "Sinusoidal"),
    (25, "Van der Grinten"),
    (26, "New Zealand Map Grid"),
    (27, "Transverse Mercator, south orientated"),
    (28, "Cylindrical Equal Area"),
    (9815, "Hotine Oblique Mercator"),
];

/// Values of the keys of a file.
pub(crate) struct KeyValues<'a> {
    /// The whole number of a key.
    pub number: &'a dyn Fn(u64) -> Option<u64>,
    /// The real numbers of a key.
    pub reals: &'a dyn Fn(u64) -> Vec<f64>,
    /// The text of a key.
    pub text: &'a dyn Fn(u64) -> Option<String>,
}

impl KeyValues<'_> {
    fn real(&self, key: u64) -> Option<f64> {
        (self.reals)(key).first().copied()
    }
}

/// The system that keys of a `GeoTIFF` describe, without a code; `None` if they describe none.
pub(crate) fn described(
    name: &str,
    keys: &KeyValues,
) -> Option<Result<ReferenceSystem, SystemError>> {
    let number = keys.number;
    let real = |key: u64| keys.real(key);
    let is_projected = number(MODEL_TYPE) != Some(2);
    let datum = match datum(keys) {
        Ok(datum) => datum,
        Err(datum) => {
            return Some(Err(SystemError::Datum {
                name: name.to_owned(),
                datum,
            }));
        }
    };
    let angle = (number(ANGULAR_UNITS).and_then(super::units::angle))
        .or_else(|| real(ANGULAR_UNIT_SIZE))
        .unwrap_or(1.0_f64.to_radians());
    let prime_meridian = real(PRIME_MERIDIAN_LONGITUDE).unwrap_or(0.0) * angle;
    if !is_projected {
        let mut numbers = code_table::plain_numbers(datum, ProjectionMethod::Geographic);
        numbers.unit = angle;
        numbers.prime_meridian = prime_meridian;
        let system = of_numbers(None, numbers);
        return Some(system.map_err(|cause| SystemError::Number {
            name: name.to_owned(),
            cause,
        }));
    }
    let unit = match number(LINEAR_UNITS) {
        None => 1.0,
        Some(code) => match super::units::length(code).or_else(|| real(LINEAR_UNIT_SIZE)) {
            Some(unit) => unit,
            None => {
                return Some(Err(SystemError::Number {
                    name: name.to_owned(),
                    cause: format!("its unit of length, EPSG:{code}, is not known"),
                }));
            }
        },
    };
    let mut definition = ProjectedDefinition {
        name: name.to_owned(),
        datum,
        prime_meridian,
        unit,
        ..ProjectedDefinition::default()
    };
    // A UTM zone by the code of its projection.
    if let Some(zone @ (16_001..=16_060 | 16_101..=16_160)) = number(PROJECTION) {
        let meridian = 6.0 * (zone % 100) as f64 - 183.0;
        let of_zone = [
            (ParameterRole::Latitude, 0.0),
            (ParameterRole::Longitude, meridian.to_radians()),
            (ParameterRole::Scale, 0.9996),
            (ParameterRole::Easting, 500_000.0),
            (
                ParameterRole::Northing,
                if zone > 16_100 { 1e7 } else { 0.0 },
            ),
        ];
        for (role, value) in of_zone {
            definition.numbers[role as usize] = Some(value);
        }
        return Some(definition.with(ProjectionMethod::TransverseMercator, false));
    }
    let code = number(TRANSFORMATION)?;
    for (role, of_role) in ROLES {
        let value = of_role.iter().find_map(|key| real(*key));
        let size = match role {
            ParameterRole::Scale => 1.0,
            ParameterRole::Easting | ParameterRole::Northing => unit,
            _ => angle,
        };
        definition.numbers[*role as usize] = value.map(|value| value * size);
    }
    let method = TRANSFORMATIONS.iter().find(|(known, _)| *known == code);
    Some(match method {
        Some((_, method)) => definition.with(*method, false),
        None => Err(SystemError::Method {
            name: name.to_owned(),
            method: match UNREAD.iter().find(|(known, _)| *known == code) {
                Some((_, method)) => (*method).to_owned(),
                None => format!("code {code} of GeoTIFF"),
            },
        }),
    })
}

/// The datum of the keys; the error is what they call it.
fn datum(keys: &KeyValues) -> Result<Datum, String> {
    let number = keys.number;
    let user = |code: &u64| *code != USER_DEFINED;
    let by_system = number(GEOGRAPHIC_TYPE)
        .filter(user)
        .map(|code| datums::by_code(code as u32).ok_or(format!("EPSG:{code}")));
    let by_datum = || {
        let code = number(DATUM).filter(user)?;
        Some(datums::by_datum_code(code as u32).ok_or(format!("EPSG:{code}")))
    };
    // "GCS Name = NAD83|Datum = North_American_Datum_1983|Ellipsoid = GRS 1980|…".
    let by_name = || {
        let citation = (keys.text)(GEOGRAPHIC_CITATION)?;
        let parts = citation.split(['|', '=']).map(str::trim);
        let found = parts.clone().find_map(datums::named);
        Some(found.ok_or_else(|| shortened(&citation)))
    };
    let known = by_system.or_else(by_datum).or_else(by_name);
    let shift = (keys.reals)(TO_WGS84);
    match (known, shift.as_slice()) {
        (Some(known), []) => known,
        // A zone of UTM without a word about the datum is one of WGS 84.
        (None, []) if number(GEOGRAPHIC_TYPE).is_none() && number(PROJECTION).is_some() => {
            Ok(datums::WGS84)
        }
        (None, []) => Err("without a name".to_owned()),
        (known, shift) => {
            let known = known.and_then(Result::ok);
            let stated = datums::stated(known, ellipsoid(keys), shift.iter().copied());
            stated.ok_or_else(|| "without an ellipsoid".to_owned())
        }
    }
}

/// The ellipsoid of the keys.
fn ellipsoid(keys: &KeyValues) -> Option<Ellipsoid> {
    let known = match (keys.number)(ELLIPSOID) {
        Some(7030) => Some(Ellipsoid::WGS84),
        Some(7019) => datums::by_code(4258).map(|datum| datum.ellipsoid),
        Some(7004) => datums::by_code(4314).map(|datum| datum.ellipsoid),
        Some(7001) => datums::by_code(4277).map(|datum| datum.ellipsoid),
        Some(7022) => datums::by_code(4230).map(|datum| datum.ellipsoid),
        Some(7024) => datums::by_code(4179).map(|datum| datum.ellipsoid),
        Some(7008) => datums::by_code(4267).map(|datum| datum.ellipsoid),
        _ => None,
    };
    known.or_else(|| {
        let semi_major = keys.real(SEMI_MAJOR)?;
        let flattening = match (keys.real(INVERSE_FLATTENING), keys.real(SEMI_MINOR)) {
            (Some(inverse), _) if inverse != 0.0 => 1.0 / inverse,
            (_, Some(semi_minor)) => 1.0 - semi_minor / semi_major,
            _ => return None,
        };
        Some(Ellipsoid {
            semi_major,
            flattening,
        })
    })
}
