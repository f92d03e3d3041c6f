//! Delays of the instruments and choice of the heading to believe, by the flight so far.

use nalgebra::{Rotation2, Vector2};
use serde::{Deserialize, Serialize};

use super::blend::Blend;
use super::fit::AirFit;
use super::fit_refusal::FitRefusal;
use super::problem::{FitPrior, FitProblem};
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

/// Standard deviation of the airspeed's scale about 1 before it was measured: ArduPilot takes ratios of 1.5 to 3 about
/// 2 between speed squared and pressure for right (`ARSPD_RATIO`), and air at 1500 m makes another 1.08.
const SCALE: f64 = 0.15;
/// Standard deviation of the sideslip's length about zero before it was measured, m: a fuselage has a few metres, a
/// bare wing some twenty.
const SLIP_LENGTH: f64 = 30.0;
/// The same of what the side force reads too much, m/s²: three degrees of roll.
const SIDE_FORCE: f64 = 0.5;

/// Source of the heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum HeadingSource {
    /// The heading that was logged.
    Logged,
    /// The turn rates, integrated since take-off.
    Gyros,
    /// The mean of both.
    Both,
}

/// Seconds by which readings come late, against the attitude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Delays {
    /// Of the airspeed.
    pub airspeed: f64,
    /// Of satellite navigation, position and velocity.
    pub gps: f64,
}

/// Settings of the search for delays and of the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct CalibrationSettings {
    /// Delays to be used as they are; estimated where `None`.
    pub given_delays: Option<Delays>,
    /// Delays that are expected before anything was measured.
    pub expected_delays: Delays,
    /// Standard deviation of each about that, seconds.
    pub delay_deviation: f64,
    /// Time for which the error of a velocity is remembered where delays are told by what is new, seconds.
    pub error_memory: f64,
    /// Prior of scale, heading and wind, for the logged heading.
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
            error_memory: 1.0,
            logged: FitPrior {
                scale: SCALE,
                heading: 0.2,
                drift: 0.0,
                wind: 5.0,
                slip_length: SLIP_LENGTH,
                slip_offset: SLIP_LENGTH * SIDE_FORCE,
            },
            gyros: FitPrior {
                scale: SCALE,
                heading: 1.0,
                drift: 0.003,
                wind: 5.0,
                slip_length: SLIP_LENGTH,
                slip_offset: SLIP_LENGTH * SIDE_FORCE,
            },
        }
    }
}

/// Calibration of the instruments at a time, by nothing later than that.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Time up to which it looked, seconds.
    pub as_of: f64,
    /// The heading it is for.
    pub heading: HeadingSource,
    /// Blend of both headings, where the calibration is for their mean.
    pub blend: Option<Blend>,
    /// Delays.
    pub delays: Delays,
    /// Wind, scale, offset and drift; `None` before there are enough samples.
    pub fit: Option<AirFit>,
    /// Result of the fit that cannot be and was refused, if there is one.
    pub refused: Option<FitRefusal>,
    /// True airspeed to assume while none is measured, m/s.
    pub cruise: f64,
    /// Standard deviation of the airspeed about `cruise`, m/s.
    pub cruise_deviation: f64,
}

impl Calibration {
    /// Rotation that takes the nose as read at `time` to where it is believed to have pointed.
    pub fn heading_correction(&self, time: f64) -> Rotation2<f64> {
        Rotation2::new(self.fit.map_or(0.0, |fit| {
            fit.heading_offset + fit.heading_drift * (time - fit.reference)
        }))
    }

