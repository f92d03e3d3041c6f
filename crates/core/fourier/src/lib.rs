//! Plans of Fourier transforms of single precision, for whatever machine the program runs on.
//!
//! A crate of its own because the vector forms of the transforms are generic: whoever plans one compiles all of them,
//! which takes longer than all kernels of pictures together.

use std::sync::Arc;

use rustfft::Fft;
pub use rustfft::num_complex::Complex32;

/// The transforms of one length.
///
/// ```
/// use pilotage_fourier::{Complex32, plan};
///
/// let samples = [1.0, -2.0, 0.5, 3.0, 0.0].map(|value| Complex32::new(value, 0.0));
/// let (transforms, mut bins) = (plan(5), samples);
/// transforms.forward.process(&mut bins);
/// assert!((bins[0].re - 2.5).abs() < 1e-5); // the sum
/// // There and back is five times the samples: nothing divides by the length.
/// transforms.inverse.process(&mut bins);
/// assert!((bins[3].re - 15.0).abs() < 1e-4);
/// ```
#[derive(Clone)]
pub struct Transforms {
    /// Σ x(n) exp(-2πi kn/N).
    pub forward: Arc<dyn Fft<f32>>,
    /// Σ X(k) exp(2πi kn/N), not divided by the length N.
    pub inverse: Arc<dyn Fft<f32>>,
}

/// A planner of transforms for the machine that the program runs on.
#[cfg(not(target_arch = "wasm32"))]
fn planner() -> rustfft::FftPlanner<f32> {
    rustfft::FftPlanner::new()
}

/// In a browser only the vector forms are taken along: the plain ones are as much code again.
#[cfg(target_arch = "wasm32")]
fn planner() -> rustfft::FftPlannerWasmSimd<f32> {
    rustfft::FftPlannerWasmSimd::new().expect("the page is built with vector instructions")
}

/// Plans the transforms of `length` complex samples.
///
/// # Panics
///
/// If `length` has other prime factors than 2, 3 and 5. Those would be slow, and the page is built without the code
/// for them (`xtask/never_called.toml`).
///
/// ```
/// use pilotage_fourier::{Complex32, plan};
///
/// // A wave of one period is in the first bin, and in the last, which stands for the period before.
/// let mut wave = [1.0, 0.0, -1.0, 0.0].map(|value| Complex32::new(value, 0.0));
/// plan(4).forward.process(&mut wave);
/// assert_eq!(wave.map(|bin| bin.re.round()), [0.0, 2.0, 0.0, 2.0]);
/// ```
#[inline(never)]
pub fn plan(length: usize) -> Transforms {
    assert!(
        is_planned(length),
        "{length} has other prime factors than 2, 3 and 5"
    );
    let mut planner = planner();
    Transforms {
        forward: planner.plan_fft_forward(length),
        inverse: planner.plan_fft_inverse(length),
    }
}

/// Whether `length` has no other prime factors than 2, 3 and 5.
fn is_planned(length: usize) -> bool {
    let mut rest = length;
    for factor in [2, 3, 5] {
        while rest > 0 && rest.is_multiple_of(factor) {
            rest /= factor;
        }
    }
    rest == 1
}
