//! A reference system out of its parts: the numbers that well-known text or the keys of a `GeoTIFF` give
//! for a projection.

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::{Datum, ProjectionMethod, ReferenceSystem};

use super::made::of_numbers;
use super::names::{plain, shortened};
use super::unstated::of_grid;
use super::{SystemError, code_table, datums, methods};

/// Role of a number in a projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ParameterRole {
    /// Latitude of the origin, radians.
    Latitude,
    /// Longitude of the origin, radians.
    Longitude,
    /// First standard parallel, or that of true scale, radians.
    FirstParallel,
    /// Second standard parallel, radians.
    SecondParallel,
    /// Scale.
    Scale,
    /// False easting, metres.
    Easting,
    /// False northing, metres.
    Northing,
    /// Azimuth of the line of true scale, radians.
    Azimuth,
}

/// A projected system before its projection is known by name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ProjectedDefinition {
    /// Name in the file.
    pub name: String,
    /// Its datum.
    pub datum: Datum,
    /// Longitude of its prime meridian, radians.
    pub prime_meridian: f64,
    /// Metres in the unit of the coordinates.
    pub unit: f64,
    /// Numbers that are given, by role.
    pub numbers: [Option<f64>; 8],
}

impl Default for ProjectedDefinition {
    fn default() -> Self {
        Self {
            name: String::new(),
            datum: datums::WGS84,
            prime_meridian: 0.0,
            unit: 1.0,
            numbers: [None; 8],
        }
    }
}

/// Names of projections, in capitals without anything but letters and digits.
const METHODS: [(&str, ProjectionMethod); 28] = [
    ("KROVAKNORTHORIENTATED", ProjectionMethod::Krovak),
    ("TRANSVERSEMERCATOR", ProjectionMethod::TransverseMercator),
    ("GAUSSKRUGER", ProjectionMethod::TransverseMercator),
    ("MERCATOR", ProjectionMethod::Mercator),
    ("MERCATOR1SP", ProjectionMethod::Mercator),
    ("MERCATOR2SP", ProjectionMethod::Mercator),
    ("MERCATORVARIANTA", ProjectionMethod::Mercator),
    ("MERCATORVARIANTB", ProjectionMethod::Mercator),
    ("LAMBERTCONFORMALCONIC", ProjectionMethod::LambertConformal),
    (
        "LAMBERTCONFORMALCONIC1SP",
        ProjectionMethod::LambertConformal,
    ),
    (
        "LAMBERTCONFORMALCONIC2SP",
        ProjectionMethod::LambertConformal,
    ),
    (
        "LAMBERTCONICCONFORMAL1SP",
        ProjectionMethod::LambertConformal,
    ),
    (
        "LAMBERTCONICCONFORMAL2SP",
        ProjectionMethod::LambertConformal,
    ),
    ("ALBERS", ProjectionMethod::Albers),
    ("ALBERSEQUALAREA", ProjectionMethod::Albers),
    ("ALBERSCONICEQUALAREA", ProjectionMethod::Albers),
    (
        "LAMBERTAZIMUTHALEQUALAREA",
        ProjectionMethod::LambertAzimuthal,
    ),
    ("POLARSTEREOGRAPHIC", ProjectionMethod::PolarStereographic),
    (
        "POLARSTEREOGRAPHICVARIANTA",
        ProjectionMethod::PolarStereographic,
    ),
    (
        "POLARSTEREOGRAPHICVARIANTB",
        ProjectionMethod::PolarStereographic,
    ),
    (
        "STEREOGRAPHICNORTHPOLE",
        ProjectionMethod::PolarStereographic,
    ),
    (
        "STEREOGRAPHICSOUTHPOLE",
        ProjectionMethod::PolarStereographic,
    ),
    (
        "OBLIQUESTEREOGRAPHIC",
        ProjectionMethod::ObliqueStereographic,
    ),
    (
        "DOUBLESTEREOGRAPHIC",
        ProjectionMethod::ObliqueStereographic,
    ),
    ("SWISSOBLIQUECYLINDRICAL", ProjectionMethod::SwissOblique),
    (
        "HOTINEOBLIQUEMERCATORAZIMUTHCENTER",
        ProjectionMethod::SwissOblique,
    ),
    (
        "HOTINEOBLIQUEMERCATORVARIANTB",
        ProjectionMethod::SwissOblique,
    ),
    ("OBLIQUEMERCATOR", ProjectionMethod::SwissOblique),
];

