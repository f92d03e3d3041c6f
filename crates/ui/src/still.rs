//! Drawings cut into triangles once and shown for as long as nothing about them changes.
//!
//! egui cuts every shape into triangles anew in every frame. For curves of thousands of points that
//! stand still while the time cursor moves, this is most of the work of a frame.

use std::sync::Arc;

use egui::epaint::{Mesh, TessellationOptions, Tessellator};
use egui::{Painter, Rect, Shape};

use crate::kept_mesh::PlacedMesh;

/// Cuts shapes into triangles. Texts cannot be among the shapes: where their letters lie in the
/// texture may change.
pub fn triangles(painter: &Painter, clip_rect: Rect, shapes: Vec<Shape>) -> Mesh {
    let options: TessellationOptions = painter.ctx().tessellation_options(|o| *o);
    let pixels_per_point = painter.pixels_per_point();
    let mut tessellator = Tessellator::new(pixels_per_point, options, [1, 1], Vec::new());
    tessellator.set_clip_rect(clip_rect);
    let mut mesh = Mesh::default();
    for shape in shapes {
        match shape {
            Shape::Vec(shapes) => {
                for shape in shapes {
                    tessellator.tessellate_shape(shape, &mut mesh);
                }
            }
            shape => tessellator.tessellate_shape(shape, &mut mesh),
        }
    }
    mesh
}

/// A drawing and what it depends on.
#[derive(Clone, Debug)]
pub struct Still<Key> {
    made_for: Option<(Key, Rect, f32)>,
    mesh: Arc<Mesh>,
}

impl<Key> Default for Still<Key> {
    fn default() -> Self {
        Self {
            made_for: None,
            mesh: Arc::default(),
        }
    }
}

impl<Key: PartialEq> Still<Key> {
    /// Shows the drawing; `draw` makes it anew if `key` (all that it depends on beside the place on
    /// the screen) is another one than before.
    pub fn paint(&mut self, painter: &Painter, key: Key, draw: impl FnOnce(&mut Vec<Shape>)) {
        let clip_rect = painter.clip_rect();
        let wanted = Some((key, clip_rect, painter.pixels_per_point()));
        let lasting = self.made_for == wanted;
        if !lasting {
            let mut shapes = Vec::new();
            draw(&mut shapes);
            self.mesh = Arc::new(triangles(painter, clip_rect, shapes));
            self.made_for = wanted;
        }
        PlacedMesh::whole(Arc::clone(&self.mesh)).paint(painter, lasting);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, Stroke, pos2};

    #[test]
    fn a_drawing_is_made_anew_only_when_its_key_changes() {
        let context = egui::Context::default();
        let mut still = Still::default();
        let mut made = 0;
        for key in [1, 1, 1, 2, 2] {
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                still.paint(ui.painter(), key, |shapes| {
                    made += 1;
                    let ends = [pos2(0.0, 0.0), pos2(50.0, 20.0)];
                    shapes.push(Shape::line_segment(ends, Stroke::new(2.0, Color32::RED)));
                });
            });
            output.textures_delta.clear();
        }
        assert_eq!(made, 2);
        assert!(!still.mesh.is_empty());
    }
}
