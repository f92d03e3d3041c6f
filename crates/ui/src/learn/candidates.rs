//! Candidates of a run that lessons tell of.

use pilotage_core::navigator::{CandidateReport, Run, StepReport};

/// The accepted landmark of a step with the best score.
pub(super) fn best_accepted(step: &StepReport) -> Option<&CandidateReport> {
    step.frame
        .as_ref()?
        .accepted()
        .max_by(|a, b| a.score.total_cmp(&b.score))
}

/// Every candidate with a NIS, with the index of its step.
pub(super) fn judged(run: &Run) -> impl Iterator<Item = (usize, &CandidateReport, f64)> {
    run.steps.iter().enumerate().flat_map(|(i, step)| {
        step.frame
            .iter()
            .flat_map(|f| &f.candidates)
            .filter_map(move |c| Some((i, c, c.nis?)))
    })
}

/// Words on a run that is told its place by anything but landmarks.
pub(super) fn no_landmark(run: &Run) -> Option<&'static str> {
    let by_landmarks = run.steps.iter().any(|step| best_accepted(step).is_some());
    let is_placed = !by_landmarks && run.steps.iter().any(StepReport::is_placed);
    is_placed.then_some(
        "Whole pictures or aids tell this run its place, and no landmark has corrected it so far: there is nothing to see here.",
    )
}
