//! Expectations and detections of the navigator, drawn over the camera picture.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};
use pilotage_core::navigator::{CandidateReport, FrameReport, Outcome, Run};
use pilotage_core::sorting::sort;

use super::super::{ellipse, parts, picking};
use super::placement::CameraPlacement;
use crate::context::ViewContext;
use crate::tokens::Tokens;

/// Radius of the ring at a predicted place, points.
const RING: f32 = 7.0;
/// Half the size of the mark at a found place, points.
const MARK: f32 = 5.0;
/// Up to this many candidates the reasons of those refused are written beside them.
const FEW: usize = 3;

/// Draws every candidate of `report`, the selected and the hovered one with more weight.
pub(super) fn draw(
    painter: &Painter,
    context: &ViewContext<'_>,
    run: &Run,
    report: &FrameReport,
    placement: &CameraPlacement,
    near: Option<u32>,
    taken: &mut Vec<Rect>,
) {
    let tokens = context.tokens;
    for candidate in &report.candidates {
        let strong =
            context.selection == Some(candidate.landmark) || near == Some(candidate.landmark);
        region(painter, tokens, placement, candidate, strong);
    }
    for candidate in &report.candidates {
        marks(painter, tokens, placement, candidate);
    }
    for candidate in &report.candidates {
        let pixels = [Some(candidate.predicted_pixel), candidate.measured_pixel];
        let marks = pixels.into_iter().flatten().map(|p| placement.at(&p));
        taken.extend(marks.map(|at| Rect::from_center_size(at, vec2(2.0 * MARK, 2.0 * MARK))));
    }
    // What matters most finds its place first; where there are many, the reasons of those refused
    // are left to the pointer and the match view.
    let strong =
        |c: &CandidateReport| context.selection == Some(c.landmark) || near == Some(c.landmark);
    let mut order: Vec<&CandidateReport> = report.candidates.iter().collect();
    let last = |c: &CandidateReport| (!strong(c), c.outcome != Outcome::Accepted);
    sort(&mut order, &|a, b| last(a).cmp(&last(b)));
    for candidate in order {
        let reason = strong(candidate) || report.candidates.len() <= FEW;
        label(painter, tokens, run, placement, candidate, reason, taken);
    }
    if let Some(trouble) = &report.trouble {
        let at = painter.clip_rect().left_bottom() + vec2(tokens.space, -3.0 * tokens.space);
        parts::tag(painter, tokens, at, trouble, tokens.warning, taken);
    }
}

/// Search outline, dashed, and the gate's ellipse around the predicted place.
fn region(
    painter: &Painter,
    tokens: &Tokens,
    placement: &CameraPlacement,
    candidate: &CandidateReport,
    strong: bool,
) {
    let width = if strong { 1.5 } else { 1.0 };
    let mut outline: Vec<Pos2> = candidate
        .search_outline
        .iter()
        .map(|p| placement.at(p))
        .collect();
    if let Some(first) = outline.first().copied() {
        outline.push(first);
        let color = tokens.sigma.gamma_multiply(if strong { 0.9 } else { 0.45 });
        painter.extend(Shape::dashed_line(
            &outline,
            Stroke::new(width, color),
            4.0,
            4.0,
        ));
    }
    let gate: Vec<Pos2> =
        ellipse::outline(&candidate.innovation_covariance, candidate.threshold, 48)
            .into_iter()
            .map(|offset| placement.at(&(candidate.predicted_pixel + offset)))
            .collect();
    outlined_line(painter, tokens, gate, width, tokens.sigma);
}

