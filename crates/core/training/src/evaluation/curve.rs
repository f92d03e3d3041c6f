//! Curves of detections against false alarms, between which a threshold trades.

use serde::{Deserialize, Serialize};

use super::draws::DayDraws;
use super::events::{Counts, MarkEvents, Totals};
use super::{EvaluatedLook, IntervalEstimate};

/// Most points that a curve keeps.
const MOST_POINTS: usize = 200;

/// Kind of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum CurveKind {
    /// Receiver operating characteristic: x is the share of pictures with a false alarm, y the share
    /// of the pictures with the landmark in which it is found.
    Roc,
    /// Free-response characteristic: x is false alarms per picture, y as above.
    Froc,
    /// x is that share of found ones (recall), y the share of marks that are right (precision).
    PrecisionRecall,
}

impl CurveKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Roc, Self::Froc, Self::PrecisionRecall];

    /// Number of tries of which y is the share, with the landmark in `present` looks.
    fn tries(self, x: f64, y: f64, present: f64) -> f64 {
        match self {
            Self::Roc | Self::Froc => present,
            // Marks: those that are right, over their share.
            Self::PrecisionRecall => x * present / y.max(f64::MIN_POSITIVE),
        }
    }

    fn at(self, counts: &Counts, totals: &Totals) -> (f64, f64) {
        let found = counts.found / totals.present.max(f64::MIN_POSITIVE);
        match self {
            Self::Roc => (counts.deceived / totals.looks, found),
            Self::Froc => (counts.wrong / totals.looks, found),
            Self::PrecisionRecall => (found, counts.found / (counts.found + counts.wrong)),
        }
    }
}

/// Step of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// See [`CurveKind`].
    pub x: f64,
    /// See [`CurveKind`].
    pub y: f64,
    /// Lower end of the 95 % interval of y at this x, over other days.
    pub low: f64,
    /// Upper end of that interval.
    pub high: f64,
    /// Marks of at least this score are accepted.
    pub threshold: f64,
}

/// A curve by falling threshold.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// At most some 200 points, x ascending.
    pub points: Vec<CurvePoint>,
}

/// Every step of a curve, without intervals: x, y and threshold.
pub fn trace(looks: &[EvaluatedLook], kind: CurveKind) -> Vec<[f64; 3]> {
    let events = MarkEvents::of(looks);
    trace_of(&events, kind)
}

/// Mean precision over the recalls: the sum over its steps of recall gained times precision. Landmarks
/// that are never marked count as recall that is never reached.
///
/// ```
/// # use pilotage_training::evaluation::{EvaluatedLook, EvaluatedMark};
/// use pilotage_training::evaluation::average_precision;
/// # let look = |score: f64, right| EvaluatedLook {
/// #     present: right,
/// #     marks: vec![EvaluatedMark { score, right, offset: [0.0; 2], rotation: 0.0, log_scale: 0.0 }],
/// #     day: 0, height: 100.0, tilt: 0.0, heading_error: 0.0, log_scale: 0.0, real: false,
/// # };
///
/// // By falling score: right, wrong, right. Half the recall at precision 1, half at 2/3.
/// let looks = [look(3.0, true), look(2.0, false), look(1.0, true)];
/// assert!((average_precision(&looks) - (0.5 + 0.5 * 2.0 / 3.0)).abs() < 1e-12);
/// ```
pub fn average_precision(looks: &[EvaluatedLook]) -> f64 {
    let events = MarkEvents::of(looks);
    average_precision_of(&events, &events.equal_weights())
}

fn trace_of(events: &MarkEvents, kind: CurveKind) -> Vec<[f64; 3]> {
    let weights = events.equal_weights();
    let totals = events.totals(&weights);
    let mut steps: Vec<[f64; 3]> = Vec::new();
    events.sweep(&weights, |threshold, counts| {
        let (x, y) = kind.at(counts, &totals);
        // A further false alarm in a picture that has one is no step of every curve.
        if steps.last().is_none_or(|last| (last[0], last[1]) != (x, y)) {
            steps.push([x, y, threshold]);
        }
    });
    steps
}

fn average_precision_of(events: &MarkEvents, weights: &[f64]) -> f64 {
    let totals = events.totals(weights);
    let (mut sum, mut last) = (0.0, 0.0);
    events.sweep(weights, |_, counts| {
        let (recall, precision) = CurveKind::PrecisionRecall.at(counts, &totals);
        sum += (recall - last) * precision;
        last = recall;
    });
    sum
}

