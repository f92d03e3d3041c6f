//! Distortion by a real lens of the picture of an ideal one.

use nalgebra::{Matrix2, Point2};
use serde::{Deserialize, Serialize};

/// Brown-Conrady distortion in OpenCV's order.
///
/// With (x, y) where the ideal lens would put a point, in units of the focal length, and
/// r² = x² + y²:
///
/// ```text
/// x' = x (1 + k₁r² + k₂r⁴ + k₃r⁶) + 2p₁xy + p₂(r² + 2x²)
/// y' = y (1 + k₁r² + k₂r⁴ + k₃r⁶) + p₁(r² + 2y²) + 2p₂xy
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Distortion {
    /// Radial coefficient of r².
    pub k1: f64,
    /// Radial coefficient of r⁴.
    pub k2: f64,
    /// First tangential coefficient.
    pub p1: f64,
    /// Second tangential coefficient.
    pub p2: f64,
    /// Radial coefficient of r⁶.
    pub k3: f64,
}

impl Distortion {
    /// Whether all coefficients are zero.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Point at which the lens puts the one that an ideal lens would put at `ideal` (both in units of the
    /// focal length from the principal point).
    ///
    /// ```
    /// use nalgebra::Point2;
    /// use pilotage_raster::camera::Distortion;
    ///
    /// let barrel = Distortion { k1: -0.1, ..Distortion::default() };
    /// // r² = 0.25: the point moves in by 2.5 %.
    /// let ideal = Point2::new(0.5, 0.0);
    /// let seen = barrel.distort(&ideal);
    /// assert!((seen.x - 0.4875).abs() < 1e-12);
    /// assert!((barrel.undistort(&seen) - ideal).norm() < 1e-9);
    /// ```
    pub fn distort(&self, ideal: &Point2<f64>) -> Point2<f64> {
        let (x, y) = (ideal.x, ideal.y);
        let s = x * x + y * y;
        let radial = 1.0 + s * (self.k1 + s * (self.k2 + s * self.k3));
        Point2::new(
            x * radial + 2.0 * self.p1 * x * y + self.p2 * (s + 2.0 * x * x),
            y * radial + self.p1 * (s + 2.0 * y * y) + 2.0 * self.p2 * x * y,
        )
    }

    /// Derivative of [`Self::distort`].
    pub fn jacobian(&self, ideal: &Point2<f64>) -> Matrix2<f64> {
        let (x, y) = (ideal.x, ideal.y);
        let s = x * x + y * y;
        let radial = 1.0 + s * (self.k1 + s * (self.k2 + s * self.k3));
        // d radial / d s
        let slope = self.k1 + s * (2.0 * self.k2 + 3.0 * s * self.k3);
        let mixed = 2.0 * x * y * slope + 2.0 * self.p1 * x + 2.0 * self.p2 * y;
        Matrix2::new(
            radial + 2.0 * x * x * slope + 2.0 * self.p1 * y + 6.0 * self.p2 * x,
            mixed,
            mixed,
            radial + 2.0 * y * y * slope + 6.0 * self.p1 * y + 2.0 * self.p2 * x,
        )
    }

