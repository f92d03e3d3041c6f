//! Projections onto planes: Lambert's equal-area, polar and oblique stereographic.

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::{Ellipsoid, SystemNumbers};

use super::latitudes::{authalic, isometric, latitude_of, latitude_of_area, parallel_radius};

/// Lambert's azimuthal equal-area, EPSG method 9820.
pub(super) struct LambertAzimuthal {
    ellipsoid: Ellipsoid,
    /// Authalic latitude of the origin.
    origin: f64,
    /// Radius of the sphere of the same area, metres.
    radius: f64,
    /// Stretch along the meridian of the origin; 1 at a pole.
    stretch: f64,
    /// Area from the equator to a pole, in units of a².
    most: f64,
}

impl LambertAzimuthal {
    pub fn new(numbers: &SystemNumbers) -> Self {
        let ellipsoid = numbers.datum.ellipsoid;
        let most = authalic(&ellipsoid, FRAC_PI_2);
        let ratio = authalic(&ellipsoid, numbers.latitude_0) / most;
        let origin = ratio.clamp(-1.0, 1.0).asin();
        let radius = ellipsoid.semi_major * (most / 2.0).sqrt();
        let is_polar = FRAC_PI_2 - numbers.latitude_0.abs() < 1e-9;
        let m = parallel_radius(&ellipsoid, numbers.latitude_0);
        Self {
            ellipsoid,
            origin: if is_polar {
                FRAC_PI_2.copysign(numbers.latitude_0)
            } else {
                origin
            },
            radius,
            stretch: if is_polar {
                1.0
            } else {
                ellipsoid.semi_major * m / (radius * origin.cos())
            },
            most,
        }
    }

    pub fn project(&self, latitude: f64, longitude: f64) -> Option<(f64, f64)> {
        let beta = (authalic(&self.ellipsoid, latitude) / self.most).clamp(-1.0, 1.0);
        // Near a pole the sine says little of the angle, its cosine much.
        let (sine, cosine) = (beta, (1.0 - beta * beta).max(0.0).sqrt());
        let (sin_origin, cos_origin) = self.origin.sin_cos();
        let along = sin_origin * sine + cos_origin * cosine * longitude.cos();
        if along < -1.0 + 1e-9 {
            return None;
        }
        let b = self.radius * (2.0 / (1.0 + along)).sqrt();
        let north = cos_origin * sine - sin_origin * cosine * longitude.cos();
        Some((
            b * self.stretch * cosine * longitude.sin(),
            b / self.stretch * north,
        ))
    }

    pub fn unproject(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (x, y) = (x / self.stretch, y * self.stretch);
        let distance = x.hypot(y);
        let half = distance / (2.0 * self.radius);
        if half.is_nan() || half > 1.0 {
            return None;
        }
        if distance == 0.0 {
            let sine = self.origin.sin();
            return Some((latitude_of_area(&self.ellipsoid, self.most * sine)?, 0.0));
        }
        let (sine, cosine) = (2.0 * half.asin()).sin_cos();
        let (sin_origin, cos_origin) = self.origin.sin_cos();
        let beta = cosine * sin_origin + y * sine * cos_origin / distance;
        let longitude = (x * sine).atan2(distance * cos_origin * cosine - y * sin_origin * sine);
        Some((
            latitude_of_area(&self.ellipsoid, self.most * beta)?,
            longitude,
        ))
    }
}

/// √((1 + e)^(1 + e) · (1 - e)^(1 - e)).
fn polar_constant(ellipsoid: &Ellipsoid) -> f64 {
    let e = ellipsoid.eccentricity_squared().sqrt();
    ((1.0 + e).powf(1.0 + e) * (1.0 - e).powf(1.0 - e)).sqrt()
}

/// Scale at the pole for a true scale at a parallel, EPSG method 9829.
pub(super) fn scale_at_pole(ellipsoid: &Ellipsoid, parallel: f64) -> f64 {
    let latitude = parallel.abs();
    if FRAC_PI_2 - latitude < 1e-9 {
        return 1.0;
    }
    let t = (-isometric(ellipsoid, latitude)).exp();
    parallel_radius(ellipsoid, latitude) * polar_constant(ellipsoid) / (2.0 * t)
}

