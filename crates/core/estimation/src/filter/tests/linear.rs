//! For linear systems the filter is the Kalman filter.

use approx::assert_relative_eq;
use nalgebra::{DMatrix, DVector, Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};
use proptest::prelude::*;

use crate::filter::*;

fn vector3() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-3.0..3.0).prop_map(Vector3::from)
}

fn matrix3() -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform3(vector3()).prop_map(|c| Matrix3::from_columns(&c))
}

fn close<const N: usize>(a: &Gaussian<N>, b: &Gaussian<N>) {
    let scale = b.covariance.norm().max(1.0);
    assert_relative_eq!(a.mean, b.mean, epsilon = 1e-7 * scale, max_relative = 1e-7);
    assert_relative_eq!(
        a.covariance,
        b.covariance,
        epsilon = 1e-7 * scale,
        max_relative = 1e-7
    );
}

proptest! {
    #[test]
    fn predict_and_correct_equal_the_kalman_filter_for_every_setting(
        transition in matrix3(), process_root in matrix3(), prior_root in matrix3(),
        mean in vector3(), rows in prop::array::uniform2(vector3()),
        z in prop::array::uniform2(-9.0..9.0), alpha in 1e-3_f64..1.0, beta in 0.0..3.0,
        carried: bool,
    ) {
        let h = Matrix2x3::from_rows(&[rows[0].transpose(), rows[1].transpose()]);
        let r = Matrix2::new(2.0, 0.3, 0.3, 1.0);
        let z = Vector2::from(z);
        let q = process_root * process_root.transpose();
        let prior = Gaussian::new(mean, prior_root * prior_root.transpose());
        let predicted_mean = transition * mean;
        let predicted = transition * prior.covariance * transition.transpose();
        // Points carried through lack Q in the innovation and in the cross covariance.
        let spread = if carried { predicted } else { predicted + q };
        let s = h * spread * h.transpose() + r;
        let gain = spread * h.transpose() * s.try_inverse().unwrap();
        let exact = Gaussian::new(
            predicted_mean + gain * (z - h * predicted_mean),
            predicted + q - gain * s * gain.transpose(),
        );
        let redraw = if carried { Redraw::CarriedThrough } else { Redraw::AfterProcessNoise };
        let mut filter = Ukf::new(prior, UnscentedSettings { alpha, beta, redraw }).unwrap();
        close(&filter.predict(|x| transition * x, &q).unwrap().after,
            &Gaussian::new(predicted_mean, predicted + q));
        let expected = filter.predict_measurement(|x| Some(h * x), &r).unwrap();
        let correction = filter.correct(&expected, &z).unwrap();
        close(&correction.after, &exact);
        assert_relative_eq!(correction.gain, gain, epsilon = 1e-6, max_relative = 1e-6);
        let nis = (z - h * predicted_mean).dot(&(s.try_inverse().unwrap() * (z - h * predicted_mean)));
        assert_relative_eq!(correction.nis, nis, epsilon = 1e-7, max_relative = 1e-6);
    }

    #[test]
    fn stacked_measurements_correct_like_one_after_the_other(
        prior_root in matrix3(), mean in vector3(), rows in prop::array::uniform4(vector3()),
        z in prop::array::uniform4(-9.0..9.0),
    ) {
        let prior = Gaussian::new(mean, prior_root * prior_root.transpose());
        let settings = UnscentedSettings::default();
        let mut single = Ukf::new(prior, settings).unwrap();
        for k in 0..2 {
            let h = Matrix2x3::from_rows(&[rows[2 * k].transpose(), rows[2 * k + 1].transpose()]);
            let predicted =
                single.predict_measurement(|x| Some(h * x), &Matrix2::identity()).unwrap();
            single.correct(&predicted, &Vector2::new(z[2 * k], z[2 * k + 1])).unwrap();
        }
        let mut stacked = Ukf::new(prior, settings).unwrap();
        let h = DMatrix::from_fn(4, 3, |i, j| rows[i][j]);
        let model = |x: &Vector3<f64>| Some(&h * DVector::from_column_slice(x.as_slice()));
        let predicted = stacked.predict_measurement(model, &DMatrix::identity(4, 4)).unwrap();
        prop_assert_eq!(predicted.dof(), 4);
        stacked.correct(&predicted, &DVector::from_column_slice(&z)).unwrap();
        close(&stacked.state(), &single.state());
    }

    #[test]
    fn an_iteration_changes_nothing_when_the_measurement_is_linear(
        prior_root in matrix3(), mean in vector3(), rows in prop::array::uniform2(vector3()),
        elsewhere in vector3(),
    ) {
        let prior_covariance = prior_root * prior_root.transpose() + Matrix3::identity() * 0.1;
        let filter = Ukf::new(Gaussian::new(mean, prior_covariance), UnscentedSettings::default())
            .unwrap();
        let h = Matrix2x3::from_rows(&[rows[0].transpose(), rows[1].transpose()]);
        let once = filter.predict_measurement(|x| Some(h * x), &Matrix2::identity()).unwrap();
        let around = Gaussian::new(elsewhere, Matrix3::identity() * 0.5);
        let again = filter
            .predict_measurement_around(&around, |x| Some(h * x), &Matrix2::identity(), |a, b| a - b)
            .unwrap();
        assert_relative_eq!(again.mean, once.mean, epsilon = 1e-8);
        assert_relative_eq!(again.innovation_covariance, once.innovation_covariance, epsilon = 1e-7);
        assert_relative_eq!(again.cross_covariance, once.cross_covariance, epsilon = 1e-7);
    }
}
