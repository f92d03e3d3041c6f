//! Invariants of every filter, and inputs that a filter refuses.

use approx::assert_relative_eq;
use nalgebra::{DMatrix, DVector, Matrix1, Matrix2, Matrix3, Vector1, Vector2, Vector3};

use crate::filter::*;
use pilotage_base::frames::wrap_pi;

fn unit_filter() -> Ukf<2> {
    let prior = Gaussian::new(Vector2::new(1.0, 2.0), Matrix2::identity());
    Ukf::new(prior, UnscentedSettings::default()).unwrap()
}

#[test]
fn sigma_points_have_the_mean_and_the_covariance_of_the_belief() {
    let covariance = Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 1.0);
    let prior = Gaussian::new(Vector3::new(5.0, -1.0, 0.2), covariance);
    for alpha in [1.0, 0.3, 1e-3] {
        let settings = UnscentedSettings {
            alpha,
            ..UnscentedSettings::default()
        };
        let filter = Ukf::new(prior, settings).unwrap();
        let weights = filter.weights();
        let points: Vec<_> = filter.sigma_points().iter().collect();
        assert_eq!(points.len(), SigmaPoints::<3>::count());
        let mut spread = Matrix3::zeros();
        for point in &points[1..] {
            spread += (point - prior.mean) * (point - prior.mean).transpose() * weights.outer;
        }
        assert_relative_eq!(spread, covariance, epsilon = 1e-8);
    }
}

#[test]
fn a_component_without_uncertainty_and_noise_stays_certain() {
    let covariance = Matrix3::from_diagonal(&Vector3::new(4.0, 0.0, 1.0));
    let prior = Gaussian::new(Vector3::new(0.0, 7.0, 1.0), covariance);
    // The noise is singular too: one direction across components 0 and 2.
    let direction = Vector3::new(0.3, 0.0, 0.7);
    let noise = direction * direction.transpose();
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
    for k in 0..200 {
        filter
            .predict(|x| Vector3::new(x[0] + 0.1 * x[2], x[1], x[2]), &noise)
            .unwrap();
        let predicted = filter
            .predict_measurement(|x| Some(Vector1::new(x[0] + x[1])), &Matrix1::new(0.5))
            .unwrap();
        filter
            .correct(&predicted, &Vector1::new(7.0 + f64::from(k)))
            .unwrap();
        let state = filter.state();
        assert_eq!(state.mean[1], 7.0);
        assert_eq!(state.covariance[(1, 1)], 0.0);
        assert!(state.covariance[(0, 0)] > 0.0 && state.covariance[(2, 2)] > 0.0);
    }
}

#[test]
fn bearings_across_the_south_are_no_trouble_with_an_angle_difference() {
    // The bearing of a beacon due south: ±π, where plain differences would be 2π.
    let prior = Gaussian::new(Vector2::new(0.0, 0.0), Matrix2::identity() * 4.0);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
    let bearing = |x: &Vector2<f64>| Some(Vector1::new((0.0 - x[1]).atan2(-100.0 - x[0])));
    let difference = |a: &Vector1<f64>, b: &Vector1<f64>| Vector1::new(wrap_pi(a[0] - b[0]));
    let noise = Matrix1::new(1e-4);
    let predicted = filter
        .predict_measurement_with(bearing, &noise, difference)
        .unwrap();
    let measured = Vector1::new(-std::f64::consts::PI + 0.01);
    let innovation = difference(&measured, &predicted.mean);
    assert!(innovation[0].abs() < 0.02, "{innovation}");
    let after = filter.correct_by(&predicted, innovation).unwrap().after;
    // At 100 m, 0.01 rad to the left of south is about one metre: the vehicle stands east of it.
    assert_relative_eq!(after.mean[1], 0.8, epsilon = 0.02);
}

#[test]
fn iterating_brings_the_estimate_near_the_best_one() {
    // Range to a beacon 10 m away from a belief of 8 m deviation: strongly curved.
    let prior = Gaussian::new(
        Vector2::new(10.0, 0.0),
        Matrix2::from_diagonal_element(64.0),
    );
    let (truth, noise) = (Vector2::new(3.0, 6.0), Matrix2::from_diagonal_element(0.01));
    let model =
        |x: &Vector2<f64>| Some(Vector2::new(x.norm(), (x - Vector2::new(0.0, 9.0)).norm()));
    let z = model(&truth).unwrap();
    let filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
    let mut predicted = filter.predict_measurement(model, &noise).unwrap();
    let mut errors = Vec::new();
    for _ in 0..8 {
        let mut copy = filter.clone();
        let after = copy.correct(&predicted, &z).unwrap().after;
        errors.push((after.mean - truth).norm());
        predicted = filter
            .predict_measurement_around(&after, model, &noise, |a, b| a - b)
            .unwrap();
    }
    assert!(errors[7] < 0.1 * errors[0] && errors[7] < 0.2, "{errors:?}");
}

