//! Questions about a run that several views ask.

use pilotage_core::navigator::{CandidateReport, FrameReport, Outcome, Refusal, Run, StepReport};

/// Age from which pictures and values are none of the moment any more, seconds.
pub(crate) const RECENT: f64 = 3.0;

/// Name of a landmark of the run, or its number.
pub(crate) fn landmark_name(run: &Run, id: u32) -> String {
    run.landmarks
        .iter()
        .find(|l| l.id == id)
        .map_or_else(|| format!("Landmark {id}"), |l| l.name.clone())
}

/// The last step with a camera frame at or before `time`, unless it is more than `within` seconds past: however long a run
/// is, no more of it is searched.
pub(crate) fn recent_frame(run: &Run, time: f64, within: f64) -> Option<&StepReport> {
    let steps = run.steps[..=run.index_at(time)?].iter().rev();
    let mut recent = steps.take_while(|step| time - step.time <= within);
    recent.find(|step| step.frame.is_some())
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

#[cfg(test)]
mod tests {
    use super::super::fixture::Fixture;
    use super::*;

    #[test]
    fn a_recent_frame_is_the_last_one_unless_it_is_long_past() {
        let mut run = Fixture::lasting(20.0).run;
        for step in run.steps.iter_mut().filter(|step| step.time > 12.1) {
            step.frame = None;
        }
        let last = run.frame_step_at(20.0).map(|step| step.time).unwrap();
        assert!((last - 12.0).abs() < 1e-9);
        for (time, within, wanted) in [
            (13.0, 3.0, Some(12.0)),
            (15.2, 3.0, None),
            (15.2, 4.0, Some(12.0)),
            (-1.0, 3.0, None),
        ] {
            let found = recent_frame(&run, time, within).map(|step| step.time.round());
            assert_eq!(found, wanted, "{time}");
        }
    }
}
