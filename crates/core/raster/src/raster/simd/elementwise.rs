//! Plain loops over long rows, written so that the compiler vectorizes them for whatever
//! instruction set the function around them is compiled for.
#![expect(
    clippy::inline_always,
    reason = "each is compiled once per instruction set, into the function that enables it"
)]

use pilotage_fourier::Complex32;

use crate::raster::integral::WindowCorners;

/// exp(iπn/N) for n < N/2, real and imaginary parts apart.
#[derive(Clone, Debug)]
pub(in crate::raster) struct Twist {
    pub cos: Vec<f32>,
    pub sin: Vec<f32>,
}

/// Factors that turn a plain correlation into a coefficient.
#[derive(Clone, Copy, Debug)]
pub(in crate::raster) struct CoefficientScale {
    /// 1 / pixels in a window.
    pub per_area: f64,
    /// 1 / norm of the template.
    pub per_norm: f32,
    /// Energy up to which a window is flat.
    pub limit: f64,
}

/// `out = (real + i imaginary) · twist`.
#[inline(always)]
pub(in crate::raster) fn twist(
    real: &[f32],
    imaginary: &[f32],
    twist: &Twist,
    out: &mut [Complex32],
) {
    let length = out.len();
    let (real, imaginary) = (&real[..length], &imaginary[..length]);
    let (cos, sin) = (&twist.cos[..length], &twist.sin[..length]);
    for n in 0..length {
        let (re, im) = (real[n], imaginary[n]);
        out[n].re = re * cos[n] - im * sin[n];
        out[n].im = re * sin[n] + im * cos[n];
    }
}

/// Adds a row of samples, backwards and scaled, as the real (`imaginary` false) or imaginary parts
/// of a signal: `out += samples · twist`, the last sample first; `out` and `twist` from `from` on.
#[inline(always)]
pub(in crate::raster) fn twist_reversed(
    samples: &[f32],
    scale: f32,
    imaginary: bool,
    twist: &Twist,
    from: usize,
    out: &mut [Complex32],
) {
    let length = samples.len();
    let out = &mut out[from..][..length];
    let (cos, sin) = (&twist.cos[from..][..length], &twist.sin[from..][..length]);
    for n in 0..length {
        let value = samples[length - 1 - n] * scale;
        let (re, im) = if imaginary {
            (-sin[n], cos[n])
        } else {
            (cos[n], sin[n])
        };
        out[n].re += value * re;
        out[n].im += value * im;
    }
}

/// `out = Re(product · conj(twist))` from index `from` on.
#[inline(always)]
pub(in crate::raster) fn untwist_real(
    product: &[Complex32],
    twist: &Twist,
    from: usize,
    out: &mut [f32],
) {
    let length = out.len();
    let product = &product[from..][..length];
    let (cos, sin) = (&twist.cos[from..][..length], &twist.sin[from..][..length]);
    for n in 0..length {
        out[n] = product[n].re * cos[n] + product[n].im * sin[n];
    }
}

/// `out = Im(product · conj(twist))` from index `from` on.
#[inline(always)]
pub(in crate::raster) fn untwist_imaginary(
    product: &[Complex32],
    twist: &Twist,
    from: usize,
    out: &mut [f32],
) {
    let length = out.len();
    let product = &product[from..][..length];
    let (cos, sin) = (&twist.cos[from..][..length], &twist.sin[from..][..length]);
    for n in 0..length {
        out[n] = product[n].im * cos[n] - product[n].re * sin[n];
    }
}

/// `out = a · b`.
#[inline(always)]
pub(in crate::raster) fn multiply(a: &[Complex32], b: &[Complex32], out: &mut [Complex32]) {
    let length = out.len();
    let (a, b) = (&a[..length], &b[..length]);
    for n in 0..length {
        out[n].re = a[n].re * b[n].re - a[n].im * b[n].im;
        out[n].im = a[n].re * b[n].im + a[n].im * b[n].re;
    }
}

