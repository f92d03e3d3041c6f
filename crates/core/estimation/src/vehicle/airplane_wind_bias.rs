//! Airplane in a steady wind with biased air data.

use nalgebra::{SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::airplane::AirData;
use super::parts::{AirDataBiases, add_velocity_noise, enter_velocity_slope};
use super::{ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Airplane in a steady wind whose airspeed and heading read slowly wrong.
///
/// State: north, east (m), wind north, wind east (m/s), airspeed bias (m/s), heading bias (rad);
/// truth is reading minus bias. The bias is an angle near zero that enters sine and cosine only, so
/// that readings may wrap as they like.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirplaneWindBias {
    /// Trust in the air data.
    pub air_data: AirData,
    /// Random walk of the steady wind, m/s/√s, on each axis.
    pub wind_noise_density: f64,
    /// Standard deviation of the unknown wind at the start, m/s on each axis.
    pub start_wind_deviation: f64,
    /// Slow errors of the air data.
    pub biases: AirDataBiases,
}

impl Default for AirplaneWindBias {
    fn default() -> Self {
        Self {
            air_data: AirData::default(),
            wind_noise_density: 0.05,
            start_wind_deviation: 4.0,
            biases: AirDataBiases::default(),
        }
    }
}

impl VehicleModel<6> for AirplaneWindBias {
    fn propagate(&self, state: &SVector<f64, 6>, input: &ControlInput, dt: f64) -> SVector<f64, 6> {
        let air = self.air_data.motion(input, state[4], state[5]).velocity();
        let mut next = *state;
        next[0] += (air.x + state[2]) * dt;
        next[1] += (air.y + state[3]) * dt;
        next
    }

    fn transition(
        &self,
        state: &SVector<f64, 6>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        let mut transition = SMatrix::<f64, 6, 6>::identity();
        let motion = self.air_data.motion(input, state[4], state[5]);
        enter_velocity_slope(&mut transition, 2, dt);
        AirDataBiases::enter_slope(&mut transition, 4, &motion, dt);
        transition
    }

    fn process_noise(
        &self,
        state: &SVector<f64, 6>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        let motion = self.air_data.motion(input, state[4], state[5]);
        let mut noise = SMatrix::<f64, 6, 6>::zeros();
        noise
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&self.air_data.position_noise(&motion, dt));
        add_velocity_noise(&mut noise, 2, self.wind_noise_density, dt);
        self.biases.add_noise(&mut noise, 4, &motion, dt);
        noise
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 6>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let air = self.air_data.motion(input, state[4], state[5]).velocity();
        Some(air + Vector2::new(state[2], state[3]))
    }

    fn layout(&self) -> [StateComponent; 6] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::WindNorth,
            StateComponent::WindEast,
            StateComponent::AirspeedBias,
            StateComponent::HeadingBias,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<6> {
        let (p, w) = (position_deviation, self.start_wind_deviation);
        let mut mean = SVector::zeros();
        mean[0] = position.north;
        mean[1] = position.east;
        let deviations = SVector::from([
            p,
            p,
            w,
            w,
            self.biases.start_airspeed_bias_deviation,
            self.biases.start_heading_bias_deviation,
        ]);
        Gaussian::from_standard_deviations(mean, &deviations)
    }
}