#[test]
fn a_measurement_predicted_before_the_filter_moved_is_refused() {
    let mut filter = unit_filter();
    let predicted = filter
        .predict_measurement(|x| Some(*x), &Matrix2::identity())
        .unwrap();
    filter.predict(|x| *x, &Matrix2::identity()).unwrap();
    assert_eq!(
        filter.correct(&predicted, &Vector2::zeros()).unwrap_err(),
        FilterError::Stale
    );
}

#[test]
fn whatever_is_refused_leaves_the_filter_as_it_was() {
    let mut filter = unit_filter();
    let before = filter.state();
    let lopsided = Matrix2::new(1.0, 0.5, 0.0, 1.0);
    let negative = Matrix2::new(1.0, 2.0, 2.0, 1.0);
    assert!(matches!(
        filter.predict(|x| *x, &lopsided),
        Err(FilterError::NotSymmetric {
            matrix: "process noise",
            row: 1,
            column: 0
        })
    ));
    assert!(matches!(
        filter.predict(|x| *x, &negative),
        Err(FilterError::NotPositive {
            matrix: "process noise",
            component: 1,
            ..
        })
    ));
    assert!(matches!(
        filter.predict(|x| x * f64::NAN, &Matrix2::identity()),
        Err(FilterError::NotFinite {
            place: "process model"
        })
    ));
    assert_eq!(
        filter
            .predict_measurement(|x| (x[0] < 2.0).then_some(*x), &Matrix2::identity())
            .unwrap_err(),
        FilterError::NoMeasurement { point: 1 }
    );
    let predicted = filter
        .predict_measurement(|x| Some(*x), &Matrix2::identity())
        .unwrap();
    assert!(matches!(
        filter.correct(&predicted, &Vector2::new(f64::INFINITY, 0.0)),
        Err(FilterError::NotFinite {
            place: "measurement"
        })
    ));
    assert_eq!(filter.state(), before);
}

#[test]
fn stacked_measurements_of_the_wrong_size_are_refused() {
    let mut filter = unit_filter();
    let model = |x: &Vector2<f64>| Some(DVector::from_vec(vec![x[0], x[1], x[0] + x[1]]));
    assert!(matches!(
        filter.predict_measurement(model, &DMatrix::identity(2, 2)),
        Err(FilterError::Size {
            expected: 3,
            found: 2,
            ..
        })
    ));
    let predicted = filter
        .predict_measurement(model, &DMatrix::identity(3, 3))
        .unwrap();
    assert!(matches!(
        filter.correct(&predicted, &DVector::zeros(2)),
        Err(FilterError::Size {
            expected: 3,
            found: 2,
            ..
        })
    ));
}

#[test]
fn a_perfect_measurement_is_taken_at_its_word() {
    let mut filter = unit_filter();
    let predicted = filter
        .predict_measurement(|x| Some(Vector1::new(x[0])), &Matrix1::new(0.0))
        .unwrap();
    let after = filter
        .correct(&predicted, &Vector1::new(5.0))
        .unwrap()
        .after;
    assert_relative_eq!(after.mean[0], 5.0, epsilon = 1e-12);
    assert!(after.covariance[(0, 0)].abs() < 1e-15);
    assert_relative_eq!(after.covariance[(1, 1)], 1.0, epsilon = 1e-12);
}

#[test]
fn the_marginal_is_the_part_and_the_nees_is_chi_square_sized() {
    let covariance = Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 1.0);
    let belief = Gaussian::new(Vector3::new(1.0, 2.0, 3.0), covariance);
    let part = belief.marginal::<1, 2>();
    assert_eq!(part.mean, Vector2::new(2.0, 3.0));
    assert_eq!(part.covariance, Matrix2::new(3.0, -0.2, -0.2, 1.0));
    let truth = Vector3::new(2.0, 1.0, 3.5);
    let error = truth - belief.mean;
    let exact = error.dot(&(covariance.try_inverse().unwrap() * error));
    assert_relative_eq!(belief.nees(&truth).unwrap(), exact, max_relative = 1e-12);
}
