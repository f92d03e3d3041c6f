//! What the instruments' delays are and which heading to believe, by the flight so far.

use nalgebra::{Rotation2, Vector2};
use serde::{Deserialize, Serialize};

use super::fit::{AirFit, FitPrior, FitProblem};
use super::readings::Readings;
use super::series::Series;
use super::slip::SideForce;
use pilotage_flight::{Finding, Severity};

/// First step of the search for delays, seconds; steps halve down to the last.
const FIRST_STEP: f64 = 0.1;
/// Step at which the search ends, seconds.
const LAST_STEP: f64 = 0.01;

/// Offset of the compass from which on it is told, radians.
const COMPASS_OFF: f64 = 0.1;

/// Standard deviation of the sideslip's length about zero before it was measured, m: a fuselage has a few metres, a
/// bare wing some twenty.
const SLIP_LENGTH: f64 = 30.0;
/// The same of what the side force reads too much, m/s²: three degrees of roll.
const SIDE_FORCE: f64 = 0.5;

/// Where the heading comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum HeadingSource {
    /// The heading that was logged.
    Logged,
    /// The turn rates, integrated since take-off.
    Gyros,
}

/// Seconds by which readings come late, against the attitude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Delays {
    /// Of the airspeed.
    pub airspeed: f64,
    /// Of satellite navigation, position and velocity.
    pub gps: f64,
}

/// How delays and fit are found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct CalibrationSettings {
    /// Delays to be used as they are; estimated where `None`.
    pub given_delays: Option<Delays>,
    /// Delays that are expected before anything was measured.
    pub expected_delays: Delays,
    /// Standard deviation of each about that, seconds.
    pub delay_deviation: f64,
    /// Standard deviation of the error of the velocity that remembers itself, m/s per axis.
    pub error_deviation: f64,
    /// Its correlation time, seconds.
    pub error_memory: f64,
    /// What is believed of scale, heading and wind, for the logged heading.
    pub logged: FitPrior,
    /// The same for the gyros' heading.
    pub gyros: FitPrior,
}

impl Default for CalibrationSettings {
    fn default() -> Self {
        Self {
            given_delays: None,
            // Receivers of such aircraft take about 0.2 s to tell a velocity, pitot tubes are filtered over 0.1 s;
            // the author of the InertialNav flights states 0.21 to 0.23 s for both.
            expected_delays: Delays {
                airspeed: 0.2,
                gps: 0.2,
            },
            delay_deviation: 0.15,
            error_deviation: 1.0,
            error_memory: 1.0,
            logged: FitPrior {
                scale: 0.1,
                heading: 0.2,
                drift: 0.0,
                wind: 5.0,
                slip_length: SLIP_LENGTH,
                slip_offset: SLIP_LENGTH * SIDE_FORCE,
            },
            gyros: FitPrior {
                scale: 0.1,
                heading: 1.0,
                drift: 0.003,
                wind: 5.0,
                slip_length: SLIP_LENGTH,
                slip_offset: SLIP_LENGTH * SIDE_FORCE,
            },
        }
    }
}

/// What is known of the instruments at a time, by nothing later than that.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Time up to which it looked, seconds.
    pub as_of: f64,
    /// The heading it is for.
    pub heading: HeadingSource,
    /// Delays.
    pub delays: Delays,
    /// Wind, scale, offset and drift; `None` before there are enough samples.
    pub fit: Option<AirFit>,
    /// True airspeed to assume while none is measured, m/s.
    pub cruise: f64,
    /// How the airspeed strays from that, standard deviation in m/s.
    pub cruise_deviation: f64,
}

impl Calibration {
    /// Rotation that takes the nose as read at `time` to where it is believed to have pointed.
    pub fn heading_correction(&self, time: f64) -> Rotation2<f64> {
        Rotation2::new(self.fit.map_or(0.0, |fit| {
            fit.heading_offset + fit.heading_drift * (time - fit.reference)
        }))
    }

