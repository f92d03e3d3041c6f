//! Inner loops written for the processor's vector registers, with a scalar twin.
//!
//! The instruction set is chosen at run time on x86-64 and by the build on WebAssembly. Everything
//! here works on buffers padded by the caller, so that no loop has a ragged end.

mod blocks;
mod elementwise;
#[cfg(any(test, not(all(target_arch = "wasm32", target_feature = "simd128"))))]
mod scalar;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(super) use blocks::{BlockKernel, PaddedRows};
pub(super) use elementwise::{CoefficientScale, Twist};
#[cfg(not(target_arch = "x86_64"))]
pub(super) use elementwise::{
    accumulate, coefficients, four_running_sums, multiply, subtract, twist, twist_reversed,
    untwist_imaginary, untwist_real, weighted_pairs,
};
#[cfg(target_arch = "x86_64")]
pub(super) use x86::{
    accumulate, coefficients, four_running_sums, multiply, subtract, twist, twist_reversed,
    untwist_imaginary, untwist_real, weighted_pairs,
};

use super::pool::Buffer;

/// Choice of the twin to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instructions {
    /// The fastest that this machine has.
    Best,
    /// Plain loops.
    #[cfg(test)]
    Scalar,
}

/// Cross-correlation of `columns` × `rows` offsets: `out[(y, x)] = Σ kernel(i, j) search(x+i, y+j)`.
///
/// `out` has the returned stride, which is `columns` rounded up to whole vectors; columns beyond
/// `columns` hold nothing of use.
pub(super) fn correlate(
    search: &PaddedRows,
    kernel: &BlockKernel,
    columns: usize,
    rows: usize,
    instructions: Instructions,
) -> (usize, Buffer<f32>) {
    let stride = columns.next_multiple_of(8);
    let mut out = Buffer::<f32>::zeros(stride * rows);
    match instructions {
        #[cfg(test)]
        Instructions::Scalar => scalar::correlate(search, kernel, &mut out, stride, rows),
        Instructions::Best => {
            #[cfg(target_arch = "x86_64")]
            if x86::correlate(search, kernel, &mut out, stride, rows) {
                return (stride, out);
            }
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            wasm::correlate(search, kernel, &mut out, stride, rows);
            #[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
            scalar::correlate(search, kernel, &mut out, stride, rows);
        }
    }
    (stride, out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_vector_loops_agree_with_the_scalar_ones(
            width in 1usize..70,
            height in 1usize..20,
            kernel_width in 1usize..20,
            kernel_height in 1usize..12,
            seed in any::<u32>(),
        ) {
            let (kw, kh) = (kernel_width.min(width), kernel_height.min(height));
            let mut state = seed | 1;
            let mut next = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 8) as f32 / 16_777_216.0 - 0.5
            };
            let pixels: Vec<f32> = (0..width * height).map(|_| next()).collect();
            let taps: Vec<f32> = (0..kw * kh).map(|_| next()).collect();
            let search = PaddedRows::new(&pixels, width);
            let kernel = BlockKernel::new(&taps, kw, kh);
            let (columns, rows) = (width - kw + 1, height - kh + 1);
            let (stride, best) = correlate(&search, &kernel, columns, rows, Instructions::Best);
            let (_, plain) = correlate(&search, &kernel, columns, rows, Instructions::Scalar);
            for y in 0..rows {
                for x in 0..columns {
                    let sum: f64 = (0..kh)
                        .flat_map(|j| (0..kw).map(move |i| (i, j)))
                        .map(|(i, j)| f64::from(taps[j * kw + i])
                            * f64::from(pixels[(y + j) * width + x + i]))
                        .sum();
                    prop_assert!((f64::from(plain[y * stride + x]) - sum).abs() < 1e-5);
                    prop_assert!((f64::from(best[y * stride + x]) - sum).abs() < 1e-5);
                }
            }
        }

        #[test]
        fn pairs_are_summed_in_their_order_whatever_the_length_of_the_line(
            length in 1usize..120,
            radius in 0usize..9,
            samples in proptest::collection::vec(-200.0..200.0f32, 400),
            places in proptest::collection::vec((0usize..280, 0usize..280), 9),
            weights in proptest::collection::vec(0.0..1.0f32, 10),
        ) {
            let (pairs, weights) = (&places[..radius], &weights[..=radius]);
            let mut out = vec![0.0; length];
            weighted_pairs(&samples, 140, pairs, weights, &mut out);
            for (n, value) in out.iter().enumerate() {
                let mut sum = weights[0] * samples[140 + n];
                for (weight, (a, b)) in weights[1..].iter().zip(pairs) {
                    sum += weight * (samples[a + n] + samples[b + n]);
                }
                prop_assert_eq!(*value, sum);
            }
        }
    }
}
