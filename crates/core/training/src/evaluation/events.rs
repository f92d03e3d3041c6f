//! The marks of all looks in the order in which a falling threshold lets them in.

use super::EvaluatedLook;

/// Kind of a mark in its look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MarkKind {
    /// The best right one: the look counts as found from here on.
    Found,
    /// The best wrong one: the look has a false alarm from here on.
    Deceived,
    /// A further wrong one.
    Wrong,
}

#[derive(Clone, Copy, Debug)]
struct MarkEvent {
    score: f64,
    look: usize,
    kind: MarkKind,
}

/// Marks by falling score. Right marks beyond the best of a look say the same again and count as
/// nothing.
#[derive(Clone, Debug)]
pub(super) struct MarkEvents {
    events: Vec<MarkEvent>,
    present: Vec<bool>,
}

/// Detections and false alarms that a threshold lets in. Counts are sums of the looks' weights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Counts {
    /// Looks with the landmark in which it is found.
    pub found: f64,
    /// Looks with a false alarm.
    pub deceived: f64,
    /// False alarms.
    pub wrong: f64,
}

/// Totals of the looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Totals {
    /// Looks.
    pub looks: f64,
    /// Looks with the landmark.
    pub present: f64,
}

impl MarkEvents {
    pub fn of(looks: &[EvaluatedLook]) -> Self {
        let mut events = Vec::new();
        for (look, seen) in looks.iter().enumerate() {
            let mut add = |score, kind| events.push(MarkEvent { score, look, kind });
            if let Some(score) = seen.found_at() {
                add(score, MarkKind::Found);
            }
            let mut wrong: Vec<f64> = seen.wrong_marks().map(|m| m.score).collect();
            wrong.sort_by(|a, b| b.total_cmp(a));
            for (rank, score) in wrong.into_iter().enumerate() {
                let first = rank == 0;
                add(
                    score,
                    if first {
                        MarkKind::Deceived
                    } else {
                        MarkKind::Wrong
                    },
                );
            }
        }
        events.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.look.cmp(&b.look)));
        Self {
            events,
            present: looks.iter().map(|look| look.present).collect(),
        }
    }

    /// Every look once.
    pub fn equal_weights(&self) -> Vec<f64> {
        vec![1.0; self.present.len()]
    }

    pub fn totals(&self, weights: &[f64]) -> Totals {
        let with = self.present.iter().zip(weights).filter(|(p, _)| **p);
        Totals {
            looks: weights.iter().sum(),
            present: with.map(|(_, w)| w).sum(),
        }
    }

    /// Lets the threshold fall over every score at which a mark of a weighted look enters, equal
    /// scores at once: `visit` gets the threshold and what it lets in.
    pub fn sweep(&self, weights: &[f64], mut visit: impl FnMut(f64, &Counts)) {
        let mut counts = Counts::default();
        let mut i = 0;
        while i < self.events.len() {
            let score = self.events[i].score;
            let mut entered = false;
            while let Some(event) = self.events.get(i).filter(|e| e.score == score) {
                let weight = weights[event.look];
                entered |= weight > 0.0;
                match event.kind {
                    MarkKind::Found => counts.found += weight,
                    MarkKind::Deceived => {
                        counts.deceived += weight;
                        counts.wrong += weight;
                    }
                    MarkKind::Wrong => counts.wrong += weight,
                }
                i += 1;
            }
            if entered {
                visit(score, &counts);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::{look, mark};
    use super::*;

    #[test]
    fn a_look_is_found_once_and_deceived_once_and_each_wrong_mark_counts() {
        let looks = [
            look(0, &[mark(0.9, true), mark(0.8, true), mark(0.5, false)]),
            look(0, &[mark(0.7, false), mark(0.6, false), mark(0.5, true)]),
        ];
        let events = MarkEvents::of(&looks);
        let mut seen = Vec::new();
        events.sweep(&events.equal_weights(), |t, c| {
            seen.push((t, c.found, c.deceived, c.wrong));
        });
        let expected = [
            (0.9, 1.0, 0.0, 0.0),
            (0.7, 1.0, 1.0, 1.0),
            (0.6, 1.0, 1.0, 2.0),
            (0.5, 2.0, 2.0, 3.0),
        ];
        assert_eq!(seen, expected);
    }

    #[test]
    fn a_mark_called_right_in_a_picture_without_the_landmark_is_a_false_alarm() {
        let mut empty = look(0, &[mark(0.9, true)]);
        empty.present = false;
        let events = MarkEvents::of(&[empty]);
        let weights = events.equal_weights();
        assert_eq!(events.totals(&weights).present, 0.0);
        events.sweep(&weights, |_, c| assert_eq!((c.found, c.wrong), (0.0, 1.0)));
    }
}
