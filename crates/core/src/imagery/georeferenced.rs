//! A picture with a georeference as imagery.

use nalgebra::{Matrix2, Point2, Vector2};

use super::{GroundFromPixel, Imagery, Window};
use crate::frames::{GroundPoint, GroundRect};
use crate::raster::{CodecError, Picture, Raster, Rgba, decode_picture_with_coverage};

/// Brightest channel of a pixel that still counts as the black of an orthophoto's border; the
/// compression of JPEG stains it a little.
const BLACK: u8 = 10;
/// Darkest channel of a pixel that still counts as a white border.
const WHITE: u8 = 247;

/// A picture of the ground with the place of its pixels; turned and skewed pictures are fine.
///
/// Holds a pyramid of halved copies, so that a wide window costs no more than a narrow one.
#[derive(Clone, Debug)]
pub struct GeoreferencedPicture {
    name: String,
    ground_from_pixel: GroundFromPixel,
    pixel_from_ground: Matrix2<f64>,
    levels: Vec<Raster<Rgba>>,
}

/// The picture opaque everywhere.
pub fn opaque(picture: &Picture) -> Raster<Rgba> {
    picture.map(|[r, g, b]| [r, g, b, 255])
}

/// The picture with its empty border taken for missing data: black wherever it is connected to the
/// picture's edge, white wherever it is connected to a corner, as orthophotos have it.
pub fn without_border(picture: &Picture) -> Raster<Rgba> {
    let (width, height) = (picture.width(), picture.height());
    let mut result = opaque(picture);
    if picture.is_empty() {
        return result;
    }
    let mut edge: Vec<(usize, usize)> = Vec::new();
    for column in 0..width {
        edge.extend([(column, 0), (column, height - 1)]);
    }
    for row in 0..height {
        edge.extend([(0, row), (width - 1, row)]);
    }
    clear(&mut result, edge, |[r, g, b, _]| r.max(g).max(b) <= BLACK);
    let (right, bottom) = (width - 1, height - 1);
    let corners = vec![(0, 0), (right, 0), (0, bottom), (right, bottom)];
    clear(&mut result, corners, |[r, g, b, _]| {
        r.min(g).min(b) >= WHITE
    });
    result
}

/// The colours of a map's JPEG or PNG file with the coverage it states; a file without any
/// transparency loses its empty border if `border_is_empty`.
pub fn decode_map(bytes: &[u8], border_is_empty: bool) -> Result<Raster<Rgba>, CodecError> {
    let picture = decode_picture_with_coverage(bytes)?;
    let transparent = picture.pixels().iter().any(|p| p[3] < 255);
    Ok(if border_is_empty && !transparent {
        without_border(&picture.map(|[r, g, b, _]| [r, g, b]))
    } else {
        picture
    })
}

/// Makes transparent what is connected to `pending` through pixels that are `empty`.
fn clear(
    result: &mut Raster<Rgba>,
    mut pending: Vec<(usize, usize)>,
    empty: impl Fn(Rgba) -> bool,
) {
    let (width, height) = (result.width(), result.height());
    while let Some((column, row)) = pending.pop() {
        let pixel = result.get(column, row);
        if pixel[3] == 0 || !empty(pixel) {
            continue;
        }
        result.set(column, row, [0; 4]);
        if column > 0 {
            pending.push((column - 1, row));
        }
        if row > 0 {
            pending.push((column, row - 1));
        }
        if column + 1 < width {
            pending.push((column + 1, row));
        }
        if row + 1 < height {
            pending.push((column, row + 1));
        }
    }
}

/// Half the size: each pixel the mean of four, weighted by coverage.
fn halved(picture: &Raster<Rgba>) -> Raster<Rgba> {
    let (width, height) = (picture.width().div_ceil(2), picture.height().div_ceil(2));
    Raster::from_fn(width, height, |column, row| {
        let mut sum = Sum::default();
        for (dc, dr) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            // An odd edge leaves the missing pixels empty, so that coverage fades there.
            let (c, r) = (2 * column + dc, 2 * row + dr);
            if c < picture.width() && r < picture.height() {
                sum.add(picture.get(c, r), 0.25);
            }
        }
        sum.pixel()
    })
}

