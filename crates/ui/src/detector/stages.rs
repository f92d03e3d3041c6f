//! Windows as the stages reject them.

use egui::{Align2, Color32, ColorImage, Rect, Sense, Stroke, TextureId, Ui, pos2, vec2};
use pilotage_core::landmark::CascadeEvidence;

use super::command::DetectorCommand;
use super::ground::{GroundPlan, legend};
use super::words;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::icon_button;
use crate::shell::icons::Icon;
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::{color_map, parts};

/// Height of the ground with its numbers, points.
const HEIGHT: f32 = 248.0;
/// Least width of the counts beside it, points.
const COUNTS: f32 = 112.0;
/// Height of a row of the counts, points, where there are many.
const LEAST_ROW: f32 = 14.0;
/// Share of the windows up to which those that are left are painted.
const FEW: f64 = 0.05;

/// Colour of what a stage rejected: dark for early ones.
fn color(stage: usize, stages: usize) -> Color32 {
    let last = stages.saturating_sub(1).max(1);
    color_map::viridis(stage as f32 / last as f32)
}

/// A pixel for each window: the colour of the stage that rejected it among the first `passed`; what is left
/// is clear, or painted where it is little; what was not looked at is dark.
pub(super) fn windows(tokens: &Tokens, evidence: &CascadeEvidence, passed: usize) -> ColorImage {
    let stages = evidence.stages.len();
    let is_few = (evidence.left_after(passed) as f64) < FEW * evidence.windows as f64;
    let left = if is_few {
        tokens.accent
    } else {
        Color32::TRANSPARENT
    };
    let pixels = evidence
        .passed
        .pixels()
        .iter()
        .zip(evidence.scores.pixels());
    let pixels = pixels.map(|(of_window, score)| {
        let of_window = usize::from(*of_window);
        if !score.is_finite() {
            Color32::from_black_alpha(150)
        } else if of_window >= passed {
            left
        } else {
            color(of_window, stages).gamma_multiply(0.86)
        }
    });
    let size = [evidence.passed.width(), evidence.passed.height()];
    ColorImage::new(size, pixels.collect())
}

