//! Everything that looks tell of a detector.

use serde::{Deserialize, Serialize};

use super::curve::curves;
use super::draws::{DayDraws, by_day};
use super::events::MarkEvents;
use super::{
    By, Curve, CurveKind, DetectionBreakdown, EvaluatedLook, EvaluationError, IntervalEstimate,
    MarkCovariance, OperatingPoint, ScoreCalibration,
};

/// Settings of the evaluation of looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationSettings {
    /// False alarms per look that are allowed at the threshold of use.
    pub false_alarms: f64,
    /// Samples of days that intervals are taken from.
    pub replicates: usize,
    /// Seed of these samples.
    pub seed: u64,
}

impl Default for EvaluationSettings {
    /// Allows one false alarm in a hundred looks.
    fn default() -> Self {
        Self {
            false_alarms: 0.01,
            replicates: 1000,
            seed: 1,
        }
    }
}

/// Evaluation of a detector by looks. All intervals are two-sided and of 95 %.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Looks.
    pub looks: usize,
    /// Those with the landmark whole in the picture.
    pub present: usize,
    /// Those that are real frames.
    pub real: usize,
    /// Days that they show.
    pub days: usize,
    /// Whether intervals draw whole days; from under five days they draw looks as well, and say little
    /// of other days.
    pub draws_whole_days: bool,
    /// Found against the share of pictures with a false alarm.
    pub roc: Curve,
    /// Found against false alarms per picture.
    pub froc: Curve,
    /// Precision against recall.
    pub precision_recall: Curve,
    /// Mean precision over the recalls.
    pub average_precision: IntervalEstimate,
    /// The threshold of use, and what happens there.
    pub operating: OperatingPoint,
    /// Detections at that threshold against each circumstance, in the order of [`By::ALL`].
    pub breakdowns: Vec<DetectionBreakdown>,
    /// Covariance of the place by right marks above that threshold; `None` with too few.
    pub covariance: Option<MarkCovariance>,
    /// Probability that marks are right; `None` with right or wrong ones alone.
    pub calibration: Option<ScoreCalibration>,
}

impl Evaluation {
    /// Evaluates looks of one landmark, or of several whose scores mean the same. The same looks and
    /// settings give the same result.
    ///
    /// # Errors
    /// If no look has the landmark in it, or a number in them is not finite.
    pub fn of(
        looks: &[EvaluatedLook],
        settings: &EvaluationSettings,
    ) -> Result<Self, EvaluationError> {
        check(looks)?;
        let events = MarkEvents::of(looks);
        let mut draws = DayDraws::new(looks, settings.seed);
        let ([roc, froc, precision_recall], average_precision) =
            curves(&events, &mut draws, settings.replicates);
        let operating = OperatingPoint::of(
            looks,
            &events,
            settings.false_alarms,
            &mut draws,
            settings.replicates,
        );
        let threshold = operating.threshold;
        Ok(Self {
            looks: looks.len(),
            present: looks.iter().filter(|l| l.present).count(),
            real: looks.iter().filter(|l| l.real).count(),
            days: by_day(looks).len(),
            draws_whole_days: draws.draws_whole_days(),
            roc,
            froc,
            precision_recall,
            average_precision,
            operating,
            breakdowns: By::ALL
                .map(|by| DetectionBreakdown::of(looks, by, threshold))
                .into(),
            covariance: MarkCovariance::of(looks, threshold, settings.seed),
            calibration: ScoreCalibration::of(looks),
        })
    }

    /// Curve of that kind, of the three.
    pub fn curve(&self, kind: CurveKind) -> &Curve {
        match kind {
            CurveKind::Roc => &self.roc,
            CurveKind::Froc => &self.froc,
            CurveKind::PrecisionRecall => &self.precision_recall,
        }
    }
}

fn check(looks: &[EvaluatedLook]) -> Result<(), EvaluationError> {
    for (index, look) in looks.iter().enumerate() {
        let scores = look.marks.iter().map(|m| ("a score", m.score));
        let offsets = look.marks.iter().flat_map(|m| m.offset);
        let numbers = [
            ("the height", look.height),
            ("the tilt", look.tilt),
            ("the heading error", look.heading_error),
        ];
        let mut numbers =
            (numbers.into_iter().chain(scores)).chain(offsets.map(|metres| ("an offset", metres)));
        if let Some((what, _)) = numbers.find(|n| !n.1.is_finite()) {
            return Err(EvaluationError::NotFinite {
                look: index,
                day: look.day,
                what,
            });
        }
    }
    if looks.iter().any(|look| look.present) {
        Ok(())
    } else {
        Err(EvaluationError::NeverPresent { looks: looks.len() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::{SyntheticDetector, look, mark};
    use super::*;

    #[test]
    fn the_same_looks_give_the_same_evaluation_and_another_seed_moves_only_intervals() {
        let looks = SyntheticDetector::USUAL.looks(10, 30, 2);
        let settings = EvaluationSettings {
            replicates: 100,
            ..EvaluationSettings::default()
        };
        let first = Evaluation::of(&looks, &settings).unwrap();
        assert_eq!(first, Evaluation::of(&looks, &settings).unwrap());
        let other = Evaluation::of(
            &looks,
            &EvaluationSettings {
                seed: 2,
                ..settings
            },
        )
        .unwrap();
        assert_eq!(first.operating.threshold, other.operating.threshold);
        assert_eq!(first.average_precision.value, other.average_precision.value);
        assert_ne!(first.average_precision.low, other.average_precision.low);
        assert_eq!((first.looks, first.days, first.real), (300, 10, 150));
        assert!(first.draws_whole_days && first.covariance.is_some());
    }

    #[test]
    fn a_detector_that_never_errs_has_intervals_all_the_same() {
        let looks: Vec<_> = (0..100).map(|i| look(i % 10, &[mark(0.9, true)])).collect();
        let found = Evaluation::of(&looks, &EvaluationSettings::default()).unwrap();
        let here = found.operating.here;
        assert_eq!(here.found.share(), Some(1.0));
        assert!(here.found.low > 0.95 && here.found.low < 0.97, "{here:?}");
        assert!(here.deceived.high > 0.03);
        assert!(found.calibration.is_none());
    }

    #[test]
    fn looks_that_say_nothing_are_refused_with_the_place() {
        let refused = Evaluation::of(&[], &EvaluationSettings::default());
        assert_eq!(refused, Err(EvaluationError::NeverPresent { looks: 0 }));
        let looks = [look(3, &[mark(f64::NAN, true)])];
        let error = Evaluation::of(&looks, &EvaluationSettings::default()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "look 0 of day 3: a score is not a finite number"
        );
    }
}
