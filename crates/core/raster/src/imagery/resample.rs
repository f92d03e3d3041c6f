//! Windows of the ground out of pictures that lie there in any way.

use nalgebra::{Point2, Vector2};

use super::{Placement, Window};
use crate::raster::{Raster, Rgba};
use pilotage_base::georeference::nearest;

/// Pixels of the window between the places where the map is evaluated. Between them it is linear to
/// (spacing · gsd)² / (8 · radius of the Earth), far below a hundredth of a pixel at any scale.
const SPACING: usize = 16;

/// A weighted sum of pixels with premultiplied coverage: red, green, blue, coverage.
#[derive(Clone, Copy, Default)]
pub struct PixelSum([f32; 4]);

impl PixelSum {
    /// Adds a pixel.
    #[inline]
    pub fn add(&mut self, [r, g, b, a]: Rgba, weight: f32) {
        let weight = weight * f32::from(a);
        let [red, green, blue, coverage] = self.0;
        self.0 = [
            red + weight * f32::from(r),
            green + weight * f32::from(g),
            blue + weight * f32::from(b),
            coverage + weight,
        ];
    }

    /// The mean, if the weights add up to `weights`.
    #[inline]
    pub fn pixel(&self, weights: f32) -> Rgba {
        let [red, green, blue, sum] = self.0;
        let coverage = sum / weights;
        if coverage < 0.5 {
            return [0; 4];
        }
        let mean = |c: f32| (c / sum + 0.5) as u8;
        let coverage = (coverage + 0.5).min(255.0) as u8;
        [mean(red), mean(green), mean(blue), coverage]
    }
}

/// A rectangle out of one level of a picture's pyramid.
pub struct PyramidRegion<'a> {
    /// Pixels of the rectangle.
    pub pixels: &'a Raster<Rgba>,
    /// Column and row of the rectangle's first pixel in the level.
    pub first: (usize, usize),
    /// Size of the whole level, pixels.
    pub level: (usize, usize),
    /// Pixels of the level per pixel of the picture.
    pub scale: (f64, f64),
}

/// The pixels of a picture under the pixels of a window.
pub struct WindowPixels {
    nodes: Vec<Vector2<f64>>,
    across: usize,
    size: (f64, f64),
    window: (usize, usize),
    /// Pixels of once around the Earth and the middle of the picture, where the window lies on both ends
    /// of a map of the world.
    seam: Option<(Vector2<f64>, Point2<f64>)>,
}

impl WindowPixels {
    /// Looks through `window` at the picture that lies at `placement`.
    pub fn new(window: &Window, placement: &Placement) -> Self {
        let across = window.width.div_ceil(SPACING) + 1;
        let down = window.height.div_ceil(SPACING) + 1;
        let node = |i: usize| {
            let (x, y) = ((i % across * SPACING) as f64, (i / across * SPACING) as f64);
            let pixel = placement.pixel_at(&window.ground_at(x, y));
            // What is not on the map fails every comparison below.
            pixel.map_or(Vector2::repeat(f64::NAN), |p: Point2<f64>| p.coords)
        };
        let (width, height) = placement.size();
        let nodes: Vec<Vector2<f64>> = (0..across * down).map(node).collect();
        let has_seam = |turn: &&Vector2<f64>| {
            let is_far = |a: &Vector2<f64>, b: &Vector2<f64>| {
                (a - b).dot(turn).abs() > 0.5 * turn.norm_squared()
            };
            let (beside, below) = (nodes.iter().skip(1), nodes.iter().skip(across));
            nodes.iter().zip(beside).any(|(a, b)| is_far(a, b))
                || nodes.iter().zip(below).any(|(a, b)| is_far(a, b))
        };
        let seam = placement.turn().filter(has_seam);
        let seam = seam.map(|turn| (*turn, placement.middle_pixel()));
        Self {
            nodes,
            across,
            size: (width as f64, height as f64),
            window: (window.width, window.height),
            seam,
        }
    }

    /// Columns and rows of the picture in sight, first and last, or `None` if it is out of sight.
    pub fn extent(&self) -> Option<(Vector2<f64>, Vector2<f64>)> {
        let limit = Vector2::new(self.size.0, self.size.1);
        let mut seen = self
            .nodes
            .iter()
            .filter(|n| n.x.is_finite() && n.y.is_finite());
        let first = *seen.next()?;
        let (low, high) = seen.fold((first, first), |(low, high), n| (low.inf(n), high.sup(n)));
        // A pixel to either side pays for the bend between the nodes.
        let low = low.add_scalar(-1.0).sup(&Vector2::zeros());
        let high = high.add_scalar(1.0).inf(&limit);
        (low.x < high.x && low.y < high.y).then_some((low, high))
    }

