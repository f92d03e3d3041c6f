//! Times that messages carry, laid on the clock of whoever received them.
//!
//! A link delivers late and in bursts; the vehicle's own clock is regular. A message sent at `s` seconds of that clock
//! and received at `r` has the delay r − s − offset ≥ 0, so the least of all r − s tells the offset. Both clocks may
//! drift against one another, and the vehicle's begins anew when it is started again.

use std::collections::BTreeMap;
use std::ops::Range;

use super::super::{FieldLayout, Log, Topic, system_of};
use crate::times::{TimeVerdict, judge, starts_of};

/// Fields in which messages carry the time, with how many of them are a second.
const STAMPS: [(&str, f64); 2] = [("time_boot_ms", 1e3), ("time_usec", 1e6)];
/// Fewer messages of one kind tell no clock.
pub(super) const ENOUGH: usize = 5;
/// Kinds of messages whose offsets differ by less are of one clock, seconds.
const SAME: f64 = 5.0;
/// Clocks are held against each other for drift from this long on, seconds, and never drift faster than this.
const DRIFT_FROM: f64 = 600.0;
const FASTEST_DRIFT: f64 = 2e-4;
/// A message without a time has that of the last one that came from the same vehicle at most so long before, seconds.
const TOGETHER: f64 = 0.5;
/// Delays that most messages stay below, seconds; what comes later is not timed by this clock.
const LATEST: f64 = 60.0;
/// A clock that was set leaves at least so much of the vehicle's time before and behind it, seconds: shorter ones may be stalls
/// of the link.
const STRETCH: f64 = 20.0;
/// A delay that people are told of, seconds.
const LATE: f64 = 0.5;

/// Between two starts of a vehicle: its clock on the receiver's.
#[derive(Clone, Copy, Debug)]
struct Start {
    /// Seconds of the receiver's clock from which on it holds.
    from: f64,
    /// Offset at second zero of the vehicle's clock, seconds, and how it grows.
    offset: f64,
    drift: f64,
}

impl Start {
    /// When a message was sent, on the receiver's clock.
    fn time(&self, sent: f64) -> f64 {
        sent + self.offset + self.drift * sent
    }
}

/// A topic whose messages carry a time.
struct TimedTopic {
    place: usize,
    sent: Vec<f64>,
    /// Rows between two starts, with the clock as these rows tell it.
    starts: Vec<(Range<usize>, Start)>,
}

/// Gives rows the times that their messages carry, in seconds of the receiver's clock, and rows of messages without one
/// that of the message before. Says so where the link delivered late.
pub(super) fn count_by_messages(log: &mut Log) {
    let mut systems: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (place, topic) in log.topics.iter().enumerate() {
        let system = system_of(topic.name.instance.unwrap_or_default());
        systems.entry(system).or_default().push(place);
    }
    let mut latest: f64 = 0.0;
    for places in systems.into_values() {
        let timed = places
            .iter()
            .filter_map(|place| timed(*place, &log.topics[*place]));
        let timed: Vec<TimedTopic> = timed.collect();
        let Some(most) = timed.iter().max_by_key(|timed| timed.sent.len()) else {
            continue;
        };
        let reference: Vec<Start> = most.starts.iter().map(|(_, start)| *start).collect();
        let step = step_of(most, &log.topics[most.place].times);
        // Received and sent, on one clock, of every message with a time.
        let mut known: Vec<(f64, f64)> = Vec::new();
        for timed in &timed {
            let topic = &mut log.topics[timed.place];
            for (rows, own) in &timed.starts {
                for row in rows.clone() {
                    let received = topic.times[row];
                    let sent = timed.sent[row];
                    let shared = at(&reference, received)
                        .filter(|start| (start.offset - own.offset).abs() < SAME);
                    let time = shared.unwrap_or(own).time(sent);
                    if sent.is_finite() {
                        topic.times[row] = time;
                        known.push((received, time));
                    }
                }
            }
        }
        known.retain(|(received, _)| received.is_finite());
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut delays: Vec<f64> = known
            .iter()
            .map(|(received, sent)| received - sent)
            .collect();
        if !delays.is_empty() {
            let late = delays.len() * 9 / 10;
            let late = *delays.select_nth_unstable_by(late, f64::total_cmp).1;
            latest = latest.max(if step.is_some() { 0.0 } else { late });
        }
        if let Some((at, by)) = step {
            let way = if by > 0.0 { "forward" } else { "back" };
            log.report.remark(format!(
                "the receiver's clock was set {way} by {:.1} s at {at:.0} s, while the vehicle's own went on: times are the \
                 vehicle's, on the clock that was the earlier",
                by.abs()
            ));
        }
        let is_timed = |place: &usize| timed.iter().any(|timed| timed.place == *place);
        for place in places.iter().filter(|place| !is_timed(place)) {
            for time in &mut log.topics[*place].times {
                let before = known.partition_point(|(received, _)| received <= time);
                let before = before.checked_sub(1).map(|before| known[before]);
                if let Some((_, sent)) = before.filter(|(received, _)| *time - received < TOGETHER)
                {
                    *time = sent;
                }
            }
        }
    }
    if latest > LATE {
        log.report.remark(format!(
            "the link delivered messages up to {latest:.1} s late (nine of ten less): times are those that messages carry, on the \
             receiver's clock; a message without a time has that of the one before it"
        ));
    }
}