/// The three curves of [`CurveKind::ALL`] and the average precision, with intervals from `replicates`
/// draws.
pub(super) fn curves(
    events: &MarkEvents,
    draws: &mut DayDraws,
    replicates: usize,
) -> ([Curve; 3], IntervalEstimate) {
    let steps = CurveKind::ALL.map(|kind| thinned(kind, &trace_of(events, kind)));
    let mut drawn: [Vec<Vec<f64>>; 3] =
        std::array::from_fn(|i| vec![Vec::with_capacity(replicates); steps[i].len()]);
    let mut precisions = Vec::with_capacity(replicates);
    for _ in 0..replicates {
        let weights = draws.next_weights();
        if events.totals(&weights).present == 0.0 {
            continue;
        }
        for (kind, (steps, drawn)) in CurveKind::ALL.into_iter().zip(steps.iter().zip(&mut drawn)) {
            sample_at(events, &weights, kind, steps, drawn);
        }
        precisions.push(average_precision_of(events, &weights));
    }
    let present = events.totals(&events.equal_weights()).present;
    let mut drawn = drawn.into_iter();
    let mut kinds = CurveKind::ALL.into_iter();
    let curves = steps.map(|steps| {
        let kind = kinds.next().unwrap_or(CurveKind::Roc);
        let columns = drawn.next().unwrap_or_default();
        let point = |([x, y, threshold], mut column): ([f64; 3], Vec<f64>)| {
            let (low, high) = draws.interval(&mut column, y, kind.tries(x, y, present));
            CurvePoint {
                x,
                y,
                low,
                high,
                threshold,
            }
        };
        let mut points: Vec<_> = steps.into_iter().zip(columns).map(point).collect();
        if kind != CurveKind::PrecisionRecall {
            never_falling(&mut points);
        }
        Curve { points }
    });
    let value = average_precision_of(events, &events.equal_weights());
    let (low, high) = draws.interval(&mut precisions, value, present);
    (curves, IntervalEstimate { value, low, high })
}

/// More false alarms never find less: what is sure before is sure after, and the other way round.
fn never_falling(points: &mut [CurvePoint]) {
    let mut least = 0.0_f64;
    for point in points.iter_mut() {
        least = least.max(point.low);
        point.low = least;
    }
    let mut greatest = 1.0_f64;
    for point in points.iter_mut().rev() {
        greatest = greatest.min(point.high);
        point.high = greatest;
    }
}

/// Appends to each column the drawn curve's y at that step's x.
fn sample_at(
    events: &MarkEvents,
    weights: &[f64],
    kind: CurveKind,
    steps: &[[f64; 3]],
    columns: &mut [Vec<f64>],
) {
    let totals = events.totals(weights);
    let mut next = 0;
    let falls = kind == CurveKind::PrecisionRecall;
    let mut last = 0.0;
    events.sweep(weights, |_, counts| {
        let (x, y) = kind.at(counts, &totals);
        // Of detections the best before a further false alarm; of precision that at which the recall
        // is first reached.
        let passed = |at: f64| {
            if falls {
                at <= x + 1e-12
            } else {
                at < x - 1e-12
            }
        };
        while next < steps.len() && passed(steps[next][0]) {
            columns[next].push(if falls { y } else { last });
            next += 1;
        }
        last = y;
    });
    for column in &mut columns[next..] {
        column.push(if falls { 0.0 } else { last });
    }
}

/// Leaves out what steps from point to point show as well, and beyond that keeps every so many.
fn thinned(kind: CurveKind, steps: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let corner = |i: usize| match kind {
        // The recall rises here for the first time.
        CurveKind::PrecisionRecall => i == 0 || steps[i][0] > steps[i - 1][0],
        // The last before a step to the right: what is found until then.
        _ => steps.get(i + 1).is_none_or(|next| next[0] > steps[i][0]),
    };
    let kept: Vec<usize> = (0..steps.len()).filter(|&i| corner(i)).collect();
    let stride = kept.len().div_ceil(MOST_POINTS).max(1);
    let last = kept.len().saturating_sub(1);
    let places = kept.iter().enumerate();
    let chosen = places.filter(|(i, _)| i % stride == 0 || *i == last);
    chosen.map(|(_, &step)| steps[step]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample::{SyntheticDetector, look, mark};
    use super::*;

    #[test]
    fn precision_is_averaged_over_recalls_and_what_is_never_marked_is_never_reached() {
        let looks = [
            look(0, &[mark(0.9, true)]),
            look(0, &[mark(0.7, true), mark(0.8, false)]),
            look(0, &[]),
        ];
        // Thirds: the first at precision 1, the second at 2/3, the third never.
        let expected = (1.0 + 2.0 / 3.0) / 3.0;
        assert!((average_precision(&looks) - expected).abs() < 1e-12);
        let steps = trace(&looks, CurveKind::Froc);
        let third = 1.0 / 3.0;
        assert_eq!(steps[0], [0.0, third, 0.9]);
        assert_eq!(steps[2], [third, 2.0 * third, 0.7]);
    }

    #[test]
    fn bands_hold_their_curve_and_more_days_narrow_them() {
        let width = |days: usize| {
            let looks = SyntheticDetector::USUAL.looks(days, 40, 5);
            let events = MarkEvents::of(&looks);
            let mut draws = DayDraws::new(&looks, 1);
            let (curves, precision) = curves(&events, &mut draws, 200);
            for curve in &curves {
                let points = &curve.points;
                assert!(points.len() > 20 && points.len() <= MOST_POINTS + 1);
                assert!(points.windows(2).all(|p| p[0].x <= p[1].x));
                assert!(points.iter().all(|p| p.low <= p.y && p.y <= p.high));
            }
            precision.high - precision.low
        };
        let (few, many) = (width(6), width(54));
        assert!(many < 0.6 * few, "{few} {many}");
    }
}
