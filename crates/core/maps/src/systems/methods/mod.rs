//! Map projections of an ellipsoid.
//!
//! Longitudes count from that of the origin, in (-π, π]; coordinates are metres without false easting and
//! northing.

mod azimuthal;
mod conic;
mod cylindrical;
mod krovak;

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::{Ellipsoid, ProjectionMethod, SystemNumbers, TransverseMercator};

/// Farthest from its central meridian that a transverse Mercator projection is used, radians.
const WIDEST: f64 = 0.7;

/// Coordinates of a place; `None` where the projection does not reach.
pub(super) fn project(
    numbers: &SystemNumbers,
    latitude: f64,
    longitude: f64,
) -> Option<(f64, f64)> {
    let (x, y) = match numbers.method {
        ProjectionMethod::Geographic => (longitude, latitude),
        ProjectionMethod::TransverseMercator => {
            if longitude.abs() > WIDEST {
                return None;
            }
            let projection = TransverseMercator::new(numbers.datum.ellipsoid, numbers.scale);
            let (x, y) = projection.project(latitude, longitude);
            (x, y - projection.project(numbers.latitude_0, 0.0).1)
        }
        ProjectionMethod::Mercator => cylindrical::mercator(numbers, latitude, longitude),
        ProjectionMethod::SwissOblique => cylindrical::swiss(numbers, latitude, longitude),
        ProjectionMethod::Krovak => {
            krovak::Krovak::new(numbers).project(numbers, latitude, longitude)
        }
        ProjectionMethod::LambertConformal => {
            conic::LambertConformal::new(numbers).project(latitude, longitude)
        }
        ProjectionMethod::Albers => conic::Albers::new(numbers).project(latitude, longitude)?,
        ProjectionMethod::LambertAzimuthal => {
            azimuthal::LambertAzimuthal::new(numbers).project(latitude, longitude)?
        }
        ProjectionMethod::PolarStereographic => azimuthal::polar(numbers, latitude, longitude),
        ProjectionMethod::ObliqueStereographic => {
            azimuthal::Oblique::new(numbers).project(latitude, longitude)?
        }
    };
    (x.is_finite() && y.is_finite()).then_some((x, y))
}

/// Latitude, and longitude from the origin, of coordinates; `None` where they name no place.
pub(super) fn unproject(numbers: &SystemNumbers, x: f64, y: f64) -> Option<(f64, f64)> {
    let (latitude, longitude) = match numbers.method {
        ProjectionMethod::Geographic => (y, x),
        ProjectionMethod::TransverseMercator => {
            let a = numbers.datum.ellipsoid.semi_major;
            let projection = TransverseMercator::new(numbers.datum.ellipsoid, numbers.scale);
            let north = y + projection.project(numbers.latitude_0, 0.0).1;
            if !(x.abs() < 0.8 * a && north.abs() < 1.6 * a) {
                return None;
            }
            projection.unproject(x, north)
        }
        ProjectionMethod::Mercator => cylindrical::from_mercator(numbers, x, y),
        ProjectionMethod::SwissOblique => cylindrical::from_swiss(numbers, x, y)?,
        ProjectionMethod::Krovak => krovak::Krovak::new(numbers).unproject(numbers, x, y),
        ProjectionMethod::LambertConformal => {
            conic::LambertConformal::new(numbers).unproject(x, y)?
        }
        ProjectionMethod::Albers => conic::Albers::new(numbers).unproject(x, y)?,
        ProjectionMethod::LambertAzimuthal => {
            azimuthal::LambertAzimuthal::new(numbers).unproject(x, y)?
        }
        ProjectionMethod::PolarStereographic => azimuthal::from_polar(numbers, x, y),
        ProjectionMethod::ObliqueStereographic => {
            azimuthal::Oblique::new(numbers).unproject(x, y)?
        }
    };
    (latitude.is_finite() && longitude.is_finite()).then_some((latitude, longitude))
}

