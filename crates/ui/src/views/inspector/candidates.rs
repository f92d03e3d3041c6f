//! The landmarks that were looked for in a frame, as a table.

use egui::{Align2, Rect, Sense, Stroke, Ui, pos2, vec2};
use pilotage_core::navigator::{CandidateReport, FrameReport, Outcome, Run};

use super::super::parts::{self, figures};
use super::super::picking;
use crate::command::Command;
use crate::context::ViewContext;

/// Draws a row per landmark: name, score, second-best score, NIS, verdict. A click selects.
pub(super) fn show(ui: &mut Ui, context: &mut ViewContext<'_>, run: &Run, frame: &FrameReport) {
    let tokens = context.tokens;
    if frame.candidates.is_empty() {
        ui.label(
            egui::RichText::new("No landmark was near enough to be looked for.")
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
        return;
    }
    let height = 2.2 * tokens.text_sizes[0];
    let width = ui.available_width();
    let columns = columns(width, tokens.text_sizes[0]);
    let (head, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let painter = ui.painter_at(head);
    for (text, column) in ["landmark", "score", "second", "NIS"]
        .into_iter()
        .zip(columns)
    {
        let (at, align) = anchor(head, column);
        painter.text(at, align, text, parts::small(tokens), tokens.muted);
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    for candidate in &frame.candidates {
        row(ui, context, run, candidate, columns, height);
    }
}

/// Ends of the four columns (of the first: its begin), from the left.
fn columns(width: f32, text: f32) -> [(f32, bool); 4] {
    let right = width - 0.5 * text;
    [
        (1.4 * text, false),
        (right - 8.4 * text, true),
        (right - 4.2 * text, true),
        (right, true),
    ]
}

fn anchor(rect: Rect, (x, right): (f32, bool)) -> (egui::Pos2, Align2) {
    let align = if right {
        Align2::RIGHT_CENTER
    } else {
        Align2::LEFT_CENTER
    };
    (pos2(rect.left() + x, rect.center().y), align)
}

fn row(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    run: &Run,
    candidate: &CandidateReport,
    columns: [(f32, bool); 4],
    height: f32,
) {
    let tokens = context.tokens;
    let name = picking::landmark_name(run, candidate.landmark);
    let refusal = match candidate.outcome {
        Outcome::Accepted => None,
        Outcome::Refused(refusal) => Some(refusal),
    };
    let lines = if refusal.is_some() { 1.8 } else { 1.0 };
    let size = vec2(ui.available_width(), lines * height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let selected = context.selection == Some(candidate.landmark);
    let verdict = refusal.map_or("accepted".to_owned(), |r| {
        format!("refused: {}", r.reason())
    });
    response.widget_info(|| {
        egui::WidgetInfo::selected(
            egui::Role::Button,
            true,
            selected,
            format!("{name}, {verdict}"),
        )
    });
    let painter = ui.painter_at(rect);
    if selected || response.hovered() {
        painter.rect_filled(rect, 0.5 * tokens.radius, tokens.raised);
    }
    let first = Rect::from_min_size(rect.min, vec2(rect.width(), height));
    let at = first.left_center() + vec2(0.6 * tokens.text_sizes[0], 0.0);
    if refusal.is_some() {
        parts::cross(&painter, at, 3.0, Stroke::new(1.5, tokens.refused));
    } else {
        painter.circle_filled(at, 3.5, tokens.observed);
    }
    let values = [
        name,
        format!("{:.2}", candidate.score),
        format!("{:.2}", candidate.second_score),
        candidate.nis.map_or_else(|| "–".to_owned(), figures),
    ];
    for (text, column) in values.into_iter().zip(columns) {
        let (at, align) = anchor(first, column);
        painter.text(at, align, text, parts::small(tokens), tokens.text);
    }
    if let Some(refusal) = refusal {
        painter.text(
            pos2(rect.left() + columns[0].0, rect.bottom() - 0.4 * height),
            Align2::LEFT_CENTER,
            refusal.reason(),
            parts::small(tokens),
            tokens.refused,
        );
    }
    if response.clicked() {
        let selection = (!selected).then_some(candidate.landmark);
        context.commands.push(Command::SelectLandmark(selection));
    }
}
