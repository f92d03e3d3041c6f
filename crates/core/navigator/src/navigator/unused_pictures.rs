//! Runs whose pictures were of no use, told in words.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    AidInfo, FrameReport, Outcome, RegistrationRefusal, RegistrationReport, Run, StepReport,
};

/// Reason of frames in which nothing was looked for, because nothing could be seen from there.
const NOT_IN_VIEW: &str = "no landmark was in view";

/// Sentences that say that no picture of a run corrected the estimate, and most often why; `None` where any did, where
/// nothing was to be looked for in them, or where they left open which of several places is the right one.
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
    let is_used = |step: &StepReport| step.corrected() || is_corrected_by_sight(step);
    let frames = || run.steps.iter().filter_map(|step| step.frame.as_ref());
    if !looks(run) || run.steps.iter().any(is_used) || frames().any(leaves_open) {
        return None;
    }
    let count = frames().count();
    let mut reasons: BTreeMap<String, (usize, String)> = BTreeMap::new();
    for frame in frames() {
        let mut of_frame = BTreeSet::new();
        for reason in reasons_of(frame) {
            let kind = kind_of(&reason);
            if of_frame.insert(kind.clone()) {
                reasons.entry(kind).or_insert((0, reason)).0 += 1;
            }
        }
    }
    let none = match count {
        0 => return None,
        1 => "Its one picture did not correct".to_owned(),
        _ => format!("None of its {count} pictures corrected"),
    };
    let why = reasons.values().max_by_key(|(times, _)| *times);
    let why = why.map(|(times, reason)| match times {
        _ if count == 1 => format!(" Why: {reason}."),
        1 => format!(" In one of them: {reason}."),
        _ => format!(" Most often, in {times} of them: {reason}."),
    });
    Some(format!(
        "{none} the estimate, which rests on the instruments alone.{}",
        why.unwrap_or_default()
    ))
}

/// Whether anything was to be looked for in the pictures of a run.
fn looks(run: &Run) -> bool {
    let mut aids = run.settings.aids.iter();
    run.settings.whole_frames.is_some()
        || run.landmarks.iter().any(|landmark| landmark.enabled)
        || aids.any(|aid| sees(&aid.key))
}

/// Whether the aid of that name in files looks at pictures.
fn sees(key: &str) -> bool {
    AidInfo::named(key).is_ok_and(AidInfo::sees)
}

/// Whether an aid that looks at pictures corrected the estimate in this step.
fn is_corrected_by_sight(step: &StepReport) -> bool {
    let mut updates = step.updates.iter();
    updates.any(|update| update.is_accepted() && sees(&update.aid))
}

/// Whether a frame was laid at several places, of which any may be right: the estimate may go on from either.
fn leaves_open(frame: &FrameReport) -> bool {
    let is_open = |laid: &RegistrationReport| laid.refused_as == Some(RegistrationRefusal::Open);
    frame.laid.as_ref().is_some_and(is_open)
}

/// Reasons for which nothing of a frame was used.
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
    let mut reasons: Vec<String> = laid.chain(candidates).collect();
    if reasons.is_empty() {
        reasons.push(NOT_IN_VIEW.to_owned());
    }
    reasons
}

/// Kind of a reason: the same of pictures that differ in their names and numbers.
fn kind_of(reason: &str) -> String {
    let cause = reason.split_once(": ").map_or(reason, |(_, cause)| cause);
    cause.chars().filter(|c| !c.is_ascii_digit()).collect()
}

#[cfg(test)]
#[path = "unused_pictures_tests.rs"]
mod tests;