/// The time of the vehicle, on the receiver's clock, at which the latter was set by less than links pause for, and by how much,
/// seconds: behind it every message is later than before, or prompter, and not only for a while.
fn step_of(most: &TimedTopic, received: &[f64]) -> Option<(f64, f64)> {
    let [(rows, start)] = most.starts.as_slice() else {
        return None;
    };
    let times = rows
        .clone()
        .map(|row| (start.time(most.sent[row]), received[row]));
    let times: Vec<(f64, f64)> = times
        .filter(|(sent, received)| (received - sent).is_finite())
        .collect();
    let delays: Vec<f64> = times
        .iter()
        .map(|(sent, received)| received - sent)
        .collect();
    let is_late = |delay: &f64| *delay > LATE;
    let first = delays.iter().position(is_late)?;
    let behind = delays.iter().rposition(is_late)? + 1;
    let (at, late, sign) = if behind == delays.len() {
        (first, first..behind, 1.0)
    } else if first == 0 {
        (behind, first..behind, -1.0)
    } else {
        return None;
    };
    let others = if sign > 0.0 {
        &times[..first]
    } else {
        &times[behind..]
    };
    let lasts = |part: &[(f64, f64)]| {
        let ends = part.first().zip(part.last());
        ends.is_some_and(|(first, last)| last.0 - first.0 >= STRETCH)
    };
    if !lasts(&times[late.clone()]) || !lasts(others) {
        return None;
    }
    let late = &delays[late];
    let least = late.iter().copied().fold(f64::INFINITY, f64::min);
    let most = late.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let is_step = least > LATE && most - least < LATE && late.len() >= ENOUGH;
    let is_known = delays.len() - late.len() >= ENOUGH;
    (is_step && is_known).then(|| (times[at].0, sign * least))
}

/// The start that holds at a moment of the receiver's clock.
fn at(starts: &[Start], received: f64) -> Option<&Start> {
    let after = starts.partition_point(|start| start.from <= received + SAME);
    starts.get(after.saturating_sub(1))
}

