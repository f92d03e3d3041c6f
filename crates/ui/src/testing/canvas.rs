//! Draws egui's triangles without a graphics card, so that people can look at what tests show: a view alone, or the app in
//! the journeys, which take this file in by its path.

use std::collections::HashMap;
use std::path::PathBuf;

use egui::epaint::{ClippedShape, ImageData, Primitive, Vertex};
use egui::{ColorImage, Context, Rect, TextureId, TexturesDelta, Vec2};

/// Folder named by `PILOTAGE_PICTURES`, if people want to look.
pub(crate) fn folder() -> Option<PathBuf> {
    let folder = PathBuf::from(std::env::var_os("PILOTAGE_PICTURES")?);
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder)
}

/// The textures that egui has made so far.
#[derive(Default)]
pub(crate) struct ScreenTextures(HashMap<TextureId, ColorImage>);

impl ScreenTextures {
    /// Takes what egui made and let go of, and leaves nothing of it.
    pub(crate) fn take(&mut self, delta: &mut TexturesDelta) {
        for (id, deltas) in delta.set.drain() {
            for delta in deltas {
                let ImageData::Color(image) = &delta.image;
                match (delta.pos, self.0.get_mut(&id)) {
                    (Some(at), Some(texture)) => put(texture, image, at),
                    _ => {
                        self.0.insert(id, image.as_ref().clone());
                    }
                }
            }
        }
        for id in delta.free.drain() {
            self.0.remove(&id);
        }
        delta.clear();
    }

    /// A frame of `size` points as a picture, at `scale` pixels per point.
    pub(crate) fn draw(
        &self,
        context: &Context,
        shapes: Vec<ClippedShape>,
        size: Vec2,
        scale: f32,
    ) -> image::RgbImage {
        let size = [(size.x * scale) as usize, (size.y * scale) as usize];
        let mut canvas = Canvas {
            size,
            scale,
            pixels: vec![[0.0; 3]; size[0] * size[1]],
        };
        for primitive in context.tessellate(shapes, scale) {
            if let Primitive::Mesh(mesh) = primitive.primitive
                && let Some(texture) = self.0.get(&mesh.texture_id)
            {
                for triangle in mesh.indices.chunks_exact(3) {
                    let corners = [0, 1, 2].map(|i| mesh.vertices[triangle[i] as usize]);
                    canvas.triangle(corners, texture, primitive.clip_rect);
                }
            }
        }
        image::RgbImage::from_fn(size[0] as u32, size[1] as u32, |x, y| {
            let pixel = canvas.pixels[y as usize * size[0] + x as usize];
            image::Rgb(pixel.map(|v| v.clamp(0.0, 255.0) as u8))
        })
    }
}

/// Puts an image into a texture.
fn put(texture: &mut ColorImage, image: &ColorImage, [left, top]: [usize; 2]) {
    for row in 0..image.size[1] {
        for column in 0..image.size[0] {
            let at = (top + row) * texture.size[0] + left + column;
            texture.pixels[at] = image.pixels[row * image.size[0] + column];
        }
    }
}

/// A screen in memory.
struct Canvas {
    /// Pixels across and down.
    size: [usize; 2],
    /// Pixels per point.
    scale: f32,
    pixels: Vec<[f32; 3]>,
}

impl Canvas {
    /// Fills a triangle, blending premultiplied colours in gamma space as egui does.
    fn triangle(&mut self, corners: [Vertex; 3], texture: &ColorImage, clip: Rect) {
        let scale = self.scale;
        let [a, b, c] = corners.map(|v| v.pos.to_vec2() * scale);
        let area = (b - a).x * (c - a).y - (b - a).y * (c - a).x;
        if area.abs() < 1e-9 {
            return;
        }
        let clip = Rect::from_min_max(
            (clip.min.to_vec2() * scale).to_pos2(),
            (clip.max.to_vec2() * scale).to_pos2(),
        );
        let low = a.min(b).min(c).max(clip.min.to_vec2().max(Vec2::ZERO));
        let high = a.max(b).max(c).min(clip.max.to_vec2());
        let right = (high.x.ceil().max(0.0) as usize).min(self.size[0]);
        let bottom = (high.y.ceil().max(0.0) as usize).min(self.size[1]);
        for y in low.y.floor() as usize..bottom {
            for x in low.x.floor() as usize..right {
                // A little beside the centre: no edge of a line then runs exactly through it.
                let p = Vec2::new(x as f32 + 0.487, y as f32 + 0.493);
                let wb = ((p - a).x * (c - a).y - (p - a).y * (c - a).x) / area;
                let wc = ((b - a).x * (p - a).y - (b - a).y * (p - a).x) / area;
                let weights = [1.0 - wb - wc, wb, wc];
                if !clip.contains(p.to_pos2()) || weights.iter().any(|w| *w < 0.0) {
                    continue;
                }
                let mix = |f: &dyn Fn(&Vertex) -> f32| -> f32 {
                    corners.iter().zip(weights).map(|(v, w)| f(v) * w).sum()
                };
                let texel = sample(texture, mix(&|v| v.uv.x), mix(&|v| v.uv.y));
                let part = |channel: usize| {
                    mix(&|v| f32::from(v.color.to_array()[channel])) * texel[channel] / 255.0
                };
                let keep = 1.0 - part(3) / 255.0;
                let pixel = &mut self.pixels[y * self.size[0] + x];
                for (channel, value) in pixel.iter_mut().enumerate() {
                    *value = *value * keep + part(channel);
                }
            }
        }
    }
}

/// The texture's colour at (u, v), between its pixels.
fn sample(texture: &ColorImage, u: f32, v: f32) -> [f32; 4] {
    let x = (u * texture.size[0] as f32 - 0.5).max(0.0);
    let y = (v * texture.size[1] as f32 - 0.5).max(0.0);
    let (column, row) = (x as usize, y as usize);
    let get = |c: usize, r: usize| -> [f32; 4] {
        let c = c.min(texture.size[0] - 1);
        let r = r.min(texture.size[1] - 1);
        texture.pixels[r * texture.size[0] + c]
            .to_array()
            .map(f32::from)
    };
    let (fx, fy) = (x.fract(), y.fract());
    let corners = [
        (get(column, row), (1.0 - fx) * (1.0 - fy)),
        (get(column + 1, row), fx * (1.0 - fy)),
        (get(column, row + 1), (1.0 - fx) * fy),
        (get(column + 1, row + 1), fx * fy),
    ];
    [0, 1, 2, 3].map(|i| corners.iter().map(|(color, w)| color[i] * w).sum())
}
