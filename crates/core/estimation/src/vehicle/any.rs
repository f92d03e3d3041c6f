//! A vehicle model of which only the number of states is known.

use nalgebra::{SMatrix, SVector, Vector2};

use super::{AnyVehicle, ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

impl<const N: usize> VehicleModel<N> for AnyVehicle<N> {
    fn propagate(&self, state: &SVector<f64, N>, input: &ControlInput, dt: f64) -> SVector<f64, N> {
        self.as_ref().propagate(state, input, dt)
    }

    fn transition(
        &self,
        state: &SVector<f64, N>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, N, N> {
        self.as_ref().transition(state, input, dt)
    }

    fn process_noise(
        &self,
        state: &SVector<f64, N>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, N, N> {
        self.as_ref().process_noise(state, input, dt)
    }

    fn noise_of_belief(
        &self,
        belief: &Gaussian<N>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, N, N> {
        self.as_ref().noise_of_belief(belief, input, dt)
    }

    fn in_gusts(&self, deviation: f64, correlation_time: f64) -> Option<AnyVehicle<N>> {
        self.as_ref().in_gusts(deviation, correlation_time)
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, N>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        self.as_ref().ground_velocity(state, input)
    }

    fn layout(&self) -> [StateComponent; N] {
        self.as_ref().layout()
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<N> {
        self.as_ref().prior(position, position_deviation)
    }
}
