//! Sums over rectangles of the strength of a picture's edges, by their direction.

use super::grid::RowGrid;
use pilotage_raster::raster::Raster;

/// Directions that are told apart, over half a turn.
pub(super) const DIRECTIONS: usize = 9;

/// Cosine and sine of 10°, 30°, …, 170°, where one direction ends and the next begins.
const BOUNDS: [(f64, f64); DIRECTIONS] = [
    (0.984_807_753_012_208, 0.173_648_177_666_930_33),
    (0.866_025_403_784_438_6, 0.5),
    (0.642_787_609_686_539_3, 0.766_044_443_118_978),
    (0.342_020_143_325_668_7, 0.939_692_620_785_908_4),
    (0.0, 1.0),
    (-0.342_020_143_325_668_7, 0.939_692_620_785_908_4),
    (-0.642_787_609_686_539_3, 0.766_044_443_118_978),
    (-0.866_025_403_784_438_6, 0.5),
    (-0.984_807_753_012_208, 0.173_648_177_666_930_33),
];

/// Longest gradient: both differences are 255.
const STRONGEST: f64 = 360.7;

/// For each direction, sums of the lengths of the gradients that lie in it, over all pixels above and
/// to the left of each corner; tables as [`super::integral::Integral`] has them.
///
/// A gradient is the difference of the two neighbours across and of the two along the column; beyond
/// the picture the outermost pixel goes on. All of its length counts for one direction: so does
/// OpenCV 2.4 (`HOGEvaluator` in `modules/objdetect/src/cascadedetect.cpp`). There the sums are floating
/// point numbers, which lose digits towards the lower right; here they are whole multiples of `unit`.
#[derive(Clone, Debug, Default)]
pub(super) struct Histograms {
    /// Sums by direction.
    pub directions: [Vec<i32>; DIRECTIONS],
    /// Sums over all directions.
    pub all: Vec<i32>,
}

/// Grey levels that a one in the tables stands for, so that no sum over a window of that many pixels
/// leaves 31 bits.
pub(super) fn unit(window_pixels: usize) -> f32 {
    let most = STRONGEST * window_pixels as f64;
    let bits = (f64::from(i32::MAX) / most).log2().floor();
    (-bits.clamp(0.0, 12.0)).exp2() as f32
}

/// Direction of a gradient: the first holds 10° up to 30° from x towards y, the last 170° up to 190°;
/// opposite gradients have the same one.
pub(super) fn direction(dx: i32, dy: i32) -> usize {
    let forward = dy > 0 || (dy == 0 && dx >= 0);
    let (dx, dy) = if forward { (dx, dy) } else { (-dx, -dy) };
    let (dx, dy) = (f64::from(dx), f64::from(dy));
    let passed = BOUNDS.iter().filter(|(c, s)| dy * c >= dx * s).count();
    // At zero degrees nothing is passed, and a gradient of no length passes all and counts nothing.
    (passed + DIRECTIONS - 1) % DIRECTIONS
}

impl Histograms {
    /// Fills the tables for a picture, in multiples of `unit`.
    pub fn fill(&mut self, picture: &Raster<u8>, grid: RowGrid, unit: f32) {
        let (width, height) = (picture.width(), picture.height());
        for table in self.directions.iter_mut().chain([&mut self.all]) {
            grid.prepare(height, table);
        }
        let mut lines = vec![[0_i32; DIRECTIONS + 1]; width + 1];
        let mut line = vec![0_i32; width + 1];
        for y in 0..height {
            let own = picture.row(y);
            let above = picture.row(y.saturating_sub(1));
            let below = picture.row((y + 1).min(height - 1));
            let mut running = [0_i32; DIRECTIONS + 1];
            for x in 0..width {
                let pixel = |row: &[u8], x: usize| i32::from(row[x]);
                let dx = pixel(own, (x + 1).min(width - 1)) - pixel(own, x.saturating_sub(1));
                let dy = pixel(below, x) - pixel(above, x);
                let length = f64::from(dx * dx + dy * dy).sqrt() / f64::from(unit);
                let length = length.round_ties_even() as i32;
                for bin in [direction(dx, dy), DIRECTIONS] {
                    running[bin] = running[bin].wrapping_add(length);
                }
                for (sum, running) in lines[x + 1].iter_mut().zip(running) {
                    *sum = sum.wrapping_add(running);
                }
            }
            for (bin, table) in self
                .directions
                .iter_mut()
                .chain([&mut self.all])
                .enumerate()
            {
                for (out, sums) in line.iter_mut().zip(&lines) {
                    *out = sums[bin];
                }
                grid.store(&line, y + 1, table);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_those_of_the_angle() {
        for dy in -255_i32..=255 {
            for dx in -255_i32..=255 {
                if (dx, dy) == (0, 0) {
                    continue;
                }
                let turns = f64::from(dy).atan2(f64::from(dx)) * 9.0 / std::f64::consts::PI - 0.5;
                let bin = turns.floor() as i32;
                assert_eq!(direction(dx, dy) as i32, bin.rem_euclid(9), "{dx} {dy}");
            }
        }
    }

    #[test]
    fn the_unit_keeps_the_strongest_window_within_31_bits() {
        for pixels in [9, 24 * 24, 64 * 128, 1 << 16] {
            let sum = 255.0 * 2_f64.sqrt() * pixels as f64 / f64::from(unit(pixels));
            assert!(sum < f64::from(i32::MAX), "{pixels}");
        }
    }
}