/// Name for people.
pub(super) fn name(method: ProjectionMethod) -> &'static str {
    match method {
        ProjectionMethod::Geographic => "longitude and latitude",
        ProjectionMethod::TransverseMercator => "transverse Mercator",
        ProjectionMethod::Mercator => "Mercator",
        ProjectionMethod::LambertConformal => "Lambert conformal conic",
        ProjectionMethod::Albers => "Albers equal-area conic",
        ProjectionMethod::LambertAzimuthal => "Lambert azimuthal equal-area",
        ProjectionMethod::PolarStereographic => "polar stereographic",
        ProjectionMethod::ObliqueStereographic => "oblique stereographic",
        ProjectionMethod::SwissOblique => "Swiss oblique Mercator",
        ProjectionMethod::Krovak => "Křovák's cone",
    }
}

/// Isometric latitude ψ = artanh(sin φ) - e · artanh(e · sin φ), without bound at the poles.
fn isometric(ellipsoid: &Ellipsoid, latitude: f64) -> f64 {
    if latitude.abs() >= FRAC_PI_2 {
        return f64::INFINITY.copysign(latitude);
    }
    ellipsoid.conformal_tangent(latitude.tan()).asinh()
}

/// Inverse of [`isometric`].
fn latitude_of(ellipsoid: &Ellipsoid, isometric: f64) -> f64 {
    if isometric.abs() > 40.0 {
        return FRAC_PI_2.copysign(isometric);
    }
    ellipsoid.geodetic_tangent(isometric.sinh()).atan()
}

/// Radius of the parallel in units of the equatorial radius, m = cos φ / √(1 - e² sin² φ).
fn parallel_radius(ellipsoid: &Ellipsoid, latitude: f64) -> f64 {
    let (sine, cosine) = latitude.sin_cos();
    cosine / (1.0 - ellipsoid.eccentricity_squared() * sine * sine).sqrt()
}

/// Area between the equator and a parallel in units of a²: q = (1 - e²)(sin φ / (1 - e² sin² φ) +
/// artanh(e sin φ) / e), twice that of a sphere of radius 1 and one radian.
fn authalic(ellipsoid: &Ellipsoid, latitude: f64) -> f64 {
    let (e2, sine) = (ellipsoid.eccentricity_squared(), latitude.sin());
    (1.0 - e2) * (sine / (1.0 - e2 * sine * sine) + artanh_ratio(e2, sine))
}

/// artanh(e s) / e, which is s on a sphere.
fn artanh_ratio(e2: f64, sine: f64) -> f64 {
    let e = e2.sqrt();
    if e == 0.0 {
        sine
    } else {
        (e * sine).atanh() / e
    }
}

/// Latitude with that [`authalic`] area; `None` beyond the poles.
fn latitude_of_area(ellipsoid: &Ellipsoid, q: f64) -> Option<f64> {
    let most = authalic(ellipsoid, FRAC_PI_2);
    let ratio = q / most;
    if ratio.is_nan() || ratio.abs() > 1.0 + 1e-9 {
        return None;
    }
    let mut latitude = ratio.clamp(-1.0, 1.0).asin();
    let e2 = ellipsoid.eccentricity_squared();
    // Newton's method; the slope of q is 2 (1 - e²) cos φ / (1 - e² sin² φ)².
    for _ in 0..12 {
        let (sine, cosine) = latitude.sin_cos();
        if cosine < 1e-9 {
            break;
        }
        let w = 1.0 - e2 * sine * sine;
        let step = (q - authalic(ellipsoid, latitude)) * w * w / (2.0 * (1.0 - e2) * cosine);
        latitude = (latitude + step).clamp(-FRAC_PI_2, FRAC_PI_2);
    }
    Some(latitude)
}

/// Scale of a projection whose scale is true along a parallel: at the pole, or along the equator.
pub(super) fn scale_for(numbers: &SystemNumbers, parallel: f64) -> f64 {
    let ellipsoid = &numbers.datum.ellipsoid;
    match numbers.method {
        ProjectionMethod::PolarStereographic => azimuthal::scale_at_pole(ellipsoid, parallel),
        _ => parallel_radius(ellipsoid, parallel),
    }
}
