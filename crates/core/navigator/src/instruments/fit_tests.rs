//! The fit on flights whose wind and scale are known.

use nalgebra::Vector2;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::fit::AirFit;
use super::problem::{FitPrior, FitProblem};
use super::series::Series;
use super::slip::SideForce;

/// Straight ahead for a minute, then, if it `turns`, round and round: 20 m/s through the air, which reads a tenth
/// too little and noise of 0.6 m/s, in a wind of 5 m/s.
fn fitted(turns: bool) -> AirFit {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
    let (mut velocities, mut airspeed, mut nose) = (Series::new(), Series::new(), Series::new());
    for i in 0..1200 {
        let time = 0.1 * f64::from(i);
        let heading = if turns {
            0.1 * (time - 60.0).max(0.0)
        } else {
            0.3
        };
        let (sin, cos) = heading.sin_cos();
        let wind = Vector2::new(-3.0, 4.0);
        if i % 2 == 0 {
            velocities.push(time, Vector2::new(cos, sin) * 20.0 + wind);
        }
        airspeed.push(time, 18.0 + 0.6 * noise());
        nose.push(time, Vector2::new(cos, sin));
    }
    let problem = FitProblem {
        velocities: &velocities,
        airspeed: &airspeed,
        nose: &nose,
        side_force: &SideForce::default(),
        span: (0.0, 120.0),
        memory: 1.0,
        prior: FitPrior {
            scale: 0.1,
            heading: 0.2,
            drift: 0.0,
            wind: 5.0,
            slip_length: 30.0,
            slip_offset: 15.0,
        },
    };
    problem.solve(0.0, 0.0, None).expect("a fit")
}

#[test]
fn noise_of_the_airspeed_is_not_taken_for_a_smaller_scale() {
    let fit = fitted(true);
    assert!((fit.scale - 1.0 / 0.9).abs() < 0.01, "{fit:?}");
    assert!((fit.wind - Vector2::new(-3.0, 4.0)).norm() < 0.1, "{fit:?}");
    assert!(fit.scale_deviation < 0.02 && fit.heading_offset.abs() < 0.01);
}

#[test]
fn who_flies_straight_ahead_is_told_that_scale_and_wind_are_not_known() {
    let fit = fitted(false);
    assert!(
        fit.scale_deviation > 0.05 && fit.wind_deviation > 1.0,
        "{fit:?}"
    );
    assert!(
        (fit.scale - 1.0 / 0.9).abs() < 2.0 * fit.scale_deviation,
        "{fit:?}"
    );
    let off = (fit.wind - Vector2::new(-3.0, 4.0)).norm();
    assert!(off < 3.0 * fit.wind_deviation, "{fit:?}");
}