/// Ring at the predicted place, shape at the found one, and the line that joins them.
fn marks(
    painter: &Painter,
    tokens: &Tokens,
    placement: &CameraPlacement,
    candidate: &CandidateReport,
) {
    let predicted = placement.at(&candidate.predicted_pixel);
    let dark = Stroke::new(3.5, parts::rim(tokens));
    painter.circle_stroke(predicted, RING, dark);
    painter.circle_stroke(predicted, RING, Stroke::new(1.5, tokens.sigma));
    match (candidate.outcome, candidate.measured_pixel) {
        (Outcome::Accepted, Some(pixel)) => {
            let found = placement.at(&pixel);
            outlined_line(
                painter,
                tokens,
                vec![predicted, found],
                1.5,
                tokens.observed,
            );
            painter.circle(
                found,
                MARK,
                tokens.observed,
                Stroke::new(1.5, parts::rim(tokens)),
            );
        }
        (Outcome::Refused(_), Some(pixel)) => {
            let found = placement.at(&pixel);
            let faint = Stroke::new(1.0, tokens.refused);
            painter.extend(Shape::dashed_line(&[predicted, found], faint, 3.0, 3.0));
            cross(painter, tokens, found);
        }
        (_, None) => cross(painter, tokens, predicted),
    }
}

/// Name with score, and for refused ones the reason.
fn label(
    painter: &Painter,
    tokens: &Tokens,
    run: &Run,
    placement: &CameraPlacement,
    candidate: &CandidateReport,
    reason: bool,
    taken: &mut Vec<Rect>,
) {
    let anchor = placement.at(&candidate
        .measured_pixel
        .unwrap_or(candidate.predicted_pixel));
    if !painter.clip_rect().expand(RING).contains(anchor) {
        return;
    }
    let name = picking::landmark_name(run, candidate.landmark);
    let (text, color) = match candidate.outcome {
        Outcome::Accepted => (format!("{name}, score {:.2}", candidate.score), tokens.text),
        Outcome::Refused(refusal) if reason => (
            format!(
                "{name}, score {:.2}\n{}",
                candidate.score,
                picking::reason(run, candidate, refusal)
            ),
            tokens.refused,
        ),
        Outcome::Refused(_) => (
            format!("{name}, score {:.2}", candidate.score),
            tokens.refused,
        ),
    };
    let at = anchor + vec2(RING + 4.0, -RING);
    parts::tag(painter, tokens, at, &text, color, taken);
}

/// Everything about one candidate in words.
pub(super) fn explain(run: &Run, candidate: &CandidateReport) -> String {
    let name = picking::landmark_name(run, candidate.landmark);
    let verdict = match candidate.outcome {
        Outcome::Accepted => "accepted: it corrected the estimate".to_owned(),
        Outcome::Refused(refusal) => {
            format!("refused: {}", picking::reason(run, candidate, refusal))
        }
    };
    let distance = candidate.innovation.map_or_else(String::new, |v| {
        format!(
            "\nFound {} px from where it was expected",
            parts::figures(v.norm())
        )
    });
    let nis = candidate.nis.map_or_else(String::new, |nis| {
        format!(
            "\nNIS {} of at most {}",
            parts::figures(nis),
            parts::figures(candidate.threshold)
        )
    });
    format!(
        "{name}, {verdict}{distance}\nScore {:.2}, second-best place {:.2}{nis}\nRing and ellipse: expected place and gate. Dashed: where it was searched.",
        candidate.score, candidate.second_score
    )
}

/// A cross in the colour of refusals.
fn cross(painter: &Painter, tokens: &Tokens, at: Pos2) {
    for (a, b) in [
        (vec2(-MARK, -MARK), vec2(MARK, MARK)),
        (vec2(-MARK, MARK), vec2(MARK, -MARK)),
    ] {
        outlined_line(painter, tokens, vec![at + a, at + b], 2.0, tokens.refused);
    }
}

/// A line with a dark rim, so that it shows on any ground.
fn outlined_line(
    painter: &Painter,
    tokens: &Tokens,
    points: Vec<Pos2>,
    width: f32,
    color: Color32,
) {
    let rim = parts::rim(tokens);
    painter.line(points.clone(), Stroke::new(width + 2.0, rim));
    painter.line(points, Stroke::new(width, color));
}
