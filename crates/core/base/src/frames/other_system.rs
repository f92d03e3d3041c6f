//! Reference systems that are described by numbers: other projections, other datums.
//!
//! Only what they are is here. The projections themselves and the table of codes are in the crate of
//! the maps, so that programs which open no map do not carry them.

use std::f64::consts::TAU;

use super::{Ellipsoid, Geodetic};

/// Method by which coordinates come from latitude and longitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProjectionMethod {
    /// They are longitude and latitude.
    Geographic,
    /// Transverse Mercator.
    TransverseMercator,
    /// Mercator on the ellipsoid.
    Mercator,
    /// Lambert's conformal conic.
    LambertConformal,
    /// Albers' equal-area conic.
    Albers,
    /// Lambert's azimuthal equal-area.
    LambertAzimuthal,
    /// Polar stereographic; the pole is that of `latitude_0`.
    PolarStereographic,
    /// Oblique (double) stereographic.
    ObliqueStereographic,
    /// Switzerland's oblique Mercator.
    SwissOblique,
    /// Křovák's cone of Czechia and Slovakia, counted east and north.
    Krovak,
}

/// A datum: the ellipsoid, and how its places come to those of WGS 84.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Datum {
    /// Name for people.
    pub name: &'static str,
    /// The ellipsoid.
    pub ellipsoid: Ellipsoid,
    /// Position-vector transformation to WGS 84: shifts in metres, rotations in radians, and the
    /// difference of the scale from 1.
    pub shift: [f64; 7],
    /// Distance by which places may be off after that, metres; 0 for WGS 84 itself, not a number where the shift
    /// is one that a file states.
    pub accuracy: f64,
}

/// The numbers of a reference system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SystemNumbers {
    /// The datum.
    pub datum: Datum,
    /// The projection.
    pub method: ProjectionMethod,
    /// Longitude of the prime meridian from Greenwich, radians.
    pub prime_meridian: f64,
    /// Latitude of the origin, radians.
    pub latitude_0: f64,
    /// Longitude of the origin from the prime meridian, radians.
    pub longitude_0: f64,
    /// The two standard parallels, radians; the latitude of the origin where there is one parallel.
    pub parallels: [f64; 2],
    /// Scale at the origin or along the parallels.
    pub scale: f64,
    /// Coordinates of the origin: easting and northing, metres.
    pub offset: [f64; 2],
    /// Metres, or radians of longitude and latitude, in the unit of the coordinates.
    pub unit: f64,
}

impl SystemNumbers {
    /// x of once around the Earth, where x counts along parallels.
    pub fn around(&self) -> Option<f64> {
        match self.method {
            ProjectionMethod::Geographic => Some(TAU / self.unit),
            ProjectionMethod::Mercator => {
                Some(TAU * self.datum.ellipsoid.semi_major * self.scale / self.unit)
            }
            _ => None,
        }
    }
}

/// Formulas that compute with [`SystemNumbers`].
pub trait SystemMethods: Sync {
    /// Latitude and longitude of WGS 84 of the coordinates (x, y), at height zero; `None` where they name
    /// no place on Earth.
    fn geodetic(&self, system: &OtherSystem, x: f64, y: f64) -> Option<Geodetic>;

    /// Coordinates (x, y) of a place; `None` where the system does not reach.
    fn coordinates(&self, system: &OtherSystem, place: &Geodetic) -> Option<(f64, f64)>;

    /// Name for people.
    fn name(&self, system: &OtherSystem) -> String;

    /// Well-known text as .prj files hold it.
    fn well_known_text(&self, system: &OtherSystem) -> String;
}

/// A reference system that is described by numbers.
#[derive(Clone, Copy)]
pub struct OtherSystem {
    /// EPSG code, if it has one.
    pub code: Option<u32>,
    /// Its definition. It stays for the life of the program, so that a system is as small as a code.
    pub numbers: &'static SystemNumbers,
    /// Formulas that compute with it.
    pub methods: &'static dyn SystemMethods,
}

/// Distance by which places of today's datums may differ from those of WGS 84 at most, metres.
const MOST_OF_TODAY: f64 = 10.0;

impl OtherSystem {
    /// Note on places that come through another datum than WGS 84.
    pub fn note(&self) -> Option<String> {
        let Datum {
            name,
            shift,
            accuracy,
            ..
        } = self.numbers.datum;
        if accuracy == 0.0 {
            return None;
        }
        let system = self.methods.name(self);
        let is_taken_for_it = shift == [0.0; 7];
        Some(if accuracy.is_nan() {
            format!("{system}: its datum is brought to WGS 84 by the shift that the file states")
        } else if is_taken_for_it && accuracy > MOST_OF_TODAY {
            format!(
                "{system}: only an ellipsoid is stated, no datum; it is taken for WGS 84, as today's datums are within \
                 2 m, but places of older ones on that ellipsoid lie up to {accuracy} m off: state the EPSG code"
            )
        } else if is_taken_for_it {
            format!(
                "{system}: its datum {name} is taken for WGS 84; places may be off by up to {accuracy} m"
            )
        } else {
            format!(
                "{system}: its datum {name} is brought to WGS 84 by its standard shift, which is good to \
                 {accuracy} m"
            )
        })
    }
}

impl PartialEq for OtherSystem {
    fn eq(&self, other: &Self) -> bool {
        // The accuracy of a stated shift is not a number.
        let plain = |mut numbers: SystemNumbers| {
            numbers.datum.accuracy = 0.0;
            numbers
        };
        self.code == other.code && plain(*self.numbers) == plain(*other.numbers)
    }
}

impl std::fmt::Debug for OtherSystem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OtherSystem")
            .field("code", &self.code)
            .field("numbers", &self.numbers)
            .finish_non_exhaustive()
    }
}
