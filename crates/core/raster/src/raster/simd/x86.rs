//! AVX-512, or AVX2 with fused multiply-add.
#![expect(
    unsafe_code,
    reason = "vector loads and stores take pointers, and functions for an instruction set that was \
              looked for at run time; every block's bounds are asserted first"
)]

use std::arch::x86_64::{
    __m256, __m512, _mm256_fmadd_ps, _mm256_loadu_ps, _mm256_set1_ps, _mm256_setzero_ps,
    _mm256_storeu_ps, _mm512_fmadd_ps, _mm512_loadu_ps, _mm512_set1_ps, _mm512_setzero_ps,
    _mm512_storeu_ps,
};

use pilotage_fourier::Complex32;

use super::blocks::{BLOCK_ROWS, BlockKernel, PaddedRows};
use super::elementwise::{self, Twist};
use crate::raster::integral::WindowCorners;

/// The instruction sets that the kernels are written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum InstructionSet {
    Avx512,
    Avx2,
    Baseline,
}

fn level() -> InstructionSet {
    if !(is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")) {
        InstructionSet::Baseline
    } else if is_x86_feature_detected!("avx512f") {
        InstructionSet::Avx512
    } else {
        InstructionSet::Avx2
    }
}

/// See [`super::correlate`]; answers false when the processor has no AVX2 with FMA.
pub(super) fn correlate(
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    rows: usize,
) -> bool {
    correlate_at(level(), search, kernel, out, stride, rows)
}

fn correlate_at(
    level: InstructionSet,
    search: &PaddedRows,
    kernel: &BlockKernel,
    out: &mut [f32],
    stride: usize,
    rows: usize,
) -> bool {
    if level == InstructionSet::Baseline {
        return false;
    }
    assert!(kernel.width > 0 && kernel.height > 0);
    assert!(stride.is_multiple_of(8) && stride * rows <= out.len());
    assert!(kernel.width - 1 + stride <= search.stride);
    assert!((rows + kernel.height - 1) * search.stride <= search.pixels.len());
    assert!(kernel.taps.len() >= (kernel.height + BLOCK_ROWS - 1) * kernel.width);
    let job = KernelCall {
        search,
        kernel,
        stride,
    };
    for y in (0..rows).step_by(BLOCK_ROWS) {
        // A block reads search rows y..y + R + kernel.height - 1 and columns from x to
        // x + columns + kernel.width - 1, and writes R rows and as many columns: inside by the
        // assertions above, as x + columns <= stride and y + R <= rows.
        match rows - y {
            1 => sweep_row::<1>(level, &job, out, y),
            2 => sweep_row::<2>(level, &job, out, y),
            3 => sweep_row::<3>(level, &job, out, y),
            _ => sweep_row::<4>(level, &job, out, y),
        }
    }
    true
}

struct KernelCall<'a> {
    search: &'a PaddedRows,
    kernel: &'a BlockKernel,
    stride: usize,
}

/// All blocks of `R` output rows from row `y` on.
fn sweep_row<const R: usize>(
    level: InstructionSet,
    job: &KernelCall<'_>,
    out: &mut [f32],
    y: usize,
) {
    let mut x = 0;
    while x < job.stride {
        let left = job.stride - x;
        // SAFETY: the caller looked for the instructions and asserted the bounds.
        x += unsafe {
            if level == InstructionSet::Avx512 && left >= 16 {
                // Equal pieces of at most four vectors.
                let vectors = left / 16;
                match vectors.div_ceil(vectors.div_ceil(4)) {
                    1 => wide_block::<R, 1>(job, out, x, y),
                    2 => wide_block::<R, 2>(job, out, x, y),
                    3 => wide_block::<R, 3>(job, out, x, y),
                    _ => wide_block::<R, 4>(job, out, x, y),
                }
            } else {
                match left {
                    8 => block::<R, 1>(job, out, x, y),
                    16 | 32 => block::<R, 2>(job, out, x, y),
                    _ => block::<R, 3>(job, out, x, y),
                }
            }
        };
    }
}

