//! Pictures at halved sizes, for sampling at a coarser scale without aliasing.

use super::Gray;

/// Levels of the pyramid of a camera picture, in flight and wherever a flight is looked at or imitated.
pub const PYRAMID_LEVELS: usize = 6;

/// A grey picture and its 2×, 4×, … area averages.
#[derive(Clone, Debug)]
pub struct Pyramid {
    levels: Vec<Gray>,
}

impl Pyramid {
    /// Builds levels until the shorter side is below 16 pixels, at most `most` of them.
    ///
    /// ```
    /// use pilotage_raster::raster::{Gray, Pyramid};
    ///
    /// let pyramid = Pyramid::new(Gray::from_fn(64, 64, |column, _| column as f32), 3);
    /// let half = pyramid.level(1);
    /// assert_eq!((half.width(), half.height()), (32, 32));
    /// // The mean of columns 4 and 5.
    /// assert_eq!(half.get(2, 0), 4.5);
    /// ```
    pub fn new(base: Gray, most: usize) -> Self {
        let mut levels = vec![base];
        while levels.len() < most {
            let last = &levels[levels.len() - 1];
            if last.width().min(last.height()) < 32 {
                break;
            }
            let next = last.halved();
            levels.push(next);
        }
        Self { levels }
    }

    /// Number of levels.
    pub fn len(&self) -> usize {
        self.levels.len()
    }

    /// Whether there is no pixel at all.
    pub fn is_empty(&self) -> bool {
        self.levels[0].is_empty()
    }

    /// Level `index`, halved that many times.
    pub fn level(&self, index: usize) -> &Gray {
        &self.levels[index.min(self.levels.len() - 1)]
    }

    /// The level whose pixels are the largest that are not larger than `pixels` base pixels.
    pub fn level_for(&self, pixels: f64) -> usize {
        let index = (pixels.max(1.0) * 1.01).log2().floor() as usize;
        index.min(self.levels.len() - 1)
    }
}

/// Bilinear sample at continuous pixel (x, y), centres at half integers; `None` outside the picture.
pub fn bilinear(picture: &Gray, x: f32, y: f32) -> Option<f32> {
    let (width, height) = (picture.width() as f32, picture.height() as f32);
    if !(x >= 0.0 && y >= 0.0 && x <= width && y <= height) {
        return None;
    }
    let cx = (x - 0.5).clamp(0.0, width - 1.0);
    let cy = (y - 0.5).clamp(0.0, height - 1.0);
    let (c0, r0) = (cx as usize, cy as usize);
    let (c1, r1) = (
        (c0 + 1).min(picture.width() - 1),
        (r0 + 1).min(picture.height() - 1),
    );
    let (fx, fy) = (cx - c0 as f32, cy - r0 as f32);
    let (upper, lower) = (picture.row(r0), picture.row(r1));
    let top = upper[c0] + fx * (upper[c1] - upper[c0]);
    let bottom = lower[c0] + fx * (lower[c1] - lower[c0]);
    Some(top + fy * (bottom - top))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_keeps_its_values_at_every_level() {
        let ramp = Gray::from_fn(128, 64, |c, r| c as f32 + 0.5 + 3.0 * (r as f32 + 0.5));
        let pyramid = Pyramid::new(ramp, 4);
        for (index, scale) in [(0, 1.0_f32), (1, 2.0), (2, 4.0)] {
            let value = bilinear(pyramid.level(index), 40.0 / scale, 20.0 / scale).unwrap();
            assert!((value - 100.0).abs() < 1e-3, "level {index}: {value}");
        }
    }

    #[test]
    fn outside_there_is_nothing() {
        let picture = Gray::filled(4, 4, 1.0);
        assert_eq!(bilinear(&picture, -0.1, 2.0), None);
        assert_eq!(bilinear(&picture, 2.0, 4.1), None);
        assert_eq!(bilinear(&picture, 0.0, 4.0), Some(1.0));
    }
}
