//! Projections onto cylinders: Mercator and Switzerland's oblique Mercator.

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::SystemNumbers;

use super::latitudes::{isometric, latitude_of};

/// Mercator, EPSG methods 9804 and 9805; a standard parallel is in the scale.
pub(super) fn mercator(numbers: &SystemNumbers, latitude: f64, longitude: f64) -> (f64, f64) {
    let radius = numbers.datum.ellipsoid.semi_major * numbers.scale;
    let north = isometric(&numbers.datum.ellipsoid, latitude);
    (radius * longitude, radius * north)
}

/// Inverse of [`mercator`].
pub(super) fn from_mercator(numbers: &SystemNumbers, x: f64, y: f64) -> (f64, f64) {
    let radius = numbers.datum.ellipsoid.semi_major * numbers.scale;
    (
        latitude_of(&numbers.datum.ellipsoid, y / radius),
        x / radius,
    )
}

/// Switzerland's projection: the ellipsoid onto a sphere that touches it at the origin, and the sphere
/// onto a cylinder that touches it along the great circle through the origin, eastward. After swisstopo,
/// "Formulas and constants for the calculation of the Swiss conformal cylindrical projection".
struct Swiss {
    /// Radius of the sphere times the scale, metres.
    radius: f64,
    /// Longitudes on the sphere per longitude on the ellipsoid.
    alpha: f64,
    /// Latitude of the origin on the sphere.
    origin: f64,
    /// Offset of the isometric latitudes.
    k: f64,
}

impl Swiss {
    fn new(numbers: &SystemNumbers) -> Self {
        let ellipsoid = &numbers.datum.ellipsoid;
        let e2 = ellipsoid.eccentricity_squared();
        let (sine, cosine) = numbers.latitude_0.sin_cos();
        let alpha = (1.0 + e2 * cosine.powi(4) / (1.0 - e2)).sqrt();
        let origin = (sine / alpha).asin();
        Self {
            radius: numbers.scale * ellipsoid.semi_major * (1.0 - e2).sqrt()
                / (1.0 - e2 * sine * sine),
            alpha,
            origin,
            k: origin.tan().asinh() - alpha * isometric(ellipsoid, numbers.latitude_0),
        }
    }
}

/// Coordinates in Switzerland's projection.
pub(super) fn swiss(numbers: &SystemNumbers, latitude: f64, longitude: f64) -> (f64, f64) {
    let swiss = Swiss::new(numbers);
    let north = swiss.alpha * isometric(&numbers.datum.ellipsoid, latitude) + swiss.k;
    let (b, l) = (north.sinh().atan(), swiss.alpha * longitude);
    let (sin_origin, cos_origin) = swiss.origin.sin_cos();
    let sin_turned = cos_origin * b.sin() - sin_origin * b.cos() * l.cos();
    let cos_turned = b.cos() * l.cos() * cos_origin + b.sin() * sin_origin;
    let l_turned = (b.cos() * l.sin()).atan2(cos_turned);
    (swiss.radius * l_turned, swiss.radius * sin_turned.atanh())
}

/// Inverse of [`swiss`]; `None` beyond the quarter of the globe around the origin.
pub(super) fn from_swiss(numbers: &SystemNumbers, x: f64, y: f64) -> Option<(f64, f64)> {
    let swiss = Swiss::new(numbers);
    let l_turned = x / swiss.radius;
    if l_turned.abs() > FRAC_PI_2 {
        return None;
    }
    let b_turned = (y / swiss.radius).sinh().atan();
    let (sin_origin, cos_origin) = swiss.origin.sin_cos();
    let sine = cos_origin * b_turned.sin() + sin_origin * b_turned.cos() * l_turned.cos();
    let cosine = b_turned.cos() * l_turned.cos() * cos_origin - b_turned.sin() * sin_origin;
    let l = (b_turned.cos() * l_turned.sin()).atan2(cosine);
    let isometric = (sine.atanh() - swiss.k) / swiss.alpha;
    Some((
        latitude_of(&numbers.datum.ellipsoid, isometric),
        l / swiss.alpha,
    ))
}
