//! Sigma points of a step on the position plane, at the four moments of the filter.

use egui::{Align2, Color32, Pos2, Rect, Sense, Stroke, Ui, vec2};
use nalgebra::DMatrix;
use pilotage_core::navigator::{Estimate, StepReport};

use super::super::chart::ticks;
use super::super::{ellipse, parts};
use crate::tokens::Tokens;
use crate::units::Units;

/// Moments that are drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stages {
    shown: [bool; 4],
}

impl Default for Stages {
    fn default() -> Self {
        Self {
            shown: [false, true, false, true],
        }
    }
}

/// Names of the four moments.
const NAMES: [&str; 4] = [
    "before predict",
    "after predict",
    "into correct",
    "after correct",
];

impl Stages {
    /// Draws the points of the chosen moments, each with the 1σ ellipse it stands for.
    pub fn show(&mut self, ui: &mut Ui, tokens: &Tokens, step: &StepReport, units: Units) {
        let sets: [Option<(&DMatrix<f64>, &Estimate)>; 4] = [
            Some((&step.sigma.before_predict, &step.before)),
            Some((&step.sigma.after_predict, &step.predicted)),
            step.sigma
                .before_correct
                .as_ref()
                .map(|s| (s, &step.predicted)),
            step.sigma.after_correct.as_ref().map(|s| (s, &step.after)),
        ];
        let colors = [
            tokens.muted,
            tokens.dead_reckoning,
            parts::ink(tokens),
            tokens.corrected,
        ];
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = egui::Vec2::splat(0.5 * tokens.space);
            for (i, name) in NAMES.into_iter().enumerate() {
                if sets[i].is_none() {
                    continue;
                }
                let on = self.shown[i];
                let label = format!("Sigma points {name}");
                let response = parts::chip(ui, tokens, on, &format!("     {name}"), &label);
                let at = response.rect.left_center() + vec2(1.5 * tokens.space, 0.0);
                mark(ui.painter(), at, i, colors[i], false);
                if response.clicked() {
                    self.shown[i] = !on;
                }
            }
        });
        ui.add_space(0.5 * tokens.space);
        let width = ui.available_width();
        let size = vec2(width, (0.6 * width).min(220.0));
        let (area, response) = ui.allocate_exact_size(size, Sense::hover());
        parts::name(&response, "Sigma points on the ground, north up");
        let painter = ui.painter_at(area);
        painter.rect_filled(area, tokens.radius, tokens.background);
        // The plane stays where the prediction is, wide enough for the widest set.
        let center = step.predicted.position();
        let reach = sets
            .iter()
            .flatten()
            .flat_map(|(set, _)| set.column_iter())
            .map(|p| (p[0] - center.north).abs().max((p[1] - center.east).abs()))
            .fold(0.0, f64::max)
            .max(0.05);
        let (factor, unit) = units.length();
        let scale = 0.5 * size.y / (1.15 * reach) as f32;
        let at = |north: f64, east: f64| {
            area.center() + vec2((east - center.east) as f32, (center.north - north) as f32) * scale
        };
        grid(&painter, tokens, area, f64::from(scale) / factor, unit);
        for (i, set) in sets.iter().enumerate() {
            let Some((points, estimate)) = set.filter(|_| self.shown[i]) else {
                continue;
            };
            let outline: Vec<Pos2> = ellipse::outline(&estimate.position_covariance(), 1.0, 48)
                .into_iter()
                .map(|v| at(estimate.mean[0] + v.x, estimate.mean[1] + v.y))
                .collect();
            painter.line(outline, Stroke::new(1.0, colors[i].gamma_multiply(0.7)));
            for (k, point) in points.column_iter().enumerate() {
                mark(&painter, at(point[0], point[1]), i, colors[i], k == 0);
            }
        }
    }
}

/// The mark of one point: another shape for every moment, the centre point larger.
fn mark(painter: &egui::Painter, at: Pos2, stage: usize, color: Color32, center: bool) {
    let r = if center { 4.5 } else { 3.0 };
    let stroke = Stroke::new(1.5, color);
    match stage {
        0 => {
            painter.circle_stroke(at, r, stroke);
        }
        1 => {
            let points = [vec2(0.0, -r), vec2(r, 0.0), vec2(0.0, r), vec2(-r, 0.0)];
            let outline = points.map(|p| at + 1.2 * p).to_vec();
            painter.add(egui::Shape::closed_line(outline, stroke));
        }
        2 => {
            let rect = Rect::from_center_size(at, egui::Vec2::splat(1.8 * r));
            painter.rect_stroke(rect, 0.0, stroke, egui::StrokeKind::Middle);
        }
        _ => {
            painter.circle_filled(at, r, color);
        }
    }
}

/// A scale bar and crossed lines through the prediction; `scale` in points per unit on screen.
fn grid(painter: &egui::Painter, tokens: &Tokens, area: Rect, scale: f64, unit: &str) {
    let line = Stroke::new(0.5, tokens.line);
    painter.hline(area.x_range(), area.center().y, line);
    painter.vline(area.center().x, area.y_range(), line);
    let wanted = f64::from(0.3 * area.width()) / scale;
    let length = ticks(0.0, wanted, 2).last().copied().unwrap_or(wanted);
    let right = area.right_bottom() + vec2(-tokens.space, -tokens.space);
    let left = right - vec2((length * scale) as f32, 0.0);
    painter.line_segment([left, right], Stroke::new(2.0, tokens.muted));
    painter.text(
        left - vec2(0.5 * tokens.space, 0.0),
        Align2::RIGHT_CENTER,
        format!("{length} {unit}"),
        parts::small(tokens),
        tokens.muted,
    );
    painter.text(
        area.left_top() + vec2(0.75 * tokens.space, 0.5 * tokens.space),
        Align2::LEFT_TOP,
        "north up",
        parts::small(tokens),
        tokens.muted,
    );
}
