//! Deterministic numbers: integer hashes, value noise and a small seeded generator.

/// Mixes two lattice coordinates and a seed into 32 well distributed bits.
#[inline]
pub(super) fn hash2(x: i32, y: i32, seed: u32) -> u32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1)
        ^ (y as u32).wrapping_mul(0x85eb_ca77).rotate_left(13)
        ^ seed.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}

/// A hash as a number from 0 to 1.
#[inline]
pub(super) fn unit(h: u32) -> f32 {
    (h >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// The whole number at or below `x` (a call to the library's floor costs more than all the rest).
#[inline]
pub(super) fn floor(x: f32) -> i32 {
    let whole = x as i32;
    whole - i32::from(x < whole as f32)
}

/// Smooth value noise from -1 to 1 with features of about one unit.
#[inline]
pub(in crate::simulate) fn value_noise(x: f32, y: f32, seed: u32) -> f32 {
    let (ix, iy) = (floor(x), floor(y));
    let (tx, ty) = (x - ix as f32, y - iy as f32);
    let (sx, sy) = (tx * tx * (3.0 - 2.0 * tx), ty * ty * (3.0 - 2.0 * ty));
    let a = unit(hash2(ix, iy, seed));
    let b = unit(hash2(ix + 1, iy, seed));
    let c = unit(hash2(ix, iy + 1, seed));
    let d = unit(hash2(ix + 1, iy + 1, seed));
    let top = a + (b - a) * sx;
    let bottom = c + (d - c) * sx;
    2.0 * (top + (bottom - top) * sy) - 1.0
}

/// Octaves of value noise from `wavelength` metres downwards, each faded out before it aliases at
/// `gsd` metres per pixel; about -1 to 1.
#[inline]
pub(in crate::simulate) fn fractal(
    x: f32,
    y: f32,
    wavelength: f32,
    octaves: u32,
    gsd: f32,
    seed: u32,
) -> f32 {
    let (mut sum, mut amplitude, mut length) = (0.0, 0.55, wavelength);
    for octave in 0..octaves {
        let keep = fade(length, gsd);
        if keep <= 0.0 {
            break;
        }
        sum += amplitude * keep * value_noise(x / length, y / length, seed.wrapping_add(octave));
        amplitude *= 0.55;
        length *= 0.47;
    }
    sum
}

/// Share of a pattern of that wavelength that survives the averaging over a pixel, 0 to 1.
#[inline]
pub(super) fn fade(wavelength: f32, gsd: f32) -> f32 {
    ((wavelength / gsd - 1.0) * 0.66).clamp(0.0, 1.0)
}

/// Smooth step from 0 below `low` to 1 above `high`.
#[inline]
pub(super) fn smooth_step(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A small seeded generator (splitmix64) for laying things out.
#[derive(Clone, Debug)]
pub(super) struct Dice(u64);

impl Dice {
    /// The generator of `seed` for one `purpose`.
    pub(super) fn new(seed: u64, purpose: u64) -> Self {
        let mut dice = Self(seed ^ purpose.wrapping_mul(0xd6e8_feb8_6659_fd93));
        dice.bits();
        dice
    }

    /// 64 random bits.
    pub(super) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform from 0 to 1.
    pub(super) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 * (1.0 / 16_777_216.0)
    }

    /// Uniform from `low` to `high`.
    pub(super) fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// True with the given probability.
    pub(super) fn chance(&mut self, probability: f32) -> bool {
        self.unit() < probability
    }

    /// Draws one of the choices.
    pub(super) fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[(self.bits() % choices.len() as u64) as usize]
    }
}
