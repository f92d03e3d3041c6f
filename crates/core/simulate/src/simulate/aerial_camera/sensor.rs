//! From light to the numbers of a picture.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

use super::AerialCameraSettings;
use super::ground::PixelLight;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::{Picture, blur_interleaved};

/// Optics, vignetting, exposure, noise and eight bits.
pub(super) fn expose(
    light: PixelLight,
    camera: &CameraModel,
    settings: &AerialCameraSettings,
    gain: f64,
    random: &mut ChaCha8Rng,
) -> Picture {
    let width = light.width;
    let mut samples = light.samples;
    blur_interleaved(&mut samples, width, 3, settings.blur_sigma);
    let seed = random.next_u64();
    let (half_width, half_height) = (0.5 * camera.width as f32, 0.5 * camera.height as f32);
    let per_corner = 1.0 / (half_width * half_width + half_height * half_height);
    let (gain, loss) = (gain as f32, settings.vignetting as f32);
    let noise = settings.noise_sd as f32;
    let mut picture = Picture::filled(width, camera.height, [0; 3]);
    let lines = samples.chunks_exact(3 * width).enumerate();
    for (row, line) in lines {
        let mut random = NormalNumbers::new(seed, row);
        let dy = row as f32 + 0.5 - half_height;
        let pixels = picture.row_mut(row).iter_mut().zip(line.as_chunks::<3>().0);
        for (column, (pixel, light)) in pixels.enumerate() {
            let dx = column as f32 + 0.5 - half_width;
            let factor = gain * (1.0 - loss * (dx * dx + dy * dy) * per_corner);
            let mut code = |v: f32| {
                let value = v * factor;
                // Photons arrive at random: their noise grows with the root of the light.
                let spread = noise * (0.3 + 0.7 * value * (1.0 / 128.0)).max(0.0).sqrt();
                // Conversion from floating point saturates.
                (value + spread * random.next() + 0.5) as u8
            };
            *pixel = [code(light[0]), code(light[1]), code(light[2])];
        }
    }
    picture
}

/// Draws what [`expose`] would.
pub(super) fn pass_over(random: &mut ChaCha8Rng) {
    random.next_u64();
}

/// Nearly normal numbers of unit variance at a nanosecond each: the sum of four uniform ones.
struct NormalNumbers(u64);

impl NormalNumbers {
    fn new(seed: u64, row: usize) -> Self {
        Self(seed.wrapping_add((row as u64).wrapping_mul(0xd1b5_4a32_d192_ed03)))
    }

    /// Steele, Lea & Flood 2014 (`SplitMix64`), cut into four numbers of 16 bits.
    #[inline]
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        let sum = (z & 0xffff) + ((z >> 16) & 0xffff) + ((z >> 32) & 0xffff) + (z >> 48);
        // Mean 2·65535, variance 4·(65536² - 1)/12.
        (sum as f32 - 131_070.0) * (1.0 / 37_837.23)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_noise_has_zero_mean_and_unit_variance() {
        let (mut sum, mut squares) = (0.0, 0.0);
        for row in 0..100 {
            let mut noise = NormalNumbers::new(7, row);
            for _ in 0..1000 {
                let v = f64::from(noise.next());
                sum += v;
                squares += v * v;
            }
        }
        assert!((sum / 1e5).abs() < 0.012, "{sum}");
        assert!((squares / 1e5 - 1.0).abs() < 0.015, "{squares}");
    }
}
