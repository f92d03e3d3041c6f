//! The score at every place of the searched ground.

use egui::{Align2, Painter, Rect, RichText, Sense, Stroke, TextureId, Ui, pos2, vec2};
use pilotage_core::filter::probability_words;
use pilotage_core::landmark::{CascadeEvidence, MarkedPlace};

use super::ground::{GroundPlan, legend};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::parts::{self, figures};
use crate::views::{chart, color_map};

/// Height of the ground with its numbers, points.
const HEIGHT: f32 = 220.0;
/// Width of the colour scale with its numbers, points.
const SCALE: f32 = 76.0;
const BAR: f32 = 10.0;
/// Meaning of scores, in words.
const MEANING: &str = "0 or more: the window passed every stage by so much. Below 0: one less for each stage \
                       that it did not reach.";

/// Scores at the two ends of the colour scale.
pub(super) fn range(evidence: &CascadeEvidence) -> (f32, f32) {
    let (low, high) = color_map::range(&evidence.scores).unwrap_or((-1.0, 1.0));
    (low, high.max(low + 1.0))
}

/// Draws the surface with the places found, its colour scale, and what was found in numbers.
pub(super) fn show(
    ui: &mut Ui,
    tokens: &Tokens,
    evidence: &CascadeEvidence,
    score: TextureId,
    units: Units,
) {
    let width = ui.available_width();
    let room = vec2(width - SCALE - 2.0 * tokens.space, HEIGHT);
    let size = GroundPlan::size_within(evidence, room);
    let (area, response) = ui.allocate_exact_size(vec2(width, size.y), Sense::hover());
    parts::name(
        &response,
        format!("Score of every window. {}", best(evidence, units)),
    );
    let plan = GroundPlan::within(evidence, Rect::from_min_size(area.min, size));
    let painter = ui.painter_at(area);
    painter.rect_filled(plan.rect(), 0.0, tokens.raised);
    plan.paint(&painter, None, score);
    plan.paint_axes(&painter, tokens, units);
    plan.paint_expected(&painter, tokens);
    plan.paint_marks(&painter, tokens, false);
    let left = plan.rect().right() + 2.0 * tokens.space;
    let bar = Rect::from_min_max(
        pos2(left, plan.rect().top() + 16.0),
        pos2(left + BAR, plan.rect().bottom()),
    );
    scale(&painter, tokens, evidence, bar);
    legend(ui, tokens, units);
    ui.label(
        RichText::new(MEANING)
            .size(tokens.text_sizes[0])
            .color(tokens.muted),
    );
    let words = [
        ("Best", evidence.marks.first()),
        ("Second best", evidence.marks.get(1)),
    ];
    for (name, mark) in words {
        let Some(mark) = mark else { continue };
        let color = if mark.score >= evidence.least_score {
            tokens.text
        } else {
            tokens.refused
        };
        let label = format!("{name} score (at least {})", figures(evidence.least_score));
        let reading = parts::NumberReadout::new(label, figures(mark.score), "").color(color);
        parts::reading(ui, tokens, &reading);
    }
    let Some(best) = evidence.marks.first() else {
        return;
    };
    let chance = probability_words(best.probability);
    let reading = parts::NumberReadout::new("Probability that this score is right", chance, "");
    parts::reading(ui, tokens, &reading);
    let names = ["North of where expected", "East of where expected"];
    let (factor, unit) = units.length();
    for (name, value) in names.into_iter().zip(offset(evidence, best)) {
        let reading = parts::NumberReadout::new(name, parts::brief(factor * value), unit);
        parts::reading(ui, tokens, &reading);
    }
}

/// Offset of a place north and east of where it is expected, metres.
fn offset(evidence: &CascadeEvidence, mark: &MarkedPlace) -> [f64; 2] {
    [
        mark.ground.north - evidence.expected.north,
        mark.ground.east - evidence.expected.east,
    ]
}

/// The best place in words.
fn best(evidence: &CascadeEvidence, units: Units) -> String {
    let Some(mark) = evidence.marks.first() else {
        return "No place found".to_owned();
    };
    let (factor, unit) = units.length();
    let [north, east] = offset(evidence, mark).map(|value| factor * value);
    let score = figures(mark.score);
    format!(
        "Best {north:.1} {unit} north and {east:.1} {unit} east of where expected, score {score}"
    )
}

/// The colours and the scores that they stand for; from zero on every stage was passed.
fn scale(painter: &Painter, tokens: &Tokens, evidence: &CascadeEvidence, bar: Rect) {
    let (low, high) = range(evidence);
    let at = |score: f64| {
        let fraction = (score - f64::from(low)) / f64::from(high - low);
        bar.bottom() - bar.height() * fraction as f32
    };
    let steps = 48;
    for i in 0..steps {
        let part = bar.height() / steps as f32;
        let top = bar.bottom() - part * (i + 1) as f32;
        let slice = Rect::from_min_size(pos2(bar.left(), top), vec2(bar.width(), part + 0.5));
        painter.rect_filled(
            slice,
            0.0,
            color_map::viridis(i as f32 / (steps - 1) as f32),
        );
    }
    let text = |y: f32, words: &str| {
        let (at, font) = (pos2(bar.right() + 6.0, y), parts::small(tokens));
        painter.text(at, Align2::LEFT_CENTER, words, font, tokens.muted);
    };
    let head = pos2(bar.left(), bar.top() - 15.0);
    painter.text(
        head,
        Align2::LEFT_TOP,
        "score",
        parts::small(tokens),
        tokens.muted,
    );
    for tick in chart::ticks(f64::from(low), f64::from(high), 5) {
        let near_zero = (at(tick) - at(0.0)).abs() < 12.0;
        if tick == 0.0 || !near_zero {
            text(at(tick), &label(tick));
        }
    }
    if low < 0.0 && high > 0.0 {
        painter.hline(bar.x_range(), at(0.0), Stroke::new(1.5, tokens.text));
    }
}

/// A number at the scale.
fn label(tick: f64) -> String {
    let decimals = usize::from(tick.fract() != 0.0);
    format!("{:.decimals$}", tick + 0.0).replace('-', "−")
}
