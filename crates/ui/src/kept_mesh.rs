//! Triangles that stay on the graphics card.
//!
//! egui sends all that it draws to the graphics card in every frame. Curves and tracks of a long flight
//! are megabytes that only ever move and turn; a host that can keep them there puts a [`MeshKeeper`]
//! into the context, and everywhere else they are drawn like all the rest.

use std::any::Any;
use std::ops::Range;
use std::sync::Arc;

use egui::epaint::{Mesh, PaintCallback, Vertex};
use egui::{Context, Id, Painter, Pos2, Shape, pos2};

/// Triangles below this number of corners are not worth keeping.
const WORTH_KEEPING: usize = 600;

/// Some triangles of a mesh and how strongly they are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshPart {
    /// The corners that are theirs alone.
    pub vertices: Range<usize>,
    /// Their place in the list of indices.
    pub indices: Range<usize>,
    /// Factor on colour and opacity, 0 to 1.
    pub strength: f32,
}

/// A mesh and where it is drawn.
#[derive(Clone, Debug)]
pub struct PlacedMesh {
    /// Triangles in one colour per corner, around an origin of their own, points.
    pub mesh: Arc<Mesh>,
    /// Place of the origin on the screen.
    pub origin: Pos2,
    /// Angle by which the mesh is turned to the left on the screen, radians.
    pub turned: f32,
    /// Parts of the mesh that are drawn.
    pub parts: Vec<MeshPart>,
}

impl PlacedMesh {
    /// The whole mesh, as it lies.
    pub fn whole(mesh: Arc<Mesh>) -> Self {
        let part = MeshPart {
            vertices: 0..mesh.vertices.len(),
            indices: 0..mesh.indices.len(),
            strength: 1.0,
        };
        Self {
            mesh,
            origin: Pos2::ZERO,
            turned: 0.0,
            parts: vec![part],
        }
    }

    /// Adds what is drawn to a mesh in screen coordinates.
    pub fn append_to(&self, out: &mut Mesh) {
        let (sin, cos) = self.turned.sin_cos();
        for part in &self.parts {
            let shift = out.vertices.len() as u32;
            let first = part.vertices.start as u32;
            let indices = &self.mesh.indices[part.indices.clone()];
            out.indices
                .extend(indices.iter().map(|i| i - first + shift));
            let vertices = &self.mesh.vertices[part.vertices.clone()];
            out.vertices.extend(vertices.iter().map(|v| {
                let (x, y) = (v.pos.x, v.pos.y);
                let color = match part.strength {
                    1.0 => v.color,
                    strength => v.color.gamma_multiply(strength),
                };
                let pos = pos2(
                    self.origin.x + cos * x + sin * y,
                    self.origin.y + cos * y - sin * x,
                );
                Vertex { pos, color, ..*v }
            }));
        }
    }

    /// Draws it; `lasting` says that it was the same mesh in the frame before, so that keeping it pays.
    pub fn paint(self, painter: &Painter, lasting: bool) {
        if self.mesh.is_empty() || self.parts.is_empty() {
            return;
        }
        let keeper = (lasting && self.mesh.vertices.len() >= WORTH_KEEPING)
            .then(|| keeper(painter.ctx()))
            .flatten();
        if let Some(keeper) = keeper {
            painter.add(PaintCallback {
                rect: painter.ctx().content_rect(),
                callback: keeper.callback(self),
            });
        } else if self.is_whole_as_it_lies() {
            painter.add(Shape::mesh(self.mesh));
        } else {
            let mut mesh = Mesh::default();
            self.append_to(&mut mesh);
            painter.add(Shape::mesh(mesh));
        }
    }

    fn is_whole_as_it_lies(&self) -> bool {
        let [part] = self.parts.as_slice() else {
            return false;
        };
        (self.origin, self.turned, part.strength) == (Pos2::ZERO, 0.0, 1.0)
            && part.indices.len() == self.mesh.indices.len()
    }
}

/// A host that keeps meshes on its graphics card.
pub trait MeshKeeper: Send + Sync {
    /// Callback by which the host's painter draws the mesh, in a viewport that is the whole screen.
    fn callback(&self, placed: PlacedMesh) -> Arc<dyn Any + Send + Sync>;
}

/// Has meshes drawn by `keeper` from now on.
pub fn install(context: &Context, keeper: Arc<dyn MeshKeeper>) {
    context.data_mut(|data| data.insert_temp(Id::NULL, keeper));
}

fn keeper(context: &Context) -> Option<Arc<dyn MeshKeeper>> {
    context.data(|data| data.get_temp(Id::NULL))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, Rect};

    fn strip(corners: usize) -> Arc<Mesh> {
        let mut mesh = Mesh::default();
        for i in 0..corners as u32 {
            mesh.colored_vertex(pos2(i as f32, 0.0), Color32::from_rgb(200, 100, 50));
            if i >= 2 {
                mesh.add_triangle(i - 2, i - 1, i);
            }
        }
        Arc::new(mesh)
    }

    fn shapes_of(lasting: bool, corners: usize, keeps: bool) -> (usize, usize) {
        struct Keeper;
        impl MeshKeeper for Keeper {
            fn callback(&self, placed: PlacedMesh) -> Arc<dyn Any + Send + Sync> {
                Arc::new(placed)
            }
        }
        let context = Context::default();
        if keeps {
            install(&context, Arc::new(Keeper));
        }
        let screen = Rect::from_min_size(Pos2::ZERO, egui::vec2(800.0, 600.0));
        let input = egui::RawInput {
            screen_rect: Some(screen),
            ..egui::RawInput::default()
        };
        let mut output = context.run_ui(input, |ui| {
            PlacedMesh::whole(strip(corners)).paint(ui.painter(), lasting);
        });
        output.textures_delta.clear();
        let count = |wanted: fn(&Shape) -> bool| {
            (output.shapes.iter())
                .filter(|clipped| wanted(&clipped.shape))
                .count()
        };
        (
            count(|s| matches!(s, Shape::Callback(_))),
            count(|s| matches!(s, Shape::Mesh(_))),
        )
    }

    #[test]
    fn only_large_lasting_meshes_go_to_a_host_that_keeps_them() {
        assert_eq!(shapes_of(true, 900, true), (1, 0));
        assert_eq!(shapes_of(false, 900, true), (0, 1));
        assert_eq!(shapes_of(true, 90, true), (0, 1));
        assert_eq!(shapes_of(true, 900, false), (0, 1));
    }

    #[test]
    fn a_part_of_a_mesh_is_turned_moved_and_faded() {
        let placed = PlacedMesh {
            mesh: strip(6),
            origin: pos2(10.0, 20.0),
            turned: std::f32::consts::FRAC_PI_2,
            parts: vec![MeshPart {
                vertices: 3..6,
                indices: 9..12,
                strength: 0.5,
            }],
        };
        let mut out = Mesh::default();
        out.append_ref(&strip(3));
        placed.append_to(&mut out);
        assert_eq!(out.indices, [0, 1, 2, 3, 4, 5]);
        let last = out.vertices[5];
        assert!(last.pos.distance(pos2(10.0, 15.0)) < 1e-4, "{:?}", last.pos);
        assert_eq!(
            last.color,
            Color32::from_rgb(200, 100, 50).gamma_multiply(0.5)
        );
    }
}
