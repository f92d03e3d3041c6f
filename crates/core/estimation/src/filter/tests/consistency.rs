//! The filter is as good as it says: NIS and NEES over many simulated flights.

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::filter::*;

fn draw<const N: usize>(
    generator: &mut ChaCha8Rng,
    root: &nalgebra::SMatrix<f64, N, N>,
) -> nalgebra::SVector<f64, N> {
    root * nalgebra::SVector::<f64, N>::from_fn(|_, _| StandardNormal.sample(generator))
}

struct Flights {
    nis: ConsistencySummary,
    nees: ConsistencySummary,
    error_over_bound: f64,
}

/// 100 seeds of 60 steps: nearly constant velocity, position measured.
fn fly(redraw: Redraw) -> Flights {
    const RUNS: usize = 100;
    let dt = 0.5;
    let transition = Matrix4::new(
        1.0, 0.0, dt, 0.0, 0.0, 1.0, 0.0, dt, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    );
    let process_noise = Matrix4::from_diagonal(&Vector4::new(0.5, 0.5, 0.2, 0.2));
    let measurement_noise = Matrix2::new(4.0, 1.0, 1.0, 2.0);
    let jacobian = nalgebra::Matrix2x4::identity();
    let prior = Gaussian::from_standard_deviations(
        Vector4::new(1.0, 2.0, 3.0, -4.0),
        &Vector4::new(3.0, 3.0, 2.0, 2.0),
    );
    let settings = UnscentedSettings {
        redraw,
        ..UnscentedSettings::default()
    };
    let (mut nis, mut nees) = (Consistency::default(), Consistency::default());
    let (mut squared_error, mut squared_bound) = (0.0, 0.0);
    for seed in 0..RUNS as u64 {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let mut truth = prior.mean + draw(&mut generator, &prior.covariance.map(f64::sqrt));
        let mut filter = Ukf::new(prior, settings).unwrap();
        let mut bound = CramerRao::from_prior(&prior.covariance).unwrap();
        for _ in 0..60 {
            truth = transition * truth + draw(&mut generator, &process_noise.map(f64::sqrt));
            filter.predict(|x| transition * x, &process_noise).unwrap();
            bound.predict(&transition, &process_noise).unwrap();
            let model = |x: &Vector4<f64>| Some(Vector2::new(x[0], x[1]));
            let predicted = filter
                .predict_measurement(model, &measurement_noise)
                .unwrap();
            let root = measurement_noise.cholesky().unwrap().l();
            let z = model(&truth).unwrap() + draw(&mut generator, &root);
            let correction = filter.correct(&predicted, &z).unwrap();
            bound.update(&jacobian, &measurement_noise).unwrap();
            nis.push(correction.nis, 2);
            nees.push(correction.after.nees(&truth).unwrap(), 4);
            squared_error += (correction.after.mean - truth).xy().norm_squared();
            squared_bound += bound.position_bound().unwrap().powi(2);
        }
    }
    Flights {
        nis: nis.summary().unwrap(),
        nees: nees.summary_of_runs(RUNS).unwrap(),
        error_over_bound: (squared_error / squared_bound).sqrt(),
    }
}

#[test]
fn nis_and_nees_lie_inside_their_bounds_and_the_error_meets_the_cramer_rao_bound() {
    let flights = fly(Redraw::AfterProcessNoise);
    assert!(flights.nis.is_consistent(), "{:?}", flights.nis);
    assert!(flights.nees.is_consistent(), "{:?}", flights.nees);
    assert!(
        (flights.nis.inside_95 - 0.95).abs() < 0.01,
        "{:?}",
        flights.nis
    );
    assert!(
        (flights.nees.inside_95 - 0.95).abs() < 0.02,
        "{:?}",
        flights.nees
    );
    assert!(
        (flights.error_over_bound - 1.0).abs() < 0.03,
        "{}",
        flights.error_over_bound
    );
}

#[test]
fn points_carried_through_report_too_large_a_covariance() {
    let flights = fly(Redraw::CarriedThrough);
    assert!(
        flights.nees.mean < flights.nees.lower_95,
        "{:?}",
        flights.nees
    );
}
