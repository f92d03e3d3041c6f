//! Rows and words whose time cannot be, left out of a log that is over.

use super::{Log, Topic};
use crate::times::{TimeVerdict, judge, most_told_era};

/// Topics of fewer rows do not tell when the log was written.
const ENOUGH: usize = 20;
/// Seconds beyond the other topics that a row may lie; and as long as all of them together last.
const BEYOND: f64 = 60.0;
/// Most topics that are named.
const NAMED: usize = 5;

/// Second zero of a log's time base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SecondZero {
    /// That of a clock, such as the autopilot's since it started.
    OfClock,
    /// The time of the first row, which sets it wrongly if its own is wrong.
    OfFirstRow,
}

impl Log {
    /// Leaves out rows whose time lies far from those around it, and says so. Where a topic's rows have no time of
    /// their own (`is_timed`, by its place), a wrong one is that of the row before, and is moved to the log's nearest end.
    ///
    /// Words, modes and parameters keep their place in the order, at the log's nearest end. Where the first row set
    /// second zero (`zero`) wrongly, times count from the first that is left.
    pub(super) fn leave_out_wrong_times(
        &mut self,
        zero: SecondZero,
        is_timed: impl Fn(usize) -> bool,
    ) {
        let rows = self.topics.iter().flat_map(|topic| &topic.times);
        let era = most_told_era(rows.copied());
        let in_era = |time: f64| era.is_none_or(|(a, b)| (a..=b).contains(&time));
        let mut left_out = Vec::new();
        for topic in self.timed_topics(&is_timed) {
            left_out.extend(topic.retain_times(in_era));
            if topic.len() >= ENOUGH {
                left_out.extend(topic.retain_sound());
            }
        }
        // What many rows tell judges the few.
        let Some((first, last)) = self.bulk(&is_timed) else {
            return;
        };
        let margin = BEYOND.max(last - first);
        // A log whose header says when it began may hold what was measured since the autopilot started, but at no time 0.
        let earliest = match self.begins {
            Some(_) if first > 1.0 => f64::MIN_POSITIVE,
            _ => first - margin,
        };
        let is_near = |time: f64| time >= earliest && time <= last + margin;
        for (place, topic) in self.topics.iter_mut().enumerate() {
            if !is_timed(place) {
                continue;
            }
            left_out.extend(topic.retain_times(is_near));
            if topic.len() < ENOUGH {
                left_out.extend(topic.retain_sound());
            }
        }
        // Rows without times of their own stand among the others.
        if let Some(span) = self.span_of(1, &is_timed) {
            let others = self.topics.iter_mut().enumerate();
            for (_, topic) in others.filter(|(place, _)| !is_timed(*place)) {
                move_near(topic.times.iter_mut(), span, 0.0);
            }
        }
        let Some((first, last)) = self.bulk(&is_timed) else {
            return;
        };
        let margin = BEYOND.max(last - first);
        let parameters = self.parameters.iter_mut().map(|p| &mut p.time);
        let messages = self.messages.iter_mut().map(|m| &mut m.time);
        move_near(parameters.chain(messages), (first, last), margin);
        move_near(
            self.modes.iter_mut().map(|m| &mut m.time),
            (first, last),
            margin,
        );
        self.begins = self
            .begins
            .filter(|begins| (first - begins).abs() <= margin);
        if !left_out.is_empty() {
            self.report.remark(words(&left_out));
        }
        if zero == SecondZero::OfFirstRow && first.abs() > margin {
            self.count_from(first);
        }
    }