impl ProjectedDefinition {
    /// The system with the projection that a file calls so.
    pub fn system(&self, method: &str) -> Result<ReferenceSystem, SystemError> {
        let plain = plain(method);
        let is_web =
            plain == "POPULARVISUALISATIONPSEUDOMERCATOR" || plain == "MERCATORAUXILIARYSPHERE";
        if is_web && self.datum == datums::WGS84 && self.unit == 1.0 {
            return Ok(ReferenceSystem::WebMercator);
        }
        // ESRI's word for one at any origin, which here is known at the poles only.
        let latitude = self.numbers[ParameterRole::Latitude as usize].unwrap_or(0.0);
        let is_polar = plain == "STEREOGRAPHIC" && FRAC_PI_2 - latitude.abs() < 1e-9;
        let plain = if is_polar {
            "POLARSTEREOGRAPHIC"
        } else {
            plain.as_str()
        };
        let known = METHODS.iter().find(|(name, _)| *name == plain);
        let (_, known) = known.ok_or_else(|| SystemError::Method {
            name: self.name.clone(),
            method: shortened(method),
        })?;
        let is_south = plain.ends_with("SOUTHPOLE");
        self.with(*known, is_south)
    }

    /// The system with a projection.
    pub fn with(
        &self,
        method: ProjectionMethod,
        is_south: bool,
    ) -> Result<ReferenceSystem, SystemError> {
        let wrong = |cause: &str| SystemError::Number {
            name: self.name.clone(),
            cause: cause.to_owned(),
        };
        let number = |role: ParameterRole| self.numbers[role as usize];
        let mut numbers = code_table::plain_numbers(self.datum, method);
        numbers.unit = self.unit;
        numbers.prime_meridian = self.prime_meridian;
        numbers.longitude_0 = number(ParameterRole::Longitude)
            .ok_or_else(|| wrong("it does not say the longitude of its origin"))?;
        numbers.offset = [ParameterRole::Easting, ParameterRole::Northing]
            .map(|role| number(role).unwrap_or(0.0));
        numbers.scale = number(ParameterRole::Scale).unwrap_or(1.0);
        let (latitude, first, second) = (
            number(ParameterRole::Latitude),
            number(ParameterRole::FirstParallel),
            number(ParameterRole::SecondParallel),
        );
        match method {
            ProjectionMethod::LambertConformal | ProjectionMethod::Albers => {
                let first = first.or(latitude);
                let first = first.ok_or_else(|| wrong("it does not say its standard parallels"))?;
                numbers.latitude_0 = latitude.unwrap_or(first);
                numbers.parallels = [first, second.unwrap_or(first)];
            }
            ProjectionMethod::PolarStereographic => {
                let parallel = first.or(latitude);
                let parallel = parallel.ok_or_else(|| wrong("it does not say its pole"))?;
                let is_south = is_south || parallel < 0.0;
                numbers.latitude_0 = if is_south { -FRAC_PI_2 } else { FRAC_PI_2 };
                // At the pole itself the scale is given, elsewhere it follows from the parallel.
                if FRAC_PI_2 - parallel.abs() > 1e-9 {
                    if (numbers.scale - 1.0).abs() > 1e-9 {
                        return Err(wrong("it says both a parallel of true scale and a scale"));
                    }
                    numbers.scale = methods::scale_for(&numbers, parallel);
                }
            }
            ProjectionMethod::Mercator => {
                if let Some(parallel) = first {
                    numbers.scale *= methods::scale_for(&numbers, parallel);
                } else if latitude.is_some_and(|latitude| latitude.abs() > 1e-9) {
                    return Err(wrong("its origin lies off the equator"));
                }
            }
            ProjectionMethod::SwissOblique => {
                let azimuth = number(ParameterRole::Azimuth).unwrap_or(FRAC_PI_2);
                if (azimuth - FRAC_PI_2).abs() > 1e-9 {
                    return Err(SystemError::Method {
                        name: self.name.clone(),
                        method: "oblique Mercator of another azimuth than 90°".to_owned(),
                    });
                }
                numbers.latitude_0 =
                    latitude.ok_or_else(|| wrong("it does not say the latitude of its origin"))?;
            }
            ProjectionMethod::LambertAzimuthal | ProjectionMethod::ObliqueStereographic => {
                numbers.latitude_0 =
                    latitude.ok_or_else(|| wrong("it does not say the latitude of its origin"))?;
            }
            ProjectionMethod::Krovak => {
                numbers.latitude_0 =
                    latitude.ok_or_else(|| wrong("it does not say the latitude of its origin"))?;
                numbers.parallels =
                    [first.ok_or_else(|| wrong("it does not say its standard parallel"))?; 2];
                let azimuth = number(ParameterRole::Azimuth).map_or(30.288, f64::to_degrees);
                if (azimuth - 30.288).abs() > 0.01 {
                    return Err(wrong("its cone is not the one of Křovák"));
                }
            }
            ProjectionMethod::TransverseMercator | ProjectionMethod::Geographic => {
                numbers.latitude_0 = latitude.unwrap_or(0.0);
            }
        }
        if !matches!(
            method,
            ProjectionMethod::LambertConformal
                | ProjectionMethod::Albers
                | ProjectionMethod::Krovak
        ) {
            numbers.parallels = [numbers.latitude_0; 2];
        }
        numbers.datum = of_grid(&numbers);
        of_numbers(None, numbers).map_err(|cause| wrong(&cause))
    }
}
