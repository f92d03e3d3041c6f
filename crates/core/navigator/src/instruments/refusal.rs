//! Measurements that were refused, and why.

use serde::{Deserialize, Serialize};

use pilotage_flight::{Finding, Severity, moment};

/// Longest pause between two refusals of one stretch, seconds …
const LONGEST_PAUSE: f64 = 2.0;
/// … unless measurements are rarer: so many of their mean intervals.
const INTERVALS: f64 = 5.0;

/// Kind of measurement that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RefusedKind {
    /// A position by satellite navigation.
    Position,
    /// A velocity by satellite navigation.
    Velocity,
    /// A position from elsewhere: a landmark.
    Fix,
}

impl RefusedKind {
    fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Position => ("GPS position", "m"),
            Self::Velocity => ("GPS velocity", "m/s"),
            Self::Fix => ("Position fix", "m"),
        }
    }
}

/// A stretch in which measurements of one kind were refused.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RefusedStretch {
    /// Kind of the refused measurements.
    pub source: RefusedKind,
    /// First and last refusal, seconds.
    pub span: (f64, f64),
    /// Number of refused measurements.
    pub count: usize,
    /// Largest distance from where it was expected, m or m/s.
    pub largest: f64,
    /// Whether they were believed in the end, because they did not cease.
    pub believed: bool,
}

impl RefusedStretch {
    /// In words.
    pub fn finding(&self) -> Finding {
        let (what, unit) = self.source.label();
        let (from, to) = self.span;
        let end = if self.believed {
            " They did not cease, and were believed in the end with as much doubt as they cast."
        } else {
            ""
        };
        Finding {
            severity: Severity::Warning,
            title: format!("{what} refused"),
            text: format!(
                "{} between {} and {}, up to {:.1} {unit} from where airspeed, heading and wind put it, which is more \
                 than the doubt about them allows.{end}",
                match self.count {
                    1 => "One measurement".to_owned(),
                    n => format!("{n} measurements"),
                },
                moment(from),
                moment(to),
                self.largest
            ),
            span: Some(self.span),
        }
    }
}

/// Findings, one for each source, however many stretches it was refused in: they have one cause. Told is the
/// worst.
pub(super) fn findings(all: &[RefusedStretch]) -> Vec<Finding> {
    let sources = [
        RefusedKind::Position,
        RefusedKind::Velocity,
        RefusedKind::Fix,
    ];
    let of_source = |source| {
        let stretches = all.iter().filter(|r| r.source == source);
        let count = stretches.clone().count();
        let worst = stretches.max_by(|a, b| a.largest.total_cmp(&b.largest))?;
        let mut finding = worst.finding();
        if count > 1 {
            let text = finding.text;
            finding.text = format!("{text} It was so in {count} stretches; this was the worst.");
        }
        Some(finding)
    };
    sources.into_iter().filter_map(of_source).collect()
}

/// Times of the measurements of one source, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct SourceTimes {
    /// The first and the latest.
    span: Option<(f64, f64)>,
    /// Intervals between all of them.
    intervals: u32,
    /// Since when they have been refused without a break.
    refused: Option<f64>,
}

impl SourceTimes {
    /// Notes a measurement at `time`; whether it follows the one before without a pause.
    fn note(&mut self, time: f64) -> bool {
        let Some((first, latest)) = self.span else {
            self.span = Some((time, time));
            return true;
        };
        let usual = (latest - first) / f64::from(self.intervals.max(1));
        self.span = Some((first, time));
        self.intervals += 1;
        time - latest <= LONGEST_PAUSE.max(INTERVALS * usual)
    }
}

/// Refusals of a run, put together by stretch.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Refusals {
    all: Vec<RefusedStretch>,
    /// Measurements of each source.
    times: [SourceTimes; 3],
}

impl Refusals {
    /// The stretches so far, in the order of their first refusals.
    pub(super) fn all(&self) -> &[RefusedStretch] {
        &self.all
    }

    /// Notes that a measurement was taken in.
    pub(super) fn accept(&mut self, source: RefusedKind, time: f64) {
        let times = &mut self.times[source as usize];
        times.note(time);
        times.refused = None;
    }

    /// Notes a refusal; for how many seconds they have gone on.
    ///
    /// A receiver that comes back after a pause may be wrong in another way, and has to insist anew. Landmarks come in
    /// passes: the next one refused is another witness, whenever it is met.
    pub(super) fn refuse(&mut self, source: RefusedKind, time: f64, distance: f64) -> f64 {
        let times = &mut self.times[source as usize];
        let goes_on = times.note(time) || source == RefusedKind::Fix;
        let since = times.refused.filter(|_| goes_on).unwrap_or(time);
        times.refused = Some(since);
        let open = self.all.iter_mut().rev().find(|r| r.source == source);
        match open {
            Some(refusal) if time - refusal.span.1 <= LONGEST_PAUSE => {
                refusal.span.1 = time;
                refusal.count += 1;
                refusal.largest = refusal.largest.max(distance);
            }
            _ => self.all.push(RefusedStretch {
                source,
                span: (time, time),
                count: 1,
                largest: distance,
                believed: false,
            }),
        }
        time - since
    }

    /// Notes that the refused ones are believed from now on.
    pub(super) fn believe(&mut self, source: RefusedKind) {
        self.times[source as usize].refused = None;
        if let Some(refusal) = self.all.iter_mut().rev().find(|r| r.source == source) {
            refusal.believed = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_receiver_that_comes_back_after_a_pause_has_to_insist_anew() {
        let mut refusals = Refusals::default();
        assert_eq!(refusals.refuse(RefusedKind::Position, 1.0, 50.0), 0.0);
        assert_eq!(refusals.refuse(RefusedKind::Position, 41.0, 150.0), 0.0);
        assert_eq!(refusals.refuse(RefusedKind::Position, 42.0, 150.0), 1.0);
        // One that measures every five seconds does not pause by that.
        let mut slow = Refusals::default();
        for k in 0..10 {
            slow.accept(RefusedKind::Position, 5.0 * f64::from(k));
        }
        assert_eq!(slow.refuse(RefusedKind::Position, 50.0, 50.0), 0.0);
        assert_eq!(slow.refuse(RefusedKind::Position, 55.0, 50.0), 5.0);
        assert_eq!(slow.refuse(RefusedKind::Position, 95.0, 50.0), 0.0);
        // A landmark that is refused a minute after another is another witness.
        let mut fixes = Refusals::default();
        fixes.refuse(RefusedKind::Fix, 1.0, 50.0);
        assert_eq!(fixes.refuse(RefusedKind::Fix, 61.0, 50.0), 60.0);
    }

    #[test]
    fn velocities_refused_in_many_stretches_are_one_note() {
        let mut refusals = Refusals::default();
        for (time, distance) in [(1.0, 4.0), (10.0, 9.0), (20.0, 5.0)] {
            refusals.refuse(RefusedKind::Velocity, time, distance);
        }
        let found = findings(refusals.all());
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].span, Some((10.0, 10.0)));
        assert!(
            found[0]
                .text
                .ends_with("in 3 stretches; this was the worst.")
        );
    }
}