/// A weighted sum of pixels with premultiplied coverage.
#[derive(Clone, Copy, Default)]
struct Sum {
    colour: [f32; 3],
    coverage: f32,
}

impl Sum {
    fn add(&mut self, [r, g, b, a]: Rgba, weight: f32) {
        let weight = weight * f32::from(a);
        self.coverage += weight;
        for (sum, value) in self.colour.iter_mut().zip([r, g, b]) {
            *sum += weight * f32::from(value);
        }
    }

    fn pixel(&self) -> Rgba {
        if self.coverage < 0.5 {
            return [0; 4];
        }
        let [r, g, b] = self.colour.map(|c| (c / self.coverage + 0.5) as u8);
        [r, g, b, (self.coverage + 0.5).min(255.0) as u8]
    }
}

impl GeoreferencedPicture {
    /// Imagery of `picture` lying on the ground as stated; `None` if the picture is empty or the
    /// map does not span an area.
    pub fn new(
        name: impl Into<String>,
        picture: Raster<Rgba>,
        ground_from_pixel: GroundFromPixel,
    ) -> Option<Self> {
        let pixel_from_ground = ground_from_pixel.matrix.try_inverse()?;
        if picture.is_empty() {
            return None;
        }
        let mut levels = vec![picture];
        while let Some(last) = levels.last()
            && last.width().min(last.height()) > 32
        {
            levels.push(halved(last));
        }
        Some(Self {
            name: name.into(),
            ground_from_pixel,
            pixel_from_ground,
            levels,
        })
    }

    /// Where the pixels lie.
    pub fn ground_from_pixel(&self) -> &GroundFromPixel {
        &self.ground_from_pixel
    }

    /// Size of the picture, pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.levels[0].width(), self.levels[0].height())
    }

    /// Adds the bilinear sample at pixel (x, y) of a level to `sum`; nothing outside the picture.
    fn sample(&self, level: usize, x: f64, y: f64, sum: &mut Sum) {
        let scale = 1.0 / (1_u64 << level) as f64;
        let (width, height) = self.size();
        if !(0.0..width as f64).contains(&x) || !(0.0..height as f64).contains(&y) {
            return;
        }
        let picture = &self.levels[level];
        let (x, y) = (x * scale - 0.5, y * scale - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (fx, fy) = ((x - left) as f32, (y - top) as f32);
        let column = |c: f64| (c.max(0.0) as usize).min(picture.width() - 1);
        let row = |r: f64| (r.max(0.0) as usize).min(picture.height() - 1);
        let (c0, c1) = (column(left), column(left + 1.0));
        let (r0, r1) = (row(top), row(top + 1.0));
        sum.add(picture.get(c0, r0), (1.0 - fx) * (1.0 - fy));
        sum.add(picture.get(c1, r0), fx * (1.0 - fy));
        sum.add(picture.get(c0, r1), (1.0 - fx) * fy);
        sum.add(picture.get(c1, r1), fx * fy);
    }
}

