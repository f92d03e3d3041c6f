//! Ellipsoids of revolution, on which latitudes and longitudes are counted.

use nalgebra::Vector3;

/// Equatorial radius of WGS 84, metres.
pub(super) const SEMI_MAJOR: f64 = 6_378_137.0;
/// Flattening of WGS 84.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// An ellipsoid of revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Equatorial radius, metres.
    pub semi_major: f64,
    /// Flattening, 0 for a sphere.
    pub flattening: f64,
}

impl Ellipsoid {
    /// The ellipsoid of WGS 84.
    pub const WGS84: Self = Self {
        semi_major: SEMI_MAJOR,
        flattening: FLATTENING,
    };

    /// Square of the eccentricity.
    pub const fn eccentricity_squared(&self) -> f64 {
        self.flattening * (2.0 - self.flattening)
    }

    /// Place in the frame with its origin in the Earth's centre, its x axis through the meridian of
    /// longitude 0 and its z axis through the north pole, metres. `latitude` and `longitude` are in
    /// radians, `height` above the ellipsoid in metres.
    ///
    /// ```
    /// use std::f64::consts::FRAC_PI_2;
    /// use pilotage_base::frames::Ellipsoid;
    ///
    /// // The north pole lies by the semi-minor axis of WGS 84 above the Earth's centre.
    /// let pole = Ellipsoid::WGS84.geocentric(FRAC_PI_2, 0.0, 0.0);
    /// assert!((pole.z - 6_356_752.314_245).abs() < 1e-6);
    /// assert!(pole.xy().norm() < 1e-6);
    /// ```
    pub fn geocentric(&self, latitude: f64, longitude: f64, height: f64) -> Vector3<f64> {
        let e2 = self.eccentricity_squared();
        let (sin_lat, cos_lat) = latitude.sin_cos();
        let (sin_lon, cos_lon) = longitude.sin_cos();
        let n = self.semi_major / (1.0 - e2 * sin_lat * sin_lat).sqrt();
        Vector3::new(
            (n + height) * cos_lat * cos_lon,
            (n + height) * cos_lat * sin_lon,
            (n * (1.0 - e2) + height) * sin_lat,
        )
    }

    /// Inverse of [`geocentric`](Self::geocentric): (latitude, longitude, height).
    ///
    /// Iterates the latitude to convergence; three rounds reach a nanometre near the surface.
    pub fn geodetic(&self, p: &Vector3<f64>) -> (f64, f64, f64) {
        let e2 = self.eccentricity_squared();
        let longitude = p.y.atan2(p.x);
        let r = p.x.hypot(p.y);
        let mut latitude = p.z.atan2(r * (1.0 - e2));
        let mut height = 0.0;
        for _ in 0..6 {
            let sin_lat = latitude.sin();
            let n = self.semi_major / (1.0 - e2 * sin_lat * sin_lat).sqrt();
            height = r * latitude.cos() + p.z * sin_lat - n * (1.0 - e2 * sin_lat * sin_lat);
            latitude = p.z.atan2(r * (1.0 - e2 * n / (n + height)));
        }
        (latitude, longitude, height)
    }

    /// Tangent of the conformal latitude from that of the geodetic latitude; Karney 2011, eqs 7-9.
    pub fn conformal_tangent(&self, tau: f64) -> f64 {
        let e = self.eccentricity_squared().sqrt();
        let sigma = (e * (e * tau / 1.0_f64.hypot(tau)).atanh()).sinh();
        tau * 1.0_f64.hypot(sigma) - sigma * 1.0_f64.hypot(tau)
    }

    /// Inverse of [`conformal_tangent`](Self::conformal_tangent) by Newton's method, eqs 19-21 there;
    /// three rounds reach the last bit.
    pub fn geodetic_tangent(&self, conformal: f64) -> f64 {
        let ratio = 1.0 - self.eccentricity_squared();
        let mut tau = conformal / ratio;
        // So near a pole the square would overflow; what is left is a constant factor.
        if tau.abs() > 1e12 {
            return conformal * self.pole_factor();
        }
        for _ in 0..5 {
            let found = self.conformal_tangent(tau);
            tau += (conformal - found) / 1.0_f64.hypot(found) * (1.0 + ratio * tau * tau)
                / (ratio * 1.0_f64.hypot(tau));
        }
        tau
    }

    /// Geodetic over conformal tangent in the limit of the poles, exp(e · artanh e).
    fn pole_factor(&self) -> f64 {
        let e = self.eccentricity_squared().sqrt();
        (e * e.atanh()).exp()
    }
}
