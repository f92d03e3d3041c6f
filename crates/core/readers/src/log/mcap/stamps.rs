//! Times that messages carry, for topics that were logged in bursts.
//!
//! A bridge or a buffer hands messages over together, so that many have one time of logging; their headers tell when each was
//! made. As for telemetry, the least time between a stamp and its logging lays the one clock on the other.

use crate::log::{FieldKind, Log, Topic};

/// Fewest rows that tell bursts.
const ENOUGH: usize = 10;
/// Usual step of times against their mean, below which rows came in bursts.
const BURST: f64 = 0.1;
/// The same of stamps, from which on they are regular.
const REGULAR: f64 = 0.5;
/// Largest share of stamps that repeat another or go back, whose rows are left out of a clock.
const ASTRAY: f64 = 0.05;
/// Topics whose stamps differ by less from the times of logging have one clock, seconds.
const SAME: f64 = 5.0;
/// Fields of a stamp: seconds, and nanoseconds beside them.
const STAMPS: [[&str; 2]; 5] = [
    ["header.stamp.sec", "header.stamp.nanosec"],
    ["header.stamp.secs", "header.stamp.nsecs"],
    ["header.stamp.sec", "header.stamp.nsec"],
    ["timestamp.sec", "timestamp.nsec"],
    ["timestamp.seconds", "timestamp.nanos"],
];
/// Fields of one number: microseconds of PX4, and the time at which a message was sent, by its publisher.
const NUMBERS: [(&str, f64); 2] = [("timestamp", 1e-6), ("publish_time", 1.0)];

/// Gives the rows of topics that were logged in bursts the times that they carry, laid on the clock of the logger, and says so.
pub(super) fn count_by_stamps(log: &mut Log) {
    let mut found: Vec<(usize, Vec<f64>, f64)> = Vec::new();
    let mut unused = Vec::new();
    for (place, topic) in log.topics.iter().enumerate() {
        if !is_in_bursts(&topic.times) {
            continue;
        }
        match stamps(topic) {
            Some(Stamps::Sound(stamps)) => {
                let delays = topic.times.iter().zip(&stamps).map(|(time, s)| time - s);
                let least = delays.fold(f64::INFINITY, f64::min);
                found.push((place, stamps, least));
            }
            Some(Stamps::Astray(astray)) => unused.push(format!(
                "messages of {} were logged in bursts, and {astray} of their {} own times repeat another or go back: they \
                 have the times of logging",
                topic.name,
                topic.times.len()
            )),
            None => {}
        }
    }
    for told in unused {
        log.report.remark(told);
    }
    let mut names = Vec::new();
    for (place, stamps, own) in &found {
        let same = found.iter().map(|(_, _, other)| *other);
        let same = same.filter(|other| (other - own).abs() < SAME);
        let offset = same.fold(*own, f64::min);
        let topic = &mut log.topics[*place];
        topic.times = stamps.iter().map(|stamp| stamp + offset).collect();
        names.push(topic.name.to_string());
    }
    if !names.is_empty() {
        log.report.remark(format!(
            "messages were logged in bursts: those of {} have the times that they carry, on the logger's clock",
            names.join(", ")
        ));
    }
}

/// Whether most steps of times are far shorter than their mean.
fn is_in_bursts(times: &[f64]) -> bool {
    usual_step(times).is_some_and(|step| step < BURST)
}

/// The usual step between times as a share of their mean; `None` of too few or of times that do not go on.
fn usual_step(times: &[f64]) -> Option<f64> {
    let span = times.last()? - times.first()?;
    let mut steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    if steps.len() < ENOUGH || !(span > 0.0 && span.is_finite()) {
        return None;
    }
    let middle = steps.len() / 2;
    let mean = span / steps.len() as f64;
    let usual = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    Some(usual / mean)
}

/// Clock by stamps.
enum Stamps {
    /// Seconds of the rows; those that repeat another or go back have the latest before them.
    Sound(Vec<f64>),
    /// So many repeat another or go back.
    Astray(usize),
}

/// The stamps of a topic's rows, where they grow as regularly as a clock and as fast as that of the logger but for a few;
/// `None` of a topic without such.
fn stamps(topic: &Topic) -> Option<Stamps> {
    let pairs = STAMPS.iter().filter_map(|[seconds, parts]| {
        let (seconds, parts) = (topic.values(seconds)?, topic.values(parts)?);
        let first = *seconds.first()?;
        let both = seconds.iter().zip(&parts);
        Some(both.map(|(s, n)| (s - first) + 1e-9 * n).collect())
    });
    let numbers = NUMBERS.iter().filter_map(|(name, factor)| {
        let kind = topic.field(name)?.kind;
        let values = topic.values(name).filter(|_| kind != FieldKind::U8)?;
        let first = *values.first()?;
        Some(values.iter().map(|v| factor * (v - first)).collect())
    });
    let lasts = topic.times.last()? - topic.times.first()?;
    let judged = |mut stamps: Vec<f64>| {
        let span = stamps.last().copied().unwrap_or_default() - stamps[0];
        if !(0.5 * lasts..2.0 * lasts).contains(&span) {
            return None;
        }
        let (mut latest, mut astray) = (f64::NEG_INFINITY, 0);
        for stamp in &mut stamps {
            astray += usize::from(*stamp <= latest);
            latest = latest.max(*stamp);
            *stamp = latest;
        }
        if astray as f64 > ASTRAY * stamps.len() as f64 {
            return Some(Stamps::Astray(astray));
        }
        let is_regular = usual_step(&stamps).is_some_and(|step| step > REGULAR);
        is_regular.then_some(Stamps::Sound(stamps))
    };
    let mut all: Vec<Stamps> = pairs.chain(numbers).filter_map(judged).collect();
    let sound = (all.iter()).position(|found| matches!(found, Stamps::Sound(_)));
    (!all.is_empty()).then(|| all.swap_remove(sound.unwrap_or(0)))
}