/// Defines a block of R rows and K vectors for one vector type.
///
/// Loads of the search are shared by the R rows, broadcasts of the kernel by the K vectors, so that
/// the multipliers and not the loads are the limit. The first and last R - 1 search rows touch only
/// some of the output rows.
macro_rules! block {
    ($block:ident, $sweep:ident, $features:literal, $vector:ty, $lanes:literal,
     $zero:ident, $load:ident, $broadcast:ident, $multiply_add:ident, $store:ident) => {
        /// Computes a single output block; answers the number of columns done.
        #[target_feature(enable = $features)]
        unsafe fn $block<const R: usize, const K: usize>(
            job: &KernelCall<'_>,
            out: &mut [f32],
            x: usize,
            y: usize,
        ) -> usize {
            let height = job.kernel.height;
            let mut sums = [[$zero(); K]; R];
            // SAFETY: see the caller.
            unsafe {
                for s in 0..height + R - 1 {
                    let first = (s + 1).saturating_sub(height);
                    match (first, (s + 1).min(R)) {
                        (0, end) if end == R => $sweep::<R, K, 0, 4>(job, x, y + s, s, &mut sums),
                        (0, 1) => $sweep::<R, K, 0, 1>(job, x, y + s, s, &mut sums),
                        (0, 2) => $sweep::<R, K, 0, 2>(job, x, y + s, s, &mut sums),
                        (0, 3) => $sweep::<R, K, 0, 3>(job, x, y + s, s, &mut sums),
                        (1, end) if end == R => $sweep::<R, K, 1, 4>(job, x, y + s, s, &mut sums),
                        (2, end) if end == R => $sweep::<R, K, 2, 4>(job, x, y + s, s, &mut sums),
                        (3, end) if end == R => $sweep::<R, K, 3, 4>(job, x, y + s, s, &mut sums),
                        // A kernel of fewer rows than the block: its taps are padded by zeros.
                        _ => $sweep::<R, K, 0, 4>(job, x, y + s, s, &mut sums),
                    }
                }
                for (r, row) in sums.iter().enumerate() {
                    let target = out.as_mut_ptr().add((y + r) * job.stride + x);
                    for (k, &sum) in row.iter().enumerate() {
                        $store(target.add($lanes * k), sum);
                    }
                }
            }
            $lanes * K
        }

        /// Adds search row `row`, which is row `s` of the block, to output rows FIRST..END.
        #[target_feature(enable = $features)]
        #[inline]
        unsafe fn $sweep<const R: usize, const K: usize, const FIRST: usize, const END: usize>(
            job: &KernelCall<'_>,
            x: usize,
            row: usize,
            s: usize,
            sums: &mut [[$vector; K]; R],
        ) {
            // SAFETY: see the caller.
            unsafe {
                let width = job.kernel.width;
                let mut source = job.search.pixels.as_ptr().add(row * job.search.stride + x);
                let mut taps = job.kernel.taps.as_ptr().add(s * width);
                let end = taps.add(width);
                let mut own = *sums;
                while taps < end {
                    let mut values = [$zero(); K];
                    for (k, value) in values.iter_mut().enumerate() {
                        *value = $load(source.add($lanes * k));
                    }
                    for (r, line) in own.iter_mut().enumerate() {
                        if r >= FIRST && r < END {
                            let weight = $broadcast((*taps)[r]);
                            for (sum, &value) in line.iter_mut().zip(&values) {
                                *sum = $multiply_add(weight, value, *sum);
                            }
                        }
                    }
                    source = source.add(1);
                    taps = taps.add(1);
                }
                *sums = own;
            }
        }
    };
}

block!(
    block,
    sweep,
    "avx2,fma",
    __m256,
    8,
    _mm256_setzero_ps,
    _mm256_loadu_ps,
    _mm256_set1_ps,
    _mm256_fmadd_ps,
    _mm256_storeu_ps
);
block!(
    wide_block,
    wide_sweep,
    "avx512f",
    __m512,
    16,
    _mm512_setzero_ps,
    _mm512_loadu_ps,
    _mm512_set1_ps,
    _mm512_fmadd_ps,
    _mm512_storeu_ps
);

/// Defines the plain loop of [`elementwise`] compiled for AVX2 beside the one for any processor.
macro_rules! for_avx2 {
    ($(#[$meta:meta])* $name:ident, $fast:ident, ($($argument:ident: $type:ty),*)) => {
        #[target_feature(enable = "avx2,fma")]
        fn $fast($($argument: $type),*) {
            elementwise::$name($($argument),*);
        }

        $(#[$meta])*
        pub(in crate::raster) fn $name($($argument: $type),*) {
            if level() == InstructionSet::Baseline {
                elementwise::$name($($argument),*);
            } else {
                // SAFETY: the instructions were looked for.
                unsafe { $fast($($argument),*) }
            }
        }
    };
}

for_avx2!(twist, twist_fast, (
    real: &[f32], imaginary: &[f32], twist: &Twist, out: &mut [Complex32]
));
for_avx2!(twist_reversed, twist_reversed_fast, (
    samples: &[f32], scale: f32, imaginary: bool, twist: &Twist, from: usize,
    out: &mut [Complex32]
));
for_avx2!(untwist_real, untwist_real_fast, (
    product: &[Complex32], twist: &Twist, from: usize, out: &mut [f32]
));
for_avx2!(untwist_imaginary, untwist_imaginary_fast, (
    product: &[Complex32], twist: &Twist, from: usize, out: &mut [f32]
));
for_avx2!(multiply, multiply_fast, (
    a: &[Complex32], b: &[Complex32], out: &mut [Complex32]
));
for_avx2!(coefficients, coefficients_fast, (
    numerator: &[f32], sums: &WindowCorners<'_>, squares: &WindowCorners<'_>, scale: &elementwise::CoefficientScale,
    out: &mut [f32]
));
for_avx2!(accumulate, accumulate_fast, (above: &[f64], line: &mut [f64]));
for_avx2!(four_running_sums, four_running_sums_fast, (
    source: [&[f32]; 4], squares: bool, out: &mut [f64], stride: usize
));
for_avx2!(subtract, subtract_fast, (from: &[f32], value: f32, out: &mut [f32]));
for_avx2!(weighted_pairs, weighted_pairs_fast, (
    source: &[f32], middle: usize, pairs: &[(usize, usize)], weights: &[f32], out: &mut [f32]
));

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_instruction_sets_agree() {
        let pixels: Vec<f32> = (0..90 * 40u32)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 20) as f32 / 4096.0 - 0.5)
            .collect();
        let search = PaddedRows::new(&pixels, 90);
        for (width, height) in [(1, 1), (5, 2), (16, 3), (24, 24), (11, 30)] {
            let kernel = BlockKernel::new(&pixels[17..][..width * height], width, height);
            let rows = 40 - height + 1;
            let stride = (90 - width + 1_usize).next_multiple_of(8);
            let run = |level| {
                let mut out = vec![0.0; stride * rows];
                correlate_at(level, &search, &kernel, &mut out, stride, rows);
                out
            };
            if level() == InstructionSet::Avx512 {
                for (a, b) in run(InstructionSet::Avx512)
                    .iter()
                    .zip(run(InstructionSet::Avx2))
                {
                    assert!((a - b).abs() < 1e-4, "{a} {b}");
                }
            }
        }
    }
}
