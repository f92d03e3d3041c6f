//! The patch: features of a stage over it, and its edges.

use egui::{
    Align2, Color32, Painter, Pos2, Rect, RichText, Sense, Stroke, TextureId, Ui, pos2, vec2,
};
use pilotage_core::landmark::CascadeEvidence;
use pilotage_core::landmark::cascade::{HogPicture, edge_angle};

use super::drawn_feature::WindowPlan;
use super::words;
use crate::shell::icon_button;
use crate::shell::icons::Icon;
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::parts;

/// Most height of a patch, points.
const TALLEST: f32 = 240.0;

/// Patch and feature that are looked at.
#[derive(Debug, Default)]
pub(super) struct PatchState {
    /// The map's patch, not the picture's.
    on_map: bool,
    /// Number of the feature in its stage.
    feature: usize,
    /// The stage it was chosen in.
    stage: usize,
}

impl PatchState {
    /// Draws the features of a stage over the picture's or the map's patch, and the patch's edges.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        evidence: &CascadeEvidence,
        stage: usize,
        textures: [Option<TextureId>; 2],
        units: Units,
    ) {
        if self.stage != stage {
            (self.stage, self.feature) = (stage, 0);
        }
        let features = evidence.stages.get(stage).map_or(&[][..], |s| &s.features);
        self.feature = self.feature.min(features.len().saturating_sub(1));
        self.choices(ui, tokens, evidence, features.len());
        let (patch, texture) = if self.on_map {
            (&evidence.on_map, textures[1])
        } else {
            (&evidence.in_picture, textures[0])
        };
        let (Some(patch), Some(texture)) = (patch, texture) else {
            let hint = "No window of the picture was looked at.";
            parts::empty(ui, tokens, "No patch", hint);
            return;
        };
        let gap = 1.5 * tokens.space;
        let size = vec2(patch.pixels.width() as f32, patch.pixels.height() as f32);
        let each = 0.5 * (ui.available_width() - gap);
        let scale = (each / size.x).min(TALLEST / size.y);
        let caption = 1.5 * tokens.text_sizes[0];
        let whole = vec2(ui.available_width(), scale * size.y + caption);
        let (area, response) = ui.allocate_exact_size(whole, Sense::hover());
        let words = words::feature(evidence, stage, self.feature, Some(patch), units);
        parts::name(
            &response,
            format!("Patch with a feature of the stage. {words}"),
        );
        let painter = ui.painter_at(area);
        let (factor, unit) = units.length();
        let pixel = factor * evidence.window.gsd;
        let width = f64::from(size.x) * pixel;
        let captions = [
            format!("Stage {}, {width:.1} {unit} wide", stage + 1),
            format!(
                "Edges in cells of {:.1} {unit}",
                patch.hog.cell as f64 * pixel
            ),
        ];
        for (number, text) in captions.into_iter().enumerate() {
            let left = area.left() + (each + gap) * number as f32;
            let font = parts::small(tokens);
            painter.text(
                pos2(left, area.top()),
                Align2::LEFT_TOP,
                text,
                font,
                tokens.muted,
            );
            let corner = pos2(left, area.top() + caption);
            let rect = Rect::from_min_size(corner, scale * size);
            let tint = if number == 0 { 255 } else { 96 };
            let uv = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
            painter.image(texture, rect, uv, Color32::from_gray(tint));
            let painter = painter.with_clip_rect(rect);
            let plan = WindowPlan { corner, scale };
            if number == 0 {
                for feature in features {
                    plan.hint(&painter, tokens, feature);
                }
                let answer = patch.answers.get(stage).and_then(|a| a.get(self.feature));
                if let Some(feature) = features.get(self.feature) {
                    plan.paint(&painter, tokens, evidence.kind, feature, answer);
                }
            } else {
                paint_edges(&painter, tokens, &patch.hog, corner, scale);
            }
        }
        let verdict = words::verdict(evidence, stage, patch);
        for (text, color) in [(words, tokens.text), (verdict, tokens.text)] {
            ui.label(RichText::new(text).size(tokens.text_sizes[0]).color(color));
        }
        ui.label(
            RichText::new(strokes(&patch.hog))
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
    }

    /// Draws the choices of the patch and the feature.
    fn choices(&mut self, ui: &mut Ui, tokens: &Tokens, evidence: &CascadeEvidence, count: usize) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
            let choices = [
                (false, "Camera", "The best window of the camera picture"),
                (true, "Map", "The landmark on the map"),
            ];
            for (on_map, text, name) in choices {
                if parts::chip(ui, tokens, self.on_map == on_map, text, name).clicked() {
                    self.on_map = on_map;
                }
            }
            if count == 0 || evidence.stages.is_empty() {
                return;
            }
            ui.add_space(tokens.space);
            if icon_button(ui, tokens, Icon::StepBack, "Previous feature").clicked() {
                self.feature = (self.feature + count - 1) % count;
            }
            let text = format!("feature {} of {count}", self.feature + 1);
            ui.label(
                RichText::new(text)
                    .size(tokens.text_sizes[0])
                    .color(tokens.text),
            );
            if icon_button(ui, tokens, Icon::StepForward, "Next feature").clicked() {
                self.feature = (self.feature + 1) % count;
            }
        });
    }
}

/// The strongest of all strokes, grey levels.
fn strongest(hog: &HogPicture) -> f32 {
    let all = hog.strengths.pixels().iter().flatten();
    all.fold(0.0_f32, |most, s| most.max(*s))
}

/// Every direction of every cell as a stroke, the longer the stronger its edges.
fn paint_edges(painter: &Painter, tokens: &Tokens, hog: &HogPicture, corner: Pos2, scale: f32) {
    let most = strongest(hog).max(1e-6);
    let side = hog.cell as f32 * scale;
    let line = Stroke::new(0.5, tokens.sigma.gamma_multiply(0.15));
    for row in 0..hog.strengths.height() {
        for column in 0..hog.strengths.width() {
            let cell = corner + side * vec2(column as f32, row as f32);
            let rect = Rect::from_min_size(cell, vec2(side, side));
            painter.rect_stroke(rect, 0.0, line, egui::StrokeKind::Middle);
            let strengths = hog.strengths.get(column, row);
            for (direction, strength) in strengths.into_iter().enumerate() {
                let part = (strength / most).sqrt();
                if part < 0.12 {
                    continue;
                }
                let (sin, cos) = edge_angle(direction).sin_cos();
                let half = 0.48 * side * part * vec2(cos as f32, sin as f32);
                let observed = Tokens::over_imagery().observed;
                let color = observed.gamma_multiply(0.35 + 0.65 * part);
                let ends = [rect.center() - half, rect.center() + half];
                painter.line_segment(ends, Stroke::new(1.0 + part, color));
            }
        }
    }
}

/// Meaning of the strokes, in words.
fn strokes(hog: &HogPicture) -> String {
    format!(
        "Strokes lie along the edges of each cell; the longest stands for {:.0} grey levels.",
        strongest(hog)
    )
}