impl Imagery for GeoreferencedPicture {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&self) -> GroundRect {
        let (width, height) = self.size();
        let (w, h) = (width as f64, height as f64);
        let corners = [(0.0, 0.0), (w, 0.0), (0.0, h), (w, h)]
            .map(|(x, y)| self.ground_from_pixel.ground_at(&Point2::new(x, y)));
        GroundRect::around(corners).unwrap_or(GroundRect::centered(
            GroundPoint::default(),
            0.0,
            0.0,
        ))
    }

    fn native_gsd(&self) -> f64 {
        self.ground_from_pixel.gsd()
    }

    /// Bilinear from the pyramid's level just finer than asked; where that level is still notably
    /// finer, four samples per pixel are averaged.
    fn window(&self, window: &Window) -> Raster<Rgba> {
        let ratio = window.gsd / self.native_gsd();
        let level = (ratio.log2().floor().max(0.0) as usize).min(self.levels.len() - 1);
        let remaining = ratio / (1_u64 << level) as f64;
        let per_side = (remaining - 0.2).ceil().clamp(1.0, 8.0) as usize;
        let offsets: Vec<f64> = (0..per_side)
            .map(|i| (i as f64 + 0.5) / per_side as f64)
            .collect();
        let weight = (per_side * per_side) as f32;
        let pixel_at = |x: f64, y: f64| -> Vector2<f64> {
            let ground = window.ground_at(x, y).to_vector();
            self.pixel_from_ground * (ground - self.ground_from_pixel.corner)
        };
        Raster::from_fn(window.width, window.height, |column, row| {
            let mut sum = Sum::default();
            for dy in &offsets {
                for dx in &offsets {
                    let p = pixel_at(column as f64 + dx, row as f64 + dy);
                    self.sample(level, p.x, p.y, &mut sum);
                }
            }
            sum.coverage /= weight;
            sum.colour = sum.colour.map(|c| c / weight);
            sum.pixel()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture whose red is 4 × column and whose green is 4 × row.
    fn ramps() -> Raster<Rgba> {
        Raster::from_fn(60, 60, |c, r| [4 * c as u8, 4 * r as u8, 90, 255])
    }

    fn window(north: f64, west: f64, gsd: f64, size: usize) -> Window {
        Window {
            north_edge: north,
            west_edge: west,
            gsd,
            width: size,
            height: size,
        }
    }

    #[test]
    fn a_north_up_picture_comes_back_pixel_for_pixel() {
        let map = GroundFromPixel::north_up(GroundPoint::new(100.0, 20.0), 0.5);
        let imagery = GeoreferencedPicture::new("ramps", ramps(), map).unwrap();
        assert_eq!(imagery.window(&window(100.0, 20.0, 0.5, 60)), ramps());
        assert_eq!(imagery.bounds().south, 70.0);
        assert_eq!(imagery.bounds().east, 50.0);
    }

    #[test]
    fn a_picture_with_south_on_top_is_turned_over() {
        let map = GroundFromPixel {
            matrix: Matrix2::new(0.0, 1.0, -1.0, 0.0),
            corner: Vector2::new(0.0, 60.0),
        };
        let imagery = GeoreferencedPicture::new("ramps", ramps(), map).unwrap();
        let north_up = imagery.window(&window(60.0, 0.0, 1.0, 60));
        assert_eq!(north_up.get(0, 0), ramps().get(59, 59));
        assert_eq!(north_up.get(10, 20), ramps().get(49, 39));
    }

    #[test]
    fn a_coarse_window_shows_the_mean_of_the_fine_pixels() {
        let map = GroundFromPixel::north_up(GroundPoint::new(0.0, 0.0), 1.0);
        let stripes = Raster::from_fn(64, 64, |c, _| {
            let v = if c % 2 == 0 { 0 } else { 200 };
            [v, v, v, 255]
        });
        let imagery = GeoreferencedPicture::new("stripes", stripes, map).unwrap();
        for gsd in [1.9, 2.0, 3.1, 7.3] {
            let seen = imagery.window(&window(-4.0, 4.0, gsd, 5));
            for p in seen.pixels() {
                assert!((i32::from(p[0]) - 100).abs() < 30, "{gsd}: {p:?}");
            }
        }
    }

    #[test]
    fn ground_beside_the_picture_is_transparent() {
        let map = GroundFromPixel::north_up(GroundPoint::new(0.0, 0.0), 1.0);
        let imagery = GeoreferencedPicture::new("ramps", ramps(), map).unwrap();
        let seen = imagery.window(&window(10.0, -10.0, 1.0, 30));
        assert_eq!(seen.get(5, 5), [0; 4]);
        assert_eq!(seen.get(15, 15)[3], 255);
    }

    #[test]
    fn a_black_border_is_no_data_but_a_black_roof_inside_stays() {
        let mut picture = Picture::filled(20, 20, [120, 130, 140]);
        for i in 0..20 {
            picture.set(i, 0, [3, 0, 2]);
            picture.set(0, i, [0, 0, 0]);
        }
        picture.set(10, 10, [0, 0, 0]);
        picture.set(12, 19, [255; 3]);
        let seen = without_border(&picture);
        assert_eq!(seen.get(7, 0), [0; 4]);
        assert_eq!(seen.get(10, 10), [0, 0, 0, 255]);
        assert_eq!(seen.get(12, 19), [255; 4]);
        picture.set(19, 19, [255; 3]);
        assert_eq!(without_border(&picture).get(19, 19), [0; 4]);
        assert_eq!(opaque(&picture).get(7, 0)[3], 255);
    }
}
