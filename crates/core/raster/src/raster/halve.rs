//! Pictures at half the size.

use super::{Gray, Raster, Rgba};

impl Raster<f32> {
    /// The picture at half the size: each pixel is the mean of 2 × 2, so no light is lost and the
    /// outer corner stays where it is. An odd last row or column is left out.
    #[must_use]
    pub fn halved(&self) -> Gray {
        let (width, height) = (self.width() / 2, self.height() / 2);
        let mut out = Gray::filled(width, height, 0.0);
        for row in 0..height {
            let (above, below) = (self.row(2 * row), self.row(2 * row + 1));
            let pairs = above.chunks_exact(2).zip(below.chunks_exact(2));
            for (value, (a, b)) in out.row_mut(row).iter_mut().zip(pairs) {
                *value = 0.25 * (a[0] + a[1] + b[0] + b[1]);
            }
        }
        out
    }
}

impl Raster<Rgba> {
    /// The picture at half the size: each pixel is the mean of those of 2 × 2 that have data. An odd
    /// last row or column is left out.
    #[must_use]
    pub fn halved(&self) -> Self {
        let (width, height) = (self.width() / 2, self.height() / 2);
        let mut out = Self::filled(width, height, [0; 4]);
        for row in 0..height {
            let (above, below) = (self.row(2 * row), self.row(2 * row + 1));
            let pairs = above.chunks_exact(2).zip(below.chunks_exact(2));
            for (value, (a, b)) in out.row_mut(row).iter_mut().zip(pairs) {
                *value = mean([a[0], a[1], b[0], b[1]]);
            }
        }
        out
    }
}

/// Mean of four pixels, each weighted by its coverage.
fn mean(four: [[u8; 4]; 4]) -> [u8; 4] {
    let coverage: u32 = four.iter().map(|p| u32::from(p[3])).sum();
    if coverage == 4 * 255 {
        return std::array::from_fn(|c| {
            ((four.iter().map(|p| u32::from(p[c])).sum::<u32>() + 2) / 4) as u8
        });
    }
    if coverage == 0 {
        return [0; 4];
    }
    std::array::from_fn(|c| {
        if c == 3 {
            return ((coverage + 2) / 4) as u8;
        }
        let weighted: u32 = four.iter().map(|p| u32::from(p[c]) * u32::from(p[3])).sum();
        ((weighted + coverage / 2) / coverage) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_averages_four_pixels() {
        let ramp = Gray::from_fn(7, 4, |x, y| (10 * x + y) as f32);
        let half = ramp.halved();
        assert_eq!((half.width(), half.height()), (3, 2));
        assert_eq!(half.get(1, 1), 27.5);
    }

    #[test]
    fn pixels_without_data_do_not_darken_their_neighbours() {
        let mut picture = Raster::filled(2, 2, [200, 100, 50, 255]);
        picture.set(1, 1, [0; 4]);
        assert_eq!(picture.halved().get(0, 0), [200, 100, 50, 191]);
        assert_eq!(Raster::filled(2, 2, [0u8; 4]).halved().get(0, 0), [0; 4]);
    }
}
