//! Vehicle that keeps its velocity, nearly: position and velocity over ground.

use nalgebra::{Matrix4, SMatrix, SVector, Vector2, Vector4};
use serde::{Deserialize, Serialize};

use super::parts::{add_velocity_noise, enter_velocity_slope};
use super::{ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Nearly constant velocity over ground. State: north, east (m), velocity north, east (m/s).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ConstantVelocity {
    /// Random walk of the velocity (white acceleration), m/s/√s, on each axis.
    pub velocity_noise_density: f64,
    /// Standard deviation of the unknown velocity at the start, m/s on each axis.
    pub start_velocity_deviation: f64,
}

impl Default for ConstantVelocity {
    fn default() -> Self {
        Self {
            velocity_noise_density: 2.0,
            start_velocity_deviation: 10.0,
        }
    }
}

impl VehicleModel<4> for ConstantVelocity {
    fn propagate(&self, state: &SVector<f64, 4>, _input: &ControlInput, dt: f64) -> Vector4<f64> {
        Vector4::new(
            state[0] + state[2] * dt,
            state[1] + state[3] * dt,
            state[2],
            state[3],
        )
    }

    fn transition(
        &self,
        _state: &SVector<f64, 4>,
        _input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 4, 4> {
        let mut transition = SMatrix::<f64, 4, 4>::identity();
        enter_velocity_slope(&mut transition, 2, dt);
        transition
    }

    fn process_noise(
        &self,
        _state: &SVector<f64, 4>,
        _input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 4, 4> {
        let mut noise = Matrix4::zeros();
        add_velocity_noise(&mut noise, 2, self.velocity_noise_density, dt);
        noise
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 4>,
        _input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        Some(Vector2::new(state[2], state[3]))
    }

    fn layout(&self) -> [StateComponent; 4] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::VelocityNorth,
            StateComponent::VelocityEast,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<4> {
        let (p, v) = (position_deviation, self.start_velocity_deviation);
        Gaussian::from_standard_deviations(
            Vector4::new(position.north, position.east, 0.0, 0.0),
            &Vector4::new(p, p, v, v),
        )
    }
}
