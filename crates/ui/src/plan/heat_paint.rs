//! The heat map on the map, its legend, and what it says below the pointer.

use egui::epaint::{Mesh, Vertex};
use egui::{Align2, Color32, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, StrokeKind, Ui};
use egui::{WidgetInfo, pos2, vec2};

use super::heat::{BLIND, blind_color};
use super::planner::Planner;
use crate::map::{ScreenFromWorld, paint_halo_text};
use crate::tokens::Tokens;
use crate::views::color_map::viridis;
use pilotage_jobs::FixesFrom;

/// Size of the legend, points.
const LEGEND: egui::Vec2 = vec2(232.0, 58.0);

impl Planner {
    /// Draws the heat map, if it is to be shown.
    pub(crate) fn paint_heat(&self, painter: &Painter, view: &ScreenFromWorld) {
        let heat = &self.preferences.heat;
        let (Some(field), Some(texture)) = (self.heat.field(), self.heat.texture()) else {
            return;
        };
        if !heat.shown {
            return;
        }
        let tint = Color32::WHITE.gamma_multiply(heat.opacity);
        let corners = view.corners(&field.bounds);
        let uv = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let mut mesh = Mesh::with_texture(texture.id());
        for (pos, (u, v)) in corners.into_iter().zip(uv) {
            mesh.vertices.push(Vertex {
                pos,
                uv: pos2(u, v),
                color: tint,
            });
        }
        mesh.add_triangle(0, 1, 2);
        mesh.add_triangle(0, 2, 3);
        painter.add(Shape::mesh(mesh));
    }

    /// Writes the probability below the pointer beside it.
    pub(crate) fn paint_heat_readout(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        pointer: Pos2,
        tokens: &Tokens,
    ) {
        if !self.preferences.heat.shown {
            return;
        }
        let value = self.heat.field().and_then(|f| f.at(&view.inverse(pointer)));
        let Some(value) = value else { return };
        let text = readout(value);
        let at = pointer + vec2(16.0, 20.0);
        paint_halo_text(
            painter,
            at,
            Align2::LEFT_TOP,
            &text,
            tokens.normal(),
            tokens.sigma,
        );
    }

    /// Draws the legend from `left_top` on; returns what it covers.
    pub fn heat_legend(&self, ui: &Ui, tokens: &Tokens, left_top: Pos2) -> Option<Rect> {
        let heat = &self.preferences.heat;
        if !heat.shown {
            return None;
        }
        let rect = Rect::from_min_size(left_top, LEGEND);
        let title = match (heat.blind, heat.of) {
            (true, _) => "Blind areas",
            (false, FixesFrom::Landmarks) => "Probability of a fix, landmarks",
            (false, FixesFrom::Map) => "Probability of a fix, map alone",
        };
        let state = match (self.heat.under_way(), self.heat.trouble()) {
            (Some((share, _)), _) => format!("{:.0} %", 100.0 * share),
            (None, Some(_)) => "impossible".to_owned(),
            (None, None) if !self.heat.is_complete() => "not all known".to_owned(),
            (None, None) => String::new(),
        };
        let response = ui.interact(rect, ui.scope_id().with("heat legend"), Sense::hover());
        let words = format!("Legend: {title}, 0 to 1. {state}");
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words.clone()));
        let painter = ui.painter();
        painter.rect_filled(rect, tokens.radius, tokens.over_map());
        let line = Stroke::new(1.0, tokens.line);
        painter.rect_stroke(rect, tokens.radius, line, StrokeKind::Inside);
        let inner = rect.shrink2(vec2(10.0, 7.0));
        let small = tokens.small();
        let top = inner.left_top();
        painter.text(top, Align2::LEFT_TOP, title, small.clone(), tokens.text);
        let right = inner.right_top();
        painter.text(right, Align2::RIGHT_TOP, state, small.clone(), tokens.muted);
        if heat.blind {
            let swatch =
                Rect::from_min_size(pos2(inner.left(), inner.top() + 22.0), vec2(28.0, 14.0));
            painter.rect_filled(
                swatch,
                2.0,
                blind_color().gamma_multiply(heat.opacity.max(0.3)),
            );
            let at = swatch.right_center() + vec2(8.0, 0.0);
            let text = format!("a fix less likely than {BLIND:.1}");
            painter.text(at, Align2::LEFT_CENTER, text, small, tokens.muted);
            return Some(rect);
        }
        let bar = Rect::from_min_max(
            pos2(inner.left(), inner.top() + 18.0),
            pos2(inner.right(), inner.top() + 28.0),
        );
        let pieces = 32;
        for i in 0..pieces {
            let share = |i: i32| bar.left() + bar.width() * i as f32 / pieces as f32;
            let piece = Rect::from_x_y_ranges(share(i)..=share(i + 1) + 0.5, bar.y_range());
            let color = viridis((i as f32 + 0.5) / pieces as f32);
            painter.rect_filled(piece.intersect(bar), 0.0, color);
        }
        for (share, align) in [
            (0.0, Align2::LEFT_TOP),
            (0.5, Align2::CENTER_TOP),
            (1.0, Align2::RIGHT_TOP),
        ] {
            let at = pos2(bar.left() + share * bar.width(), bar.bottom() + 2.0);
            painter.text(at, align, format!("{share}"), small.clone(), tokens.muted);
        }
        Some(rect)
    }
}

/// The probability at a place, in words.
fn readout(value: f64) -> String {
    if value < BLIND {
        format!("fix {value:.2}, blind")
    } else {
        format!("fix {value:.2}")
    }
}