    /// Places in the picture of the four nodes around a pixel of the window.
    #[inline]
    fn corners(&self, column: usize, row: usize) -> [Vector2<f64>; 4] {
        let i = row / SPACING * self.across + column / SPACING;
        let (above, below) = (&self.nodes[i..][..2], &self.nodes[i + self.across..][..2]);
        let corners = [above[0], above[1], below[0], below[1]];
        let Some((turn, _)) = &self.seam else {
            return corners;
        };
        let first = Point2::from(corners[0]);
        corners.map(|corner| nearest(&corner.into(), &first, turn).coords)
    }

    /// Places in the picture above and below each sample of a row of the window, `offsets` into every pixel: where its
    /// column meets the lines of nodes to both sides.
    fn rails(&self, row: usize, offsets: &[f64]) -> Vec<[Vector2<f64>; 2]> {
        let of_pixel = |column: usize| {
            let [a, b, c, d] = self.corners(column, row);
            let shares = offsets.iter().map(move |dx| between_nodes(column, *dx));
            shares.map(move |t| [a * (1.0 - t) + b * t, c * (1.0 - t) + d * t])
        };
        (0..self.window.0).flat_map(of_pixel).collect()
    }

    /// The window's pixels, `per_side`² bilinear samples of `part` each. The part has to hold what
    /// is in sight.
    pub fn draw(&self, part: &PyramidRegion, per_side: usize) -> Raster<Rgba> {
        let offsets: Vec<f64> = (0..per_side)
            .map(|i| (i as f64 + 0.5) / per_side as f64)
            .collect();
        let weights = (per_side * per_side) as f32;
        let mut drawn = Raster::filled(self.window.0, self.window.1, [0; 4]);
        let mut rails = Vec::new();
        for row in 0..self.window.1 {
            if row % SPACING == 0 {
                rails = self.rails(row, &offsets);
            }
            let shares: Vec<f64> = offsets.iter().map(|dy| between_nodes(row, *dy)).collect();
            let pixels = drawn.row_mut(row).iter_mut();
            for (pixel, rails) in pixels.zip(rails.chunks_exact(per_side)) {
                let mut sum = PixelSum::default();
                for t in &shares {
                    for [above, below] in rails {
                        let p = self.once(above * (1.0 - t) + below * *t);
                        if (0.0..self.size.0).contains(&p.x) && (0.0..self.size.1).contains(&p.y) {
                            part.sample(p, &mut sum);
                        }
                    }
                }
                *pixel = sum.pixel(weights);
            }
        }
        drawn
    }

    /// The place itself, or on a map of the world that which is nearest to its middle.
    #[inline]
    fn once(&self, place: Vector2<f64>) -> Vector2<f64> {
        match &self.seam {
            Some((turn, middle)) => nearest(&place.into(), middle, turn).coords,
            None => place,
        }
    }
}

/// Share of the way from the node before a place of a row or column to the node after it, `offset` into pixel `index`.
#[inline]
fn between_nodes(index: usize, offset: f64) -> f64 {
    let place = (index as f64 + offset) / SPACING as f64;
    place - (place as usize) as f64
}

impl PyramidRegion<'_> {
    /// Adds the bilinear sample at a pixel that the picture has.
    #[inline]
    fn sample(&self, p: Vector2<f64>, sum: &mut PixelSum) {
        let (x, y) = (p.x * self.scale.0 - 0.5, p.y * self.scale.1 - 0.5);
        let (left, top) = (floor(x), floor(y));
        let (fx, fy) = ((x - left as f64) as f32, (y - top as f64) as f32);
        let place = |v: i64, level: usize, first: usize, held: usize| {
            let inside = (v.max(0) as usize).min(level - 1);
            inside.saturating_sub(first).min(held - 1)
        };
        let column = |v: i64| place(v, self.level.0, self.first.0, self.pixels.width());
        let row = |v: i64| place(v, self.level.1, self.first.1, self.pixels.height());
        let (c0, c1) = (column(left), column(left + 1));
        let above = self.pixels.row(row(top));
        let below = self.pixels.row(row(top + 1));
        sum.add(above[c0], (1.0 - fx) * (1.0 - fy));
        sum.add(above[c1], fx * (1.0 - fy));
        sum.add(below[c0], (1.0 - fx) * fy);
        sum.add(below[c1], fx * fy);
    }
}

/// The whole number at or below `x`, within the numbers that it can be (the library's is a call for each of millions).
#[inline]
fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole - i64::from(x < whole as f64)
}

/// Samples per side of a window's pixel, if that is `remaining` pixels of the level wide.
pub fn samples_per_side(remaining: f64) -> usize {
    (remaining - 0.2).ceil().clamp(1.0, 8.0) as usize
}

