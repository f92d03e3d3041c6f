//! Fields of a format that hold the roles, and factors of the units that logs state.

use crate::log::LogFormat;
use crate::role::{DEGREE, RoleSource, RowCondition};

const GRAVITY: f64 = pilotage_base::frames::units::GRAVITY;

/// Places of a format, for each role the best first.
pub fn sources(format: LogFormat) -> impl Iterator<Item = &'static RoleSource> {
    format.meaning().roles.iter().copied().flatten()
}

/// Conditions of a format's rows.
pub fn conditions(format: LogFormat) -> &'static [RowCondition] {
    format.meaning().conditions
}

/// Factor to SI and radians of a unit as logs write it; `None` if it is not known.
pub fn factor_of_unit(unit: &str) -> Option<f64> {
    Some(match unit {
        "deg" | "degheading" | "deglatitude" | "deglongitude" | "deg/s" | "degrees" => DEGREE,
        "cdeg" | "cdeg/s" => 0.01 * DEGREE,
        "degE7" => 1e-7 * DEGREE,
        "rad" | "rad/s" | "m" | "m/s" | "m/s/s" | "m/s^2" | "m/s²" | "s" | "satellites" => 1.0,
        "mrad/s" | "mm" | "mm/s" => 1e-3,
        "cm" | "cm/s" => 0.01,
        "km" => 1e3,
        "km/h" => 1.0 / 3.6,
        "knots" | "kt" => pilotage_base::frames::units::MPS_PER_KNOT,
        "ft" => pilotage_base::frames::units::METRES_PER_FOOT,
        "mG" | "mg" => 1e-3 * GRAVITY,
        "G" => GRAVITY,
        _ => return None,
    })
}
