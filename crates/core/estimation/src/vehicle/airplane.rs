//! Motion through the air and its noise, shared by the airplane models.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::ControlInput;
use super::held_heading::{AIRSPEED_MEMORY, HeldHeading};

/// Trust in the instruments of an airplane to tell its motion through the air.
///
/// Densities are standard deviations piled up in one second (see the noise formulas): position
/// variance grows with their square times time, independent of the filter's steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirData {
    /// Noise of the airspeed, m/s/√Hz; acts along the heading.
    pub airspeed_noise_density: f64,
    /// Noise of the heading, rad/√Hz; acts across the heading, times the airspeed.
    pub heading_noise_density: f64,
    /// Anything else that moves the position, m/√s, on each axis.
    pub position_noise_density: f64,
    /// Airspeed to assume while none is measured, m/s.
    pub cruise_airspeed: f64,
    /// Noise of that assumption in place of `airspeed_noise_density`, m/s/√Hz.
    pub cruise_airspeed_noise_density: f64,
}

impl Default for AirData {
    fn default() -> Self {
        Self {
            airspeed_noise_density: 0.25,
            heading_noise_density: 0.01,
            position_noise_density: 0.05,
            cruise_airspeed: 18.0,
            cruise_airspeed_noise_density: 3.0,
        }
    }
}

/// Motion through the air at a moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct AirMotion {
    /// Unit vector of the heading, north and east.
    pub(super) ahead: Vector2<f64>,
    /// Airspeed, m/s.
    pub(super) airspeed: f64,
    /// Density of its noise, m/s/√Hz.
    pub(super) airspeed_noise_density: f64,
    /// Whether the airspeed is a reading, from which its bias was taken.
    pub(super) measured: bool,
    /// Variances that a held heading adds along and across it each second, m²/s.
    pub(super) strayed: [f64; 2],
}

impl AirMotion {
    /// Unit vector to the right of the heading, north and east.
    pub(super) fn right(&self) -> Vector2<f64> {
        Vector2::new(-self.ahead.y, self.ahead.x)
    }

    /// Velocity through the air, m/s north and east.
    pub(super) fn velocity(&self) -> Vector2<f64> {
        self.ahead * self.airspeed
    }
}

/// White noise that moves a vehicle as far in the long run as a velocity that strays by `deviation` m/s for
/// [`AIRSPEED_MEMORY`]: σ √(2τ), m/√s.
pub(super) fn density_of(deviation: f64) -> f64 {
    deviation * (2.0 * AIRSPEED_MEMORY).sqrt()
}

impl AirData {
    /// The same instruments, with `speed` assumed wherever no airspeed is measured, of standard deviation
    /// `deviation`, m/s.
    #[must_use]
    pub fn cruising(self, speed: f64, deviation: f64) -> Self {
        Self {
            cruise_airspeed: speed,
            cruise_airspeed_noise_density: density_of(deviation),
            ..self
        }
    }

    /// Motion when the instruments read too much by these biases (m/s, radians).
    pub(super) fn motion(
        &self,
        input: &ControlInput,
        airspeed_bias: f64,
        heading_bias: f64,
    ) -> AirMotion {
        let (sin, cos) = (input.heading() - heading_bias).sin_cos();
        let ahead = Vector2::new(cos, sin);
        let (airspeed, airspeed_noise_density) = match input.airspeed {
            Some(reading) => (reading - airspeed_bias, self.airspeed_noise_density),
            None => (self.cruise_airspeed, self.cruise_airspeed_noise_density),
        };
        let held = HeldHeading::of(input);
        AirMotion {
            ahead,
            airspeed: held.left * airspeed,
            airspeed_noise_density,
            strayed: held.rates(airspeed),
            measured: input.airspeed.is_some(),
        }
    }

    /// Covariance of the position (north, east) that noise adds in `dt` seconds, m².
    pub(super) fn position_noise(&self, motion: &AirMotion, dt: f64) -> nalgebra::Matrix2<f64> {
        let [along, across] = motion.strayed;
        let along = along + motion.airspeed_noise_density.powi(2);
        let across = across + (motion.airspeed * self.heading_noise_density).powi(2);
        let (ahead, right) = (motion.ahead, motion.right());
        let rest = self.position_noise_density.powi(2);
        (ahead * ahead.transpose() * along
            + right * right.transpose() * across
            + nalgebra::Matrix2::from_diagonal_element(rest))
            * dt
    }
}
