//! The transverse Mercator projection, as UTM uses it.
//!
//! Krüger's series to the sixth order in the third flattening, after Karney, "Transverse Mercator
//! with an accuracy of a few nanometers", Journal of Geodesy 85 (2011): eqs 11 and 35 there,
//! 14, 15, 18 and 36 back. Good to nanometres within 3,900 km of the central meridian.

use super::Ellipsoid;

/// A transverse Mercator projection of an ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransverseMercator {
    ellipsoid: Ellipsoid,
    /// Scale on the central meridian times the radius of the sphere with the same meridian, metres.
    radius: f64,
    /// Coefficients of eq 35.
    alpha: [f64; 6],
    /// Coefficients of eq 36.
    beta: [f64; 6],
}

impl TransverseMercator {
    /// The projection of `ellipsoid` with the given scale on its central meridian.
    pub const fn new(ellipsoid: Ellipsoid, scale: f64) -> Self {
        // Third flattening, n = (a - b) / (a + b), and its powers.
        let n = ellipsoid.flattening / (2.0 - ellipsoid.flattening);
        let (n2, n3) = (n * n, n * n * n);
        let (n4, n5, n6) = (n2 * n2, n2 * n3, n3 * n3);
        Self {
            ellipsoid,
            // a / (1 + n) · (1 + n²/4 + n⁴/64 + n⁶/256).
            radius: scale * ellipsoid.semi_major / (1.0 + n)
                * (1.0 + n2 / 4.0 + n4 / 64.0 + n6 / 256.0),
            alpha: [
                n / 2.0 - 2.0 * n2 / 3.0 + 5.0 * n3 / 16.0 + 41.0 * n4 / 180.0 - 127.0 * n5 / 288.0
                    + 7891.0 * n6 / 37_800.0,
                13.0 * n2 / 48.0 - 3.0 * n3 / 5.0 + 557.0 * n4 / 1440.0 + 281.0 * n5 / 630.0
                    - 1_983_433.0 * n6 / 1_935_360.0,
                61.0 * n3 / 240.0 - 103.0 * n4 / 140.0
                    + 15_061.0 * n5 / 26_880.0
                    + 167_603.0 * n6 / 181_440.0,
                49_561.0 * n4 / 161_280.0 - 179.0 * n5 / 168.0 + 6_601_661.0 * n6 / 7_257_600.0,
                34_729.0 * n5 / 80_640.0 - 3_418_889.0 * n6 / 1_995_840.0,
                212_378_941.0 * n6 / 319_334_400.0,
            ],
            beta: [
                n / 2.0 - 2.0 * n2 / 3.0 + 37.0 * n3 / 96.0 - n4 / 360.0 - 81.0 * n5 / 512.0
                    + 96_199.0 * n6 / 604_800.0,
                n2 / 48.0 + n3 / 15.0 - 437.0 * n4 / 1440.0 + 46.0 * n5 / 105.0
                    - 1_118_711.0 * n6 / 3_870_720.0,
                17.0 * n3 / 480.0 - 37.0 * n4 / 840.0 - 209.0 * n5 / 4480.0
                    + 5569.0 * n6 / 90_720.0,
                4397.0 * n4 / 161_280.0 - 11.0 * n5 / 504.0 - 830_251.0 * n6 / 7_257_600.0,
                4583.0 * n5 / 161_280.0 - 108_847.0 * n6 / 3_991_680.0,
                20_648_693.0 * n6 / 638_668_800.0,
            ],
        }
    }

    /// Metres east of the central meridian and north of the equator at `latitude` and at `longitude`
    /// from the central meridian, radians.
    pub fn project(&self, latitude: f64, longitude: f64) -> (f64, f64) {
        let tau = self.ellipsoid.conformal_tangent(latitude.tan());
        let xi = tau.atan2(longitude.cos());
        let eta = (longitude.sin() / tau.hypot(longitude.cos())).asinh();
        let (xi, eta) = with_series(xi, eta, &self.alpha, 1.0);
        (self.radius * eta, self.radius * xi)
    }

    /// Latitude and longitude from the central meridian, radians, of a point `east` metres of the
    /// central meridian and `north` metres of the equator.
    pub fn unproject(&self, east: f64, north: f64) -> (f64, f64) {
        let (xi, eta) = with_series(north / self.radius, east / self.radius, &self.beta, -1.0);
        let tau = xi.sin() / eta.sinh().hypot(xi.cos());
        let longitude = eta.sinh().atan2(xi.cos());
        (self.ellipsoid.geodetic_tangent(tau).atan(), longitude)
    }
}

/// (ξ, η) + sign · Σ cⱼ (sin 2jξ cosh 2jη, cos 2jξ sinh 2jη), eqs 11 and 15.
fn with_series(xi: f64, eta: f64, coefficients: &[f64; 6], sign: f64) -> (f64, f64) {
    let mut sums = (xi, eta);
    for (j, coefficient) in coefficients.iter().enumerate() {
        let twice = 2.0 * (j + 1) as f64;
        let (sine, cosine) = (twice * xi).sin_cos();
        sums.0 += sign * coefficient * sine * (twice * eta).cosh();
        sums.1 += sign * coefficient * cosine * (twice * eta).sinh();
    }
    sums
}