    /// The topics whose rows have times of their own.
    fn timed_topics(
        &mut self,
        is_timed: &impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = &mut Topic> {
        let topics = self.topics.iter_mut().enumerate();
        let timed = topics.filter(|(place, _)| is_timed(*place));
        timed.map(|(_, topic)| topic)
    }

    /// First and last time of the topics with many rows, or of all if none has; seconds.
    fn bulk(&self, is_timed: &impl Fn(usize) -> bool) -> Option<(f64, f64)> {
        let many = self.span_of(ENOUGH, is_timed);
        many.or_else(|| self.span_of(1, is_timed))
    }

    /// First and last time of the topics with so many rows at least, seconds.
    fn span_of(&self, least: usize, is_timed: &impl Fn(usize) -> bool) -> Option<(f64, f64)> {
        let topics = self.topics.iter().enumerate();
        let topics = topics.filter(|(place, topic)| is_timed(*place) && topic.len() >= least);
        let times = topics.flat_map(|(_, topic)| &topic.times);
        let finite = times.copied().filter(|time| time.is_finite());
        finite.fold(None, |span: Option<(f64, f64)>, time| {
            let (first, last) = span.unwrap_or((time, time));
            Some((first.min(time), last.max(time)))
        })
    }

    /// Makes the second `zero` of the log's time base its second 0.
    fn count_from(&mut self, zero: f64) {
        for time in self.topics.iter_mut().flat_map(|topic| &mut topic.times) {
            *time -= zero;
        }
        let parameters = self.parameters.iter_mut().map(|p| &mut p.time);
        let messages = self.messages.iter_mut().map(|m| &mut m.time);
        let modes = self.modes.iter_mut().map(|m| &mut m.time);
        for time in parameters.chain(messages).chain(modes) {
            *time -= zero;
        }
        if let Some(utc) = &mut self.utc_at_zero {
            *utc += zero;
        }
    }
}

impl Topic {
    /// Keeps only rows whose time is to be kept.
    fn retain_times(&mut self, is_kept: impl Fn(f64) -> bool) -> Option<(String, usize, f64)> {
        if self.times.iter().all(|time| is_kept(*time)) {
            return None;
        }
        let kept: Vec<bool> = self.times.iter().map(|time| is_kept(*time)).collect();
        self.retain_rows(&kept)
    }

    /// Keeps only rows whose time is not wrong.
    fn retain_sound(&mut self) -> Option<(String, usize, f64)> {
        let verdicts = judge(&self.times)?;
        let kept: Vec<bool> = verdicts
            .into_iter()
            .map(|v| v != TimeVerdict::Wrong)
            .collect();
        self.retain_rows(&kept)
    }

    /// Keeps only rows that are to be kept. Name, number and first time of the others, if there are any.
    fn retain_rows(&mut self, kept: &[bool]) -> Option<(String, usize, f64)> {
        let first = kept.iter().position(|kept| !kept)?;
        let (first, count) = (
            self.times[first],
            kept.iter().filter(|kept| !**kept).count(),
        );
        let mut rows = super::Rows::new(self.rows.width());
        for (row, _) in self.rows.iter().zip(kept).filter(|(_, kept)| **kept) {
            rows.push(row);
        }
        self.rows = rows;
        let mut is_kept = kept.iter().copied();
        self.times.retain(|_| is_kept.next().unwrap_or(true));
        Some((self.name.to_string(), count, first))
    }
}

/// Moves times that are far off to the nearest end.
fn move_near<'a>(times: impl Iterator<Item = &'a mut f64>, (first, last): (f64, f64), margin: f64) {
    for time in times {
        if time.is_nan() || *time < first - margin {
            *time = first;
        } else if *time > last + margin {
            *time = last;
        }
    }
}