/// The times that the messages of a topic carry; `None` where they carry none that runs.
fn timed(place: usize, topic: &Topic) -> Option<TimedTopic> {
    let mut sent = stamps(topic)?;
    let starts = starts_of(&sent);
    let receptions = judge(&topic.times);
    let mut fitted: Vec<(Range<usize>, Start)> = Vec::new();
    for rows in starts {
        if let Some(verdicts) = judge(&sent[rows.clone()]) {
            for (row, verdict) in rows.clone().zip(verdicts) {
                if verdict == TimeVerdict::Wrong {
                    sent[row] = f64::NAN;
                }
            }
        }
        let is_received = |row: &usize| {
            receptions
                .as_ref()
                .is_none_or(|v| v[*row] != TimeVerdict::Wrong)
        };
        let pairs = rows
            .clone()
            .filter(is_received)
            .map(|row| (topic.times[row], sent[row]));
        let pairs: Vec<(f64, f64)> = pairs.filter(|(_, sent)| sent.is_finite()).collect();
        if let Some(start) = fit(&pairs) {
            fitted.push((rows, start));
        } else {
            sent[rows].fill(f64::NAN);
        }
    }
    (!fitted.is_empty()).then_some(TimedTopic {
        place,
        sent,
        starts: fitted,
    })
}

/// Seconds of the vehicle's clock at which the rows of a topic were sent; `None` where they carry none, or are too few.
pub(super) fn stamps(topic: &Topic) -> Option<Vec<f64>> {
    let (field, per_second) = STAMPS
        .iter()
        .find_map(|(name, per_second)| Some((topic.field(name)?, *per_second)))?;
    if topic.len() < ENOUGH {
        return None;
    }
    let rows = topic.rows.iter();
    Some(rows.map(|row| stamp(field, row) / per_second).collect())
}

/// The stored number of a stamp; NaN where it is zero, which stands for no time.
fn stamp(field: &FieldLayout, row: &[u8]) -> f64 {
    let number = field.bytes(row).and_then(|bytes| field.kind.number(bytes));
    number.filter(|number| *number > 0.0).unwrap_or(f64::NAN)
}

/// The clock that messages tell between two starts, from when each was received and sent. `None` of too few, or where
/// the time that they carry stands still.
fn fit(pairs: &[(f64, f64)]) -> Option<Start> {
    let (first, last) = (pairs.first()?, pairs.last()?);
    let span = last.1 - first.1;
    let is_running = span > 0.1 * (last.0 - first.0);
    if pairs.len() < ENOUGH || !is_running {
        return None;
    }
    let least = |pairs: &[(f64, f64)], drift: f64| {
        let mut offsets: Vec<f64> = pairs.iter().map(|(r, s)| r - s - drift * s).collect();
        // One of a hundred may be wrong.
        let rank = offsets.len() / 100;
        *offsets.select_nth_unstable_by(rank, f64::total_cmp).1
    };
    let quarter = pairs.len() / 4;
    let drift = if span > DRIFT_FROM && quarter > ENOUGH {
        let (early, late) = (&pairs[..quarter], &pairs[pairs.len() - quarter..]);
        let middle = |part: &[(f64, f64)]| 0.5 * (part[0].1 + part[part.len() - 1].1);
        let drift = (least(late, 0.0) - least(early, 0.0)) / (middle(late) - middle(early));
        if drift.abs() < FASTEST_DRIFT {
            drift
        } else {
            0.0
        }
    } else {
        0.0
    };
    let start = Start {
        from: first.0,
        offset: least(pairs, drift),
        drift,
    };
    let mut delays: Vec<f64> = pairs.iter().map(|(r, s)| r - start.time(*s)).collect();
    let rank = delays.len() * 9 / 10;
    let late = *delays.select_nth_unstable_by(rank, f64::total_cmp).1;
    (late < LATEST).then_some(start)
}

#[cfg(test)]
mod tests {
    use super::super::super::{FieldKind, LogFormat, TopicName};
    use super::*;

    /// A topic of times received and stamps in milliseconds.
    fn add(log: &mut Log, name: &str, rows: &[(f64, u32)]) {
        let name = TopicName {
            name: name.to_owned(),
            instance: Some(1),
        };
        let fields = || vec![FieldLayout::plain("time_boot_ms", FieldKind::U32, 0)];
        let place = log.topic_or_new(&name, fields);
        for (received, stamp) in rows {
            log.topics[place].push(*received, &stamp.to_le_bytes());
        }
    }

