//! Channels of a picture of the ground, averaged over cells, and their sums over squares.

use super::CELL_PIXELS;
use pilotage_raster::raster::{Gray, Raster, Rgba, luminance};

/// Number of channels with sums.
pub const SUMS: usize = 8;

/// Channels of a picture.
pub struct CoverPlanes {
    pub width: usize,
    pub height: usize,
    /// Brightness, over the mean of the picture.
    pub bright: Gray,
    /// Share of red in the light, less a third.
    pub red: Gray,
    /// Share of blue, less a third.
    pub blue: Gray,
    /// Differences of brightness within the cell and to the next ones.
    pub texture: Gray,
    /// Whether a cell was seen whole.
    pub seen: Vec<bool>,
    /// Sums over all cells above and left of a corner, corner by corner: of brightness, its square, red, blue, texture,
    /// and of the two parts and the length of the squared gradient. Beside each other, so that one look finds all.
    sums: Vec<[f64; SUMS]>,
}

impl CoverPlanes {
    /// Channels of `picture`, whose clear pixels were not seen.
    pub fn of(picture: &Raster<Rgba>) -> Self {
        let (width, height) = (
            picture.width() / CELL_PIXELS,
            picture.height() / CELL_PIXELS,
        );
        let lit = picture.pixels().iter().filter(|pixel| pixel[3] > 0);
        let (sum, count) = lit.fold((0.0_f64, 0_usize), |(sum, count), [r, g, b, _]| {
            (sum + f64::from(luminance([*r, *g, *b])), count + 1)
        });
        let mean = (sum / count.max(1) as f64).max(1.0) as f32;
        let mut planes = [0; 4].map(|_: u8| Gray::filled(width, height, 0.0));
        let mut seen = vec![false; width * height];
        for row in 0..height {
            let lines = [0, 1].map(|i| &picture.row(CELL_PIXELS * row + i)[..CELL_PIXELS * width]);
            let [bright, red, blue, texture] = &mut planes;
            let outs = [bright, red, blue, texture].map(|plane| plane.row_mut(row));
            let [bright, red, blue, texture] = outs;
            for column in 0..width {
                let at = CELL_PIXELS * column;
                let four = [
                    lines[0][at],
                    lines[0][at + 1],
                    lines[1][at],
                    lines[1][at + 1],
                ];
                if four.iter().any(|pixel| pixel[3] == 0) {
                    bright[column] = 1.0;
                    continue;
                }
                seen[row * width + column] = true;
                let light = four.map(|[r, g, b, _]| luminance([r, g, b]));
                let mut colour = [0_u32; 3];
                for pixel in &four {
                    for (sum, value) in colour.iter_mut().zip(pixel) {
                        *sum += u32::from(*value);
                    }
                }
                let all = (colour[0] + colour[1] + colour[2]).max(1) as f32;
                bright[column] = 0.25 * light.iter().sum::<f32>() / mean;
                red[column] = colour[0] as f32 / all - 1.0 / 3.0;
                blue[column] = colour[2] as f32 / all - 1.0 / 3.0;
                let across = (light[0] - light[1]).abs() + (light[2] - light[3]).abs();
                let along = (light[0] - light[2]).abs() + (light[1] - light[3]).abs();
                texture[column] = 0.25 * (across + along) / mean;
            }
        }
        let [bright, red, blue, texture] = planes;
        let (along, across, length) = gradients(&bright);
        let stride = width + 1;
        let mut sums = vec![[0.0; SUMS]; stride * (height + 1)];
        for row in 0..height {
            let mut running = [0.0; SUMS];
            for column in 0..width {
                let value = bright.get(column, row);
                let values = [
                    value,
                    value * value,
                    red.get(column, row),
                    blue.get(column, row),
                    texture.get(column, row),
                    along.get(column, row),
                    across.get(column, row),
                    length.get(column, row),
                ];
                let above = sums[row * stride + column + 1];
                let below = &mut sums[(row + 1) * stride + column + 1];
                for k in 0..SUMS {
                    running[k] += f64::from(values[k]);
                    below[k] = above[k] + running[k];
                }
            }
        }
        Self {
            width,
            height,
            bright,
            red,
            blue,
            texture,
            seen,
            sums,
        }
    }

    /// Means of the channels with sums over the cells at most `radius` away along each axis, as far as there are any.
    pub fn means(&self, (column, row): (usize, usize), radius: usize) -> [f32; SUMS] {
        let (left, top) = (column.saturating_sub(radius), row.saturating_sub(radius));
        let right = (column + radius + 1).min(self.width);
        let bottom = (row + radius + 1).min(self.height);
        let share = 1.0 / ((right - left) * (bottom - top)) as f64;
        let corner = |column: usize, row: usize| &self.sums[row * (self.width + 1) + column];
        let (a, b) = (corner(left, top), corner(right, top));
        let (c, d) = (corner(left, bottom), corner(right, bottom));
        std::array::from_fn(|k| ((d[k] - c[k] - b[k] + a[k]) * share) as f32)
    }
}

/// Squared gradient of a picture as a vector of twice its angle, and its length.
fn gradients(bright: &Gray) -> (Gray, Gray, Gray) {
    let (width, height) = (bright.width(), bright.height());
    let mut out = [0; 3].map(|_: u8| Gray::filled(width, height, 0.0));
    for row in 1..height.saturating_sub(1) {
        let (above, own, below) = (bright.row(row - 1), bright.row(row), bright.row(row + 1));
        let [along, across, length] = &mut out;
        let outs = [along, across, length].map(|plane| plane.row_mut(row));
        let [along, across, length] = outs;
        for column in 1..width.saturating_sub(1) {
            let x = own[column + 1] - own[column - 1];
            let y = below[column] - above[column];
            along[column] = x * x - y * y;
            across[column] = 2.0 * x * y;
            length[column] = x * x + y * y;
        }
    }
    let [along, across, length] = out;
    (along, across, length)
}
