//! The threshold for a stated number of false alarms, and what is found there.

use serde::{Deserialize, Serialize};

use super::draws::{DayDraws, by_day};
use super::events::{Counts, MarkEvents};
use super::rate::correlation_within;
use super::{EvaluatedLook, IntervalEstimate, Rate};

/// Counts (happened, of) by day.
type DayCounts = Vec<(usize, usize)>;

/// Detections and false alarms at one threshold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AtThreshold {
    /// Looks with the landmark in which it was found.
    pub found: Rate,
    /// Looks with a false alarm.
    pub deceived: Rate,
    /// False alarms per look.
    pub false_alarms: f64,
}

/// The threshold at which a detector is used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OperatingPoint {
    /// False alarms per look that were allowed.
    pub allowed: f64,
    /// Marks of at least this score are accepted.
    pub threshold: f64,
    /// Share of the looks with the landmark in which it is found, over other days, where the threshold
    /// would have been chosen otherwise.
    pub detection: IntervalEstimate,
    /// Result at the threshold in the looks from which it was chosen.
    pub here: AtThreshold,
    /// Result on each day at the threshold that was chosen from the others; `None` with one day.
    pub held_out: Option<AtThreshold>,
}

impl OperatingPoint {
    pub(super) fn of(
        looks: &[EvaluatedLook],
        events: &MarkEvents,
        allowed: f64,
        draws: &mut DayDraws,
        replicates: usize,
    ) -> Self {
        let weights = events.equal_weights();
        let (threshold, counts) = choose(events, &weights, allowed);
        let share =
            |counts: &Counts, weights: &[f64]| counts.found / events.totals(weights).present;
        let mut drawn = Vec::new();
        for _ in 0..replicates {
            let weights = draws.next_weights();
            let (_, counts) = choose(events, &weights, allowed);
            drawn.push(share(&counts, &weights));
        }
        // Without the landmark in any of its looks a draw says nothing.
        drawn.retain(|share| share.is_finite());
        let value = share(&counts, &weights);
        let tries = events.totals(&weights).present;
        let (low, high) = draws.interval(&mut drawn, value, tries);
        let days = by_day(looks);
        Self {
            allowed,
            threshold,
            detection: IntervalEstimate { value, low, high },
            here: AtThreshold::over(looks, threshold),
            held_out: (days.len() > 1).then(|| {
                let elsewhere = days.iter().map(|(_, day)| {
                    let mut weights = weights.clone();
                    for &look in day {
                        weights[look] = 0.0;
                    }
                    (day.as_slice(), choose(events, &weights, allowed).0)
                });
                AtThreshold::of(looks, elsewhere)
            }),
        }
    }
}

impl AtThreshold {
    /// Result in `looks` at a threshold that was not chosen from them.
    ///
    /// ```
    /// # use pilotage_training::evaluation::{EvaluatedLook, EvaluatedMark};
    /// use pilotage_training::evaluation::AtThreshold;
    /// # let look = |score: f64, right| EvaluatedLook {
    /// #     present: right,
    /// #     marks: vec![EvaluatedMark { score, right, offset: [0.0; 2], rotation: 0.0, log_scale: 0.0 }],
    /// #     day: 0, height: 100.0, tilt: 0.0, heading_error: 0.0, log_scale: 0.0, real: false,
    /// # };
    ///
    /// let looks = [look(3.0, true), look(2.0, false), look(1.0, true), look(0.5, false)];
    /// let at = AtThreshold::over(&looks, 1.5);
    /// assert_eq!((at.found.happened, at.found.of), (1, 2));
    /// assert_eq!(at.false_alarms, 0.25); // one in four looks
    /// ```
    pub fn over(looks: &[EvaluatedLook], threshold: f64) -> Self {
        let days = by_day(looks);
        Self::of(
            looks,
            days.iter().map(|(_, day)| (day.as_slice(), threshold)),
        )
    }

    /// Result in the real frames among `looks`. Frames of one day go together as looks of a day do over all `looks`: one
    /// day by itself does not tell how much days differ.
    pub fn over_real(looks: &[EvaluatedLook], threshold: f64) -> Self {
        let correlations = Self::by_day(looks, threshold).map(|days| correlation_within(&days));
        let real: Vec<_> = looks.iter().filter(|look| look.real).cloned().collect();
        let [found, deceived] = Self::by_day(&real, threshold);
        Self {
            found: Rate::clustered(&found, correlations[0]),
            deceived: Rate::clustered(&deceived, correlations[1]),
            ..Self::over(&real, threshold)
        }
    }

    /// Counts (happened, of) by day of looks with the landmark in which it was found, and of looks with a false alarm.
    fn by_day(looks: &[EvaluatedLook], threshold: f64) -> [DayCounts; 2] {
        let days = by_day(looks);
        let days = days.iter().map(|(_, day)| (day.as_slice(), threshold));
        let (found, deceived, _) = Self::counts(looks, days);
        [found, deceived]
    }

