//! A rectangular array of pixels.

use serde::{Deserialize, Serialize};

/// Rows of pixels, top row first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Raster<T> {
    width: usize,
    height: usize,
    pixels: Vec<T>,
}

/// Red, green, blue.
pub type Rgb = [u8; 3];
/// Red, green, blue, coverage (0: no data here).
pub type Rgba = [u8; 4];
/// A colour picture, as a camera gives it.
pub type Picture = Raster<Rgb>;
/// A grey picture in floating point; the scale is the caller's (usually 0 to 255).
pub type Gray = Raster<f32>;

impl<T: Copy> Raster<T> {
    /// A picture of one value.
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Self {
            width,
            height,
            pixels: vec![value; width * height],
        }
    }

    /// A picture from its rows, or `None` if the number of pixels does not fit.
    pub fn from_pixels(width: usize, height: usize, pixels: Vec<T>) -> Option<Self> {
        (pixels.len() == width * height).then_some(Self {
            width,
            height,
            pixels,
        })
    }

    /// A picture computed pixel by pixel from (column, row).
    ///
    /// ```
    /// use pilotage_raster::raster::Raster;
    ///
    /// let picture = Raster::from_fn(4, 3, |column, row| 10 * row + column);
    /// assert_eq!(picture.get(3, 1), 13);
    /// let part = picture.crop(2, 1, 2, 2).ok_or("beyond the picture")?;
    /// assert_eq!(part.pixels(), [12, 13, 22, 23]);
    /// assert!(picture.crop(3, 0, 2, 1).is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn from_fn(width: usize, height: usize, mut f: impl FnMut(usize, usize) -> T) -> Self {
        let mut pixels = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                pixels.push(f(column, row));
            }
        }
        Self {
            width,
            height,
            pixels,
        }
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Whether there is no pixel at all.
    pub fn is_empty(&self) -> bool {
        self.pixels.is_empty()
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[T] {
        &self.pixels
    }

    /// All pixels, row by row.
    pub fn pixels_mut(&mut self) -> &mut [T] {
        &mut self.pixels
    }

    /// Pixels of a row.
    pub fn row(&self, row: usize) -> &[T] {
        &self.pixels[row * self.width..][..self.width]
    }

    /// Pixels of a row, to be changed.
    pub fn row_mut(&mut self, row: usize) -> &mut [T] {
        &mut self.pixels[row * self.width..][..self.width]
    }

    /// The pixel at (column, row); panics outside.
    pub fn get(&self, column: usize, row: usize) -> T {
        self.row(row)[column]
    }

    /// Sets the pixel at (column, row); panics outside.
    pub fn set(&mut self, column: usize, row: usize, value: T) {
        self.row_mut(row)[column] = value;
    }

    /// A picture of the same size with every pixel mapped.
    pub fn map<U: Copy>(&self, f: impl FnMut(T) -> U) -> Raster<U> {
        Raster {
            width: self.width,
            height: self.height,
            pixels: self.pixels.iter().copied().map(f).collect(),
        }
    }

    /// The part that begins at (column, row), or `None` if it does not lie inside.
    pub fn crop(&self, column: usize, row: usize, width: usize, height: usize) -> Option<Self> {
        (column + width <= self.width && row + height <= self.height)
            .then(|| Self::from_fn(width, height, |c, r| self.get(column + c, row + r)))
    }
}

/// Luminance of a colour, 0 to 255 (ITU-R BT.601 weights, as OpenCV's `COLOR_RGB2GRAY`).
pub fn luminance([r, g, b]: Rgb) -> f32 {
    0.299 * f32::from(r) + 0.587 * f32::from(g) + 0.114 * f32::from(b)
}

impl Raster<Rgb> {
    /// Luminance, 0 to 255.
    pub fn to_gray(&self) -> Gray {
        self.map(luminance)
    }
}

impl Raster<Rgba> {
    /// Luminance, 0 to 255, whatever the coverage.
    pub fn to_gray(&self) -> Gray {
        self.map(|[r, g, b, _]| luminance([r, g, b]))
    }
}