    /// Whether the radial part still grows everywhere between the axis and `ideal`.
    ///
    /// Beyond the radius where it turns back, the polynomial describes no lens: it folds points
    /// far outside the view into the picture.
    pub fn is_valid_at(&self, ideal: &Point2<f64>) -> bool {
        if self.k1 == 0.0 && self.k2 == 0.0 && self.k3 == 0.0 {
            return true;
        }
        let end = ideal.coords.norm_squared();
        // d(r·radial)/dr as a polynomial in s = r²; its minimum over [0, end] lies at an end or
        // where its own derivative 3k₁ + 10k₂s + 21k₃s² vanishes.
        let growth = |s: f64| 1.0 + s * (3.0 * self.k1 + s * (5.0 * self.k2 + s * 7.0 * self.k3));
        let positive_until = |s: f64| !(0.0..=end).contains(&s) || growth(s) > 0.0;
        let (a, b, c) = (21.0 * self.k3, 10.0 * self.k2, 3.0 * self.k1);
        let turning = if a.abs() > 1e-12 {
            let root = (b * b - 4.0 * a * c).sqrt();
            [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
        } else {
            [-c / b, f64::NAN]
        };
        growth(end) > 0.0 && turning.into_iter().all(positive_until)
    }

    /// Point at which an ideal lens would put the one that this lens puts at `distorted`; the inverse of
    /// [`Self::distort`] by Newton's method with halved steps.
    ///
    /// Where the lens reaches no such point, the answer is near the last one it reaches.
    pub fn undistort(&self, distorted: &Point2<f64>) -> Point2<f64> {
        if self.is_none() {
            return *distorted;
        }
        self.undistort_from(distorted, distorted)
    }

    /// As [`Self::undistort`], starting from a good guess: the answer for a neighbouring pixel.
    pub(super) fn undistort_from(
        &self,
        distorted: &Point2<f64>,
        guess: &Point2<f64>,
    ) -> Point2<f64> {
        // A start beyond the fold would find a root that is none of this lens.
        let mut ideal = *guess;
        for _ in 0..60 {
            if self.is_valid_at(&ideal) {
                break;
            }
            ideal *= 0.8;
        }
        let mut residual = self.distort(&ideal) - distorted;
        for _ in 0..40 {
            let size = residual.norm_squared();
            if size < 1e-30 {
                break;
            }
            let Some(inverse) = self.jacobian(&ideal).try_inverse() else {
                break;
            };
            let step = inverse * residual;
            let mut scale = 1.0;
            let advanced = loop {
                let next = ideal - scale * step;
                let next_residual = self.distort(&next) - distorted;
                if next_residual.norm_squared() < size && self.is_valid_at(&next) {
                    break Some((next, next_residual));
                }
                scale *= 0.5;
                if scale < 1e-6 {
                    break None;
                }
            };
            let Some((next, next_residual)) = advanced else {
                break;
            };
            (ideal, residual) = (next, next_residual);
        }
        ideal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn undistorting_undoes_distorting(
            k1 in -0.3..0.3f64, k2 in -0.1..0.1f64, k3 in -0.02..0.02f64,
            p1 in -0.005..0.005f64, p2 in -0.005..0.005f64,
            x in -0.9..0.9f64, y in -0.7..0.7f64,
        ) {
            let lens = Distortion { k1, k2, p1, p2, k3 };
            let ideal = Point2::new(x, y);
            // Well inside the valid region, where the inverse is unique.
            prop_assume!(lens.is_valid_at(&(ideal * 1.15)));
            let back = lens.undistort(&lens.distort(&ideal));
            prop_assert!((back - ideal).norm() < 1e-9, "{back} {ideal}");
        }

        #[test]
        fn the_jacobian_is_the_difference_quotient(
            k1 in -0.3..0.3f64, k2 in -0.1..0.1f64, k3 in -0.02..0.02f64,
            p1 in -0.01..0.01f64, p2 in -0.01..0.01f64,
            x in -0.9..0.9f64, y in -0.7..0.7f64,
        ) {
            let lens = Distortion { k1, k2, p1, p2, k3 };
            let h = 1e-5;
            let jacobian = lens.jacobian(&Point2::new(x, y));
            let dx = lens.distort(&Point2::new(x + h, y)) - lens.distort(&Point2::new(x - h, y));
            let dy = lens.distort(&Point2::new(x, y + h)) - lens.distort(&Point2::new(x, y - h));
            let numerical = Matrix2::from_columns(&[dx, dy]) / (2.0 * h);
            prop_assert!((jacobian - numerical).amax() < 1e-8);
        }
    }

    #[test]
    fn a_point_beyond_the_fold_is_not_valid() {
        // r (1 - 0.3 r²) turns back at r² = 1 / 0.9.
        let lens = Distortion {
            k1: -0.3,
            ..Distortion::default()
        };
        assert!(lens.is_valid_at(&Point2::new(1.05, 0.0)));
        assert!(!lens.is_valid_at(&Point2::new(1.06, 0.0)));
        assert!(!lens.is_valid_at(&Point2::new(40.0, 10.0)));
        let reached = lens.undistort(&Point2::new(0.0, 2.0));
        assert!(lens.is_valid_at(&reached) && reached.y > 1.0, "{reached}");
    }
}
