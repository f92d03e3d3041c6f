//! The longest stretch of a run without a landmark.

use pilotage_core::navigator::Run;

/// First and last step of the longest stretch between two corrections (or to the end).
pub(super) fn longest_gap(run: &Run) -> Option<(usize, usize)> {
    let mut ends: Vec<usize> = (0..run.steps.len())
        .filter(|i| run.steps[*i].corrected())
        .collect();
    ends.push(run.steps.len().checked_sub(1)?);
    ends.windows(2).map(|w| (w[0], w[1])).max_by(|a, b| {
        let length = |g: &(usize, usize)| run.steps[g.1].time - run.steps[g.0].time;
        // Of equal ones the first.
        length(a).total_cmp(&length(b)).then(b.0.cmp(&a.0))
    })
}

#[cfg(test)]
mod tests {
    use pilotage_core::navigator::StepReport;

    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn the_longest_gap_is_longer_than_any_other() {
        let fixture = Fixture::new();
        let run = &fixture.run;
        let (from, to) = longest_gap(run).unwrap();
        assert!(!run.steps[from + 1..to].iter().any(StepReport::corrected));
        let length = run.steps[to].time - run.steps[from].time;
        assert!(length > 10.0, "{length}");
    }
}
