//! Cross-correlation through one real Fourier transform of the flattened picture.
//!
//! Written row after row, a picture of W × H pixels is a signal of W·H samples, and a template laid
//! out with the same stride W is one too. Their one-dimensional correlation at lag y·W + x is the
//! two-dimensional one at (x, y) for every place at which the template lies inside the picture:
//! there no row of the template reaches over the end of a row. The highest sample such a place
//! touches is W·H - 1, so a cyclic transform of W·H samples suffices, without zeros in between and
//! without the two passes of a two-dimensional transform.

use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use realfft::num_complex::Complex32;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// Half spectrum of a flattened real picture.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    pub stride: usize,
    pub length: usize,
    bins: Vec<Complex32>,
}

type Plans = (Arc<dyn RealToComplex<f32>>, Arc<dyn ComplexToReal<f32>>);

/// The plans for a length; the planner keeps what it has made.
fn plans(length: usize) -> Plans {
    static PLANNER: LazyLock<Mutex<RealFftPlanner<f32>>> =
        LazyLock::new(|| Mutex::new(RealFftPlanner::new()));
    let mut planner = PLANNER.lock().unwrap_or_else(PoisonError::into_inner);
    (
        planner.plan_fft_forward(length),
        planner.plan_fft_inverse(length),
    )
}

/// The shortest length of at least `length` samples that transforms fast: a power of two times 1,
/// 3, 5, 9 or 15 (over 16, so that the vector code applies).
pub(super) fn good_length(length: usize) -> usize {
    [1, 3, 5, 9, 15]
        .into_iter()
        .map(|odd| {
            let mut candidate = odd * 32;
            while candidate < length {
                candidate *= 2;
            }
            candidate
        })
        .min()
        .unwrap_or(length)
}

impl Spectrum {
    /// Of a picture given row by row, `stride` pixels in each.
    pub fn of_picture(pixels: &[f32], stride: usize, length: usize) -> Self {
        let mut samples = vec![0.0; length];
        samples[..pixels.len()].copy_from_slice(pixels);
        Self::of_samples(samples, stride)
    }

    /// Of a correlation kernel with `width` pixels in a row, conjugated and divided by the length.
    pub fn of_kernel(pixels: &[f32], width: usize, stride: usize, length: usize) -> Self {
        let mut samples = vec![0.0; length];
        for (target, source) in samples.chunks_mut(stride).zip(pixels.chunks_exact(width)) {
            target[..width].copy_from_slice(source);
        }
        let mut spectrum = Self::of_samples(samples, stride);
        let scale = 1.0 / length as f32;
        for bin in &mut spectrum.bins {
            *bin = Complex32::new(bin.re * scale, -bin.im * scale);
        }
        spectrum
    }

    fn of_samples(mut samples: Vec<f32>, stride: usize) -> Self {
        let length = samples.len();
        let (forward, _) = plans(length);
        let mut bins = forward.make_output_vec();
        let mut scratch = forward.make_scratch_vec();
        // The transform only refuses buffers of another length than its own.
        let done = forward.process_with_scratch(&mut samples, &mut bins, &mut scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        Self {
            stride,
            length,
            bins,
        }
    }

    /// The correlation with a kernel: `length` samples of which lag y·stride + x is place (x, y).
    pub fn correlate(&self, kernel: &Self) -> Vec<f32> {
        debug_assert_eq!((self.stride, self.length), (kernel.stride, kernel.length));
        let mut product: Vec<Complex32> = self
            .bins
            .iter()
            .zip(&kernel.bins)
            .map(|(a, b)| a * b)
            .collect();
        // The bins at zero and at the Nyquist frequency of a real signal are real.
        if let Some(first) = product.first_mut() {
            first.im = 0.0;
        }
        if let Some(last) = product.last_mut().filter(|_| self.length.is_multiple_of(2)) {
            last.im = 0.0;
        }
        let (_, inverse) = plans(self.length);
        let mut samples = inverse.make_output_vec();
        let mut scratch = inverse.make_scratch_vec();
        let done = inverse.process_with_scratch(&mut product, &mut samples, &mut scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        samples
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_good_length_is_at_most_a_third_longer_than_asked() {
        for length in 200..20_000 {
            let good = good_length(length);
            assert!(good >= length && good * 3 <= length * 4, "{length}: {good}");
        }
    }
}