    /// Of looks by day, each day with its threshold.
    fn of<'a>(looks: &[EvaluatedLook], days: impl Iterator<Item = (&'a [usize], f64)>) -> Self {
        let (found, deceived, wrong) = Self::counts(looks, days);
        let rate = |days: &[(usize, usize)]| Rate::clustered(days, correlation_within(days));
        Self {
            found: rate(&found),
            deceived: rate(&deceived),
            false_alarms: wrong as f64 / looks.len().max(1) as f64,
        }
    }

    /// Counts of what was found and of looks with false alarms by day, and the number of false alarms.
    fn counts<'a>(
        looks: &[EvaluatedLook],
        days: impl Iterator<Item = (&'a [usize], f64)>,
    ) -> (DayCounts, DayCounts, usize) {
        let (mut found, mut deceived) = (Vec::new(), Vec::new());
        let mut wrong = 0;
        for (day, threshold) in days {
            let looks = || day.iter().map(|&look| &looks[look]);
            let enters = |score: Option<f64>| score.is_some_and(|s| s >= threshold);
            found.push((
                looks().filter(|l| enters(l.found_at())).count(),
                looks().filter(|l| l.present).count(),
            ));
            deceived.push((
                looks().filter(|l| enters(l.deceived_at())).count(),
                day.len(),
            ));
            let marks = looks().flat_map(EvaluatedLook::wrong_marks);
            wrong += marks.filter(|m| m.score >= threshold).count();
        }
        (found, deceived, wrong)
    }
}

/// The lowest threshold that lets no more false alarms in than `allowed` per look, halfway to the score
/// that would, and what it lets in.
fn choose(events: &MarkEvents, weights: &[f64], allowed: f64) -> (f64, Counts) {
    let most = allowed * events.totals(weights).looks + 1e-9;
    let mut last: Option<(f64, Counts)> = None;
    let mut refused = None;
    events.sweep(weights, |score, counts| {
        if refused.is_none() {
            if counts.wrong <= most {
                last = Some((score, *counts));
            } else {
                refused = Some(score);
            }
        }
    });
    match (last, refused) {
        (Some((score, counts)), Some(refused)) => {
            // Halfway between neighbouring numbers can be the lower one.
            let middle = 0.5 * (score + refused);
            (if middle > refused { middle } else { score }, counts)
        }
        (Some((score, counts)), None) => (score, counts),
        (None, Some(refused)) => (refused.next_up(), Counts::default()),
        (None, None) => (0.0, Counts::default()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::{SyntheticDetector, look, mark};
    use super::super::{By, DetectionBreakdown};
    use super::*;

    fn point(looks: &[EvaluatedLook], allowed: f64) -> OperatingPoint {
        let events = MarkEvents::of(looks);
        OperatingPoint::of(looks, &events, allowed, &mut DayDraws::new(looks, 2), 200)
    }

    #[test]
    fn one_false_alarm_in_ten_looks_is_let_in_and_the_second_is_not() {
        let mut looks: Vec<_> = (0..10).map(|d| look(d, &[mark(0.6, true)])).collect();
        looks[0].marks.push(mark(0.9, false));
        looks[1].marks.push(mark(0.4, false));
        let point = point(&looks, 0.1);
        assert_eq!(point.threshold, 0.5);
        assert_eq!((point.here.found.happened, point.here.found.of), (10, 10));
        assert_eq!(point.here.deceived.happened, 1);
        assert!((point.here.false_alarms - 0.1).abs() < 1e-12);
    }

    #[test]
    fn where_the_best_mark_is_wrong_and_none_is_allowed_nothing_is_found() {
        let looks = [look(0, &[mark(0.9, false), mark(0.8, true)])];
        let point = point(&looks, 0.0);
        assert!(point.threshold > 0.9 && point.detection.value == 0.0);
        assert_eq!(point.here.deceived.happened, 0);
        assert!(point.held_out.is_none());
    }

    #[test]
    fn frames_of_one_day_are_worth_no_more_than_the_days_say() {
        // On ten days everything is found, on ten nothing; and all fifty frames of one real day.
        let photos = (0..200).map(|i| {
            let score = if i % 20 < 10 { 0.9 } else { 0.1 };
            look(i % 20, &[mark(score, true)])
        });
        let frames = (0..50).map(|_| {
            let mut frame = look(20, &[mark(0.9, true)]);
            frame.real = true;
            frame
        });
        let looks: Vec<_> = photos.chain(frames).collect();
        let real = AtThreshold::over_real(&looks, 0.5).found;
        assert_eq!((real.happened, real.of), (50, 50));
        // One try: 1 / (1 + 1.96²) is the lower end. Fifty that know nothing of each other have 0.93.
        assert!((real.low - 0.2065).abs() < 0.02, "{real:?}");
        let by_source = DetectionBreakdown::of(&looks, By::Source, 0.5);
        assert_eq!(by_source.bins[1].found, real, "as the plot has it");
    }

    #[test]
    fn held_out_days_get_about_the_false_alarms_that_were_allowed() {
        let looks = SyntheticDetector::USUAL.looks(40, 50, 9);
        let point = point(&looks, 0.05);
        let held_out = point.held_out.unwrap();
        assert!((point.here.false_alarms - 0.05).abs() < 0.002);
        assert!((held_out.false_alarms - 0.05).abs() < 0.01);
        let share = held_out.found.share().unwrap();
        assert!((point.detection.low..=point.detection.high).contains(&share));
    }

    #[test]
    fn intervals_from_twelve_days_hold_the_rate_of_all_days_in_about_nine_of_ten_studies() {
        let detector = SyntheticDetector {
            wrong: 1,
            ..SyntheticDetector::USUAL
        };
        let truth = point(&detector.looks(3000, 20, 1), 0.05).detection.value;
        let studies = 200;
        let holds = |study: &u64| {
            let looks = detector.looks(12, 20, 100 + study);
            let rate = point(&looks, 0.05).detection;
            (rate.low..=rate.high).contains(&truth)
        };
        let held = (0..studies).filter(holds).count();
        println!("{held} of {studies} intervals hold {truth:.3}");
        assert!((172..=199).contains(&held), "{held} of {studies}");
    }
}
