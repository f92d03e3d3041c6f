//! When a landmark was last looked for, and when one will be next.

use pilotage_core::navigator::{Run, StepReport};

/// Number of steps ahead in which the next look-out is searched.
const AHEAD: usize = 4_000;

/// Remembers what was found for the last cursor, so that a long run is not searched in every frame.
#[derive(Debug, Default)]
pub(crate) struct Sights {
    /// Steps of the run at the time, the cursor's step, and the last look-out at or before it.
    seen: Option<(usize, usize, Option<usize>)>,
}

/// Whether a landmark was looked for in this step.
fn looked(step: &StepReport) -> bool {
    step.frame
        .as_ref()
        .is_some_and(|f| !f.candidates.is_empty())
}

impl Sights {
    /// The last step at or before `index` in which a landmark was looked for.
    pub fn last(&mut self, run: &Run, index: usize) -> Option<usize> {
        let steps = run.steps.get(..=index)?;
        let known = self.seen.filter(|(length, _, found)| {
            *length <= run.steps.len() && found.is_none_or(|f| run.steps.get(f).is_some_and(looked))
        });
        let (from, before) = match known {
            Some((_, at, found)) if at <= index => (at, found),
            _ => (0, None),
        };
        let new = steps[from..].iter().rposition(looked).map(|i| from + i);
        let found = new.or(before);
        self.seen = Some((run.steps.len(), index, found));
        found
    }

    /// The first step after `index` in which a landmark is looked for, unless it is far off.
    pub fn next(run: &Run, index: usize) -> Option<usize> {
        let from = index + 1;
        let until = run.steps.len().min(from + AHEAD);
        let ahead = run.steps.get(from..until)?;
        ahead.iter().position(looked).map(|i| from + i)
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::Fixture;
    use super::*;

    #[test]
    fn the_last_look_out_is_the_same_however_the_cursor_came_there() {
        let run = Fixture::new().run;
        let mut sights = Sights::default();
        for index in (0..run.steps.len()).chain((0..run.steps.len()).rev().step_by(7)) {
            let plain = run.steps[..=index].iter().rposition(looked);
            assert_eq!(sights.last(&run, index), plain, "at step {index}");
        }
    }

    #[test]
    fn another_run_is_not_taken_for_the_one_before() {
        let run = Fixture::new().run;
        let mut sights = Sights::default();
        let end = run.steps.len() - 1;
        assert!(sights.last(&run, end).is_some());
        let mut other = run.clone();
        for step in &mut other.steps {
            step.frame = None;
        }
        assert_eq!(sights.last(&other, end), None);
    }

    #[test]
    fn the_next_look_out_lies_after_the_cursor() {
        let run = Fixture::new().run;
        let next = Sights::next(&run, 0).expect("a landmark is looked for");
        assert!(next > 0 && looked(&run.steps[next]));
        assert!(!run.steps[1..next].iter().any(looked));
    }
}
