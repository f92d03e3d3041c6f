//! The other estimators and the smoother against the exact answers that linear systems have.

use approx::assert_relative_eq;
use nalgebra::{Matrix2, Matrix2x4, Matrix4, SMatrix, SVector, Vector2, Vector4, dvector};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::filter::*;

const STEP: f64 = 0.5;

fn normal<const N: usize>(random: &mut ChaCha8Rng) -> SVector<f64, N> {
    SVector::from_fn(|_, _| StandardNormal.sample(random))
}

/// Nearly constant velocity, position measured.
struct Linear {
    transition: Matrix4<f64>,
    process_noise: Matrix4<f64>,
    jacobian: Matrix2x4<f64>,
    noise: Matrix2<f64>,
    prior: Gaussian<4>,
}

impl Linear {
    fn new() -> Self {
        let dt = STEP;
        Self {
            transition: Matrix4::new(
                1.0, 0.0, dt, 0.0, 0.0, 1.0, 0.0, dt, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
            ),
            process_noise: Matrix4::from_diagonal(&Vector4::new(0.5, 0.5, 0.2, 0.2)),
            jacobian: Matrix2x4::identity(),
            noise: Matrix2::new(4.0, 1.0, 1.0, 2.0),
            prior: Gaussian::from_standard_deviations(
                Vector4::new(1.0, 2.0, 3.0, -4.0),
                &Vector4::new(3.0, 3.0, 2.0, 2.0),
            ),
        }
    }

    /// Truth and measurements by `seed`.
    fn fly(&self, seed: u64, steps: usize) -> Vec<(Vector4<f64>, Vector2<f64>)> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let root = self.noise.cholesky().unwrap().l();
        let mut truth =
            self.prior.mean + self.prior.covariance.map(f64::sqrt) * normal(&mut random);
        (0..steps)
            .map(|_| {
                truth = self.transition * truth
                    + self.process_noise.map(f64::sqrt) * normal(&mut random);
                (truth, self.jacobian * truth + root * normal(&mut random))
            })
            .collect()
    }

    fn see(&self) -> impl Fn(&Vector4<f64>) -> Option<Vector2<f64>> + '_ {
        |x| Some(self.jacobian * x)
    }

    /// The Kalman filter over `flight`, with the links of its smoother.
    fn filter(
        &self,
        flight: &[(Vector4<f64>, Vector2<f64>)],
    ) -> (Vec<Gaussian<4>>, Vec<SmootherLink<4>>) {
        let mut ukf = Ukf::new(self.prior, UnscentedSettings::default()).unwrap();
        let (mut filtered, mut links) = (vec![ukf.state()], Vec::new());
        for (_, z) in flight {
            let step = ukf
                .predict(|x| self.transition * x, &self.process_noise)
                .unwrap();
            links.push(SmootherLink::of(&step, ukf.weights()));
            let predicted = ukf.predict_measurement(self.see(), &self.noise).unwrap();
            filtered.push(ukf.correct(&predicted, z).unwrap().after);
        }
        (filtered, links)
    }
}

fn least_eigenvalue<const N: usize>(matrix: &SMatrix<f64, N, N>) -> f64 {
    let dynamic = nalgebra::DMatrix::from_column_slice(N, N, matrix.as_slice());
    dynamic.symmetric_eigen().eigenvalues.min()
}

#[test]
fn the_smoother_equals_least_squares_over_the_whole_flight() {
    const STEPS: usize = 12;
    let linear = Linear::new();
    let flight = linear.fly(3, STEPS);
    let (filtered, links) = linear.filter(&flight);
    let smoothed = smooth(&links, filtered.last().unwrap()).unwrap();
    // All states at once: information of the prior, of every step and of every measurement.
    let size = 4 * (STEPS + 1);
    let mut information = nalgebra::DMatrix::<f64>::zeros(size, size);
    let mut vector = nalgebra::DVector::<f64>::zeros(size);
    let prior = linear.prior.covariance.try_inverse().unwrap();
    let mut add = |row: usize, column: usize, block: &Matrix4<f64>| {
        let mut view = information.fixed_view_mut::<4, 4>(4 * row, 4 * column);
        view += block;
    };
    add(0, 0, &prior);
    let (f, h) = (linear.transition, linear.jacobian);
    let q = linear.process_noise.try_inverse().unwrap();
    let r = linear.noise.try_inverse().unwrap();
    for k in 1..=STEPS {
        add(k - 1, k - 1, &(f.transpose() * q * f));
        add(k - 1, k, &(-f.transpose() * q));
        add(k, k - 1, &(-q * f));
        add(k, k, &(q + h.transpose() * r * h));
    }
    vector
        .fixed_rows_mut::<4>(0)
        .copy_from(&(prior * linear.prior.mean));
    for (k, (_, z)) in flight.iter().enumerate() {
        vector
            .fixed_rows_mut::<4>(4 * k + 4)
            .copy_from(&(h.transpose() * r * z));
    }
    let covariance = information.try_inverse().unwrap();
    let mean = &covariance * vector;
    for (k, belief) in smoothed.iter().enumerate() {
        let exact = mean.fixed_rows::<4>(4 * k).into_owned();
        assert_relative_eq!(belief.mean, exact, epsilon = 1e-9, max_relative = 1e-9);
        let exact = covariance.fixed_view::<4, 4>(4 * k, 4 * k).into_owned();
        assert_relative_eq!(
            belief.covariance,
            exact,
            epsilon = 1e-9,
            max_relative = 1e-9
        );
    }
}

