//! A million steps without a covariance that is none.

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

use crate::filter::*;

const STEP: f64 = 0.1;

/// Circles with drag, pulled to the origin and pushed by a changing force.
fn turn(x: &Vector4<f64>, t: f64) -> Vector4<f64> {
    let speed = x[2].hypot(x[3]);
    let pull = 10.0 / (x[0].hypot(x[1]) + 1.0) / 900.0;
    Vector4::new(
        x[0] + STEP * x[2],
        x[1] + STEP * x[3],
        x[2] - STEP * (x[0] * pull + 0.01 * speed * x[2] - 0.1 * (0.01 * t).sin()),
        x[3] - STEP * (x[1] * pull + 0.01 * speed * x[3] - 0.1 * (0.013 * t).cos()),
    )
}

/// A nonlinear system that turns, looks from near and far, and goes without measurements at times.
fn a_million_steps(alpha: f64, redraw: Redraw) {
    let settings = UnscentedSettings {
        alpha,
        beta: 2.0,
        redraw,
    };
    let prior = Gaussian::from_standard_deviations(
        Vector4::new(900.0, 0.0, 0.0, 10.0),
        &Vector4::new(30.0, 30.0, 5.0, 5.0),
    );
    let mut filter = Ukf::new(prior, settings).unwrap();
    // Very uneven noise: twelve orders of magnitude between the components.
    let process_noise = Matrix4::from_diagonal(&Vector4::new(1e-12, 1e-12, 1e-6, 1e-2));
    let mut truth = prior.mean;
    let mut worst_error = 0.0_f64;
    for k in 0..1_000_000_u32 {
        let t = f64::from(k) * STEP;
        truth = turn(&truth, t);
        filter.predict(|x| turn(x, t), &process_noise).unwrap();
        if k % 1000 < 900 {
            let sharp = if k % 3 == 0 { 1e-8 } else { 25.0 };
            let model = |x: &Vector4<f64>| {
                Some(Vector2::new(
                    (x[0] - 50.0).hypot(x[1] + 2000.0),
                    500.0 * (x[0] / 3000.0).sin(),
                ))
            };
            let noise = Matrix2::from_diagonal(&Vector2::new(sharp, 4.0));
            let predicted = filter.predict_measurement(model, &noise).unwrap();
            let error = Vector2::new(sharp.sqrt() * (1.1 * t).sin(), 2.0 * (3.7 * t).cos());
            filter
                .correct(&predicted, &(model(&truth).unwrap() + error))
                .unwrap();
        }
        let state = filter.state();
        assert_eq!(state.covariance, state.covariance.transpose(), "step {k}");
        let root = filter.covariance_root();
        assert!(
            (0..4).all(|i| root[(i, i)] > 0.0),
            "alpha {alpha}, step {k}: {root}"
        );
        if k > 1000 {
            worst_error = worst_error.max((state.mean - truth).norm());
        }
    }
    assert!(
        worst_error < 100.0,
        "alpha {alpha}: the estimate strayed by {worst_error}"
    );
    assert!(filter.state().covariance.cholesky().is_some());
}

#[test]
fn covariances_stay_positive_definite_for_a_million_steps_with_alpha_1e_4() {
    a_million_steps(1e-4, Redraw::AfterProcessNoise);
}

#[test]
fn covariances_stay_positive_definite_for_a_million_steps_with_alpha_1e_3() {
    a_million_steps(1e-3, Redraw::CarriedThrough);
}

#[test]
fn covariances_stay_positive_definite_for_a_million_steps_with_alpha_a_tenth() {
    a_million_steps(0.1, Redraw::AfterProcessNoise);
}

#[test]
fn covariances_stay_positive_definite_for_a_million_steps_with_alpha_1() {
    a_million_steps(1.0, Redraw::CarriedThrough);
}
