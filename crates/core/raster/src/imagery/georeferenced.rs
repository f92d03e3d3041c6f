//! A picture with a georeference as imagery.

use super::resample::{PyramidRegion, WindowPixels, halved, samples_per_side};
use super::{Imagery, Placement, Window};
use crate::raster::{CodecError, Picture, Raster, Rgba, decode_picture_with_coverage};
use pilotage_base::frames::GroundRect;
use pilotage_base::georeference::GroundFromPixel;

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
    placement: Placement,
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

impl GeoreferencedPicture {
    /// Imagery of `picture` lying on the ground as stated; `None` if the picture is empty or the
    /// map does not span an area.
    ///
    /// ```
    /// use pilotage_base::{frames::GroundPoint, georeference::GroundFromPixel};
    /// use pilotage_raster::imagery::{GeoreferencedPicture, Imagery, Window};
    /// use pilotage_raster::raster::Raster;
    ///
    /// // 8 × 8 pixels of 2 m, north-west corner at the origin; the eastern half is white.
    /// let picture = Raster::from_fn(8, 8, |x, _| if x < 4 { [0, 0, 0, 255] } else { [255; 4] });
    /// let place = GroundFromPixel::north_up(GroundPoint::new(0.0, 0.0), 2.0);
    /// let map = GeoreferencedPicture::new("halves", picture, place).ok_or("no area")?;
    /// let window = Window { north_edge: -4.0, west_edge: 10.0, gsd: 2.0, width: 1, height: 1 };
    /// assert_eq!(map.window(&window).get(0, 0), [255; 4]);
    /// assert_eq!(map.bounds().east, 16.0);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn new(
        name: impl Into<String>,
        picture: Raster<Rgba>,
        ground_from_pixel: GroundFromPixel,
    ) -> Option<Self> {
        let (width, height) = (picture.width(), picture.height());
        let placement = Placement::affine(ground_from_pixel, width, height)?;
        Self::placed(name, picture, placement)
    }

    /// Imagery of `picture` lying at `placement`; `None` if the picture is empty or of another size.
    pub fn placed(
        name: impl Into<String>,
        picture: Raster<Rgba>,
        placement: Placement,
    ) -> Option<Self> {
        if picture.is_empty() || placement.size() != (picture.width(), picture.height()) {
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
            placement,
            levels,
        })
    }

    /// Placement of the pixels.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Size of the picture, pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.levels[0].width(), self.levels[0].height())
    }
}

impl Imagery for GeoreferencedPicture {
    fn name(&self) -> &str {
        &self.name
    }

    fn bounds(&self) -> GroundRect {
        self.placement.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.placement.gsd()
    }

    /// Bilinear from the pyramid's level just finer than asked; where that level is still notably
    /// finer, several samples per pixel are averaged.
    fn window(&self, window: &Window) -> Raster<Rgba> {
        let ratio = window.gsd / self.native_gsd();
        let level = (ratio.log2().floor().max(0.0) as usize).min(self.levels.len() - 1);
        let factor = (1_u64 << level) as f64;
        let pixels = &self.levels[level];
        let part = PyramidRegion {
            pixels,
            first: (0, 0),
            level: (pixels.width(), pixels.height()),
            scale: (1.0 / factor, 1.0 / factor),
        };
        WindowPixels::new(window, &self.placement).draw(&part, samples_per_side(ratio / factor))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Vector2};

    use super::*;
    use pilotage_base::frames::GroundPoint;

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
