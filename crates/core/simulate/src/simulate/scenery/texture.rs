//! Tileable detail, made once from the seed: four channels with a mip pyramid.
//!
//! Costly patterns (foliage, tufts of grass) are looked up instead of computed for every pixel;
//! individual offsets and turns hide the repetition.

use std::sync::Arc;

use super::noise::{floor, hash2, unit};
use super::shape::{Spot, spot};
use crate::simulate::channels::{between, floats, times};

/// Side of a texel at the finest level, metres.
const TEXEL: f32 = 0.125;

/// The textures of one seed; clones share them.
#[derive(Clone, Debug)]
pub(super) struct PeriodicTextures {
    pub(super) foliage: PeriodicTexture,
    pub(super) grain: PeriodicTexture,
    pub(super) land: PeriodicTexture,
}

impl PeriodicTextures {
    pub(super) fn new(seed: u64) -> Self {
        Self {
            foliage: foliage(seed as u32 ^ 0x51),
            grain: grain(seed as u32 ^ 0x52),
            land: lay_of_the_land(seed as u32 ^ 0x53),
        }
    }
}

/// A periodic picture of four channels from -1 to 1.
#[derive(Clone, Debug)]
pub(super) struct PeriodicTexture {
    levels: Arc<[Vec<[i8; 4]>]>,
    side: usize,
}

impl PeriodicTexture {
    /// A texture of `side` (a power of two) texels, computed texel by texel.
    pub(super) fn from_fn(side: usize, f: impl Fn(f32, f32) -> [f32; 4]) -> Self {
        let finest = (0..side * side)
            .map(|i| {
                let (x, y) = ((i / side) as f32 + 0.5, (i % side) as f32 + 0.5);
                f(x * TEXEL, y * TEXEL).map(|v| (v.clamp(-1.0, 1.0) * 127.0).round() as i8)
            })
            .collect();
        let mut levels: Vec<Vec<[i8; 4]>> = vec![finest];
        let mut n = side;
        while n > 1 {
            n /= 2;
            let finer = &levels[levels.len() - 1];
            let coarser = (0..n * n)
                .map(|i| {
                    let (x, y) = (2 * (i / n), 2 * (i % n));
                    std::array::from_fn(|c| {
                        let at =
                            |dx: usize, dy: usize| i16::from(finer[(x + dx) * 2 * n + y + dy][c]);
                        (f32::from(at(0, 0) + at(0, 1) + at(1, 0) + at(1, 1)) * 0.25).round() as i8
                    })
                })
                .collect();
            levels.push(coarser);
        }
        Self {
            levels: levels.into(),
            side,
        }
    }

    /// Channels at a place, averaged over about `gsd` metres.
    #[inline]
    pub(super) fn sample(&self, p: Spot, gsd: f32) -> [f32; 4] {
        // The next power of two above the pixel's size in texels, from the exponent's bits.
        let level = if gsd < 0.18 {
            0
        } else {
            let exponent = ((gsd * (1.0 / 0.18)).to_bits() >> 23) as usize - 126;
            exponent.min(self.levels.len() - 1)
        };
        let n = self.side >> level;
        let mask = n as i32 - 1;
        let k = 1.0 / (TEXEL * (1 << level) as f32);
        let (x, y) = (p.n * k - 0.5, p.e * k - 0.5);
        let (ix, iy) = (floor(x), floor(y));
        let (tx, ty) = (x - ix as f32, y - iy as f32);
        let row = |i: i32| ((i & mask) as usize) * n;
        let column = |i: i32| (i & mask) as usize;
        let texels = &self.levels[level];
        let (a, b) = (
            texels[row(ix) + column(iy)],
            texels[row(ix + 1) + column(iy)],
        );
        let (c, d) = (
            texels[row(ix) + column(iy + 1)],
            texels[row(ix + 1) + column(iy + 1)],
        );
        let left = between(floats(a), floats(b), tx);
        let right = between(floats(c), floats(d), tx);
        times(between(left, right, ty), 1.0 / 127.0)
    }
}

/// `x` in the first period, for a place within one period of it: the same number as that of
/// `rem_euclid`, whose division costs more than all the rest.
#[inline]
fn wrapped(x: f32, period: f32) -> f32 {
    if x < 0.0 {
        x + period
    } else if x >= period {
        x - period
    } else {
        x
    }
}

/// Periodic smooth noise from -1 to 1 on a lattice whose values are drawn once.
struct Periodic {
    cells: i32,
    period: f32,
    lattice: Vec<f32>,
}