#[test]
fn smoothed_beliefs_are_honest_and_surer_than_filtered_ones() {
    const RUNS: usize = 100;
    let linear = Linear::new();
    let (mut nees, mut error, mut filtered_error) = (Consistency::default(), 0.0, 0.0);
    for seed in 0..RUNS as u64 {
        let flight = linear.fly(seed, 40);
        let (filtered, links) = linear.filter(&flight);
        let smoothed = smooth(&links, filtered.last().unwrap()).unwrap();
        for (k, (truth, _)) in flight.iter().enumerate() {
            let (ours, before) = (&smoothed[k + 1], &filtered[k + 1]);
            nees.push(ours.nees(truth).unwrap(), 4);
            error += (ours.mean - truth).norm_squared();
            filtered_error += (before.mean - truth).norm_squared();
            let gained = before.covariance - ours.covariance;
            let least = least_eigenvalue(&gained);
            assert!(least > -1e-12 * before.covariance.norm(), "{least:e}");
        }
    }
    let summary = nees.summary_of_runs(RUNS).unwrap();
    assert!(summary.is_consistent(), "{summary:?}");
    assert!((summary.inside_95 - 0.95).abs() < 0.02, "{summary:?}");
    assert!(error < 0.7 * filtered_error, "{error} {filtered_error}");
}

#[test]
fn what_never_moves_is_known_from_the_beginning_as_well_as_at_the_end() {
    // A bias without noise beside a walking position: the predicted covariance has a direction that the
    // process leaves alone, and a third component is certain from the start.
    let prior = Gaussian::from_standard_deviations(
        nalgebra::Vector3::new(0.0, 0.0, 7.0),
        &nalgebra::Vector3::new(1.0, 2.0, 0.0),
    );
    let noise = SMatrix::<f64, 3, 3>::from_diagonal(&nalgebra::Vector3::new(0.1, 0.0, 0.0));
    let mut ukf = Ukf::new(prior, UnscentedSettings::default()).unwrap();
    let mut links = Vec::new();
    for k in 0..50 {
        let step = ukf
            .predict(
                |x| nalgebra::Vector3::new(x[0] + STEP * x[1], x[1], x[2]),
                &noise,
            )
            .unwrap();
        links.push(SmootherLink::of(&step, ukf.weights()));
        let z = nalgebra::Vector1::new(0.4 * f64::from(k));
        let predicted = ukf
            .predict_measurement(
                |x| Some(nalgebra::Vector1::new(x[0])),
                &nalgebra::Matrix1::new(0.5),
            )
            .unwrap();
        ukf.correct(&predicted, &z).unwrap();
    }
    let smoothed = smooth(&links, &ukf.state()).unwrap();
    assert_eq!(smoothed.len(), 51);
    for belief in &smoothed {
        assert_relative_eq!(belief.mean[1], ukf.mean()[1], epsilon = 1e-9);
        let variance = ukf.state().covariance[(1, 1)];
        assert_relative_eq!(belief.covariance[(1, 1)], variance, epsilon = 1e-9);
        assert_eq!((belief.mean[2], belief.covariance[(2, 2)]), (7.0, 0.0));
    }
}

