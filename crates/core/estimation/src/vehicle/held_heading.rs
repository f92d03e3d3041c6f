//! Motion by a heading that is not read but held from earlier.

use super::ControlInput;

/// Time for which a strayed airspeed stays strayed, seconds.
pub const AIRSPEED_MEMORY: f64 = 10.0;

/// Motion by a held heading whose error is a random walk, as shares of the speed and its square.
///
/// The walk has the variance q t after t seconds; with a = q/2 a unit of speed has along the held heading the mean
/// e^(-a t), and errors of the covariances, for s < t,
///
/// ```text
/// along   (e^(-a(t-s)) + e^(-a(t+3s)))/2 - e^(-a(t+s))
/// across  (e^(-a(t-s)) - e^(-a(t+3s)))/2 .
/// ```
///
/// The position's variance grows at t by twice the integral over s: as much white noise leaves the position as uncertain
/// at every time. Across it is q t³/3 while the error is small: a heading stays off, and what it does adds up.
///
/// An aircraft that turns does so within seconds, sooner than a walk: at first the velocity of mean square
/// (1 - e^(-2 a t))/2 on each axis may point anywhere, for as long as [`AIRSPEED_MEMORY`].
#[derive(Clone, Copy, Debug)]
pub(super) struct HeldHeading {
    /// Share of the speed that is left along the heading.
    pub(super) left: f64,
    /// Growth rates of the variances along and across it for a unit of speed, s.
    grown: [f64; 2],
}

impl HeldHeading {
    /// By these readings; a heading that is read leaves all of the speed.
    pub(super) fn of(input: &ControlInput) -> Self {
        // a t = σ²/2.
        let x = 0.5 * input.heading_deviation.powi(2);
        if x <= 0.0 {
            return Self {
                left: 1.0,
                grown: [0.0; 2],
            };
        }
        let left = (-x).exp();
        let once = -(-x).exp_m1() / x;
        let thrice = -left * (-3.0 * x).exp_m1() / (3.0 * x);
        let grown = [once + thrice - 2.0 * left * once, once - thrice];
        let anywhere = AIRSPEED_MEMORY * (1.0 - left * left);
        Self {
            left,
            grown: grown.map(|share| anywhere.max(input.heading_held * share)),
        }
    }

    /// Growth rates of the position's variances along and across the heading at `speed` in m/s, m²/s.
    pub(super) fn rates(&self, speed: f64) -> [f64; 2] {
        self.grown.map(|rate| rate * speed * speed)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector4;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::vehicle::{AirData, AirplaneWind, VehicleModel};
    use pilotage_base::frames::Attitude;
    use pilotage_base::statistics::chi_square_quantile;

    const SPEED: f64 = 18.87;
    const STEP: f64 = 0.1;

    fn held(wander: f64, time: f64) -> ControlInput {
        ControlInput {
            heading_deviation: (wander * time).sqrt(),
            heading_held: time,
            ..ControlInput::new(SPEED, Attitude::level(0.0))
        }
    }

    /// Mean and covariance of the position after `steps` by a model that knows of no other error.
    fn predicted(wander: f64, steps: u32) -> (nalgebra::Vector2<f64>, nalgebra::Matrix2<f64>) {
        let air_data = AirData {
            airspeed_noise_density: 0.0,
            heading_noise_density: 0.0,
            position_noise_density: 0.0,
            ..AirData::default()
        };
        let model = AirplaneWind {
            air_data,
            ..AirplaneWind::default()
        };
        let mut state = Vector4::zeros();
        let mut covariance = nalgebra::Matrix2::zeros();
        for step in 0..steps {
            let input = held(wander, STEP * (f64::from(step) + 0.5));
            let motion = model.air_data.motion(&input, 0.0, 0.0);
            covariance += model.air_data.position_noise(&motion, STEP);
            state = model.propagate(&state, &input, STEP);
        }
        (state.fixed_rows::<2>(0).into_owned(), covariance)
    }

    #[test]
    fn a_heading_that_strays_slowly_leaves_the_way_across_it_as_uncertain_as_the_walk_says() {
        let wander = 1e-6;
        let (_, covariance) = predicted(wander, 600);
        // V² q t² from 10 s on, when it is more than V² q τ t: together V² q (60³/3 + 500/3) m² = 25.70 m² · 1e6 q.
        let across = SPEED * SPEED * wander * (60_f64.powi(3) / 3.0 + 500.0 / 3.0);
        assert!(
            (covariance[(1, 1)] / across - 1.0).abs() < 1e-3,
            "{covariance}"
        );
        // Anywhere, but nothing that adds up: V² q τ t²/2.
        let along = SPEED * SPEED * wander * 18_000.0;
        assert!(
            (covariance[(0, 0)] / along - 1.0).abs() < 1e-3,
            "{covariance}"
        );
    }

    #[test]
    fn the_ellipse_of_a_held_heading_holds_the_truth_for_two_minutes() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let inside = chi_square_quantile(0.95, 2.0);
        for wander in [0.001, 0.01, 0.03] {
            for steps in [150, 600, 1200] {
                let (mean, covariance) = predicted(wander, steps);
                let inverse = covariance.try_inverse().unwrap();
                let (mut held, mut sum) = (0, nalgebra::Matrix2::zeros());
                for _ in 0..500 {
                    let (mut heading, mut place) = (0.0_f64, nalgebra::Vector2::zeros());
                    for _ in 0..steps {
                        let unit: f64 = StandardNormal.sample(&mut random);
                        heading += (wander * STEP).sqrt() * unit;
                        let (sin, cos) = heading.sin_cos();
                        place += nalgebra::Vector2::new(cos, sin) * (SPEED * STEP);
                    }
                    let off = place - mean;
                    sum += off * off.transpose() / 500.0;
                    held += u32::from((off.transpose() * inverse * off)[0] <= inside);
                }
                assert!(held >= 450, "{wander}, {steps}: {held} of 500");
                // After the first seconds no wider than the walk.
                let ratio = sum[(1, 1)] / covariance[(1, 1)];
                assert!(
                    steps == 150 || (0.8..1.25).contains(&ratio),
                    "{wander}, {steps}: {ratio}"
                );
            }
        }
    }
}
