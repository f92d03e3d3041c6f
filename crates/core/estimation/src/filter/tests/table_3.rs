//! The filter equals Table 3 as printed (with working transposes), written out plainly here.

use approx::assert_relative_eq;
use nalgebra::{DMatrix, DVector, Matrix2, Matrix4, Vector2, Vector4};

use crate::filter::*;

/// DeAngelo 2016, eqs 9-22, with matrices of weights and no thought for rounding.
struct Table3 {
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    settings: UnscentedSettings,
    points: DMatrix<f64>,
}

impl Table3 {
    fn draw(&self) -> DMatrix<f64> {
        let n = self.mean.len();
        let eta = self.settings.alpha * (n as f64).sqrt();
        let root = self.covariance.clone().cholesky().unwrap().l();
        DMatrix::from_fn(n, 2 * n + 1, |i, j| {
            self.mean[i]
                + match j {
                    0 => 0.0,
                    j if j <= n => eta * root[(i, j - 1)],
                    j => -eta * root[(i, j - 1 - n)],
                }
        })
    }

    fn weights(&self) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.mean.len();
        let a2 = self.settings.alpha.powi(2);
        let mut mean = DVector::from_element(2 * n + 1, 1.0 / (2.0 * n as f64 * a2));
        mean[0] = (a2 - 1.0) / a2;
        let mut covariance = DMatrix::from_diagonal(&mean);
        covariance[(0, 0)] += 1.0 - a2 + self.settings.beta;
        (mean, covariance)
    }

    fn predict(&mut self, f: impl Fn(&Vector4<f64>) -> Vector4<f64>, q: &Matrix4<f64>) {
        let (wm, wc) = self.weights();
        let mut points = self.draw();
        for mut column in points.column_iter_mut() {
            let moved = f(&Vector4::from_iterator(column.iter().copied()));
            column.copy_from(&moved);
        }
        self.mean = &points * &wm;
        let centred = &points - &self.mean * DMatrix::from_element(1, points.ncols(), 1.0);
        self.covariance = &centred * wc * centred.transpose();
        self.covariance += q;
        self.points = if self.settings.redraw == Redraw::AfterProcessNoise {
            self.draw()
        } else {
            points
        };
    }

    fn correct(
        &mut self,
        h: impl Fn(&Vector4<f64>) -> Vector2<f64>,
        r: &Matrix2<f64>,
        z: Vector2<f64>,
    ) {
        let (wm, wc) = self.weights();
        let columns = self.points.ncols();
        let mut seen = DMatrix::zeros(2, columns);
        for j in 0..columns {
            let state = Vector4::from_iterator(self.points.column(j).iter().copied());
            seen.set_column(j, &h(&state));
        }
        let expected = &seen * &wm;
        let ones = DMatrix::from_element(1, columns, 1.0);
        let state = &self.points - &self.mean * &ones;
        let seen = seen - &expected * ones;
        let pzz = &seen * &wc * seen.transpose() + r;
        let pxz = state * wc * seen.transpose();
        let gain = &pxz * pzz.try_inverse().unwrap();
        let z = DVector::from_column_slice(z.as_slice());
        self.mean += &gain * (z - expected);
        self.covariance -= &gain * pzz * gain.transpose();
    }
}

/// Bends the reference flight, so that every second moment of the points matters.
fn bend(x: &Vector4<f64>) -> Vector4<f64> {
    Vector4::new(
        0.02 * x[2] * x[3],
        0.02 * x[2] * x[2],
        0.03 * x[3].sin(),
        0.03 * x[2].cos(),
    )
}

fn compare(settings: UnscentedSettings, tolerance: f64) {
    let prior = reference_prior();
    let mut plain = Table3 {
        mean: DVector::from_column_slice(prior.mean.as_slice()),
        covariance: DMatrix::from_column_slice(4, 4, prior.covariance.as_slice()),
        settings,
        points: DMatrix::zeros(4, 9),
    };
    let mut filter = Ukf::new(prior, settings).unwrap();
    let (q, r) = (reference_process_noise(), reference_measurement_noise());
    for step in reference_flight(200) {
        let process = |x: &Vector4<f64>| reference_process(x, &step) + bend(x);
        let measure = |x: &Vector4<f64>| {
            let bent = Vector2::new(x[2].sin(), 0.05 * x[3] * x[3]);
            reference_measurement(x, &step).unwrap() + bent
        };
        plain.predict(process, &q);
        plain.correct(measure, &r, step.pixel);
        filter.predict(process, &q).unwrap();
        let predicted = filter
            .predict_measurement(|x| Some(measure(x)), &r)
            .unwrap();
        let state = filter.correct(&predicted, &step.pixel).unwrap().after;
        let (mean, covariance) = (&plain.mean, &plain.covariance);
        assert_relative_eq!(
            state.mean.as_slice(),
            mean.as_slice(),
            max_relative = tolerance,
            epsilon = tolerance
        );
        assert_relative_eq!(
            state.covariance.as_slice(),
            covariance.as_slice(),
            max_relative = tolerance,
            epsilon = tolerance
        );
    }
}

#[test]
fn the_filter_is_table_3_with_points_redrawn() {
    for (alpha, beta) in [(1.0, 2.0), (1.0, 0.0), (0.7, 2.0), (0.1, 2.0), (0.1, 0.3)] {
        let redraw = Redraw::AfterProcessNoise;
        compare(
            UnscentedSettings {
                alpha,
                beta,
                redraw,
            },
            1e-8,
        );
    }
}

#[test]
fn the_filter_is_table_3_with_points_carried_through() {
    for (alpha, beta) in [(1.0, 2.0), (1.0, 0.0), (0.7, 2.0), (0.1, 2.0), (0.1, 0.3)] {
        let redraw = Redraw::CarriedThrough;
        compare(
            UnscentedSettings {
                alpha,
                beta,
                redraw,
            },
            1e-8,
        );
    }
}

#[test]
fn weights_are_those_of_the_table() {
    for (alpha, eta, mean_centre, outer, covariance_centre) in [
        (1.0, 2.0, 0.0, 0.125, 2.0),
        (0.5, 1.0, -3.0, 0.5, -0.25),
        (0.1, 0.2, -99.0, 12.5, -96.01),
        (1e-3, 0.002, -999_999.0, 125_000.0, -999_996.000_001),
    ] {
        let settings = UnscentedSettings {
            alpha,
            ..UnscentedSettings::default()
        };
        let weights = Weights::new::<4>(&settings, 0.0).unwrap();
        assert_relative_eq!(weights.eta, eta, max_relative = 1e-12);
        assert_relative_eq!(weights.mean_centre, mean_centre, max_relative = 1e-9);
        assert_relative_eq!(weights.outer, outer, max_relative = 1e-12);
        assert_relative_eq!(
            weights.covariance_centre,
            covariance_centre,
            max_relative = 1e-9
        );
        assert_relative_eq!(weights.mean_centre + 8.0 * outer, 1.0, epsilon = 1e-9);
    }
}

#[test]
fn settings_outside_their_range_are_refused() {
    for (alpha, beta) in [
        (0.0, 2.0),
        (-1.0, 2.0),
        (f64::NAN, 2.0),
        (1.0, -0.1),
        (1.0, f64::NAN),
    ] {
        let settings = UnscentedSettings {
            alpha,
            beta,
            ..UnscentedSettings::default()
        };
        assert!(matches!(
            Weights::new::<4>(&settings, 0.0),
            Err(FilterError::Setting { .. })
        ));
    }
    assert!(Weights::new::<4>(&UnscentedSettings::default(), -4.0).is_err());
}
