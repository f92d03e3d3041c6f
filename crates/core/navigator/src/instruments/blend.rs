//! The mean of two headings of which neither explains the flight better.

use nalgebra::{Rotation2, Vector2};
use serde::{Deserialize, Serialize};

use super::fit::AirFit;
use super::series::Series;

/// Angle that is added to a heading, and its drift.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct HeadingTurn {
    /// Radians at `reference`.
    offset: f64,
    /// Radians per second.
    drift: f64,
    /// Seconds.
    reference: f64,
}

impl HeadingTurn {
    fn of(fit: &AirFit) -> Self {
        Self {
            offset: fit.heading_offset,
            drift: fit.heading_drift,
            reference: fit.reference,
        }
    }

    fn apply(&self, time: f64, nose: Vector2<f64>) -> Vector2<f64> {
        Rotation2::new(self.offset + self.drift * (time - self.reference)) * nose
    }
}

/// Blend of the logged heading and the gyros' heading: each turned to where the track wants it. Their errors
/// have different causes, so that the mean has less of them than the worse of the two, and which that is
/// nobody knows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Blend {
    logged: HeadingTurn,
    gyros: HeadingTurn,
}

impl Blend {
    /// Of the headings that these fits are about.
    pub(super) fn of(logged: &AirFit, gyros: &AirFit) -> Self {
        Self {
            logged: HeadingTurn::of(logged),
            gyros: HeadingTurn::of(gyros),
        }
    }

    /// Horizontal part of the nose's direction; by one of the two where the other is missing.
    pub(super) fn nose(
        &self,
        logged: &Series<Vector2<f64>>,
        gyros: &Series<Vector2<f64>>,
    ) -> Series<Vector2<f64>> {
        let mut nose = Series::new();
        for (time, by_gyros) in gyros.iter() {
            let by_gyros = self.gyros.apply(time, by_gyros);
            let by_logged = logged.at(time).map(|n| self.logged.apply(time, n));
            nose.push(time, by_logged.map_or(by_gyros, |n| mean(n, by_gyros)));
        }
        nose
    }
}

/// The direction between two, with their mean length.
fn mean(a: Vector2<f64>, b: Vector2<f64>) -> Vector2<f64> {
    let length = 0.5 * (a.norm() + b.norm());
    (a + b).try_normalize(1e-9).map_or(b, |n| n * length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_headings_that_err_apart_meet_in_the_middle() {
        let (mut logged, mut gyros) = (Series::new(), Series::new());
        let along = |angle: f64| Vector2::new(angle.cos(), angle.sin());
        for i in 0..100 {
            let time = 0.1 * f64::from(i);
            let truth = 0.3 * time;
            if i < 50 {
                logged.push(time, along(truth - 0.2 + 0.1));
            }
            gyros.push(time, along(truth - 1.0 + 0.02 * (time - 10.0) - 0.1) * 0.9);
        }
        let turn = |offset, drift| HeadingTurn {
            offset,
            drift,
            reference: 10.0,
        };
        let blend = Blend {
            logged: turn(0.2, 0.0),
            gyros: turn(1.0, -0.02),
        };
        let nose = blend.nose(&logged, &gyros);
        let off = |time: f64| {
            let turned = Rotation2::new(-0.3 * time) * nose.at(time).unwrap();
            (turned.y.atan2(turned.x), turned.norm())
        };
        let (angle, length) = off(2.0);
        assert!(angle.abs() < 0.01 && (length - 0.95).abs() < 1e-3);
        assert!((off(9.0).0 + 0.1).abs() < 0.01);
    }
}
