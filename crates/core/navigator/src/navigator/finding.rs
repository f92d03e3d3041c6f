//! Findings of a run on what it doubted of its flight, in words.

use std::mem::discriminant;

use super::{Doubt, Run};
use pilotage_flight::{Finding, Severity, moment};

impl Run {
    /// Findings on what the navigator did not believe in any of the steps: once for each instrument and
    /// reason, as it was last said, from when it was doubted first.
    pub fn findings(&self) -> Vec<Finding> {
        let doubts = |step: &super::StepReport| {
            let time = step.time;
            let doubts = step.doubts.clone();
            doubts.into_iter().map(move |doubt| (time, doubt))
        };
        findings(self.steps.iter().flat_map(doubts))
    }
}

/// The same for doubts with the times of their steps, seconds.
fn findings(doubts: impl Iterator<Item = (f64, Doubt)>) -> Vec<Finding> {
    let mut last: Vec<(Doubt, f64, f64)> = Vec::new();
    for (time, doubt) in doubts {
        let is_same = |(known, ..): &&mut (Doubt, f64, f64)| {
            known.instrument == doubt.instrument
                && discriminant(&known.why) == discriminant(&doubt.why)
        };
        if let Some((known, _, until)) = last.iter_mut().find(is_same) {
            (*known, *until) = (doubt, time);
        } else {
            last.push((doubt, doubt.since, time));
        }
    }
    let finding = |(doubt, from, until): (Doubt, f64, f64)| Finding {
        severity: Severity::Warning,
        title: format!("In flight: {}", doubt.words()),
        text: format!(
            "The navigator allowed for it from {} to {}.",
            moment(from),
            moment(until)
        ),
        span: Some((from, until)),
    };
    last.into_iter().map(finding).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Instrument, SensorFault};
    use super::*;

    #[test]
    fn what_is_doubted_for_long_is_told_once_as_it_was_said_last() {
        let late = |by| Doubt {
            instrument: Instrument::Camera,
            why: SensorFault::Late { by },
            since: 8.5,
        };
        let open = Doubt {
            why: SensorFault::MayBeLate,
            since: 8.0,
            ..late(0.0)
        };
        let found = findings([(8.0, open), (9.0, late(0.7)), (12.0, late(1.0))].into_iter());
        assert_eq!(found.len(), 2);
        assert!(found[1].title.contains("1.0 s late"), "{}", found[1].title);
        assert_eq!(found[1].span, Some((8.5, 12.0)));
        assert!(findings(std::iter::empty()).is_empty());
    }
}
