//! Shapes painted into a picture of the ground, half a metre per pixel.

use pilotage_raster::raster::{Raster, Rgba};

use super::example::{RoadExample, RoadTruth};

/// Colour, each part 0 to 255.
pub(super) type Paint = [f32; 3];

/// A picture in the making.
pub(super) struct Painter {
    pub(super) colours: Raster<Paint>,
    pub(super) truth: Raster<RoadTruth>,
    seed: u32,
}

/// A rectangle: middle, unit vector along it, half its sides along and across, pixels.
#[derive(Clone, Copy)]
pub(super) struct PaintedSlab {
    pub(super) middle: [f32; 2],
    pub(super) along: [f32; 2],
    pub(super) half: [f32; 2],
}

impl PaintedSlab {
    /// Coordinates along and across it.
    fn local(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let (dx, dy) = (x - self.middle[0], y - self.middle[1]);
        let [ax, ay] = self.along;
        [dx * ax + dy * ay, dy * ax - dx * ay]
    }

    /// Moved by (x, y).
    pub(super) fn moved(&self, [x, y]: [f32; 2]) -> Self {
        Self {
            middle: [self.middle[0] + x, self.middle[1] + y],
            ..*self
        }
    }
}

/// A number from 0 to 1 for a lattice point.
fn lattice(x: i32, y: i32, seed: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1) ^ (y as u32).wrapping_mul(0x85eb_ca6b) ^ seed;
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    (h >> 8) as f32 / 16_777_216.0
}

/// Smooth noise from -1 to 1 with features of so many pixels.
pub(super) fn noise([x, y]: [f32; 2], size: f32, seed: u32) -> f32 {
    let (u, v) = (x / size, y / size);
    let (left, top) = (u.floor(), v.floor());
    let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
    let (fx, fy) = (smooth(u - left), smooth(v - top));
    let at = |dx: i32, dy: i32| lattice(left as i32 + dx, top as i32 + dy, seed);
    let upper = at(0, 0) + fx * (at(1, 0) - at(0, 0));
    let lower = at(0, 1) + fx * (at(1, 1) - at(0, 1));
    2.0 * (upper + fy * (lower - upper)) - 1.0
}

/// `a` with the share of `b`.
pub(super) fn mixed(a: Paint, b: Paint, share: f32) -> Paint {
    std::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
}

/// Brighter by a share.
pub(super) fn scaled(paint: Paint, by: f32) -> Paint {
    paint.map(|value| value * by)
}

impl Painter {
    /// An empty picture.
    pub(super) fn new(side: usize, seed: u32) -> Self {
        Self {
            colours: Raster::filled(side, side, [0.0; 3]),
            truth: Raster::filled(side, side, RoadTruth::Open),
            seed,
        }
    }

    /// Paints wherever `depth` is above zero within `reach` pixels around a place, with a soft edge of a pixel; `depth`
    /// is in pixels from the edge inward. `paint` gets place and what was there.
    pub(super) fn shape(
        &mut self,
        [x, y]: [f32; 2],
        reach: f32,
        depth: impl Fn([f32; 2]) -> f32,
        paint: impl Fn([f32; 2], Paint) -> Paint,
        truth: Option<RoadTruth>,
    ) {
        let side = self.colours.width() as f32;
        let range = |middle: f32| {
            let low = (middle - reach).floor().clamp(0.0, side) as usize;
            low..(middle + reach).ceil().clamp(0.0, side) as usize
        };
        for row in range(y) {
            for column in range(x) {
                let place = [column as f32 + 0.5, row as f32 + 0.5];
                let share = (depth(place) + 0.5).clamp(0.0, 1.0);
                if share > 0.0 {
                    let under = self.colours.get(column, row);
                    let over = paint(place, under);
                    self.colours.set(column, row, mixed(under, over, share));
                    if let (Some(truth), true) = (truth, share >= 0.5) {
                        self.truth.set(column, row, truth);
                    }
                }
            }
        }
    }

    /// A rectangle in one colour with some noise.
    pub(super) fn slab(
        &mut self,
        slab: &PaintedSlab,
        paint: Paint,
        rough: f32,
        truth: Option<RoadTruth>,
    ) {
        let seed = self.seed;
        let reach = slab.half[0].hypot(slab.half[1]) + 1.0;
        let depth = |p: [f32; 2]| {
            let [u, v] = slab.local(p);
            (slab.half[0] - u.abs()).min(slab.half[1] - v.abs())
        };
        let speckled = |p: [f32; 2], _: Paint| {
            scaled(
                paint,
                1.0 + rough * (noise(p, 1.3, seed) + noise(p, 7.0, seed ^ 5)),
            )
        };
        self.shape(slab.middle, reach, depth, speckled, truth);
    }

    /// Darkens a rectangle.
    pub(super) fn shade_slab(&mut self, slab: &PaintedSlab, by: f32) {
        let reach = slab.half[0].hypot(slab.half[1]) + 1.0;
        let depth = |p: [f32; 2]| {
            let [u, v] = slab.local(p);
            (slab.half[0] - u.abs()).min(slab.half[1] - v.abs())
        };
        self.shape(
            slab.middle,
            reach,
            depth,
            |_, under| scaled(under, by),
            None,
        );
    }

    /// A disc; `paint` gets place and what was there.
    pub(super) fn disc(
        &mut self,
        middle: [f32; 2],
        radius: f32,
        paint: impl Fn([f32; 2], Paint) -> Paint,
    ) {
        let seed = self.seed;
        let depth = |p: [f32; 2]| {
            let ragged = 0.25 * radius * noise(p, 2.5, seed ^ 0x4d);
            radius + ragged - (p[0] - middle[0]).hypot(p[1] - middle[1])
        };
        self.shape(middle, 1.3 * radius + 1.0, depth, paint, None);
    }

    /// The finished picture.
    pub(super) fn finished(self) -> RoadExample {
        let pixel = |[r, g, b]: Paint| -> Rgba { [r as u8, g as u8, b as u8, 255] };
        RoadExample {
            picture: self.colours.map(pixel),
            truth: self.truth,
        }
    }
}
