//! Smoothing.

use super::{Gray, Raster, Rgb, bilinear, simd};

/// Least standard deviation of a Gaussian on a picture that was halved, in its pixels.
const LEAST_WHEN_HALVED: f64 = 8.0;

/// The picture smoothed by a Gaussian of standard deviation `sigma` pixels (cut at 3 σ); edges are
/// continued. A `sigma` that is not positive changes nothing.
pub fn gaussian_blur(picture: &Gray, sigma: f64) -> Gray {
    if !(sigma > 0.0 && sigma.is_finite()) || picture.is_empty() {
        return picture.clone();
    }
    let weights = gaussian_weights(sigma);
    let mut out = picture.clone();
    blur_planes(out.pixels_mut(), picture.width(), 1, &weights);
    out
}

/// [`gaussian_blur`] in a time that does not grow with `sigma`: wide ones are made on a picture of halved
/// size, halved as often as they allow, and interpolated. Away from the edges they differ from it by a
/// thousandth of the contrast.
pub fn wide_blur(picture: &Gray, sigma: f64) -> Gray {
    let (mut small, mut side) = (picture.clone(), 1.0);
    while sigma >= 2.0 * side * LEAST_WHEN_HALVED && small.width().min(small.height()) >= 2 {
        small = small.halved();
        side *= 2.0;
    }
    if side <= 1.0 {
        return gaussian_blur(picture, sigma);
    }
    // The means and the interpolation between them spread a dot, too.
    let variance = sigma * sigma - (side * side - 1.0) / 12.0 - side * side / 6.0;
    let blurred = gaussian_blur(&small, variance.sqrt() / side);
    let per_pixel = 1.0 / side as f32;
    Gray::from_fn(picture.width(), picture.height(), |x, y| {
        // What halving left out at the edges continues them.
        let x = ((x as f32 + 0.5) * per_pixel).min(blurred.width() as f32);
        let y = ((y as f32 + 0.5) * per_pixel).min(blurred.height() as f32);
        bilinear(&blurred, x, y).unwrap_or_default()
    })
}

/// [`gaussian_blur`] of each colour.
pub fn gaussian_blur_colour(picture: &Raster<Rgb>, sigma: f64) -> Raster<Rgb> {
    if !(sigma > 0.0 && sigma.is_finite()) || picture.is_empty() {
        return picture.clone();
    }
    let weights = gaussian_weights(sigma);
    let mut samples: Vec<f32> = picture
        .pixels()
        .iter()
        .flat_map(|rgb| rgb.map(f32::from))
        .collect();
    blur_planes(&mut samples, picture.width(), 3, &weights);
    let mut out = picture.clone();
    for (pixel, sample) in out.pixels_mut().iter_mut().zip(samples.chunks_exact(3)) {
        for (value, &sample) in pixel.iter_mut().zip(sample) {
            *value = (sample + 0.5) as u8;
        }
    }
    out
}

/// [`gaussian_blur`] of interleaved samples, `channels` per pixel and `width` pixels in a row, in
/// place.
pub fn blur_interleaved(samples: &mut [f32], width: usize, channels: usize, sigma: f64) {
    if sigma > 0.0 && sigma.is_finite() && !samples.is_empty() {
        blur_planes(samples, width, channels, &gaussian_weights(sigma));
    }
}

/// The mean over a window of `2·radius + 1` pixels a side, cut at the edges of the picture.
///
/// ```
/// use pilotage_raster::raster::{Gray, box_blur};
///
/// let mut picture = Gray::filled(5, 5, 0.0);
/// picture.set(2, 2, 9.0);
/// let blurred = box_blur(&picture, 1);
/// assert!((blurred.get(1, 1) - 1.0).abs() < 1e-6); // 9 over 3 × 3 pixels
/// assert_eq!(blurred.get(0, 0), 0.0);
/// ```
pub fn box_blur(picture: &Gray, radius: usize) -> Gray {
    let table = super::IntegralImage::new(picture);
    let (width, height) = (picture.width(), picture.height());
    Gray::from_fn(width, height, |x, y| {
        let (left, top) = (x.saturating_sub(radius), y.saturating_sub(radius));
        let (w, h) = (
            (x + radius + 1).min(width) - left,
            (y + radius + 1).min(height) - top,
        );
        (table.sum(left, top, w, h) / (w * h) as f64) as f32
    })
}

