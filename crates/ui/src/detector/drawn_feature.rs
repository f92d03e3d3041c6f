//! A feature drawn over the window.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};
use pilotage_core::landmark::cascade::{CascadeKind, FeatureAnswer, ShownFeature, edge_angle};

use crate::tokens::Tokens;
use crate::views::parts;

/// Blocks of an LBP feature in the order of the bits of its code, the highest first.
const AROUND: [usize; 8] = [0, 1, 2, 5, 8, 7, 6, 3];

/// Place of a window on the screen.
#[derive(Clone, Copy)]
pub(super) struct WindowPlan {
    /// Its upper left corner.
    pub corner: Pos2,
    /// Points in a pixel.
    pub scale: f32,
}

impl WindowPlan {
    fn at(&self, x: i32, y: i32) -> Pos2 {
        self.corner + vec2(x as f32, y as f32) * self.scale
    }

    fn rect(&self, [x, y, w, h]: [i32; 4]) -> Rect {
        Rect::from_min_max(self.at(x, y), self.at(x + w, y + h))
    }

    /// Corners of a rectangle, turned by 45° if `tilted`.
    fn corners(&self, [x, y, w, h]: [i32; 4], tilted: bool) -> Vec<Pos2> {
        if tilted {
            vec![
                self.at(x, y),
                self.at(x + w, y + w),
                self.at(x + w - h, y + w + h),
                self.at(x - h, y + h),
            ]
        } else {
            let rect = self.rect([x, y, w, h]);
            vec![
                rect.left_top(),
                rect.right_top(),
                rect.right_bottom(),
                rect.left_bottom(),
            ]
        }
    }

    /// Draws a feature; what a patch answers to it tells the bright blocks of a binary pattern.
    pub fn paint(
        &self,
        painter: &Painter,
        tokens: &Tokens,
        kind: CascadeKind,
        feature: &ShownFeature,
        answer: Option<&FeatureAnswer>,
    ) {
        match kind {
            CascadeKind::Hog => self.paint_hog(painter, tokens, feature),
            CascadeKind::Haar => {
                for (area, weight) in &feature.areas {
                    let color = if *weight > 0.0 { UP } else { DOWN };
                    let corners = self.corners(*area, feature.tilted);
                    let fill = color.gamma_multiply(0.5);
                    painter.add(Shape::convex_polygon(
                        corners,
                        fill,
                        Stroke::new(1.5, color),
                    ));
                }
            }
            CascadeKind::Lbp => self.paint_pattern(painter, tokens, feature, answer),
        }
    }

    fn paint_hog(&self, painter: &Painter, tokens: &Tokens, feature: &ShownFeature) {
        let [Some((cell, _)), Some((block, _))] = [0, 1].map(|i| feature.areas.get(i)) else {
            return;
        };
        let (cell, block) = (self.rect(*cell), self.rect(*block));
        outline(painter, tokens, block, UP, 1.5);
        painter.hline(block.x_range(), block.center().y, Stroke::new(0.75, UP));
        painter.vline(block.center().x, block.y_range(), Stroke::new(0.75, UP));
        painter.rect_filled(cell, 0.0, UP.gamma_multiply(0.35));
        let Some(direction) = feature.direction else {
            return;
        };
        let (sin, cos) = edge_angle(direction).sin_cos();
        let half = 0.42 * cell.size().min_elem() * vec2(cos as f32, sin as f32);
        let ends = [cell.center() - half, cell.center() + half];
        painter.line_segment(ends, Stroke::new(4.5, parts::rim(tokens)));
        painter.line_segment(ends, Stroke::new(2.5, Tokens::over_imagery().observed));
    }

    fn paint_pattern(
        &self,
        painter: &Painter,
        tokens: &Tokens,
        feature: &ShownFeature,
        answer: Option<&FeatureAnswer>,
    ) {
        let code = answer.map(|a| a.value as usize);
        for (number, (area, _)) in feature.areas.iter().enumerate() {
            let rect = self.rect(*area);
            let bit = AROUND.iter().position(|block| *block == number);
            let fill = match (bit, code) {
                (None, _) => UP.gamma_multiply(0.5),
                (Some(bit), Some(code)) if code >> (7 - bit) & 1 == 1 => {
                    Color32::from_white_alpha(130)
                }
                (Some(_), Some(_)) => Color32::from_black_alpha(130),
                _ => Color32::TRANSPARENT,
            };
            painter.rect_filled(rect, 0.0, fill);
            outline(painter, tokens, rect, UP, 1.0);
        }
    }

    /// Draws where a feature lies, for those that are not looked at.
    pub fn hint(&self, painter: &Painter, tokens: &Tokens, feature: &ShownFeature) {
        if let Some((area, _)) = feature.areas.first() {
            let mut corners = self.corners(*area, feature.tilted);
            corners.extend(corners.first().copied());
            let stroke = Stroke::new(0.75, tokens.sigma.gamma_multiply(0.45));
            painter.add(Shape::line(corners, stroke));
        }
    }
}

/// Colours of areas that count up, and of those that count down.
const UP: Color32 = Color32::from_rgb(240, 180, 41);
const DOWN: Color32 = Color32::from_rgb(86, 156, 255);

fn outline(painter: &Painter, tokens: &Tokens, rect: Rect, color: Color32, width: f32) {
    let kind = egui::StrokeKind::Middle;
    painter.rect_stroke(
        rect,
        0.0,
        Stroke::new(width + 1.5, parts::rim(tokens)),
        kind,
    );
    painter.rect_stroke(rect, 0.0, Stroke::new(width, color), kind);
}
