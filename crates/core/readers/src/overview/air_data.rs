//! Agreement of airspeed, heading and the track over ground.

use nalgebra::{Matrix3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use super::super::interpret::{Role, RoleSeries};
use super::{Finding, Severity};
use pilotage_base::frames::wrap_pi;

/// Fewest samples of a fit.
const FEWEST: usize = 30;
/// Least change of heading, radians, without which wind and scale cannot be told apart.
const LEAST_TURN: f64 = 1.5;

/// Scales beyond which it is no scale any more that is wrong.
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// Least-squares fit of one wind and one scale of the airspeed for the whole flight: ground velocity = scale
/// · airspeed · cos(pitch) · (cos heading, sin heading) + wind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AirDataFit {
    /// True airspeed over measured airspeed.
    pub scale: f64,
    /// Velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
    /// Root mean square of what is left per axis, m/s.
    pub rms: f64,
    /// Samples that it rests on.
    pub samples: usize,
}

impl AirDataFit {
    /// Findings that look wrong about the fit.
    pub fn findings(&self) -> Vec<Finding> {
        if !PLAUSIBLE.contains(&self.scale) {
            return vec![Finding {
                severity: Severity::Warning,
                title: "Airspeed, heading and track contradict each other".to_owned(),
                text: format!(
                    "No wind and no scale of the airspeed explain the track over ground: the best leave \
                     {:.1} m/s. One of the three measures something else, or nothing.",
                    self.rms
                ),
                span: None,
            }];
        }
        let percent = 100.0 * (self.scale - 1.0);
        if percent.abs() < 3.0 {
            return Vec::new();
        }
        let (word, amount) = if percent < 0.0 {
            ("too fast", 100.0 * (1.0 / self.scale - 1.0))
        } else {
            ("too slow", 100.0 * (1.0 - 1.0 / self.scale))
        };
        vec![Finding {
            severity: if percent.abs() > 15.0 {
                Severity::Warning
            } else {
                Severity::Note
            },
            title: format!("Airspeed reads {amount:.0} % {word}"),
            text: format!(
                "Over the whole flight the track fits the airspeed best when it is multiplied by {:.3} \
                 (equivalent airspeed reads low with height; a wrong sensor ratio either way).",
                self.scale
            ),
            span: None,
        }]
    }
}

/// Fits wind and airspeed scale to the stretches in the air; `None` where a series is missing, or the
/// flight turns too little to tell them apart.
pub fn fit_air_data(found: &[RoleSeries], airborne: &[(f64, f64)]) -> Option<AirDataFit> {
    let of = |role| found.iter().find(|s: &&RoleSeries| s.role == role);
    let north = of(Role::GpsVelocityNorth)?;
    let (east, airspeed) = (of(Role::GpsVelocityEast)?, of(Role::Airspeed)?);
    let (heading, pitch) = (of(Role::Heading)?, of(Role::Pitch));
    let is_up = |time: f64| airborne.iter().any(|(a, b)| (*a..=*b).contains(&time));
    let samples: Vec<(Vector2<f64>, Vector2<f64>)> = north
        .times
        .iter()
        .zip(&north.values)
        .filter(|(time, _)| is_up(**time))
        .filter_map(|(time, north)| {
            let over_ground = Vector2::new(*north, east.at(*time)?);
            let pitch = pitch.and_then(|p| p.at(*time)).unwrap_or(0.0);
            let (sin, cos) = heading.at(*time)?.sin_cos();
            let forward = airspeed.at(*time)? * pitch.cos();
            Some((over_ground, Vector2::new(cos, sin) * forward))
        })
        .collect();
    if samples.len() < FEWEST || turned(heading, airborne) < LEAST_TURN {
        return None;
    }
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for (ground, air) in &samples {
        for (axis, row) in [
            (0, Vector3::new(air.x, 1.0, 0.0)),
            (1, Vector3::new(air.y, 0.0, 1.0)),
        ] {
            normal += row * row.transpose();
            right += row * ground[axis];
        }
    }
    let solution = normal.cholesky()?.solve(&right);
    let (scale, wind) = (solution.x, Vector2::new(solution.y, solution.z));
    let squares: f64 = samples
        .iter()
        .map(|(ground, air)| (ground - air * scale - wind).norm_squared())
        .sum();
    Some(AirDataFit {
        scale,
        wind,
        rms: (squares / (2 * samples.len()) as f64).sqrt(),
        samples: samples.len(),
    })
}

/// Largest turn away from the first heading in the air, radians.
fn turned(heading: &RoleSeries, airborne: &[(f64, f64)]) -> f64 {
    let is_up = |time: f64| airborne.iter().any(|(a, b)| (*a..=*b).contains(&time));
    let pairs = heading.times.iter().zip(&heading.values);
    let mut flown = pairs.filter(|(time, _)| is_up(**time)).map(|(_, h)| *h);
    let Some(first) = flown.next() else {
        return 0.0;
    };
    flown
        .map(|heading| wrap_pi(heading - first).abs())
        .fold(0.0, f64::max)
}
