//! Latitudes and radii of the ellipsoid on which several projections count.

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::Ellipsoid;

/// Isometric latitude ψ = artanh(sin φ) - e · artanh(e · sin φ), without bound at the poles.
pub(super) fn isometric(ellipsoid: &Ellipsoid, latitude: f64) -> f64 {
    if latitude.abs() >= FRAC_PI_2 {
        return f64::INFINITY.copysign(latitude);
    }
    ellipsoid.conformal_tangent(latitude.tan()).asinh()
}

/// Inverse of [`isometric`].
pub(super) fn latitude_of(ellipsoid: &Ellipsoid, isometric: f64) -> f64 {
    if isometric.abs() > 40.0 {
        return FRAC_PI_2.copysign(isometric);
    }
    ellipsoid.geodetic_tangent(isometric.sinh()).atan()
}

/// Radius of the parallel in units of the equatorial radius, m = cos φ / √(1 - e² sin² φ).
pub(super) fn parallel_radius(ellipsoid: &Ellipsoid, latitude: f64) -> f64 {
    let (sine, cosine) = latitude.sin_cos();
    cosine / (1.0 - ellipsoid.eccentricity_squared() * sine * sine).sqrt()
}

/// Area between the equator and a parallel in units of a²: q = (1 - e²)(sin φ / (1 - e² sin² φ) +
/// artanh(e sin φ) / e), twice that of a sphere of radius 1 and one radian.
pub(super) fn authalic(ellipsoid: &Ellipsoid, latitude: f64) -> f64 {
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
pub(super) fn latitude_of_area(ellipsoid: &Ellipsoid, q: f64) -> Option<f64> {
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