/// Sentence about the rows that were left out.
fn words(left_out: &[(String, usize, f64)]) -> String {
    let total: usize = left_out.iter().map(|(_, count, _)| count).sum();
    let topics = left_out.iter().take(NAMED);
    let topics: Vec<String> = topics
        .map(|(name, count, time)| format!("{name} {count} (at {time:.1} s)"))
        .collect();
    let more = left_out.len().saturating_sub(NAMED);
    let more = if more > 0 {
        format!(" and of {more} more topics")
    } else {
        String::new()
    };
    let (rows, have) = if total == 1 {
        ("row was", "its time lies")
    } else {
        ("rows were", "their times lie")
    };
    format!(
        "{total} {rows} left out, as {have} far from those around: {}{more}",
        topics.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::super::{FieldKind, FieldLayout, LogFormat, LogMessage, TopicName};
    use super::*;

    fn log(topics: &[(&str, Vec<f64>)]) -> Log {
        let mut log = Log::new("a.bin", LogFormat::Dataflash);
        for (name, times) in topics {
            let fields = || vec![FieldLayout::plain("Alt", FieldKind::U8, 0)];
            let place = log.topic_or_new(&TopicName::single(*name), fields);
            for (i, time) in times.iter().enumerate() {
                log.topics[place].push(*time, &[i as u8]);
            }
        }
        log
    }

    fn regular(from: f64, count: usize) -> Vec<f64> {
        (0..count).map(|i| from + 0.1 * i as f64).collect()
    }

    #[test]
    fn a_row_far_off_is_left_out_with_its_values_and_told() {
        let mut times = regular(50.0, 100);
        times[40] = 9e12;
        let mut log = log(&[("GPS", times)]);
        log.leave_out_wrong_times(SecondZero::OfClock, |_| true);
        let topic = log.first("GPS").unwrap();
        assert_eq!(topic.len(), 99);
        let values = topic.values("Alt").unwrap();
        assert_eq!((values[39], values[40]), (39.0, 41.0));
        assert!((log.span().unwrap().1 - 59.9).abs() < 1e-9);
        assert_eq!(
            log.report.remarks,
            [
                "1 row was left out, as its time lies far from those around: GPS 1 (at 9000000000000.0 s)"
            ]
        );
    }

    #[test]
    fn a_topic_told_once_before_there_was_a_clock_makes_no_span() {
        let mut log = log(&[
            ("parameter_update", vec![0.0]),
            ("att", regular(1.7e9, 300)),
        ]);
        log.leave_out_wrong_times(SecondZero::OfClock, |_| true);
        let (first, last) = log.span().unwrap();
        assert!(first == 1.7e9 && (last - first - 29.9).abs() < 1e-6);
        assert!(log.first("parameter_update").unwrap().is_empty());
    }

    #[test]
    fn rows_without_times_of_their_own_and_words_are_moved_and_not_lost() {
        let mut log = log(&[("FMT", vec![9e12; 3]), ("ATT", regular(1.0, 100))]);
        log.messages.push(LogMessage {
            time: 9e12,
            source: None,
            severity: None,
            text: "Throttle armed".to_owned(),
        });
        log.leave_out_wrong_times(SecondZero::OfClock, |place| place == 1);
        assert_eq!(log.first("FMT").unwrap().times, [1.0 + 9.9; 3]);
        assert!(log.messages[0].time < 11.0 && log.report.remarks.is_empty());
    }

    #[test]
    fn a_first_row_far_off_does_not_set_second_zero() {
        let mut times = regular(-1.7e9, 100);
        times[0] = 0.0;
        let mut log = log(&[("HEARTBEAT", times)]);
        log.utc_at_zero = Some(3.4e9);
        log.leave_out_wrong_times(SecondZero::OfFirstRow, |_| true);
        assert_eq!(log.span().map(|(first, _)| first), Some(0.0));
        assert!((log.utc_at_zero.unwrap() - 1.7e9).abs() < 1.0);
    }

    #[test]
    fn the_log_of_a_reboot_keeps_both_starts() {
        let mut times = regular(0.0, 100);
        times.extend(regular(0.0, 300));
        let mut log = log(&[("ATT", times)]);
        log.leave_out_wrong_times(SecondZero::OfClock, |_| true);
        assert_eq!(log.first("ATT").map(Topic::len), Some(400));
        assert!(log.report.remarks.is_empty());
    }
}
