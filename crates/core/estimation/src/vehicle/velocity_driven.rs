//! Vehicle whose velocity over ground is measured, as by motion capture.

use nalgebra::{Matrix4, SMatrix, SVector, Vector2, Vector4};
use serde::{Deserialize, Serialize};

use super::noise::add_integrated_random_walk;
use super::parts::position_effect;
use super::{ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Moves with a measured velocity over ground.
///
/// State: north, east (m), bias of the velocity north and east (m/s): truth is reading minus bias.
/// DeAngelo 2016, eqs 55 and 56, where the state keeps two components beside the position that the printed
/// text calls the wind: what the readings are wrong by takes their place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct VelocityDriven {
    /// White noise of the velocity, m/s/√Hz, on each axis.
    pub velocity_noise_density: f64,
    /// The same while no velocity is measured and the vehicle is taken to stand still.
    pub unmeasured_noise_density: f64,
    /// Random walk of the bias, m/s/√s, on each axis.
    pub bias_noise_density: f64,
    /// Standard deviation of the bias at the start, m/s on each axis.
    pub start_bias_deviation: f64,
}

impl Default for VelocityDriven {
    fn default() -> Self {
        Self {
            velocity_noise_density: 0.05,
            unmeasured_noise_density: 2.0,
            bias_noise_density: 0.01,
            start_bias_deviation: 0.1,
        }
    }
}

impl VelocityDriven {
    /// Factor on the effect of a bias: 0 while no velocity is measured, else 1.
    fn felt(input: &ControlInput) -> f64 {
        f64::from(u8::from(input.ground_velocity.is_some()))
    }
}

impl VehicleModel<4> for VelocityDriven {
    fn propagate(&self, state: &SVector<f64, 4>, input: &ControlInput, dt: f64) -> Vector4<f64> {
        let bias = Vector2::new(state[2], state[3]);
        let velocity = input
            .ground_velocity
            .map_or_else(Vector2::zeros, |reading| reading - bias);
        Vector4::new(
            state[0] + velocity.x * dt,
            state[1] + velocity.y * dt,
            bias.x,
            bias.y,
        )
    }

    fn transition(
        &self,
        _state: &SVector<f64, 4>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 4, 4> {
        let mut transition = Matrix4::identity();
        transition[(0, 2)] = -Self::felt(input) * dt;
        transition[(1, 3)] = -Self::felt(input) * dt;
        transition
    }

    fn process_noise(
        &self,
        _state: &SVector<f64, 4>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 4, 4> {
        let density = if input.ground_velocity.is_some() {
            self.velocity_noise_density
        } else {
            self.unmeasured_noise_density
        };
        let mut noise = Matrix4::zeros();
        for (axis, direction) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
            noise[(axis, axis)] = density * density * dt;
            let effect = position_effect(direction * -Self::felt(input));
            add_integrated_random_walk(&mut noise, 2 + axis, &effect, self.bias_noise_density, dt);
        }
        noise
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 4>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let bias = Vector2::new(state[2], state[3]);
        Some(input.ground_velocity? - bias)
    }

    fn layout(&self) -> [StateComponent; 4] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::VelocityBiasNorth,
            StateComponent::VelocityBiasEast,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<4> {
        let (p, b) = (position_deviation, self.start_bias_deviation);
        Gaussian::from_standard_deviations(
            Vector4::new(position.north, position.east, 0.0, 0.0),
            &Vector4::new(p, p, b, b),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_where_the_reading_less_its_bias_says_and_stands_without_one() {
        let model = VelocityDriven::default();
        let state = Vector4::new(1.0, 2.0, 0.1, -0.2);
        let measured = ControlInput {
            ground_velocity: Some(Vector2::new(0.6, 0.3)),
            ..ControlInput::default()
        };
        let next = model.propagate(&state, &measured, 2.0);
        assert!((next - Vector4::new(2.0, 3.0, 0.1, -0.2)).norm() < 1e-12);
        let blind = ControlInput::default();
        assert_eq!(model.propagate(&state, &blind, 2.0), state);
        let noise = |input| model.process_noise(&state, input, 1.0)[(0, 0)];
        assert!(noise(&blind) > 100.0 * noise(&measured));
    }
}