    /// Findings on the calibration.
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        let finding = |severity, title: String, text: String| Finding {
            severity,
            title,
            text,
            span: None,
        };
        if self.delays != Delays::default() {
            findings.push(finding(
                Severity::Note,
                format!("GPS comes {:.2} s late", self.delays.gps),
                format!(
                    "Against the attitude, satellite navigation comes {:.2} s and airspeed {:.2} s late; each is \
                     taken for the time at which it was true.",
                    self.delays.gps, self.delays.airspeed
                ),
            ));
        }
        findings.extend(self.refused.map(|refused| refused.finding()));
        let Some(fit) = self.fit else {
            return findings;
        };
        let off = fit.scale - 1.0;
        if off.abs() > 0.03 && off.abs() > 2.0 * fit.scale_deviation {
            let word = if off < 0.0 { "fast" } else { "slow" };
            findings.push(finding(
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
            ));
        }
        findings
    }

    /// Finding on the logged heading, if this is a calibration of it and the track wants it turned; `is_used`
    /// says whether navigation goes by it.
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
pub(super) fn calibrate(
    readings: &Readings,
    nose: &Series<Vector2<f64>>,
    side_force: &SideForce,
    heading: HeadingSource,
    span: (f64, f64),
    settings: &CalibrationSettings,
) -> Calibration {
    let mut problem = problem(readings, nose, side_force, heading, span, settings);
    let none = readings.are_true.then(Delays::default);
    let given = settings.given_delays.or(none);
    let start = given.unwrap_or(settings.expected_delays);
    let (mean, _) = cruise(readings, span, 1.0);
    let (mut fit, refused) = believable(&mut problem, start, mean);
    let mut delays = start;
    if let Some(first) = fit.filter(|_| given.is_none()) {
        let expected = settings.expected_delays;
        let score = |delays: Delays| {
            let fit = problem.solve(delays.airspeed, delays.gps, Some(&first))?;
            let off = Vector2::new(
                delays.airspeed - expected.airspeed,
                delays.gps - expected.gps,
            );
            Some(fit.log_likelihood - 0.5 * off.norm_squared() / settings.delay_deviation.powi(2))
        };
        delays = search(start, &score);
        fit = problem.solve(delays.airspeed, delays.gps, None);
    }
    let (cruise, cruise_deviation) = cruise(readings, span, fit.map_or(1.0, |fit| fit.scale));
    Calibration {
        as_of: span.1,
        heading,
        blend: None,
        delays,
        fit,
        refused,
        cruise,
        cruise_deviation,
    }
}

/// Fit problem of the stretch `span` (seconds) of a flight.
pub(super) fn problem<'a>(
    readings: &'a Readings,
    nose: &'a Series<Vector2<f64>>,
    side_force: &'a SideForce,
    heading: HeadingSource,
    span: (f64, f64),
    settings: &CalibrationSettings,
) -> FitProblem<'a> {
    FitProblem {
        velocities: &readings.velocities,
        airspeed: &readings.airspeed,
        nose,
        side_force,
        span,
        memory: settings.error_memory,
        prior: match heading {
            HeadingSource::Logged | HeadingSource::Both => settings.logged,
            HeadingSource::Gyros => settings.gyros,
        },
    }
}

/// A fit in which nothing cannot be, at a mean airspeed of `airspeed` m/s, and what was refused of it at first; the
/// problem is left with priors that keep it so.
fn believable(
    problem: &mut FitProblem<'_>,
    delays: Delays,
    airspeed: f64,
) -> (Option<AirFit>, Option<FitRefusal>) {
    let mut refused = None;
    loop {
        let fit = problem.solve(delays.airspeed, delays.gps, None);
        let Some(wrong) = fit.and_then(|fit| FitRefusal::of(&fit, airspeed)) else {
            return (fit, refused);
        };
        // A sideslip that cannot be and a scale that still cannot be without it: the scale is the worse.
        let is_new = refused.is_none() || matches!(refused, Some(FitRefusal::Slip(..)));
        let Some(prior) = wrong.believed(problem.prior).filter(|_| is_new) else {
            return (None, Some(wrong));
        };
        (problem.prior, refused) = (prior, Some(wrong));
    }
}

/// Climbs from `start` to the delays of the best score, by steps that halve.
fn search(start: Delays, score: &impl Fn(Delays) -> Option<f64>) -> Delays {
    let Some(mut best) = score(start) else {
        return start;
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
        match candidates.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((there, found)) if found > best => (at, best) = (there, found),
            _ => step *= 0.5,
        }
    }
    at
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
