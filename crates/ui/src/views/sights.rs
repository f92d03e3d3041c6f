//! When a landmark was last looked for, and when one will be next.

use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::{Run, StepReport};

/// Number of steps ahead in which the next look-out is searched.
const AHEAD: usize = 4_000;

/// Remembers the last step of a kind before the cursor, so that a long run is not searched in every frame.
#[derive(Debug, Default)]
pub(crate) struct LastStep {
    seen: Option<SeenSteps>,
}

/// Search that was made.
#[derive(Debug)]
struct SeenSteps {
    /// Steps of the run at the time.
    length: usize,
    /// Step up to which it went, and the estimate there: another run has another one.
    until: usize,
    position: GroundPoint,
    found: Option<usize>,
}

impl LastStep {
    /// The last step at or before `index` that is `wanted`, which is the same in every call.
    pub fn at(
        &mut self,
        run: &Run,
        index: usize,
        wanted: impl Fn(&StepReport) -> bool,
    ) -> Option<usize> {
        let steps = run.steps.get(..=index)?;
        let known = self.seen.as_ref().filter(|seen| {
            let is_same = |step: &StepReport| step.after.position() == seen.position;
            seen.length <= run.steps.len()
                && run.steps.get(seen.until).is_some_and(is_same)
                && seen
                    .found
                    .is_none_or(|f| run.steps.get(f).is_some_and(&wanted))
        });
        let (from, before) = match known {
            Some(seen) if seen.until <= index => (seen.until, seen.found),
            // What was the last one later on is so here, too, or all before it are to be searched.
            Some(SeenSteps {
                found: Some(found), ..
            }) if *found <= index => (index, Some(*found)),
            Some(SeenSteps { found: None, .. }) => (index, None),
            _ => (0, None),
        };
        let new = steps[from..].iter().rposition(wanted).map(|i| from + i);
        let found = new.or(before);
        self.seen = Some(SeenSteps {
            length: run.steps.len(),
            until: index,
            position: steps[index].after.position(),
            found,
        });
        found
    }
}

/// Remembers when a landmark was looked for last.
#[derive(Debug, Default)]
pub(crate) struct Sights(LastStep);

/// Whether a landmark was looked for in this step.
fn looked(step: &StepReport) -> bool {
    step.frame
        .as_ref()
        .is_some_and(|f| !f.candidates.is_empty())
}

impl Sights {
    /// The last step at or before `index` in which a landmark was looked for.
    pub fn last(&mut self, run: &Run, index: usize) -> Option<usize> {
        self.0.at(run, index, looked)
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
    fn a_run_without_landmarks_is_not_taken_for_the_next_one() {
        let fixture = Fixture::new();
        let mut without = fixture.run.clone();
        for step in &mut without.steps {
            step.frame = None;
            step.after.mean[0] += 1.0;
        }
        let end = without.steps.len() - 1;
        let mut sights = Sights::default();
        assert_eq!(sights.last(&without, end), None);
        assert!(sights.last(&fixture.run, end).is_some());
    }

    #[test]
    fn a_run_without_pictures_is_searched_once_and_not_in_every_frame() {
        let mut run = Fixture::lasting(20.0).run;
        for step in &mut run.steps {
            step.frame = None;
        }
        let asked = std::cell::Cell::new(0);
        let mut last = LastStep::default();
        let end = run.steps.len() - 1;
        for index in [end, end, end, end - 1, end - 2, end] {
            let wanted = |step: &StepReport| {
                asked.set(asked.get() + 1);
                step.frame.is_some()
            };
            assert_eq!(last.at(&run, index, wanted), None);
        }
        assert!(asked.get() < run.steps.len() + 10, "{}", asked.get());
    }

    #[test]
    fn the_next_look_out_lies_after_the_cursor() {
        let run = Fixture::new().run;
        let next = Sights::next(&run, 0).expect("a landmark is looked for");
        assert!(next > 0 && looked(&run.steps[next]));
        assert!(!run.steps[1..next].iter().any(looked));
    }
}
