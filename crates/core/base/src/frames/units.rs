//! Conversions at the edge: SI and radians inside, the user's units outside.

/// Metres in an international foot.
pub const METRES_PER_FOOT: f64 = 0.3048;
/// Metres per second in a knot.
pub const MPS_PER_KNOT: f64 = 1852.0 / 3600.0;
/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.806_65;

/// Mean radius of the earth, metres, where a sphere is near enough.
pub const EARTH_RADIUS: f64 = 6_371_000.0;

/// Feet to metres.
pub fn feet(value: f64) -> f64 {
    value * METRES_PER_FOOT
}

/// Knots to metres per second.
///
/// ```
/// use pilotage_base::frames::units::{feet, knots};
///
/// // A knot is a nautical mile of 1852 m an hour.
/// assert!((knots(36.0) - 18.52).abs() < 1e-12);
/// assert!((feet(400.0) - 121.92).abs() < 1e-12);
/// ```
pub fn knots(value: f64) -> f64 {
    value * MPS_PER_KNOT
}

/// Degrees to radians.
pub fn degrees(value: f64) -> f64 {
    value.to_radians()
}