/// Correlation coefficients of one row of windows.
#[inline(always)]
pub(in crate::raster) fn coefficients(
    numerator: &[f32],
    sums: &WindowCorners<'_>,
    squares: &WindowCorners<'_>,
    scale: &CoefficientScale,
    out: &mut [f32],
) {
    let length = out.len();
    let numerator = &numerator[..length];
    let (sums, squares) = (sums.cut(length), squares.cut(length));
    for x in 0..length {
        let sum = sums.at(x);
        let energy = squares.at(x) - sum * sum * scale.per_area;
        let root = (energy.max(scale.limit) as f32)
            .sqrt()
            .max(f32::MIN_POSITIVE);
        let value = (numerator[x] * scale.per_norm / root).clamp(-1.0, 1.0);
        out[x] = if energy > scale.limit { value } else { 0.0 };
    }
}

/// `line += above`.
#[inline(always)]
pub(in crate::raster) fn accumulate(above: &[f64], line: &mut [f64]) {
    for (sum, &upper) in line.iter_mut().zip(above) {
        *sum += upper;
    }
}

/// Running sums of four rows (of their squares) into four rows of a table, `stride` apart, from its
/// second column on, zeros in the first; four chains of additions run side by side.
#[inline(always)]
pub(in crate::raster) fn four_running_sums(
    source: [&[f32]; 4],
    squares: bool,
    out: &mut [f64],
    stride: usize,
) {
    let width = stride - 1;
    let source = source.map(|line| &line[..width]);
    let (a, rest) = out.split_at_mut(stride);
    let (b, rest) = rest.split_at_mut(stride);
    let (c, d) = rest.split_at_mut(stride);
    (a[0], b[0], c[0], d[0]) = (0.0, 0.0, 0.0, 0.0);
    let (a, b, c, d) = (&mut a[1..], &mut b[1..], &mut c[1..], &mut d[1..stride]);
    let mut running = [0.0f64; 4];
    for x in 0..width {
        let values = source.map(|line| f64::from(line[x]));
        for (sum, value) in running.iter_mut().zip(values) {
            *sum += if squares { value * value } else { value };
        }
        (a[x], b[x], c[x], d[x]) = (running[0], running[1], running[2], running[3]);
    }
}

/// `out = from - value`.
#[inline(always)]
pub(in crate::raster) fn subtract(from: &[f32], value: f32, out: &mut [f32]) {
    for (out, &from) in out.iter_mut().zip(from) {
        *out = from - value;
    }
}

/// `out[n] = weights[0] · source[middle + n] + Σ weights[i] · (source[a + n] + source[b + n])`, with `(a, b)` the
/// pair before place `i`; the sums are made in that order.
#[inline(always)]
pub(in crate::raster) fn weighted_pairs(
    source: &[f32],
    middle: usize,
    pairs: &[(usize, usize)],
    weights: &[f32],
    out: &mut [f32],
) {
    let mut done = 0;
    while done < out.len() {
        // The last block ends with the line: what it has in common with the one before comes out alike.
        let left = out.len() - done;
        let step = if out.len() >= 32 {
            done -= 32_usize.saturating_sub(left);
            paired_block::<32>(source, (middle, done), pairs, weights, out)
        } else if out.len() >= 8 {
            done -= 8_usize.saturating_sub(left);
            paired_block::<8>(source, (middle, done), pairs, weights, out)
        } else {
            paired_block::<1>(source, (middle, done), pairs, weights, out)
        };
        done += step;
    }
}

/// `N` of the sums of [`weighted_pairs`] side by side, in registers, from the one at `first` on; their number.
#[inline(always)]
fn paired_block<const N: usize>(
    source: &[f32],
    (middle, first): (usize, usize),
    pairs: &[(usize, usize)],
    weights: &[f32],
    out: &mut [f32],
) -> usize {
    let mut sums = [0.0; N];
    let here = &source[middle + first..][..N];
    for n in 0..N {
        sums[n] = weights[0] * here[n];
    }
    for (&weight, &(a, b)) in weights[1..].iter().zip(pairs) {
        let (a, b) = (&source[a + first..][..N], &source[b + first..][..N]);
        for n in 0..N {
            sums[n] += weight * (a[n] + b[n]);
        }
    }
    out[first..][..N].copy_from_slice(&sums);
    N
}
