//! State components that several airplane models share: gusts and instrument biases.

use nalgebra::{SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::airplane::AirMotion;
use super::noise::{GaussMarkov, add_integrated_random_walk};
use crate::filter::Gaussian;

/// Wind that changes by the second: each axis an exponentially correlated velocity of its own.
///
/// Turbulence near the ground is as strong as the wind that makes it (MIL-F-8785C, 3.7.3.4), and so is
/// what is expected of it: it follows the wind of the state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Gusts {
    /// Least standard deviation on each axis, m/s.
    pub deviation: f64,
    /// Standard deviation on each axis in a wind of 1 m/s, if that is more.
    pub per_wind: f64,
    /// Correlation time τ, seconds.
    pub correlation_time: f64,
}

impl Default for Gusts {
    fn default() -> Self {
        Self {
            deviation: 0.7,
            per_wind: 0.0,
            correlation_time: 5.0,
        }
    }
}

impl Gusts {
    /// Gusts as strong in any wind: `deviation` m/s per axis, that fade over `correlation_time` seconds.
    pub(super) fn even(deviation: f64, correlation_time: f64) -> Self {
        Self {
            deviation,
            per_wind: 0.0,
            correlation_time,
        }
    }

    /// Standard deviation on each axis in winds whose mean square is `squared_wind` (m/s)².
    pub(super) fn deviation_in(&self, squared_wind: f64) -> f64 {
        self.deviation.max(self.per_wind * squared_wind.sqrt())
    }

    /// Lets the gusts of `state` at `first` move the position and fade, over `dt` seconds.
    pub(super) fn propagate<const N: usize>(
        &self,
        state: &mut SVector<f64, N>,
        first: usize,
        dt: f64,
    ) {
        let step = GaussMarkov::over(0.0, self.correlation_time, dt);
        for axis in 0..2 {
            state[axis] += step.travel * state[first + axis];
            state[first + axis] *= step.persistence;
        }
    }

    /// Enters the slope of [`Self::propagate`] into that of a model.
    pub(super) fn enter_slope<const N: usize>(
        &self,
        transition: &mut SMatrix<f64, N, N>,
        first: usize,
        dt: f64,
    ) {
        let step = GaussMarkov::over(0.0, self.correlation_time, dt);
        for axis in 0..2 {
            transition[(axis, first + axis)] = step.travel;
            transition[(first + axis, first + axis)] = step.persistence;
        }
    }

    /// Adds their noise in winds whose mean square is `squared_wind` (m/s)².
    pub(super) fn add_noise<const N: usize>(
        &self,
        noise: &mut SMatrix<f64, N, N>,
        first: usize,
        squared_wind: f64,
        dt: f64,
    ) {
        let deviation = self.deviation_in(squared_wind);
        let step = GaussMarkov::over(deviation, self.correlation_time, dt);
        for axis in 0..2 {
            step.add_to(noise, axis, first + axis);
        }
    }
}

/// Slow errors of airspeed and heading: reading minus truth, each a random walk.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirDataBiases {
    /// Random walk of the airspeed's bias, m/s/√s.
    pub airspeed_bias_noise_density: f64,
    /// Random walk of the heading's bias, rad/√s.
    pub heading_bias_noise_density: f64,
    /// Standard deviation of the airspeed's bias at the start, m/s.
    pub start_airspeed_bias_deviation: f64,
    /// Standard deviation of the heading's bias at the start, radians.
    pub start_heading_bias_deviation: f64,
}

impl Default for AirDataBiases {
    fn default() -> Self {
        Self {
            airspeed_bias_noise_density: 0.01,
            heading_bias_noise_density: 0.0005,
            start_airspeed_bias_deviation: 0.5,
            start_heading_bias_deviation: 0.03,
        }
    }
}

impl AirDataBiases {
    /// Adds their noise, with airspeed bias at `first` and heading bias after it.
    ///
    /// Truth is reading minus bias, so that a growing airspeed bias pulls the position back along
    /// the heading and a growing heading bias pulls it to the left at the airspeed. Without a reading
    /// of the airspeed its bias moves nothing.
    pub(super) fn add_noise<const N: usize>(
        &self,
        noise: &mut SMatrix<f64, N, N>,
        first: usize,
        motion: &AirMotion,
        dt: f64,
    ) {
        let densities = [
            self.airspeed_bias_noise_density,
            self.heading_bias_noise_density,
        ];
        for (k, (density, velocity)) in densities.into_iter().zip(effects(motion)).enumerate() {
            add_integrated_random_walk(noise, first + k, &position_effect(velocity), density, dt);
        }
    }

    /// Enters what the biases at `first` do to the position in `dt` seconds into the slope of a model.
    pub(super) fn enter_slope<const N: usize>(
        transition: &mut SMatrix<f64, N, N>,
        first: usize,
        motion: &AirMotion,
        dt: f64,
    ) {
        for (k, velocity) in effects(motion).into_iter().enumerate() {
            transition[(0, first + k)] = velocity.x * dt;
            transition[(1, first + k)] = velocity.y * dt;
        }
    }
}

/// Change of the velocity (north, east) with the airspeed's bias, and with the heading's, m/s per rad.
fn effects(motion: &AirMotion) -> [Vector2<f64>; 2] {
    let of_airspeed = if motion.measured {
        -motion.ahead
    } else {
        Vector2::zeros()
    };
    [of_airspeed, -motion.right() * motion.airspeed]
}

/// Enters a velocity (wind, or over ground) at `first` that moves the position into the slope of a model.
pub(super) fn enter_velocity_slope<const N: usize>(
    transition: &mut SMatrix<f64, N, N>,
    first: usize,
    dt: f64,
) {
    for axis in 0..2 {
        transition[(axis, first + axis)] = dt;
    }
}

/// Velocity (m/s north and east per unit) as an effect on the state.
pub(super) fn position_effect<const N: usize>(velocity: Vector2<f64>) -> SVector<f64, N> {
    let mut effect = SVector::zeros();
    effect[0] = velocity.x;
    effect[1] = velocity.y;
    effect
}

/// Mean square of the wind, whose components begin at `first`, over all states of `belief`, (m/s)².
pub(super) fn mean_squared_wind<const N: usize>(belief: &Gaussian<N>, first: usize) -> f64 {
    let of = |i: usize| belief.mean[i] * belief.mean[i] + belief.covariance[(i, i)];
    of(first) + of(first + 1)
}

/// Adds the noise of a velocity (wind, or over ground) at `first` that walks at `density` (m/s/√s)
/// and moves the position.
pub(super) fn add_velocity_noise<const N: usize>(
    noise: &mut SMatrix<f64, N, N>,
    first: usize,
    density: f64,
    dt: f64,
) {
    for (axis, direction) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
        add_integrated_random_walk(
            noise,
            first + axis,
            &position_effect(direction),
            density,
            dt,
        );
    }
}