    /// What there is to say of it.
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        let mut say = |severity, title: String, text: String| {
            findings.push(Finding {
                severity,
                title,
                text,
                span: None,
            });
        };
        if self.delays != Delays::default() {
            say(
                Severity::Note,
                format!("GPS comes {:.2} s late", self.delays.gps),
                format!(
                    "Against the attitude, satellite navigation comes {:.2} s and airspeed {:.2} s late; each is \
                     taken for the time at which it was true.",
                    self.delays.gps, self.delays.airspeed
                ),
            );
        }
        let Some(fit) = self.fit else {
            return findings;
        };
        let off = fit.scale - 1.0;
        if off.abs() > 0.03 && off.abs() > 2.0 * fit.scale_deviation {
            let word = if off < 0.0 { "fast" } else { "slow" };
            say(
                if off.abs() > 0.15 {
                    Severity::Warning
                } else {
                    Severity::Note
                },
                format!(
                    "Airspeed reads {:.0} % too {word}",
                    100.0 * (1.0 / fit.scale - 1.0).abs()
                ),
                format!(
                    "The track fits the airspeed best when it is multiplied by {:.3} ± {:.3}.",
                    fit.scale, fit.scale_deviation
                ),
            );
        }
        findings
    }

    /// What there is to say of the logged heading, if this is a calibration of it and the track wants it turned;
    /// `is_used` says whether navigation goes by it.
    pub fn compass_finding(&self, is_used: bool) -> Option<Finding> {
        let fit = self.fit.filter(|_| self.heading == HeadingSource::Logged)?;
        let offset = fit.heading_offset;
        let is_sure = offset.abs() > 3.0 * fit.offset_deviation;
        if offset.abs() <= COMPASS_OFF || !is_sure {
            return None;
        }
        let side = if offset < 0.0 { "right" } else { "left" };
        let remedy = if is_used {
            ", and so they are."
        } else {
            "; the gyros' heading is used in its place."
        };
        Some(Finding {
            severity: Severity::Warning,
            title: format!(
                "The compass is {:.0}° off to the {side}",
                offset.to_degrees().abs()
            ),
            text: format!(
                "The track fits the heading best when {:.1}° ± {:.1}° are added to it{remedy}",
                offset.to_degrees(),
                fit.offset_deviation.to_degrees()
            ),
            span: None,
        })
    }
}

/// Finds delays, wind, scale and heading offset from the stretch `span` (seconds) of a flight.
pub fn calibrate(
    readings: &Readings,
    nose: &Series<Vector2<f64>>,
    side_force: &SideForce,
    heading: HeadingSource,
    span: (f64, f64),
    settings: &CalibrationSettings,
) -> Calibration {
    let problem = FitProblem {
        velocities: &readings.velocities,
        airspeed: &readings.airspeed,
        nose,
        side_force,
        span,
        memory: settings.error_memory,
        deviation: settings.error_deviation,
        prior: match heading {
            HeadingSource::Logged => settings.logged,
            HeadingSource::Gyros => settings.gyros,
        },
    };
    let expected = settings.expected_delays;
    let score = |delays: Delays| {
        let fit = problem.solve(delays.airspeed, delays.gps)?;
        let off = Vector2::new(
            delays.airspeed - expected.airspeed,
            delays.gps - expected.gps,
        );
        let unlikely = 0.5 * off.norm_squared() / settings.delay_deviation.powi(2);
        Some((fit.log_likelihood - unlikely, fit))
    };
    let none = readings.are_true.then(Delays::default);
    let (delays, fit) = match settings.given_delays.or(none) {
        Some(delays) => (delays, score(delays).map(|(_, fit)| fit)),
        None => search(expected, &score),
    };
    let (cruise, cruise_deviation) = cruise(readings, span, fit.map_or(1.0, |fit| fit.scale));
    Calibration {
        as_of: span.1,
        heading,
        delays,
        fit,
        cruise,
        cruise_deviation,
    }
}

/// Climbs from `start` to the delays of the best score, by steps that halve.
fn search(
    start: Delays,
    score: &impl Fn(Delays) -> Option<(f64, AirFit)>,
) -> (Delays, Option<AirFit>) {
    let Some(mut best) = score(start) else {
        return (start, None);
    };
    let mut at = start;
    let mut step = FIRST_STEP;
    while step > LAST_STEP {
        // Along both axes and along their sum: what both have in common is known worse than their difference.
        let around = [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let around = around.into_iter().flat_map(|(a, g)| [(a, g), (-a, -g)]);
        let candidates = around.filter_map(|(airspeed, gps)| {
            let there = Delays {
                airspeed: at.airspeed + airspeed * step,
                gps: at.gps + gps * step,
            };
            Some((there, score(there)?))
        });
        match candidates.max_by(|a, b| a.1.0.total_cmp(&b.1.0)) {
            Some((there, found)) if found.0 > best.0 => (at, best) = (there, found),
            _ => step *= 0.5,
        }
    }
    (at, Some(best.1))
}

/// Mean and standard deviation of the true airspeed over a stretch, m/s: by the airspeed, or by the speed over
/// ground where there is none.
fn cruise(readings: &Readings, (from, to): (f64, f64), scale: f64) -> (f64, f64) {
    let mut speeds: Vec<f64> = readings
        .airspeed
        .between(from, to)
        .map(|(_, v)| v * scale)
        .collect();
    if speeds.len() < 2 {
        let velocities = readings.velocities.between(from, to);
        speeds = velocities.map(|(_, v)| v.norm()).collect();
    }
    let count = speeds.len().max(1) as f64;
    let mean = speeds.iter().sum::<f64>() / count;
    let spread: f64 = speeds.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (spread / count).sqrt())
}
