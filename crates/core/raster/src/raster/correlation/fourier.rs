//! Cross-correlation through one complex Fourier transform of half the picture's pixels.
//!
//! Written row after row, a picture of W × H pixels is a signal of W·H samples, and a template laid
//! out with the same stride W is one too. Their one-dimensional correlation at lag y·W + x is the
//! two-dimensional one at (x, y) for every place at which the template lies inside the picture:
//! there no row of the template reaches over the end of a row. The highest sample such a place
//! touches is W·H - 1, so N ≥ W·H samples suffice, without zeros in between and without the two
//! passes of a two-dimensional transform.
//!
//! The correlation is a convolution with the reversed template. For real signals of N samples it is
//! computed with complex transforms of N/2: with z(n) = x(n) + i x(n + N/2) and the twist
//! w(n) = exp(iπn/N), the product of the transforms of z·w is the transform of the twisted
//! *negacyclic* convolution, whose samples wrap around with the sign changed. No valid place wraps
//! around, so the sign does not matter, and nothing has to be untangled afterwards.

use std::f64::consts::PI;
use std::sync::{Arc, Mutex, PoisonError};

use pilotage_fourier::{Complex32, Transforms};

use crate::raster::pool::Buffer;
use crate::raster::simd::{self, Twist};

/// Transform of a flattened, twisted real picture.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    pub stride: usize,
    pub length: usize,
    /// Samples of the flattened kernel less one: the lag of its first place. Zero for a picture.
    delay: usize,
    bins: Buffer<Complex32>,
}

/// Transforms for signals of one length.
struct TransformPlan {
    /// Of half as many complex samples.
    transforms: Transforms,
    twist: Twist,
}

/// Plans kept; a navigator meets few lengths.
const KEPT_PLANS: usize = 64;

/// The plan for signals of `length` real samples.
fn plan(length: usize) -> Arc<TransformPlan> {
    static PLANS: Mutex<Vec<(usize, Arc<TransformPlan>)>> = Mutex::new(Vec::new());
    let mut plans = PLANS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, plan)) = plans.iter().find(|(own, _)| *own == length) {
        return Arc::clone(plan);
    }
    let angle = |n: usize| PI * n as f64 / length as f64;
    let plan = Arc::new(TransformPlan {
        transforms: pilotage_fourier::plan(length / 2),
        twist: Twist {
            cos: (0..length / 2).map(|n| angle(n).cos() as f32).collect(),
            sin: (0..length / 2).map(|n| angle(n).sin() as f32).collect(),
        },
    });
    if plans.len() >= KEPT_PLANS {
        plans.remove(0);
    }
    plans.push((length, Arc::clone(&plan)));
    plan
}

/// The shortest length of at least `length` samples that transforms fast.
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
    /// Of a picture given row by row, `stride` pixels in each; `length` is even and not shorter.
    pub fn of_picture(pixels: &[f32], stride: usize, length: usize) -> Self {
        let plan = plan(length);
        let half = length / 2;
        let mut bins = Buffer::<Complex32>::dirty(half);
        // The last samples are zeros.
        let mut padded = Buffer::<f32>::dirty(length);
        padded[..pixels.len()].copy_from_slice(pixels);
        padded[pixels.len()..].fill(0.0);
        let (real, imaginary) = padded.split_at(half);
        simd::twist(real, imaginary, &plan.twist, &mut bins);
        plan.transform(&mut bins);
        Self {
            stride,
            length,
            delay: 0,
            bins,
        }
    }

    /// Of a correlation kernel with `width` pixels in a row: reversed and divided by N/2.
    pub fn of_kernel(pixels: &[f32], width: usize, stride: usize, length: usize) -> Self {
        let plan = plan(length);
        let half = length / 2;
        let delay = (pixels.len() / width - 1) * stride + width - 1;
        let scale = 1.0 / half as f32;
        let mut bins = Buffer::<Complex32>::zeros(half);
        let mut add = |samples: &[f32], imaginary: bool, from: usize| {
            simd::twist_reversed(samples, scale, imaginary, &plan.twist, from, &mut bins);
        };
        for (row, line) in pixels.chunks_exact(width).enumerate() {
            // The row's last pixel comes first.
            let first = delay - row * stride + 1 - width;
            if first >= half {
                add(line, true, first - half);
            } else if first + width <= half {
                add(line, false, first);
            } else {
                let (second, head) = line.split_at(width - (half - first));
                add(head, false, first);
                add(second, true, 0);
            }
        }
        plan.transform(&mut bins);
        Self {
            stride,
            length,
            delay,
            bins,
        }
    }

    /// The correlation of a picture with a kernel: sample y·stride + x is place (x, y).
    pub fn correlate(&self, kernel: &Self) -> Buffer<f32> {
        debug_assert_eq!((self.stride, self.length), (kernel.stride, kernel.length));
        let mut product = Buffer::<Complex32>::dirty(self.bins.len());
        simd::multiply(&self.bins, &kernel.bins, &mut product);
        self.back(product, kernel.delay)
    }

    /// The sum of the correlations of the channels of a picture with those of a kernel, all of one size.
    pub fn correlate_sum(
        pictures: &[Self],
        kernels: impl Iterator<Item = Self>,
    ) -> Option<Buffer<f32>> {
        let mut sum: Option<(Buffer<Complex32>, usize)> = None;
        for (picture, kernel) in pictures.iter().zip(kernels) {
            let (sum, _) = sum.get_or_insert_with(|| {
                (Buffer::<Complex32>::zeros(picture.bins.len()), kernel.delay)
            });
            let bins = picture.bins.iter().zip(kernel.bins.iter());
            for (sum, (a, b)) in sum.iter_mut().zip(bins) {
                sum.re += a.re * b.re - a.im * b.im;
                sum.im += a.re * b.im + a.im * b.re;
            }
        }
        let (product, delay) = sum?;
        Some(pictures.first()?.back(product, delay))
    }

    /// Transforms a product back; places begin at the kernel's delay.
    fn back(&self, mut product: Buffer<Complex32>, delay: usize) -> Buffer<f32> {
        let plan = plan(self.length);
        let inverse = &plan.transforms.inverse;
        let mut scratch = Buffer::<Complex32>::dirty(inverse.get_inplace_scratch_len());
        inverse.process_with_scratch(&mut product, &mut scratch);
        let half = self.length / 2;
        let mut samples = Buffer::<f32>::dirty(self.length - delay);
        let (real, imaginary) = samples.split_at_mut(half.saturating_sub(delay));
        simd::untwist_real(&product, &plan.twist, delay.min(half), real);
        let from = delay.saturating_sub(half);
        simd::untwist_imaginary(&product, &plan.twist, from, imaginary);
        samples
    }
}

impl TransformPlan {
    fn transform(&self, bins: &mut [Complex32]) {
        let forward = &self.transforms.forward;
        let mut scratch = Buffer::<Complex32>::dirty(forward.get_inplace_scratch_len());
        forward.process_with_scratch(bins, &mut scratch);
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
