//! Projections onto cones: Lambert's conformal and Albers' equal-area.

use std::f64::consts::{FRAC_PI_2, PI};

use pilotage_base::frames::{Ellipsoid, SystemNumbers};

use super::latitudes::{authalic, isometric, latitude_of, latitude_of_area, parallel_radius};

/// Parallels nearer to each other are one, radians.
const ONE_PARALLEL: f64 = 1e-10;

/// A cone through the standard parallels of a system.
struct Cone {
    /// Radius of the first parallel in units of the equatorial radius.
    m1: f64,
    /// Measure of the latitude of the first parallel: isometric or authalic.
    measure: f64,
    /// Angle on the map per longitude.
    n: f64,
}

/// The cone for which `n` is `difference(m₁, m₂)` by the difference of the parallels' measures, or the sine of the one
/// parallel at which it touches.
fn cone(
    numbers: &SystemNumbers,
    measure: fn(&Ellipsoid, f64) -> f64,
    difference: fn(f64, f64) -> f64,
) -> Cone {
    let ellipsoid = &numbers.datum.ellipsoid;
    let [first, second] = numbers.parallels;
    let [m1, m2] = [first, second].map(|latitude| parallel_radius(ellipsoid, latitude));
    let [measure, other] = [first, second].map(|latitude| measure(ellipsoid, latitude));
    let n = if (first - second).abs() < ONE_PARALLEL {
        first.sin()
    } else {
        difference(m1, m2) / (other - measure)
    };
    Cone { m1, measure, n }
}

/// Lambert's conformal conic, EPSG methods 9801 and 9802.
pub(super) struct LambertConformal {
    ellipsoid: Ellipsoid,
    /// Angle on the map per longitude.
    n: f64,
    /// a · k · F, with which ρ = a k F tⁿ and t = exp(-ψ).
    factor: f64,
    /// Radius of the parallel of the origin on the map, metres.
    origin: f64,
}

impl LambertConformal {
    pub fn new(numbers: &SystemNumbers) -> Self {
        let ellipsoid = numbers.datum.ellipsoid;
        let Cone {
            m1,
            measure: psi1,
            n,
        } = cone(numbers, isometric, |m1, m2| (m1 / m2).ln());
        let factor = ellipsoid.semi_major * numbers.scale * m1 / n * (n * psi1).exp();
        let mut projection = Self {
            ellipsoid,
            n,
            factor,
            origin: 0.0,
        };
        projection.origin = projection.radius(numbers.latitude_0);
        projection
    }

    fn radius(&self, latitude: f64) -> f64 {
        self.factor * (-self.n * isometric(&self.ellipsoid, latitude)).exp()
    }

    pub fn project(&self, latitude: f64, longitude: f64) -> (f64, f64) {
        let radius = self.radius(latitude);
        let (sine, cosine) = (self.n * longitude).sin_cos();
        (radius * sine, self.origin - radius * cosine)
    }

    pub fn unproject(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (radius, longitude) = polar(self.n, x, self.origin - y)?;
        let isometric = -(radius / self.factor).ln() / self.n;
        Some((latitude_of(&self.ellipsoid, isometric), longitude))
    }
}

/// Albers' equal-area conic, EPSG method 9822.
pub(super) struct Albers {
    ellipsoid: Ellipsoid,
    /// Angle on the map per longitude.
    n: f64,
    /// m₁² + n q₁.
    c: f64,
    /// Radius of the parallel of the origin on the map, metres.
    origin: f64,
}

impl Albers {
    pub fn new(numbers: &SystemNumbers) -> Self {
        let ellipsoid = numbers.datum.ellipsoid;
        let Cone { m1, measure: q1, n } = cone(numbers, authalic, |m1, m2| m1 * m1 - m2 * m2);
        let mut projection = Self {
            ellipsoid,
            n,
            c: m1 * m1 + n * q1,
            origin: 0.0,
        };
        projection.origin = projection.radius(numbers.latitude_0).unwrap_or(f64::NAN);
        projection
    }

    fn radius(&self, latitude: f64) -> Option<f64> {
        let square = self.c - self.n * authalic(&self.ellipsoid, latitude);
        (square >= -1e-12).then(|| self.ellipsoid.semi_major * square.max(0.0).sqrt() / self.n)
    }

    pub fn project(&self, latitude: f64, longitude: f64) -> Option<(f64, f64)> {
        let radius = self.radius(latitude)?;
        let (sine, cosine) = (self.n * longitude).sin_cos();
        Some((radius * sine, self.origin - radius * cosine))
    }

    pub fn unproject(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (radius, longitude) = polar(self.n, x, self.origin - y)?;
        let ratio = radius * self.n / self.ellipsoid.semi_major;
        let q = (self.c - ratio * ratio) / self.n;
        Some((latitude_of_area(&self.ellipsoid, q)?, longitude))
    }
}

/// Radius from the tip of a cone, with the sign of `n`, and the longitude there; `None` in the gap where
/// the cone is cut open.
fn polar(n: f64, x: f64, from_tip: f64) -> Option<(f64, f64)> {
    let radius = x.hypot(from_tip).copysign(n);
    let angle = (x * n.signum()).atan2(from_tip * n.signum());
    let longitude = angle / n;
    (longitude.abs() <= PI + 1e-9 && n.abs() <= FRAC_PI_2).then_some((radius, longitude))
}