/// Weights of one side, the middle first, normalized over both sides.
fn gaussian_weights(sigma: f64) -> Vec<f32> {
    let radius = (3.0 * sigma).ceil().clamp(1.0, 200.0) as i32;
    let weight = |i: i32| (-0.5 * (f64::from(i) / sigma).powi(2)).exp();
    let total: f64 = (-radius..=radius).map(weight).sum();
    (0..=radius).map(|i| (weight(i) / total) as f32).collect()
}

/// Smooths interleaved samples, `channels` per pixel, first across and then down, in place.
fn blur_planes(samples: &mut [f32], width: usize, channels: usize, weights: &[f32]) {
    let radius = weights.len() - 1;
    let row_length = width * channels;
    let height = samples.len() / row_length;
    let mut padded = vec![0.0f32; (width + 2 * radius) * channels];
    // Samples as far before the middle one as behind it.
    let mut pairs: Vec<(usize, usize)> = (1..=radius)
        .map(|i| ((radius - i) * channels, (radius + i) * channels))
        .collect();
    for line in samples.chunks_exact_mut(row_length) {
        padded[radius * channels..][..row_length].copy_from_slice(line);
        for i in 0..radius {
            for c in 0..channels {
                padded[i * channels + c] = line[c];
                padded[(radius + width + i) * channels + c] = line[row_length - channels + c];
            }
        }
        simd::weighted_pairs(&padded, radius * channels, &pairs, weights, line);
    }
    // Down the columns, from a copy of what is smoothed across.
    let source = samples.to_vec();
    for (y, line) in samples.chunks_exact_mut(row_length).enumerate() {
        for (i, pair) in (1..).zip(&mut pairs) {
            let (above, below) = (y.saturating_sub(i), (y + i).min(height - 1));
            *pair = (above * row_length, below * row_length);
        }
        simd::weighted_pairs(&source, y * row_length, &pairs, weights, line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_spreads_to_the_given_width_and_keeps_its_light() {
        let mut dot = Gray::filled(41, 41, 0.0);
        dot.set(20, 20, 100.0);
        let out = gaussian_blur(&dot, 2.5);
        let total: f32 = out.pixels().iter().sum();
        assert!((total - 100.0).abs() < 1e-3, "{total}");
        let spread: f32 = (0..41 * 41)
            .map(|i| out.pixels()[i] * ((i % 41) as f32 - 20.0).powi(2))
            .sum();
        assert!(
            ((spread / total).sqrt() - 2.5).abs() < 0.05,
            "{}",
            (spread / total).sqrt()
        );
    }

    #[test]
    fn a_wide_blur_is_the_same_on_a_halved_picture() {
        let mut state = 1_u32;
        let picture = Gray::from_fn(301, 233, |_, _| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as f32
        });
        // Noise of 74 grey levels: a blur by 9 leaves 2.3 of it, by 17 1.2. Beyond the edges it is not the
        // same noise that is continued.
        for (sigma, most) in [(2.0, 0.0), (9.0, 0.2), (17.0, 0.15)] {
            let (slow, fast) = (gaussian_blur(&picture, sigma), wide_blur(&picture, sigma));
            let edge = (3.0 * sigma) as usize;
            let inner = (edge..301 - edge).flat_map(|x| (edge..233 - edge).map(move |y| (x, y)));
            let squares = inner.map(|(x, y)| (slow.get(x, y) - fast.get(x, y)).powi(2));
            let off = (squares.sum::<f32>() / ((301 - 2 * edge) * (233 - 2 * edge)) as f32).sqrt();
            assert!(off <= most, "{sigma}: {off}");
        }
    }

    #[test]
    fn an_even_picture_stays_even_up_to_its_edges() {
        let even = Gray::filled(7, 5, 31.0);
        for out in [gaussian_blur(&even, 3.0), box_blur(&even, 4)] {
            assert!(out.pixels().iter().all(|v| (v - 31.0).abs() < 1e-4));
        }
        let colour = Raster::filled(7, 5, [10, 200, 30]);
        assert_eq!(gaussian_blur_colour(&colour, 1.2), colour);
    }

    #[test]
    fn the_box_averages_its_window() {
        let ramp = Gray::from_fn(9, 9, |x, y| (x * x + y) as f32);
        let expected: f32 = (2..5)
            .flat_map(|x| (3..6).map(move |y| (x * x + y) as f32))
            .sum();
        assert!((box_blur(&ramp, 1).get(3, 4) - expected / 9.0).abs() < 1e-4);
    }
}
