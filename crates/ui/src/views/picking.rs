//! Questions about a run that several views ask.

use pilotage_core::navigator::{CandidateReport, FrameReport, Outcome, Refusal, Run, StepReport};

/// Name of a landmark of the run, or its number.
pub(crate) fn landmark_name(run: &Run, id: u32) -> String {
    run.landmarks
        .iter()
        .find(|l| l.id == id)
        .map_or_else(|| format!("Landmark {id}"), |l| l.name.clone())
}

/// The last step with a camera frame at or before `time`, with that frame.
pub(crate) fn frame_at(run: &Run, time: f64) -> Option<(&StepReport, &FrameReport)> {
    let step = run.frame_step_at(time)?;
    Some((step, step.frame.as_ref()?))
}

/// The candidate to explain: the selected landmark's, else the best-scored accepted one, else the
/// best-scored at all.
pub(crate) fn candidate_to_explain(
    frame: &FrameReport,
    selection: Option<u32>,
) -> Option<&CandidateReport> {
    let best = |accepted: bool| {
        frame
            .candidates
            .iter()
            .filter(|c| !accepted || c.outcome == Outcome::Accepted)
            .max_by(|a, b| a.score.total_cmp(&b.score))
    };
    frame
        .candidates
        .iter()
        .find(|c| Some(c.landmark) == selection)
        .or_else(|| best(true))
        .or_else(|| best(false))
}

/// Index of the last step at or before `index` in which anything told the place.
pub(crate) fn last_correction(run: &Run, index: usize) -> Option<usize> {
    run.steps
        .get(..=index)?
        .iter()
        .rposition(StepReport::is_placed)
}

/// The second-best score as a fraction of the best; infinite where the best is not positive.
pub(crate) fn ambiguity(candidate: &CandidateReport) -> f64 {
    if candidate.score > 0.0 {
        (candidate.second_score / candidate.score).max(0.0)
    } else {
        f64::INFINITY
    }
}

/// Why a match was refused, in words. A place can be ambiguous for what the picture holds or for
/// what the map holds elsewhere; the numbers tell which.
pub(crate) fn reason(run: &Run, candidate: &CandidateReport, refusal: Refusal) -> &'static str {
    let limit = run.settings.detector.greatest_ambiguity;
    if refusal == Refusal::Ambiguous && ambiguity(candidate) <= limit {
        "it scores no better than look-alikes on the map"
    } else {
        refusal.reason()
    }
}
