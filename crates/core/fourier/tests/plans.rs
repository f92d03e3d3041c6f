//! Transforms against the sums that they stand for. Not beside the code: all vector forms would be compiled once more.

use std::f64::consts::TAU;
use std::panic::catch_unwind;

use pilotage_fourier::{Complex32, plan};

#[test]
fn lengths_of_small_factors_alone_are_planned() {
    let is_planned = |length: &usize| catch_unwind(|| plan(*length)).is_ok();
    let planned: Vec<usize> = (0..=16).filter(is_planned).collect();
    assert_eq!(planned, [1, 2, 3, 4, 5, 6, 8, 9, 10, 12, 15, 16]);
}

#[test]
#[should_panic(expected = "prime factors")]
fn a_length_that_would_be_slow_is_refused() {
    plan(14);
}

#[test]
fn transforms_are_the_sums_that_they_stand_for() {
    for length in [1, 6, 40, 96] {
        let signal: Vec<Complex32> = (0..length)
            .map(|n| Complex32::new((n * n % 7) as f32, (n % 5) as f32))
            .collect();
        let transforms = plan(length);
        let mut bins = signal.clone();
        transforms.forward.process(&mut bins);
        for (k, bin) in bins.iter().enumerate() {
            let (mut real, mut imaginary) = (0.0, 0.0);
            for (n, value) in signal.iter().enumerate() {
                let (sin, cos) = (-TAU * (k * n) as f64 / length as f64).sin_cos();
                let (re, im) = (f64::from(value.re), f64::from(value.im));
                real += re * cos - im * sin;
                imaginary += re * sin + im * cos;
            }
            let off = (f64::from(bin.re) - real).hypot(f64::from(bin.im) - imaginary);
            assert!(off < 1e-3, "{length} {k}: {off}");
        }
        transforms.inverse.process(&mut bins);
        for (back, value) in bins.iter().zip(&signal) {
            assert!((back / length as f32 - value).norm() < 1e-4);
        }
    }
}
