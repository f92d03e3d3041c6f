//! Photos that were laid on the map: their outlines, and the chosen one over the map.

use egui::epaint::{Mesh, Vertex};
use egui::{Color32, Painter, Shape, Stroke, pos2};
use pilotage_core::frames::{GroundPoint, LocalFrame};
use pilotage_core::imagery::Window;

use super::PhotoAppearance;
use super::draped::DrapedPhoto;
use super::feature::PhotosFeature;
use crate::context::ViewContext;
use crate::map::{MapLayer, ScreenFromWorld};
use crate::shell::FADED;
use crate::tokens::Tokens;

/// Squares of the chequerboard along the longer side of a photo.
const SQUARES: usize = 10;

impl MapLayer for PhotosFeature {
    /// Draws the photos that were laid, the chosen one over the map as it is wished.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        frame: Option<LocalFrame>,
    ) {
        if !self.hides_flight(frame) {
            return;
        }
        let (photos, tokens) = (&self.state, context.tokens);
        let opacity = if self.are_of_another_map { FADED } else { 1.0 };
        let laid = (0..photos.reports.len()).filter_map(|n| Some((n, photos.laid(n)?)));
        for (number, photo) in laid {
            if photos.chosen != Some(number) {
                let stroke = Stroke::new(1.25, tokens.observed.gamma_multiply(0.8 * opacity));
                outline(painter, view, &photo.outline, stroke, tokens);
            }
        }
        if let Some(draped) = photos.draped() {
            match photos.shown {
                PhotoAppearance::Squares => squares(painter, view, draped, opacity),
                PhotoAppearance::Whole(shown) => {
                    let tint = Color32::WHITE.gamma_multiply(shown * opacity);
                    let mut mesh = Mesh::with_texture(draped.texture.id());
                    add(&mut mesh, view, &draped.window, [0.0, 0.0, 1.0, 1.0], tint);
                    painter.add(Shape::mesh(mesh));
                }
                PhotoAppearance::Outline => {}
            }
        }
        if let Some(photo) = photos.chosen.and_then(|number| photos.laid(number)) {
            let stroke = Stroke::new(2.5, tokens.accent.gamma_multiply(opacity));
            outline(painter, view, &photo.outline, stroke, tokens);
        }
    }

    /// While photos of this world are looked at, each is shown by itself.
    fn hides_flight(&self, frame: Option<LocalFrame>) -> bool {
        self.is_shown && self.state.lie_in(frame.map(|frame| frame.origin))
    }
}

/// The outline of a picture, with its top drawn heavier.
fn outline(
    painter: &Painter,
    view: &ScreenFromWorld,
    corners: &[GroundPoint],
    stroke: Stroke,
    tokens: &Tokens,
) {
    let points: Vec<_> = corners.iter().map(|corner| view.apply(corner)).collect();
    if points.len() < 3 {
        return;
    }
    let under = Stroke::new(stroke.width + 2.0, tokens.outline().gamma_multiply(0.5));
    painter.add(Shape::closed_line(points.clone(), under));
    painter.add(Shape::closed_line(points.clone(), stroke));
    let top = Stroke::new(2.0 * stroke.width, stroke.color);
    painter.line_segment([points[0], points[1]], top);
}

/// Every other square of a photo, with this opacity, 0 to 1.
fn squares(painter: &Painter, view: &ScreenFromWorld, draped: &DrapedPhoto, opacity: f32) {
    let window = &draped.window;
    let side = window.width.max(window.height).div_ceil(SQUARES);
    let mut mesh = Mesh::with_texture(draped.texture.id());
    let tint = Color32::WHITE.gamma_multiply(opacity);
    let part = |from: usize, size: usize| {
        let to = (from + side).min(size);
        [from, to].map(|pixel| pixel as f32 / size as f32)
    };
    for (row, top) in (0..window.height).step_by(side).enumerate() {
        for (column, left) in (0..window.width).step_by(side).enumerate() {
            if (row + column).is_multiple_of(2) {
                let [left, right] = part(left, window.width);
                let [top, bottom] = part(top, window.height);
                let square = [left, top, right, bottom];
                add(&mut mesh, view, window, square, tint);
            }
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// Adds a part of a photo (left, top, right, bottom, as shares of its window) where it lies.
fn add(
    mesh: &mut Mesh,
    view: &ScreenFromWorld,
    window: &Window,
    [left, top, right, bottom]: [f32; 4],
    color: Color32,
) {
    let first = mesh.vertices.len() as u32;
    for (u, v) in [(left, top), (right, top), (right, bottom), (left, bottom)] {
        let column = f64::from(u) * window.width as f64;
        let row = f64::from(v) * window.height as f64;
        mesh.vertices.push(Vertex {
            pos: view.apply(&window.ground_at(column, row)),
            uv: pos2(u, v),
            color,
        });
    }
    mesh.add_triangle(first, first + 1, first + 2);
    mesh.add_triangle(first, first + 2, first + 3);
}