proptest! {
    #[test]
    fn along_slopes_a_linear_system_is_filtered_as_through_sigma_points(
        seed in 0_u64..1000, alpha in 1e-4..1.0,
    ) {
        let linear = Linear::new();
        let flight = linear.fly(seed, 20);
        let (filtered, links) = linear.filter(&flight);
        let shown = UnscentedSettings { alpha, ..UnscentedSettings::default() };
        let weights = Weights::new::<4>(&shown, 0.0).unwrap();
        let mut ekf = Ekf::new(linear.prior, shown).unwrap();
        for (k, (_, z)) in flight.iter().enumerate() {
            let moved = linear.transition * ekf.mean();
            let step = ekf.predict(moved, &linear.transition, &linear.process_noise).unwrap();
            let link = SmootherLink::of(&step, &weights);
            let cross = step.before.covariance * linear.transition.transpose();
            // The shown points lie near the mean for a small α: their differences lose digits.
            let lost = 1e-13 / (alpha * alpha);
            assert_relative_eq!(link.cross_covariance, cross, epsilon = 1e-11 + lost * 1e-2);
            assert_relative_eq!(
                link.cross_covariance, links[k].cross_covariance, epsilon = 1e-9 + lost
            );
            let seen = linear.jacobian * ekf.mean();
            let predicted = ekf.predict_measurement(seen, &linear.jacobian, &linear.noise).unwrap();
            let after = ekf.correct(&predicted, z).unwrap().after;
            assert_relative_eq!(after.mean, filtered[k + 1].mean, epsilon = 1e-10);
            assert_relative_eq!(after.covariance, filtered[k + 1].covariance, epsilon = 1e-10);
        }
    }
}

#[test]
fn particles_find_the_exact_answer_of_a_linear_system_within_their_scatter() {
    const RUNS: usize = 30;
    const STEPS: usize = 25;
    let linear = Linear::new();
    for count in [500, 4000] {
        let (mut squared, mut covariance) = (Vector4::zeros(), 0.0);
        let mut nees = Consistency::default();
        for seed in 0..RUNS as u64 {
            let flight = linear.fly(seed, STEPS);
            let (exact, _) = linear.filter(&flight);
            let settings = ParticleSettings {
                count,
                seed,
                ..ParticleSettings::default()
            };
            let mut filter =
                ParticleFilter::new(&linear.prior, settings, UnscentedSettings::default()).unwrap();
            for (k, (truth, z)) in flight.iter().enumerate() {
                filter
                    .predict(|x| linear.transition * x, &linear.process_noise)
                    .unwrap();
                let noise = linear.noise;
                filter
                    .correct(linear.see(), &noise, z, |a, b| a - b)
                    .unwrap();
                let exact = &exact[k + 1];
                let off =
                    (filter.state().mean - exact.mean).component_div(&exact.standard_deviations());
                squared += off.component_mul(&off);
                covariance += filter.state().covariance.trace() / exact.covariance.trace();
                nees.push(filter.state().nees(truth).unwrap(), 4);
            }
        }
        let samples = (RUNS * STEPS) as f64;
        // The mean of n independent draws is off by 1/√n deviations. Half of them effective, drawn anew
        // about once a step, and remembered for the some eight steps of the filter's memory: five times.
        let scatter = (squared / samples).map(f64::sqrt);
        let allowed = 5.0 / (count as f64).sqrt();
        println!("{count}: off by {scatter:?} of a deviation, {allowed:.3} allowed");
        assert!(scatter.max() < allowed, "{count}: {scatter} {allowed}");
        let ratio = covariance / samples;
        assert!((ratio - 1.0).abs() < 0.05, "{count}: covariance × {ratio}");
        let summary = nees.summary_of_runs(RUNS).unwrap();
        assert!(summary.is_consistent(), "{count}: {summary:?}");
    }
}

#[test]
fn a_measurement_far_out_and_sharp_is_reached_by_stages() {
    // At five deviations no particle is near: plain weights would leave one.
    let prior = Gaussian::new(Vector2::zeros(), Matrix2::identity());
    let settings = ParticleSettings {
        count: 4000,
        ..ParticleSettings::default()
    };
    let mut filter = ParticleFilter::new(&prior, settings, UnscentedSettings::default()).unwrap();
    let noise = Matrix2::identity() * 0.01;
    let z = Vector2::new(5.0, 0.0);
    let step = filter
        .correct(|x| Some(*x), &noise, &z, |a, b| a - b)
        .unwrap();
    let exact = z / 1.01;
    assert!(
        (step.after.mean - exact).norm() < 0.1,
        "{}",
        step.after.mean
    );
    let deviation = (0.01_f64 / 1.01).sqrt();
    let ratio = step.after.standard_deviations() / deviation;
    assert!(ratio.iter().all(|r| (0.8..1.25).contains(r)), "{ratio}");
    assert!(filter.effective_count() >= 2000.0);
}