impl Periodic {
    /// `cells` lattice cells in `period` metres.
    fn new(cells: i32, period: f32, seed: u32) -> Self {
        let places = (0..cells).flat_map(|x| (0..cells).map(move |y| (x, y)));
        Self {
            cells,
            period,
            lattice: places.map(|(x, y)| unit(hash2(x, y, seed))).collect(),
        }
    }

    /// The noise at a place of the first period or just beyond its end.
    #[inline]
    fn at(&self, x: f32, y: f32) -> f32 {
        let k = self.cells as f32 / self.period;
        let (x, y) = (wrapped(x, self.period) * k, wrapped(y, self.period) * k);
        let (ix, iy) = (floor(x), floor(y));
        let (tx, ty) = (x - ix as f32, y - iy as f32);
        let (sx, sy) = (tx * tx * (3.0 - 2.0 * tx), ty * ty * (3.0 - 2.0 * ty));
        let wrap = |i: i32| if i >= self.cells { i - self.cells } else { i };
        let (ix, iy) = (wrap(ix), wrap(iy));
        let (next_x, next_y) = (wrap(ix + 1), wrap(iy + 1));
        let at = |x: i32, y: i32| self.lattice[(x * self.cells + y) as usize];
        let top = at(ix, iy) + (at(next_x, iy) - at(ix, iy)) * sx;
        let bottom = at(ix, next_y) + (at(next_x, next_y) - at(ix, next_y)) * sx;
        2.0 * (top + (bottom - top) * sy) - 1.0
    }
}

/// Periodic cells: distance to the nearest seed point in cell sides, and that point's own number.
fn cells(x: f32, y: f32, count: i32, period: f32, seed: u32) -> (f32, f32) {
    let k = count as f32 / period;
    let (x, y) = (x * k, y * k);
    let (ix, iy) = (x.floor() as i32, y.floor() as i32);
    let mut best = (9.0_f32, 0.0);
    for i in -1..=1 {
        for j in -1..=1 {
            let h = hash2((ix + i).rem_euclid(count), (iy + j).rem_euclid(count), seed);
            let dx = (ix + i) as f32 + unit(h) - x;
            let dy = (iy + j) as f32 + unit(h.wrapping_mul(0x9e37_79b1)) - y;
            // Most are clearly farther, which costs less to see than the distance.
            if dx * dx + dy * dy > 1.001 * best.0 * best.0 {
                continue;
            }
            let d = dx.hypot(dy);
            if d < best.0 {
                best = (d, unit(h.rotate_left(11)));
            }
        }
    }
    best
}

const FOLIAGE_SIDE: usize = 256;

/// Foliage: height 0 to 1 (as -1 to 1), slopes north and east (in units of 2.5), tone.
fn foliage(seed: u32) -> PeriodicTexture {
    let period = FOLIAGE_SIDE as f32 * TEXEL;
    let dome = |d: f32| (1.0 - d * d).max(0.0);
    let wave = |cells, salt| Periodic::new(cells, period, seed ^ salt);
    let (warps, bends) = (wave(32, 1), wave(35, 5));
    let raw = |x: f32, y: f32| {
        let warp = 0.5 * warps.at(x, y);
        let bend = 0.5 * bends.at(x, y);
        let (big, big_tone) = cells(x + warp, y + bend, 15, period, seed ^ 2);
        let (middle, middle_tone) = cells(x - bend, y + warp, 33, period, seed ^ 3);
        let (small, small_tone) = cells(x + 0.3 * bend, y - 0.3 * warp, 84, period, seed ^ 4);
        let height = 0.36 * dome(big) + 0.38 * dome(middle) + 0.26 * dome(small);
        let tone = 0.5 * (big_tone - 0.5) + 0.8 * (middle_tone - 0.5) + 1.1 * (small_tone - 0.5);
        (height, tone)
    };
    let mut heights = vec![(0.0, 0.0); FOLIAGE_SIDE * FOLIAGE_SIDE];
    for (i, h) in heights.iter_mut().enumerate() {
        let (x, y) = (
            (i / FOLIAGE_SIDE) as f32 + 0.5,
            (i % FOLIAGE_SIDE) as f32 + 0.5,
        );
        *h = raw(x * TEXEL, y * TEXEL);
    }
    let count = heights.len() as f32;
    let mean = heights.iter().map(|h| h.0).sum::<f32>() / count;
    let spread = (heights.iter().map(|h| (h.0 - mean).powi(2)).sum::<f32>() / count).sqrt();
    PeriodicTexture::from_fn(FOLIAGE_SIDE, |x, y| {
        let (i, j) = ((x / TEXEL) as usize, (y / TEXEL) as usize);
        let at = |i: usize, j: usize| heights[(i % FOLIAGE_SIDE) * FOLIAGE_SIDE + j % FOLIAGE_SIDE];
        let (height, tone) = at(i, j);
        let slope = |a: f32, b: f32| (a - b) / (2.0 * TEXEL) * 1.3 / 2.5;
        [
            (height - mean) / (2.2 * spread),
            slope(at(i + 1, j).0, at(i + FOLIAGE_SIDE - 1, j).0),
            slope(at(i, j + 1).0, at(i, j + FOLIAGE_SIDE - 1).0),
            tone,
        ]
    })
}

