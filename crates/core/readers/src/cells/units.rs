//! Units in which files write values.

use pilotage_base::frames::units::{METRES_PER_FOOT, MPS_PER_KNOT};
use pilotage_flight::Quantity;

/// Physical dimension of the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dimension {
    Length,
    Speed,
    Angle,
    AngularRate,
    Acceleration,
    /// Pixels and other bare numbers.
    Number,
}

/// The unit of angles whose degrees and minutes stand in one number, as satellite receivers write them (NMEA 0183): 4717.5
/// is 47° 17.5'.
pub(crate) const DEGREES_AND_MINUTES: &str = "ddmm";

/// The unit of angles of which 2^31 are half a turn, as activities of Garmin (FIT) have it.
pub(crate) const SEMICIRCLES: &str = "semicircles";

/// The number of which a unit is a factor: degrees of degrees and minutes in one number, any other as it stands.
pub(crate) fn linear(unit: &str, number: f64) -> f64 {
    if unit != DEGREES_AND_MINUTES {
        return number;
    }
    let whole = (number.abs() / 100.0).floor();
    (whole + (number.abs() - 100.0 * whole) / 60.0).copysign(number)
}

const LENGTHS: &[(&str, f64)] = &[
    ("m", 1.0),
    ("ft", METRES_PER_FOOT),
    ("km", 1000.0),
    ("dm", 0.1),
    ("cm", 0.01),
    ("mm", 0.001),
];
const SPEEDS: &[(&str, f64)] = &[
    ("m/s", 1.0),
    ("kt", MPS_PER_KNOT),
    ("km/h", 1.0 / 3.6),
    ("ft/s", METRES_PER_FOOT),
    ("ft/min", METRES_PER_FOOT / 60.0),
    ("mph", 0.447_04),
    ("dm/s", 0.1),
    ("cm/s", 0.01),
    ("mm/s", 0.001),
];
const ANGLES: &[(&str, f64)] = &[
    ("rad", 1.0),
    ("deg", std::f64::consts::PI / 180.0),
    // Tenths and hundredths of degrees.
    ("ddeg", std::f64::consts::PI / 1800.0),
    ("cdeg", std::f64::consts::PI / 18_000.0),
    ("mrad", 1e-3),
    (DEGREES_AND_MINUTES, std::f64::consts::PI / 180.0),
    ("deg1e5", std::f64::consts::PI / 1.8e7),
    ("deg1e6", std::f64::consts::PI / 1.8e8),
    ("deg1e7", std::f64::consts::PI / 1.8e9),
    ("deg1e8", std::f64::consts::PI / 1.8e10),
    (SEMICIRCLES, std::f64::consts::PI / 2_147_483_648.0),
];
const ANGULAR_RATES: &[(&str, f64)] = &[
    ("rad/s", 1.0),
    ("deg/s", std::f64::consts::PI / 180.0),
    ("ddeg/s", std::f64::consts::PI / 1800.0),
    ("cdeg/s", std::f64::consts::PI / 18_000.0),
    ("mrad/s", 1e-3),
];
/// Standard gravity, m/s².
const GRAVITY: f64 = 9.806_65;
const ACCELERATIONS: &[(&str, f64)] = &[
    ("m/s2", 1.0),
    ("g", GRAVITY),
    ("mg", 1e-3 * GRAVITY),
    ("cm/s2", 0.01),
    ("mm/s2", 0.001),
];
const NUMBERS: &[(&str, f64)] = &[("px", 1.0), ("", 1.0)];

impl Dimension {
    /// That of a quantity.
    pub(crate) fn of(quantity: Quantity) -> Self {
        quantity.into()
    }

    /// Names of the units that there are.
    pub(crate) fn names(self) -> Vec<&'static str> {
        self.units().iter().map(|(name, _)| *name).collect()
    }

    fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Length => LENGTHS,
            Self::Speed => SPEEDS,
            Self::Angle => ANGLES,
            Self::AngularRate => ANGULAR_RATES,
            Self::Acceleration => ACCELERATIONS,
            Self::Number => NUMBERS,
        }
    }

    /// Factor from `unit` to SI and radians; without a unit values are in SI already. The error
    /// names the units that there are.
    pub(crate) fn factor(self, unit: Option<&str>) -> Result<f64, String> {
        let Some(unit) = unit else { return Ok(1.0) };
        let known = self.units();
        known
            .iter()
            .find(|(name, _)| *name == unit)
            .map(|(_, factor)| *factor)
            .ok_or_else(|| {
                let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
                format!(
                    "\"{}\" is not a unit for this; use one of {}",
                    shortened(unit),
                    names.join(", ")
                )
            })
    }
}

impl From<Quantity> for Dimension {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Length => Self::Length,
            Quantity::Speed => Self::Speed,
            Quantity::Angle => Self::Angle,
            Quantity::AngularRate => Self::AngularRate,
            Quantity::Acceleration => Self::Acceleration,
        }
    }
}

/// At most forty characters, for messages.
pub(crate) fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}
