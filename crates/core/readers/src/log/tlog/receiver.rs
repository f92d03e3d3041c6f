//! Leaps of the receiver's clock: it was set, or summer time began or ended, while the vehicle's own went on.

use super::super::Log;
use super::clock::{ENOUGH, stamps};
use crate::times::starts_of;

/// Two messages received further apart may have a leap between them, seconds: links pause for less, and what is set by
/// less is within the delays of a link.
const LEAP: f64 = 20.0;
/// Most places that are looked at, and most topics that are asked at each.
const MOST_LEAPS: usize = 200;
const MOST_TOPICS: usize = 16;
/// Rows of a topic among which wrong times of single messages are the fewer, as far as they are enough.
const MAJORITY: usize = 4 * ENOUGH;
/// Beyond a day the clock was not set before, seconds.
const DAY: f64 = 86_400.0;

/// Contents of a log when its receiver's clock may have leapt.
struct PossibleLeap {
    /// Rows of each topic.
    rows: Vec<usize>,
    messages: usize,
    modes: usize,
    parameters: usize,
}

impl PossibleLeap {
    fn rows(&self, topic: usize) -> usize {
        self.rows.get(topic).copied().unwrap_or(0)
    }
}

/// Places of a file between whose messages the receiver's clock may have leapt.
#[derive(Default)]
pub(super) struct ReceiverLeaps {
    places: Vec<PossibleLeap>,
}

impl ReceiverLeaps {
    /// Takes note of a message that was received so many seconds after the one before it.
    pub fn note(&mut self, step: f64, log: &Log) {
        if step.abs() > LEAP && self.places.len() < MOST_LEAPS {
            self.places.push(PossibleLeap {
                rows: log.topics.iter().map(|topic| topic.times.len()).collect(),
                messages: log.messages.len(),
                modes: log.modes.len(),
                parameters: log.parameters.len(),
            });
        }
    }

    /// Takes the leaps out of all times behind them, where the vehicle's own clock went on, and says so. The date is that
    /// before the leap, but where it was off by more than a day. `first` is the time of second zero, since 1970.
    pub fn straighten(&self, first: f64, log: &mut Log) {
        let leaps = self.leaps(log);
        let mut unset = 0.0;
        for (place, leap) in self.places.iter().zip(&leaps) {
            let Some(leap) = leap.filter(|leap| *leap != 0.0) else {
                continue;
            };
            let rows: Vec<usize> = (0..log.topics.len()).map(|t| place.rows(t)).collect();
            let mut at = f64::NEG_INFINITY;
            for (topic, rows) in log.topics.iter_mut().zip(rows) {
                if let Some(before) = rows.checked_sub(1) {
                    at = at.max(topic.times[before]);
                }
                topic.times[rows..].iter_mut().for_each(|t| *t -= leap);
            }
            log.messages[place.messages..]
                .iter_mut()
                .for_each(|message| message.time -= leap);
            log.modes[place.modes..]
                .iter_mut()
                .for_each(|mode| mode.time -= leap);
            log.parameters[place.parameters..]
                .iter_mut()
                .for_each(|parameter| parameter.time -= leap);
            if leap.abs() > DAY {
                unset += leap;
            }
            let way = if leap > 0.0 { "forward" } else { "back" };
            log.report.remark(format!(
                "the receiver's clock was set {way} by {:.0} s at {at:.0} s, while the vehicle's own went on: times go on by \
                 the vehicle's",
                leap.abs()
            ));
        }
        if unset != 0.0 {
            log.utc_at_zero = Some(first + unset);
        }
    }

    /// Seconds by which the receiver's clock leapt at each place; `None` where no topic tells.
    fn leaps(&self, log: &Log) -> Vec<Option<f64>> {
        let mut leaps: Vec<Option<f64>> = vec![None; self.places.len()];
        if leaps.is_empty() {
            return leaps;
        }
        let mut timed: Vec<(usize, Vec<f64>)> = log
            .topics
            .iter()
            .enumerate()
            .filter_map(|(place, topic)| Some((place, stamps(topic)?)))
            .collect();
        timed.sort_by_key(|(_, sent)| std::cmp::Reverse(sent.len()));
        for (topic, sent) in timed.iter().take(MOST_TOPICS) {
            let received = &log.topics[*topic].times;
            let starts = starts_of(sent);
            // Rows from which on the clock is that before the next leap.
            let mut begin = 0;
            for (number, leap) in leaps.iter_mut().enumerate() {
                let row = self.places[number].rows(*topic);
                let next = self.places.get(number + 1);
                let next = next.map_or(sent.len(), |next| next.rows(*topic));
                let Some(start) = starts.iter().find(|start| start.contains(&row)) else {
                    continue;
                };
                let offset = |rows: std::ops::Range<usize>| least_offset(received, sent, rows);
                let before = offset(begin.max(start.start)..row);
                // Between wrong times of single messages lie few: more tell.
                let after = offset(row..next.min(start.end))
                    .or_else(|| offset(row..(row + MAJORITY).min(start.end)));
                if let Some((before, after)) = before.zip(after) {
                    let by = after - before;
                    let is_leap = by.abs() > LEAP && goes_on(sent, row);
                    leap.get_or_insert(if is_leap { by } else { 0.0 });
                    if is_leap {
                        begin = row;
                    }
                }
            }
            if leaps.iter().all(Option::is_some) {
                break;
            }
        }
        leaps
    }
}

/// Whether the vehicle's clock goes on at a row: it was neither started again nor pauses there.
fn goes_on(sent: &[f64], row: usize) -> bool {
    let middle = |rows: &[f64]| {
        let mut times: Vec<f64> = rows.iter().copied().filter(|t| t.is_finite()).collect();
        let rank = times.len() / 2;
        (!times.is_empty()).then(|| *times.select_nth_unstable_by(rank, f64::total_cmp).1)
    };
    let before = middle(&sent[row.saturating_sub(ENOUGH)..row]);
    let after = middle(&sent[row..(row + ENOUGH).min(sent.len())]);
    before
        .zip(after)
        .is_some_and(|(before, after)| (0.0..LEAP).contains(&(after - before)))
}

/// The offset between both clocks that the promptest messages among rows tell, about one of ten aside; `None` of too few.
///
/// Times of the receiver are behind no checksum: an offset that few others tell is that of a wrong time.
fn least_offset(received: &[f64], sent: &[f64], rows: std::ops::Range<usize>) -> Option<f64> {
    let rows = rows.start..rows.end.max(rows.start);
    let mut offsets: Vec<f64> = rows
        .map(|row| received[row] - sent[row])
        .filter(|offset| offset.is_finite())
        .collect();
    offsets.sort_unstable_by(f64::total_cmp);
    let tenth = offsets.len() / 10;
    let agreed = offsets
        .windows(ENOUGH.max(tenth + 1))
        .find(|some| some[some.len() - 1] - some[0] <= LEAP)?;
    Some(agreed[tenth])
}