/// Draws the ground with what is rejected, and how many windows each stage leaves; the stage that
/// was clicked, if any.
pub(super) fn show(
    ui: &mut Ui,
    tokens: &Tokens,
    evidence: &CascadeEvidence,
    passed: usize,
    [ground, rejected]: [TextureId; 2],
    units: Units,
) -> Option<usize> {
    let width = ui.available_width();
    let room = vec2(width - COUNTS - 2.0 * tokens.space, HEIGHT);
    let size = GroundPlan::size_within(evidence, room);
    let rows = evidence.stages.len() as f32 + 2.0;
    let height = size.y.max((rows * LEAST_ROW).min(HEIGHT));
    let (area, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let what = words::left(evidence, passed);
    parts::name(
        &response,
        format!("Searched ground, windows coloured by the stage that rejected them. {what}"),
    );
    let plan = GroundPlan::within(evidence, Rect::from_min_size(area.min, size));
    let painter = ui.painter_at(area);
    plan.paint(&painter, Some(ground), rejected);
    plan.paint_axes(&painter, tokens, units);
    plan.paint_expected(&painter, tokens);
    plan.paint_marks(&painter, tokens, true);
    let left = plan.rect().right() + 1.5 * tokens.space;
    let counts = Rect::from_min_max(
        pos2(left, plan.rect().top()),
        pos2(area.right().min(left + 260.0), area.bottom()),
    );
    let chosen = funnel(ui, tokens, evidence, passed, counts);
    legend(ui, tokens, units);
    chosen
}

/// Windows left after each stage, bars by their logarithm; also the legend of the colours.
fn funnel(
    ui: &Ui,
    tokens: &Tokens,
    evidence: &CascadeEvidence,
    passed: usize,
    area: Rect,
) -> Option<usize> {
    let stages = evidence.stages.len();
    let painter = ui.painter();
    let head = 14.0;
    let text = |at, align, words: &str, color| {
        painter.text(at, align, words, parts::small(tokens), color);
    };
    text(area.left_top(), Align2::LEFT_TOP, "stage", tokens.muted);
    text(
        area.right_top(),
        Align2::RIGHT_TOP,
        "windows left",
        tokens.muted,
    );
    let row = ((area.height() - head) / (stages + 1) as f32).clamp(11.0, 20.0);
    let most = (1.0 + evidence.windows as f32).ln();
    let mut chosen = None;
    for stage in 0..=stages {
        let top = area.top() + head + row * stage as f32;
        let rect = Rect::from_min_size(pos2(area.left(), top), vec2(area.width(), row));
        let response = ui.interact(rect, ui.scope_id().with(("stage", stage)), Sense::click());
        let left = evidence.left_after(stage);
        let name = format!("Show {}", words::left(evidence, stage));
        let is_shown = stage == passed;
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::Role::Button, true, is_shown, name.clone())
        });
        if is_shown || response.hovered() || response.has_focus() {
            painter.rect_filled(rect, 3.0, tokens.hover());
        }
        if response.clicked() {
            chosen = Some(stage);
        }
        let ink = if is_shown { tokens.text } else { tokens.muted };
        let middle = rect.center().y;
        let number = if stage == 0 {
            "–".to_owned()
        } else {
            stage.to_string()
        };
        text(
            pos2(rect.left() + 16.0, middle),
            Align2::RIGHT_CENTER,
            &number,
            ink,
        );
        let swatch = Rect::from_center_size(pos2(rect.left() + 25.0, middle), vec2(8.0, row - 3.0));
        let of_stage = match stage.checked_sub(1) {
            Some(number) => color(number, stages),
            None => Color32::TRANSPARENT,
        };
        painter.rect_filled(swatch, 1.0, of_stage);
        let from = swatch.right() + 4.0;
        let room = (rect.right() - 44.0 - from).max(0.0);
        let length = room * (1.0 + left as f32).ln() / most.max(1e-6);
        let bar = Rect::from_min_size(pos2(from, middle - 2.0), vec2(length, 4.0));
        painter.rect_filled(bar, 2.0, if is_shown { tokens.accent } else { tokens.line });
        let left = words::count(left);
        text(
            pos2(rect.right() - 2.0, middle),
            Align2::RIGHT_CENTER,
            &left,
            ink,
        );
        if is_shown {
            let line = Stroke::new(1.0, tokens.accent);
            painter.vline(rect.left(), rect.y_range(), line);
        }
    }
    chosen
}

/// Play, one stage back and on, a slider, and what is left in words.
pub(super) fn controls(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    evidence: &CascadeEvidence,
    (passed, is_playing): (usize, bool),
) {
    let tokens = context.tokens;
    let stages = evidence.stages.len();
    let mut send = |command| context.commands.push(Command::from(command));
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.25 * tokens.space;
        let (icon, label) = if is_playing {
            (Icon::Pause, "Stop at this stage (Shift Z)")
        } else {
            (Icon::Play, "Let the stages pass (Shift Z)")
        };
        if icon_button(ui, tokens, icon, label).clicked() {
            send(DetectorCommand::Play);
        }
        if icon_button(ui, tokens, Icon::StepBack, "One stage back (,)").clicked() {
            send(DetectorCommand::Stages(-1));
        }
        if icon_button(ui, tokens, Icon::StepForward, "One stage on (.)").clicked() {
            send(DetectorCommand::Stages(1));
        }
        let mut chosen = passed;
        ui.spacing_mut().slider_width = (ui.available_width() - 2.0 * tokens.space).max(60.0);
        let slider = egui::Slider::new(&mut chosen, 0..=stages).show_value(false);
        let name = "Stages that have rejected their windows";
        let response = ui.add(slider).accessible_name(name);
        if response.changed() {
            send(DetectorCommand::Stages(chosen as i32 - passed as i32));
        }
    });
    ui.label(
        egui::RichText::new(words::left(evidence, passed))
            .size(tokens.text_sizes[0])
            .color(tokens.text),
    );
}