/// Half the size: each pixel the mean of four, weighted by coverage.
pub fn halved(picture: &Raster<Rgba>) -> Raster<Rgba> {
    let (width, height) = (picture.width().div_ceil(2), picture.height().div_ceil(2));
    Raster::from_fn(width, height, |column, row| {
        let mut sum = PixelSum::default();
        for (dc, dr) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            // An odd edge leaves the missing pixels empty, so that coverage fades there.
            let (c, r) = (2 * column + dc, 2 * row + dr);
            if c < picture.width() && r < picture.height() {
                sum.add(picture.get(c, r), 0.25);
            }
        }
        sum.pixel(1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix2;
    use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame, ReferenceSystem};
    use pilotage_base::georeference::{Georeference, GroundFromPixel, WorldFile};

    fn whole(pixels: &Raster<Rgba>) -> PyramidRegion<'_> {
        let size = (pixels.width(), pixels.height());
        PyramidRegion {
            pixels,
            first: (0, 0),
            level: size,
            scale: (1.0, 1.0),
        }
    }

    /// The window's pixels, each sought among its own four nodes.
    fn by_pixel(sight: &WindowPixels, part: &PyramidRegion, per_side: usize) -> Raster<Rgba> {
        Raster::from_fn(sight.window.0, sight.window.1, |column, row| {
            let corners = sight.corners(column, row);
            let mut sum = PixelSum::default();
            for i in 0..per_side * per_side {
                let into = |i: usize| (i as f64 + 0.5) / per_side as f64;
                let x = (column as f64 + into(i % per_side)) / SPACING as f64;
                let y = (row as f64 + into(i / per_side)) / SPACING as f64;
                let (fx, fy) = (x.fract(), y.fract());
                let top = corners[0] * (1.0 - fx) + corners[1] * fx;
                let bottom = corners[2] * (1.0 - fx) + corners[3] * fx;
                let mut p = top * (1.0 - fy) + bottom * fy;
                if let Some((turn, middle)) = &sight.seam {
                    p = nearest(&p.into(), middle, turn).coords;
                }
                if (0.0..sight.size.0).contains(&p.x) && (0.0..sight.size.1).contains(&p.y) {
                    part.sample(p, &mut sum);
                }
            }
            sum.pixel((per_side * per_side) as f32)
        })
    }

    #[test]
    fn rows_that_share_nodes_show_the_very_pixels_that_each_shows_alone() {
        let pixels = Raster::from_fn(90, 70, |x, y| [x as u8, y as u8, (x * y) as u8, 255]);
        // Turned, and not square.
        let place = GroundFromPixel {
            matrix: Matrix2::new(0.1, -0.4, 0.37, 0.12),
            corner: Vector2::new(20.0, -30.0),
        };
        let placement = Placement::affine(place, 90, 70).unwrap();
        for (width, height) in [(1, 1), (16, 16), (61, 45), (100, 90)] {
            let window = Window {
                north_edge: 21.5,
                west_edge: -31.0,
                gsd: 0.9,
                width,
                height,
            };
            let sight = WindowPixels::new(&window, &placement);
            for per_side in 1..4 {
                let drawn = sight.draw(&whole(&pixels), per_side);
                assert_eq!(drawn, by_pixel(&sight, &whole(&pixels), per_side));
                assert!(drawn.pixels().iter().any(|p| p[3] == 255) || width == 1);
            }
        }
    }

    #[test]
    fn a_map_of_the_world_goes_on_over_the_date_line() {
        let place = Georeference::Projected {
            system: ReferenceSystem::Geographic,
            file: WorldFile {
                a: 1.0,
                d: 0.0,
                b: 0.0,
                e: -1.0,
                c: -179.5,
                f: 89.5,
            },
        };
        // Its colour is its distance from the date line, in degrees.
        let pixels = Raster::from_fn(360, 180, |x, _| {
            let from_line = (x as f64 + 0.5).min(359.5 - x as f64);
            [from_line as u8, 0, 0, 255]
        });
        let frame = LocalFrame::new(Geodetic::from_degrees(0.0, 180.0, 0.0));
        let placement = Placement::on_globe(place, frame, 360, 180).unwrap();
        let rect = GroundRect::centered(GroundPoint::default(), 1e6, 2.4e6);
        let window = Window::covering(&rect, 30_000.0);
        let sight = WindowPixels::new(&window, &placement);
        let part = whole(&pixels);
        let drawn = sight.draw(&part, 1);
        assert_eq!(drawn, by_pixel(&sight, &part, 1));
        for column in 0..drawn.width() {
            let east = window.ground_at(column as f64 + 0.5, 1.0).east;
            let degrees = (east.abs() / 6_378_137.0).atan().to_degrees();
            let [seen, _, _, coverage] = drawn.get(column, drawn.height() / 2);
            assert_eq!(coverage, 255);
            assert!(
                (f64::from(seen) - degrees).abs() < 1.5,
                "{column}: {seen}, {degrees}"
            );
        }
    }
}