const GRAIN_SIDE: usize = 512;

/// Ground detail: speckle, clumps of half a metre, patches of some metres, thin veins.
fn grain(seed: u32) -> PeriodicTexture {
    let period = GRAIN_SIDE as f32 * TEXEL;
    let wave = |cells, salt| Periodic::new(cells, period, seed ^ salt);
    let speckles = [wave(512, 0), wave(301, 6)];
    let clumped = [wave(150, 7), wave(83, 8), wave(240, 9)];
    let patched = [wave(13, 0xa), wave(27, 0xb), wave(49, 0xc)];
    let (bends, ridges) = (wave(20, 0xd), wave(16, 0xe));
    PeriodicTexture::from_fn(GRAIN_SIDE, |x, y| {
        let speckle = 0.6 * speckles[0].at(x, y) + 0.5 * speckles[1].at(x, y);
        let clumps =
            0.6 * clumped[0].at(x, y) + 0.45 * clumped[1].at(x, y) + 0.3 * clumped[2].at(x, y);
        let patches =
            0.55 * patched[0].at(x, y) + 0.4 * patched[1].at(x, y) + 0.3 * patched[2].at(x, y);
        let bend = 1.5 * bends.at(x, y);
        let ridge = ridges.at(x + bend, y - bend).abs();
        let veins = 1.0 - (ridge * 14.0).min(1.0);
        [speckle, clumps, patches, veins]
    })
}

/// Side of the [`lay_of_the_land`] texture, in texture units of about 45 m.
pub(super) const LAND_SCALE: f32 = 1.0 / 45.0;

/// Slow variation of the land: how boundaries bend north and east, dampness, brightness.
fn lay_of_the_land(seed: u32) -> PeriodicTexture {
    const SIDE: usize = 256;
    let period = SIDE as f32 * TEXEL;
    let wave = |cells, salt| Periodic::new(cells, period, seed ^ salt);
    let north = [wave(16, 31), wave(39, 32)];
    let east = [wave(15, 33), wave(41, 34)];
    let damp = [wave(15, 35), wave(32, 36), wave(65, 37)];
    let bright = [wave(5, 38), wave(12, 39)];
    PeriodicTexture::from_fn(SIDE, |x, y| {
        [
            0.75 * north[0].at(x, y) + 0.25 * north[1].at(x, y),
            0.75 * east[0].at(x, y) + 0.25 * east[1].at(x, y),
            0.55 * damp[0].at(x, y) + 0.3 * damp[1].at(x, y) + 0.2 * damp[2].at(x, y),
            0.6 * bright[0].at(x, y) + 0.35 * bright[1].at(x, y),
        ]
    })
}

/// A place seen through an individual offset and quarter turn, so that neighbours differ.
#[inline]
pub(super) fn individual(p: Spot, variant: u32) -> Spot {
    let offset = spot(
        (variant & 0xff) as f32 * 0.37,
        (variant >> 8 & 0xff) as f32 * 0.41,
    );
    let q = p + offset;
    match variant >> 30 {
        0 => q,
        1 => spot(q.e, -q.n),
        2 => spot(-q.n, -q.e),
        _ => spot(-q.e, q.n),
    }
}

/// Turns a slope found through [`individual`] back into world directions.
#[inline]
pub(super) fn turned_back(slope: Spot, variant: u32) -> Spot {
    match variant >> 30 {
        0 => slope,
        1 => spot(-slope.e, slope.n),
        2 => spot(-slope.n, -slope.e),
        _ => spot(slope.e, -slope.n),
    }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn wrapping_gives_the_very_numbers_of_the_division() {
        for period in [32.0_f32, 64.0] {
            for i in -1000..2000 {
                let x = i as f32 * 0.001 * period + 1e-4;
                let wanted = x.rem_euclid(period);
                assert_eq!(wrapped(x, period).to_bits(), wanted.to_bits(), "{x}");
            }
        }
    }
}
