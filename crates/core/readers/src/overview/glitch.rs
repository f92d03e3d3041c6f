//! Positions by satellite navigation that jump.

use super::super::interpret::{Role, RoleSeries};
use super::{Finding, Severity};
use pilotage_flight::{TruthState, moment};

/// A jump is this many times the usual disagreement between positions and velocities, and at least so
/// many metres.
const TIMES: f64 = 8.0;
const LEAST_JUMP: f64 = 5.0;
/// Longest pause over which a step is judged, seconds.
const LONGEST_STEP: f64 = 2.0;

/// Jumps of the position that its velocity does not tell of, as one finding; the largest is placed.
pub fn findings(found: &[RoleSeries], states: &[TruthState]) -> Vec<Finding> {
    let of = |role| found.iter().find(|s: &&RoleSeries| s.role == role);
    let (Some(north), Some(east)) = (of(Role::GpsVelocityNorth), of(Role::GpsVelocityEast)) else {
        return Vec::new();
    };
    let mean = |series: &RoleSeries, a: f64, b: f64| Some(0.5 * (series.at(a)? + series.at(b)?));
    let mut leaps: Vec<(f64, f64)> = states
        .windows(2)
        .filter_map(|pair| {
            let (a, b) = (&pair[0], &pair[1]);
            let dt = b.time - a.time;
            if dt > LONGEST_STEP {
                return None;
            }
            let step = b.position - a.position;
            let north = step.x - dt * mean(north, a.time, b.time)?;
            let east = step.y - dt * mean(east, a.time, b.time)?;
            Some((b.time, north.hypot(east)))
        })
        .collect();
    let mut sizes: Vec<f64> = leaps.iter().map(|(_, size)| *size).collect();
    if sizes.is_empty() {
        return Vec::new();
    }
    let middle = sizes.len() / 2;
    let usual = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
    leaps.retain(|(_, size)| *size > (TIMES * usual).max(LEAST_JUMP));
    let largest = leaps.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((time, size)) = largest else {
        return Vec::new();
    };
    let count = match leaps.len() {
        1 => "Once".to_owned(),
        n => format!("{n} times"),
    };
    vec![Finding {
        severity: Severity::Warning,
        title: format!("GPS jumps by {size:.0} m"),
        text: format!(
            "{count} the position moved by more than its own velocity tells (usually they agree to \
             {usual:.1} m); most at {}.",
            moment(*time)
        ),
        span: Some((*time, *time)),
    }]
}
