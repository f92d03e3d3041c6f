//! Explanations of a search, in words.

use pilotage_core::landmark::cascade::CascadeKind;
use pilotage_core::landmark::{CascadeEvidence, PatchLook};

use crate::units::Units;
use crate::views::parts::figures;

/// A whole number with its thousands apart.
pub(super) fn count(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// A share in percent, small ones with more digits.
pub(super) fn percent(part: usize, whole: usize) -> String {
    let share = 100.0 * part as f64 / whole.max(1) as f64;
    if part > 0 && share < 0.1 {
        format!("{share:.3} %")
    } else {
        format!("{share:.1} %")
    }
}

/// Unit that is counted where a tree has one feature or several.
fn asked(evidence: &CascadeEvidence) -> &'static str {
    let one = |stage: &pilotage_core::landmark::StageLook| stage.features.len() == stage.votes;
    if evidence.stages.iter().all(one) {
        "features"
    } else {
        "trees"
    }
}

/// Why a cascade is fast, in the figures of this search.
pub(super) fn lesson(evidence: &CascadeEvidence) -> String {
    let (all, mean) = (evidence.all_votes(), evidence.mean_votes);
    let times = all as f64 / mean.max(1e-9);
    format!(
        "Each window, a place where the landmark may be, is tested by {mean:.1} {} on average; all {all} everywhere would take \
         {times:.1} times as long.",
        asked(evidence)
    )
}

/// Number of windows that are left after so many stages, in words.
pub(super) fn left(evidence: &CascadeEvidence, passed: usize) -> String {
    let (left, all) = (evidence.left_after(passed), evidence.windows);
    if passed == 0 {
        return format!("Before the first stage: all {} windows", count(all));
    }
    format!(
        "After stage {passed} of {}: {} of {} windows left ({})",
        evidence.stages.len(),
        count(left),
        count(all),
        percent(left, all)
    )
}

/// Verdict of a stage on a patch: its votes beside those it needs.
pub(super) fn verdict(evidence: &CascadeEvidence, stage: usize, patch: &PatchLook) -> String {
    let (Some(look), Some(answers)) = (evidence.stages.get(stage), patch.answers.get(stage)) else {
        return String::new();
    };
    if answers.is_empty() {
        return "The patch is too flat to be asked anything.".to_owned();
    }
    // Every node of a tree tells the vote of the tree.
    let mut votes = 0.0;
    let mut tree = None;
    for (feature, answer) in look.features.iter().zip(answers) {
        if tree != Some(feature.tree) {
            votes += answer.vote;
        }
        tree = Some(feature.tree);
    }
    let passes = if votes >= look.threshold {
        "it passes"
    } else {
        "it is rejected"
    };
    format!(
        "Votes of this patch {}, at least {} needed: {passes}.",
        signed(votes),
        signed(look.threshold)
    )
}

/// Question of a feature of a stage, and the answer of this patch.
pub(super) fn feature(
    evidence: &CascadeEvidence,
    stage: usize,
    number: usize,
    patch: Option<&PatchLook>,
    units: Units,
) -> String {
    let look = evidence.stages.get(stage);
    let Some(shown) = look.and_then(|look| look.features.get(number)) else {
        return String::new();
    };
    let what = match evidence.kind {
        CascadeKind::Hog => {
            let direction = shown.direction.unwrap_or_default();
            let edge = pilotage_core::landmark::cascade::edge_angle(direction).to_degrees();
            // Angles of pictures run from right towards down; people measure from right towards up.
            let edge = (180.0 - edge).rem_euclid(180.0);
            let block = shown.areas.get(1).map_or(0, |(area, _)| area[2]);
            let (factor, unit) = units.length();
            let across = factor * f64::from(block) * evidence.window.gsd;
            format!(
                "Edges at {edge:.0}° in the filled cell, as a share of all in its block ({across:.1} {unit} wide)"
            )
        }
        CascadeKind::Lbp => {
            "Which of eight blocks are at least as bright as the middle one".to_owned()
        }
        CascadeKind::Haar => "Mean brightness: amber counts up, blue down".to_owned(),
    };
    let answer = patch
        .and_then(|patch| patch.answers.get(stage)?.get(number))
        .map(|answer| match answer.threshold {
            Some(threshold) => format!(
                ": {}, compared with {}; votes {}.",
                figures(f64::from(answer.value)),
                figures(f64::from(threshold)),
                signed(answer.vote)
            ),
            None => format!(
                ": pattern {:.0} of 256; votes {}.",
                answer.value,
                signed(answer.vote)
            ),
        });
    format!("{what}{}", answer.unwrap_or_else(|| ".".to_owned()))
}

/// A number with its sign.
fn signed(value: f32) -> String {
    let text = figures(f64::from(value));
    if value > 0.0 {
        format!("+{text}")
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_have_their_thousands_apart_and_small_shares_their_digits() {
        assert_eq!(count(7), "7");
        assert_eq!(count(12_321), "12\u{202f}321");
        assert_eq!(count(1_000_000), "1\u{202f}000\u{202f}000");
        assert_eq!(percent(412, 12_321), "3.3 %");
        assert_eq!(percent(3, 12_321), "0.024 %");
        assert_eq!(percent(0, 12_321), "0.0 %");
    }
}