#[test]
fn particles_of_which_half_cannot_be_measured_are_corrected_by_the_others() {
    let prior = Gaussian::new(Vector2::zeros(), Matrix2::identity());
    let mut filter = ParticleFilter::new(
        &prior,
        ParticleSettings::default(),
        UnscentedSettings::default(),
    )
    .unwrap();
    // East of the origin nothing is seen; what is seen is four deviations to the north.
    let model = |x: &Vector2<f64>| (x.y < 0.0).then(|| dvector![x.x]);
    let noise = nalgebra::DMatrix::from_element(1, 1, 0.01);
    // Those that see it are spread over the north as all are, by one.
    let expected = filter
        .predict_measurement(model, &noise, |a, b| a - b)
        .unwrap();
    let innovation = expected.innovation_covariance[(0, 0)];
    assert!((innovation - 1.01).abs() < 0.2, "{innovation}");
    let cross = expected.cross_covariance[(0, 0)];
    assert!((cross - 1.0).abs() < 0.2, "{cross}");
    let step = filter
        .correct(model, &noise, &dvector![4.0], |a, b| a - b)
        .unwrap();
    let mean = step.after.mean;
    assert!((mean.x - 4.0 / 1.01).abs() < 0.1, "{mean}");
    // Half of a normal distribution has the mean √(2/π); kernels blur its edge.
    assert!((mean.y + 0.8).abs() < 0.25, "{mean}");
}

#[test]
fn particles_keep_two_places_apart_where_a_gaussian_knows_one() {
    // The square of a coordinate says nothing of its sign.
    let prior = Gaussian::new(Vector2::zeros(), Matrix2::identity() * 4.0);
    let mut filter = ParticleFilter::new(
        &prior,
        ParticleSettings::default(),
        UnscentedSettings::default(),
    )
    .unwrap();
    let model = |x: &Vector2<f64>| Some(dvector![x[0] * x[0]]);
    let noise = nalgebra::DMatrix::from_element(1, 1, 1.0);
    filter
        .correct(model, &noise, &dvector![9.0], |a, b| a - b)
        .unwrap();
    let share = |wanted: &dyn Fn(f64) -> bool| -> f64 {
        let particles = filter.particles().iter().zip(filter.weights());
        let inside = particles.filter(|(x, _)| wanted(x[0]));
        inside.map(|(_, w)| w).sum()
    };
    let (left, right) = (share(&|x| x < -2.0), share(&|x| x > 2.0));
    assert!(left > 0.3 && right > 0.3, "{left} {right}");
    assert!(share(&|x| x.abs() < 1.5) < 0.1);
}

#[test]
fn the_same_seed_draws_the_same_particles_and_fading_widens_them() {
    let prior = Gaussian::new(Vector2::new(1.0, 2.0), Matrix2::identity());
    let make = |seed| {
        let settings = ParticleSettings {
            seed,
            ..ParticleSettings::default()
        };
        ParticleFilter::new(&prior, settings, UnscentedSettings::default()).unwrap()
    };
    let mut filter = make(7);
    assert_eq!(filter.particles(), make(7).particles());
    assert_ne!(filter.particles(), make(8).particles());
    let before = *filter.state();
    filter.fade(9.0).unwrap();
    assert_relative_eq!(filter.state().mean, before.mean, epsilon = 1e-12);
    assert_relative_eq!(
        filter.state().covariance,
        before.covariance * 9.0,
        epsilon = 1e-9
    );
}

#[test]
fn particles_that_see_nothing_are_refused_and_impossible_settings_too() {
    let prior = Gaussian::new(Vector2::zeros(), Matrix2::identity());
    let shown = UnscentedSettings::default();
    let with = |count, least_effective| {
        let settings = ParticleSettings {
            count,
            seed: 1,
            least_effective,
        };
        ParticleFilter::new(&prior, settings, shown)
    };
    assert!(with(1, 0.5).is_err() && with(100, 0.0).is_err() && with(100, 1.0).is_err());
    let mut filter = with(100, 0.5).unwrap();
    let before = *filter.state();
    let seen = filter.correct(
        |_| None::<Vector2<f64>>,
        &Matrix2::identity(),
        &Vector2::zeros(),
        |a, b| a - b,
    );
    assert!(matches!(seen, Err(FilterError::NoMeasurement { .. })));
    assert_eq!(*filter.state(), before);
}
