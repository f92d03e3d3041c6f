//! Runs whose pictures were of no use, told in words.

use super::{FrameReport, Outcome, Run, StepReport, UpdateReport};

/// Sentences that say that no picture of a run corrected the estimate, and most often why; `None` where any did, or where
/// nothing was looked for in them.
///
/// ```
/// use pilotage_mission::settings::NavigatorSettings;
/// use pilotage_navigator::navigator::{Run, unused_pictures};
///
/// let run = Run {
///     name: "a flight without pictures".to_owned(),
///     settings: NavigatorSettings::default(),
///     landmarks: Vec::new(),
///     state_names: Vec::new(),
///     steps: Vec::new(),
/// };
/// assert_eq!(unused_pictures(&run), None);
/// ```
pub fn unused_pictures(run: &Run) -> Option<String> {
    if run.steps.iter().any(is_corrected_by_picture) {
        return None;
    }
    let frames = run.steps.iter().filter_map(|step| step.frame.as_ref());
    let mut count = 0;
    let mut reasons: Vec<(String, usize)> = Vec::new();
    for frame in frames {
        count += 1;
        for reason in reasons_of(frame) {
            match reasons.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, times)) => *times += 1,
                None => reasons.push((reason, 1)),
            }
        }
    }
    // Of several that are as frequent the first.
    let (reason, times) = reasons.iter().rev().max_by_key(|(_, times)| *times)?;
    let when = if *times > 1 { "Most often" } else { "At first" };
    let none = match count {
        1 => "Its one picture did not correct".to_owned(),
        _ => format!("None of its {count} pictures corrected"),
    };
    Some(format!(
        "{none} the estimate, which rests on the instruments alone. {when}: {reason}."
    ))
}

/// Whether something that was seen in a picture corrected the estimate in this step.
fn is_corrected_by_picture(step: &StepReport) -> bool {
    let is_joined = |frame: &FrameReport| frame.joint.is_some();
    let by_aid = !step.sightings.is_empty() && step.updates.iter().any(UpdateReport::is_accepted);
    step.frame.as_ref().is_some_and(is_joined) || by_aid
}

/// Reasons for which what was looked for in a frame was not used.
fn reasons_of(frame: &FrameReport) -> Vec<String> {
    if let Some(trouble) = &frame.trouble {
        return vec![trouble.trim_end_matches('.').to_owned()];
    }
    let laid = frame.laid.iter().filter_map(|laid| {
        let kind = laid.refused_as.map(|kind| kind.reason().to_owned());
        kind.or_else(|| laid.refusal.clone())
    });
    let candidates = frame
        .candidates
        .iter()
        .filter_map(|candidate| match candidate.outcome {
            Outcome::Refused(refusal) => Some(refusal.reason().to_owned()),
            Outcome::Accepted => None,
        });
    laid.chain(candidates).collect()
}
