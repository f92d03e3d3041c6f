//! The longest stretch of a run in which nothing told the place.

use pilotage_core::navigator::{Run, StepReport};
use pilotage_core::vehicle::StateComponent;

use crate::views::DEAD_RECKONING_AFTER;
use crate::views::inspector::sentence::sigma;

/// Stretch of dead reckoning, by indices of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
    /// Step in which the place was told before.
    pub from: usize,
    /// Last step of the stretch.
    pub last: usize,
    /// Step in which the place is told again; the last of the run if it is not.
    pub end: usize,
}

/// The longest stretch of dead reckoning (to the end of the run, if nothing ends it) in which the uncertainty of the
/// position grew, of those whose last step is as `is_end` wants it.
pub(super) fn longest_gap(run: &Run, is_end: impl Fn(&StepReport) -> bool) -> Option<Gap> {
    let steps = &run.steps;
    let mut ends: Vec<usize> = (0..steps.len()).filter(|i| steps[*i].is_placed()).collect();
    ends.push(steps.len().checked_sub(1)?);
    let length = |gap: &Gap| steps[gap.end].time - steps[gap.from].time;
    let gaps = ends.windows(2).map(|pair| {
        let (from, end) = (pair[0], pair[1]);
        let last = end.saturating_sub(usize::from(steps[end].is_placed()));
        Gap {
            from,
            last: last.max(from),
            end,
        }
    });
    let gaps = gaps.filter(|gap| {
        length(gap) > DEAD_RECKONING_AFTER
            && sigma(&steps[gap.last].after) > sigma(&steps[gap.from].after)
            && is_end(&steps[gap.end])
    });
    // Of equal ones the first.
    gaps.max_by(|a, b| length(a).total_cmp(&length(b)).then(b.from.cmp(&a.from)))
}

/// Words on a run that has told its place, and no such stretch.
pub(super) fn no_gap(run: &Run) -> Option<&'static str> {
    let is_placed = run.steps.iter().any(StepReport::is_placed);
    (is_placed && longest_gap(run, |_| true).is_none()).then_some(
        "This run has no stretch of dead reckoning so far: something tells the place again within two seconds, or keeps \
         the uncertainty from growing.",
    )
}

/// Whether the filter of a run estimates the wind: the position errs by the wind's error then.
pub(super) fn estimates_wind(run: &Run) -> bool {
    run.state_index(StateComponent::WindNorth).is_some()
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::views::fixture::{Fixture, reading_of_gps};

    #[test]
    fn the_longest_gap_is_longer_than_any_other() {
        let fixture = Fixture::new();
        let run = &fixture.run;
        let gap = longest_gap(run, |_| true).unwrap();
        let between = &run.steps[gap.from + 1..gap.end];
        assert!(!between.iter().any(StepReport::is_placed));
        let length = run.steps[gap.end].time - run.steps[gap.from].time;
        assert!(length > 10.0, "{length}");
    }

    #[test]
    fn readings_of_an_aid_that_tells_the_place_leave_no_gap_and_refused_ones_do() {
        let mut fixture = Fixture::new();
        let whole = longest_gap(&fixture.run, |_| true);
        for step in &mut fixture.run.steps {
            step.updates = vec![reading_of_gps(40.0, None)];
        }
        assert_eq!(longest_gap(&fixture.run, |_| true), whole);
        for step in &mut fixture.run.steps {
            step.updates = vec![reading_of_gps(1.0, Some(DMatrix::zeros(4, 2)))];
        }
        assert_eq!(longest_gap(&fixture.run, |_| true), None);
        assert!(no_gap(&fixture.run).is_some());
    }

    #[test]
    fn a_stretch_in_which_the_uncertainty_does_not_grow_is_none() {
        let mut fixture = Fixture::new();
        let before = longest_gap(&fixture.run, |_| true).unwrap();
        let known = fixture.run.steps[before.from].after.clone();
        for step in &mut fixture.run.steps[before.from..before.end] {
            step.after.covariance.clone_from(&known.covariance);
        }
        assert_ne!(longest_gap(&fixture.run, |_| true), Some(before));
    }
}
