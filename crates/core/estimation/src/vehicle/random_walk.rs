//! Vehicle of which nothing but slowness is known: position only.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::{ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Position driven by nothing but uncertainty. State: north, east (m).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RandomWalk {
    /// Random walk of the position, m/√s, on each axis.
    pub position_noise_density: f64,
}

impl Default for RandomWalk {
    fn default() -> Self {
        Self {
            position_noise_density: 8.0,
        }
    }
}

impl VehicleModel<2> for RandomWalk {
    fn propagate(&self, state: &SVector<f64, 2>, _input: &ControlInput, _dt: f64) -> Vector2<f64> {
        *state
    }

    fn transition(
        &self,
        _state: &SVector<f64, 2>,
        _input: &ControlInput,
        _dt: f64,
    ) -> SMatrix<f64, 2, 2> {
        Matrix2::identity()
    }

    fn process_noise(
        &self,
        _state: &SVector<f64, 2>,
        _input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 2, 2> {
        let density = self.position_noise_density;
        Matrix2::from_diagonal_element(density * density * dt)
    }

    fn layout(&self) -> [StateComponent; 2] {
        [StateComponent::PositionNorth, StateComponent::PositionEast]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<2> {
        Gaussian::from_standard_deviations(
            position.to_vector(),
            &Vector2::from_element(position_deviation),
        )
    }
}
