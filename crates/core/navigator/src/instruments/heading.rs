//! The logged heading against the gyros.

use std::f64::consts::TAU;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::calibration::HeadingSource;
use super::series::Series;
use pilotage_base::frames::wrap_pi;
use pilotage_flight::{Finding, Severity, moment};

/// Share of the nose's direction that must lie in the horizontal for its heading to mean something.
const LEVEL: f64 = 0.5;
/// Standard deviation from which on the difference is told, radians.
const NOTED: f64 = 0.1;
/// Standard deviation from which on it warns, radians: across 0.2 of the airspeed.
const WARNED: f64 = 0.2;

/// Difference between the logged heading and the one that the gyros integrate to, a constant and a steady
/// drift apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadingCheck {
    /// Standard deviation of the difference, radians.
    pub deviation: f64,
    /// Largest difference, radians.
    pub largest: f64,
    /// When it was that large, seconds.
    pub at: f64,
    /// Drift of the gyros' heading against the logged one, rad/s.
    pub drift: f64,
    /// Stretch that was looked at, seconds.
    pub span: (f64, f64),
}

impl HeadingCheck {
    /// Compares two headings over a stretch; `None` with fewer than 20 samples.
    pub fn of(
        logged: &Series<Vector2<f64>>,
        gyros: &Series<Vector2<f64>>,
        span: (f64, f64),
    ) -> Option<Self> {
        let mut differences: Vec<(f64, f64)> = Vec::new();
        for (time, nose) in logged.between(span.0, span.1) {
            let Some(other) = gyros.at(time) else {
                continue;
            };
            if nose.norm().min(other.norm()) < LEVEL {
                continue;
            }
            let difference = nose.y.atan2(nose.x) - other.y.atan2(other.x);
            let last = differences.last().map_or(0.0, |(_, last)| *last);
            differences.push((time, last + wrap_pi(difference - last)));
        }
        if differences.len() < 20 {
            return None;
        }
        let count = differences.len() as f64;
        let mean_time = differences.iter().map(|(t, _)| t).sum::<f64>() / count;
        let mean = differences.iter().map(|(_, d)| d).sum::<f64>() / count;
        let (mut both, mut squares) = (0.0, 0.0);
        for (time, difference) in &differences {
            both += (time - mean_time) * (difference - mean);
            squares += (time - mean_time).powi(2);
        }
        let drift = both / squares;
        let left = differences
            .iter()
            .map(|(time, d)| (*time, d - mean - drift * (time - mean_time)));
        let left: Vec<(f64, f64)> = left.collect();
        let sum: f64 = left.iter().map(|(_, d)| d * d).sum();
        let largest = left.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some(Self {
            deviation: (sum / count).sqrt(),
            largest: largest.1.abs().min(TAU),
            at: largest.0,
            drift,
            span,
        })
    }

    /// Finding on the difference of the headings; `residuals` are what the best wind leaves of the velocity
    /// with the logged and with the gyros' heading, m/s, and `taken` says which of them is used.
    pub fn finding(&self, residuals: Option<(f64, f64)>, taken: HeadingSource) -> Option<Finding> {
        if self.deviation < NOTED {
            return None;
        }
        let fits = residuals.map_or_else(String::new, |(logged, gyros)| {
            format!(
                " With it the velocity over ground fits airspeed and wind to {logged:.1} m/s, with the gyros' \
                 heading to {gyros:.1} m/s."
            )
        });
        let taken = match taken {
            HeadingSource::Gyros => {
                "The gyros' heading is used, turned to where the track over ground wants it."
            }
            HeadingSource::Logged => "The logged heading is used.",
            HeadingSource::Both => {
                "Neither fits better by more than chance: their mean is used, each turned to where the track over \
                 ground wants it."
            }
        };
        Some(Finding {
            severity: if self.deviation >= WARNED {
                Severity::Warning
            } else {
                Severity::Note
            },
            title: format!(
                "Heading and gyros disagree by {:.0}°",
                self.deviation.to_degrees()
            ),
            text: format!(
                "The logged heading strays from what the turn rates add up to by {:.0}° (standard deviation; a \
                 constant and a steady drift do not count), most by {:.0}° at {}.{fits} {taken}",
                self.deviation.to_degrees(),
                self.largest.to_degrees(),
                moment(self.at)
            ),
            span: Some(self.span),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nose(heading: impl Fn(f64) -> f64) -> Series<Vector2<f64>> {
        let mut nose = Series::new();
        for i in 0..1000 {
            let time = 0.1 * f64::from(i);
            let heading = heading(time);
            nose.push(time, Vector2::new(heading.cos(), heading.sin()));
        }
        nose
    }

    #[test]
    fn a_compass_that_errs_with_the_heading_is_told_and_a_constant_is_not() {
        let turning = |t: f64| 0.3 * t;
        let gyros = nose(move |t| turning(t) + 0.002 * t);
        let constant = nose(move |t| turning(t) + 0.35);
        let check = HeadingCheck::of(&constant, &gyros, (0.0, 100.0)).unwrap();
        assert!(check.deviation < 1e-6 && (check.drift + 0.002).abs() < 1e-9);
        assert_eq!(check.finding(None, HeadingSource::Logged), None);
        let bent = nose(move |t| turning(t) + 0.5 * turning(t).sin());
        let check = HeadingCheck::of(&bent, &gyros, (0.0, 100.0)).unwrap();
        assert!((check.deviation - 0.5 / 2.0_f64.sqrt()).abs() < 0.02);
        let finding = check
            .finding(Some((3.2, 1.0)), HeadingSource::Gyros)
            .unwrap();
        assert_eq!(finding.severity, Severity::Warning);
        assert_eq!(finding.title, "Heading and gyros disagree by 20°");
        assert!(
            finding
                .text
                .contains("3.2 m/s, with the gyros' heading to 1.0 m/s. The gyros'")
        );
    }
}