    fn log() -> Log {
        Log::new("a.tlog", LogFormat::Tlog)
    }

    fn steps(log: &Log, name: &str) -> (f64, f64) {
        let times = &log.first(name).unwrap().times;
        let steps = times.windows(2).map(|w| w[1] - w[0]);
        steps.fold((f64::INFINITY, 0.0), |(a, b), step| {
            (a.min(step), step.max(b))
        })
    }

    #[test]
    fn a_link_that_delivers_in_bursts_leaves_regular_times() {
        let row = |i: u32| {
            let sent = 0.2 * f64::from(i);
            (
                (sent / 2.0).ceil() * 2.0 + 1e-6 * f64::from(i),
                5000 + 200 * i,
            )
        };
        let rows: Vec<_> = (0..300).map(row).collect();
        let mut log = log();
        add(&mut log, "ATTITUDE", &rows);
        count_by_messages(&mut log);
        let (least, most) = steps(&log, "ATTITUDE");
        assert!((least - 0.2).abs() < 1e-9 && (most - 0.2).abs() < 1e-9);
        assert!(log.first("ATTITUDE").unwrap().times[0].abs() < 1e-3);
        assert!(
            log.report.remarks[0].contains("late"),
            "{:?}",
            log.report.remarks
        );
    }

    #[test]
    fn a_clock_that_starts_again_goes_on_where_it_was_received() {
        let stamp = |i: u32| {
            if i < 100 {
                60_000 + 200 * i
            } else {
                1000 + 200 * (i - 100)
            }
        };
        let rows: Vec<_> = (0..250).map(|i| (0.2 * f64::from(i), stamp(i))).collect();
        let mut log = log();
        add(&mut log, "ATTITUDE", &rows);
        count_by_messages(&mut log);
        let (least, most) = steps(&log, "ATTITUDE");
        assert!(
            (least - 0.2).abs() < 1e-9 && (most - 0.2).abs() < 1e-9,
            "{least} {most}"
        );
    }

    #[test]
    fn a_drifting_clock_is_followed_and_one_wrong_stamp_takes_only_its_own() {
        let rows: Vec<_> = (0..10_000_u32)
            .map(|i| {
                (
                    0.2 * f64::from(i) * (1.0 + 5e-5) + 0.05 * f64::from(i % 7),
                    200 * i + 1,
                )
            })
            .collect();
        let mut wrong = rows.clone();
        wrong[5000].1 |= 1 << 30;
        let mut log = log();
        add(&mut log, "ATTITUDE", &wrong);
        count_by_messages(&mut log);
        let times = &log.first("ATTITUDE").unwrap().times;
        for (i, time) in times.iter().enumerate().filter(|(i, _)| *i != 5000) {
            assert!(
                (time - 0.2 * i as f64 * (1.0 + 5e-5)).abs() < 0.05,
                "{i} {time}"
            );
        }
        assert_eq!(times[5000], rows[5000].0);
    }

    #[test]
    fn stamps_that_are_no_clock_leave_the_receivers_times() {
        let stamp = |i: u32| i.wrapping_mul(2_654_435_761) >> 3;
        let rows: Vec<_> = (0..50)
            .map(|i| (0.2 * f64::from(i), stamp(i + 1)))
            .collect();
        let mut log = log();
        add(&mut log, "ATTITUDE", &rows);
        count_by_messages(&mut log);
        let times = &log.first("ATTITUDE").unwrap().times;
        assert!(times.iter().zip(&rows).all(|(a, b)| *a == b.0));
    }

    #[test]
    fn stamps_that_are_never_set_leave_the_receivers_times() {
        let rows: Vec<_> = (0..50).map(|i| (0.2 * f64::from(i), 0)).collect();
        let mut log = log();
        add(&mut log, "ATTITUDE", &rows);
        count_by_messages(&mut log);
        let times = &log.first("ATTITUDE").unwrap().times;
        assert!(times.iter().zip(&rows).all(|(a, b)| *a == b.0));
    }
}