/// Polar stereographic, EPSG method 9810.
pub(super) fn polar(numbers: &SystemNumbers, latitude: f64, longitude: f64) -> (f64, f64) {
    let ellipsoid = &numbers.datum.ellipsoid;
    let sign = numbers.latitude_0.signum();
    let t = (-isometric(ellipsoid, sign * latitude)).exp();
    let radius = 2.0 * ellipsoid.semi_major * numbers.scale * t / polar_constant(ellipsoid);
    let (sine, cosine) = longitude.sin_cos();
    (radius * sine, -sign * radius * cosine)
}

/// Inverse of [`polar`].
pub(super) fn from_polar(numbers: &SystemNumbers, x: f64, y: f64) -> (f64, f64) {
    let ellipsoid = &numbers.datum.ellipsoid;
    let sign = numbers.latitude_0.signum();
    let factor = 2.0 * ellipsoid.semi_major * numbers.scale / polar_constant(ellipsoid);
    let t = x.hypot(y) / factor;
    (sign * latitude_of(ellipsoid, -t.ln()), x.atan2(-sign * y))
}

/// Oblique stereographic by way of a sphere, EPSG method 9809.
pub(super) struct Oblique {
    ellipsoid: Ellipsoid,
    /// Longitudes on the sphere per longitude on the ellipsoid.
    n: f64,
    /// Logarithm of the factor between the isometric latitudes.
    offset: f64,
    /// Latitude of the origin on the sphere.
    origin: f64,
    /// Twice the radius of the sphere times the scale, metres.
    diameter: f64,
}

impl Oblique {
    pub fn new(numbers: &SystemNumbers) -> Self {
        let ellipsoid = numbers.datum.ellipsoid;
        let e2 = ellipsoid.eccentricity_squared();
        let (sine, cosine) = numbers.latitude_0.sin_cos();
        let w = 1.0 - e2 * sine * sine;
        // √(meridional · prime vertical radius of curvature).
        let radius = ellipsoid.semi_major * (1.0 - e2).sqrt() / w;
        let n = (1.0 + e2 * cosine.powi(4) / (1.0 - e2)).sqrt();
        // The sphere's latitude of the origin: tan χ₀ = tan φ₀ · √(ν₀/ρ₀)⁻¹ with sin χ₀ = sin φ₀ / n.
        let origin = (sine / n).asin();
        Self {
            ellipsoid,
            n,
            offset: origin.tan().asinh() - n * isometric(&ellipsoid, numbers.latitude_0),
            origin,
            diameter: 2.0 * radius * numbers.scale,
        }
    }

    pub fn project(&self, latitude: f64, longitude: f64) -> Option<(f64, f64)> {
        let north = self.n * isometric(&self.ellipsoid, latitude) + self.offset;
        let (sin_b, cos_b) = north.sinh().atan().sin_cos();
        let (sin_l, cos_l) = (self.n * longitude).sin_cos();
        let (sin_origin, cos_origin) = self.origin.sin_cos();
        let b = 1.0 + sin_b * sin_origin + cos_b * cos_origin * cos_l;
        (b > 1e-9).then(|| {
            (
                self.diameter * cos_b * sin_l / b,
                self.diameter * (sin_b * cos_origin - cos_b * sin_origin * cos_l) / b,
            )
        })
    }

    pub fn unproject(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let distance = x.hypot(y);
        let (sine, cosine) = (2.0 * (distance / self.diameter).atan()).sin_cos();
        let (sin_origin, cos_origin) = self.origin.sin_cos();
        let (east, north) = if distance == 0.0 {
            (0.0, 0.0)
        } else {
            (x / distance, y / distance)
        };
        let sin_b = cosine * sin_origin + north * sine * cos_origin;
        let l = (east * sine).atan2(cos_origin * cosine - north * sin_origin * sine);
        let isometric = (sin_b.atanh() - self.offset) / self.n;
        (distance < 4.0 * self.diameter)
            .then(|| (latitude_of(&self.ellipsoid, isometric), l / self.n))
    }
}
