//! Křovák's oblique conformal cone of Czechia and Slovakia, EPSG method 1041, with coordinates that count
//! east and north.

use pilotage_base::frames::SystemNumbers;

use super::latitudes::{isometric, latitude_of};

/// Angle between the axes of the Earth and of the cone: 30° 17′ 17.30311″, radians.
const TILT: f64 = (30.0 + 17.0 / 60.0 + 17.303_11 / 3600.0) * std::f64::consts::PI / 180.0;

/// The cone: the ellipsoid onto a sphere, the sphere onto a cone that stands askew.
pub(super) struct Krovak {
    /// Longitudes on the sphere per longitude on the ellipsoid.
    b: f64,
    /// Offset of the isometric latitudes.
    k: f64,
    /// Angle on the map per angle around the cone's axis.
    n: f64,
    /// Distance from the tip where the isometric latitude from the axis is 0, metres.
    factor: f64,
}

impl Krovak {
    /// The cone of `numbers`: its first parallel is that around the cone's axis.
    pub fn new(numbers: &SystemNumbers) -> Self {
        let ellipsoid = &numbers.datum.ellipsoid;
        let e2 = ellipsoid.eccentricity_squared();
        let (sine, cosine) = numbers.latitude_0.sin_cos();
        let radius = ellipsoid.semi_major * (1.0 - e2).sqrt() / (1.0 - e2 * sine * sine);
        let b = (1.0 + e2 * cosine.powi(4) / (1.0 - e2)).sqrt();
        let gamma = (sine / b).asin();
        let parallel = numbers.parallels[0];
        let n = parallel.sin();
        Self {
            b,
            k: gamma.tan().asinh() - b * isometric(ellipsoid, numbers.latitude_0),
            n,
            factor: numbers.scale * radius / parallel.tan() * (n * parallel.tan().asinh()).exp(),
        }
    }

    pub fn project(&self, numbers: &SystemNumbers, latitude: f64, longitude: f64) -> (f64, f64) {
        let north = self.b * isometric(&numbers.datum.ellipsoid, latitude) + self.k;
        let (sin_u, cos_u) = north.sinh().atan().sin_cos();
        let (sin_v, cos_v) = (-self.b * longitude).sin_cos();
        let (sin_tilt, cos_tilt) = TILT.sin_cos();
        let sin_t = cos_tilt * sin_u + sin_tilt * cos_u * cos_v;
        let d = (cos_u * sin_v).atan2(cos_tilt * cos_u * cos_v - sin_tilt * sin_u);
        let radius = self.factor * (-self.n * sin_t.atanh()).exp();
        // Southward and westward, as the method is written.
        let (sine, cosine) = (self.n * d).sin_cos();
        (-radius * sine, -radius * cosine)
    }

    pub fn unproject(&self, numbers: &SystemNumbers, x: f64, y: f64) -> (f64, f64) {
        let radius = x.hypot(y);
        let d = (-x).atan2(-y) / self.n;
        let (sin_t, cos_t) = ((self.factor / radius).ln() / self.n)
            .sinh()
            .atan()
            .sin_cos();
        let (sin_tilt, cos_tilt) = TILT.sin_cos();
        let (sin_d, cos_d) = d.sin_cos();
        let sin_u = cos_tilt * sin_t - sin_tilt * cos_t * cos_d;
        let v = (cos_t * sin_d).atan2(cos_tilt * cos_t * cos_d + sin_tilt * sin_t);
        let isometric = (sin_u.atanh() - self.k) / self.b;
        (
            latitude_of(&numbers.datum.ellipsoid, isometric),
            -v / self.b,
        )
    }
}
