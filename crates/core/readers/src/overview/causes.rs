//! Findings by cause: sensors that fail together, told together.

use super::sensor::{SampleGap, Sensor, often};
use super::{Finding, Severity};
use crate::interpret::Role;
use pilotage_flight::moment;

/// Seconds by which the ends of two stretches with one cause may lie apart.
const NEAR: f64 = 2.0;

/// Findings that look wrong about sensors, those with one cause together. On the ground nothing is stuck: `airborne`
/// are the times in flight.
pub fn findings(sensors: &[Sensor], airborne: &[(f64, f64)]) -> Vec<Finding> {
    let is_aloft = |(from, to): (f64, f64)| airborne.iter().any(|(a, b)| from < *b && to > *a);
    let is_dead = |sensor: &&Sensor| sensor.is_dead && sensor.samples > 1 && measures(sensor.role);
    let dead = sensors.iter().filter(is_dead);
    let mut findings: Vec<Finding> = groups(dead, |a, b| topic(a) == topic(b))
        .iter()
        .map(|group| never_moves(group))
        .collect();
    let is_stuck = |sensor: &&Sensor| !is_dead(sensor) && sensor.stuck.is_some_and(is_aloft);
    let stuck = sensors.iter().filter(is_stuck);
    let stuck = groups(stuck, |a, b| near(a.stuck, b.stuck));
    findings.extend(stuck.iter().filter_map(|group| is_held(group)));
    let missing = sensors.iter().filter(|sensor| !sensor.gaps.is_empty());
    let span = |sensor: &Sensor| longest(sensor).map(|gap| (gap.from, gap.to));
    let missing = groups(missing, |a, b| near(span(a), span(b)));
    findings.extend(missing.iter().filter_map(|group| is_missing(group)));
    findings
}

/// Whether a role is measured and moves; counts and what an estimator makes are neither.
fn measures(role: Role) -> bool {
    !matches!(
        role,
        Role::GpsFix
            | Role::GpsSatellites
            | Role::WindNorth
            | Role::WindEast
            | Role::AutopilotLatitude
            | Role::AutopilotLongitude
            | Role::AutopilotHeight
    )
}

/// The topic of a sensor's source.
fn topic(sensor: &Sensor) -> &str {
    sensor
        .source
        .rsplit_once('.')
        .map_or(&sensor.source, |(topic, _)| topic)
}

fn near(a: Option<(f64, f64)>, b: Option<(f64, f64)>) -> bool {
    a.zip(b)
        .is_some_and(|(a, b)| (a.0 - b.0).abs() <= NEAR && (a.1 - b.1).abs() <= NEAR)
}

/// Sensors that are alike, in groups.
fn groups<'a>(
    sensors: impl Iterator<Item = &'a Sensor>,
    is_like: impl Fn(&Sensor, &Sensor) -> bool,
) -> Vec<Vec<&'a Sensor>> {
    let mut groups: Vec<Vec<&Sensor>> = Vec::new();
    for sensor in sensors {
        match groups.iter_mut().find(|group| is_like(group[0], sensor)) {
            Some(group) => group.push(sensor),
            None => groups.push(vec![sensor]),
        }
    }
    groups
}

/// Name of a group: the role of its first sensor, with the number of the others, if any.
fn called(group: &[&Sensor]) -> String {
    match group {
        [one] => one.role.label().to_owned(),
        several => format!("{} and {} more", several[0].role.label(), several.len() - 1),
    }
}

/// The sources of a group, each once.
fn sources(group: &[&Sensor]) -> String {
    let mut sources: Vec<&str> = Vec::new();
    for sensor in group {
        if !sources.contains(&sensor.source.as_str()) {
            sources.push(&sensor.source);
        }
    }
    sources.join(", ")
}

fn verb(group: &[&Sensor], one: &'static str, several: &'static str) -> &'static str {
    if group.len() == 1 { one } else { several }
}

fn never_moves(group: &[&Sensor]) -> Finding {
    Finding {
        severity: Severity::Warning,
        title: format!("{} never {}", called(group), verb(group, "moves", "move")),
        text: format!(
            "{} {} one number in all {} samples: the sensor was probably not there.",
            sources(group),
            verb(group, "shows", "each show"),
            group[0].samples
        ),
        span: None,
    }
}

fn is_held(group: &[&Sensor]) -> Option<Finding> {
    let (from, to) = group[0].stuck?;
    Some(Finding {
        severity: Severity::Warning,
        title: format!(
            "{} {} stuck for {:.0} s",
            called(group),
            verb(group, "is", "are"),
            to - from
        ),
        text: format!(
            "{} {} one number from {} to {}.",
            sources(group),
            verb(group, "shows", "each show"),
            moment(from),
            moment(to)
        ),
        span: Some((from, to)),
    })
}

/// The longest gap of a sensor.
fn longest(sensor: &Sensor) -> Option<&SampleGap> {
    let gaps = sensor.gaps.iter();
    gaps.max_by(|a, b| (a.to - a.from).total_cmp(&(b.to - b.from)))
}

fn is_missing(group: &[&Sensor]) -> Option<Finding> {
    let gap = longest(group[0])?;
    let others = match group[0].gaps.len() {
        1 => String::new(),
        n => format!(" {n} gaps in all."),
    };
    let usual = if group.len() == 1 {
        format!(", though it usually has {}", often(group[0].rate))
    } else {
        String::new()
    };
    Some(Finding {
        severity: Severity::Note,
        title: format!(
            "{} {} missing for {:.1} s",
            called(group),
            verb(group, "is", "are"),
            gap.to - gap.from
        ),
        text: format!(
            "{} {} no sample between {} and {}{usual}.{others}",
            sources(group),
            verb(group, "has", "have"),
            moment(gap.from),
            moment(gap.to)
        ),
        span: Some((gap.from, gap.to)),
    })
}
