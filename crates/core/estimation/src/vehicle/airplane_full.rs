//! Airplane in a steady wind with gusts and biased air data.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::airplane::AirData;
use super::parts::{
    AirDataBiases, Gusts, add_velocity_noise, enter_velocity_slope, mean_squared_wind,
};
use super::{AnyVehicle, ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Airplane in wind and gusts whose airspeed and heading read slowly wrong.
///
/// State: north, east (m), wind north, wind east, gust north, gust east, airspeed bias (m/s),
/// heading bias (rad); see [`super::AirplaneWindGust`] and [`super::AirplaneWindBias`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirplaneFull {
    /// Trust in the air data.
    pub air_data: AirData,
    /// Random walk of the steady wind, m/s/√s, on each axis.
    pub wind_noise_density: f64,
    /// Standard deviation of the unknown wind at the start, m/s on each axis.
    pub start_wind_deviation: f64,
    /// Wind that changes by the second.
    pub gusts: Gusts,
    /// Slow errors of the air data.
    pub biases: AirDataBiases,
}

impl Default for AirplaneFull {
    fn default() -> Self {
        Self {
            air_data: AirData::default(),
            wind_noise_density: 0.02,
            start_wind_deviation: 4.0,
            gusts: Gusts::default(),
            biases: AirDataBiases::default(),
        }
    }
}

impl AirplaneFull {
    /// Process noise in winds whose mean square is `squared_wind` (m/s)².
    fn noise_in(
        &self,
        state: &SVector<f64, 8>,
        squared_wind: f64,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 8, 8> {
        let motion = self.air_data.motion(input, state[6], state[7]);
        let mut noise = SMatrix::<f64, 8, 8>::zeros();
        noise
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&self.air_data.position_noise(&motion, dt));
        add_velocity_noise(&mut noise, 2, self.wind_noise_density, dt);
        self.gusts.add_noise(&mut noise, 4, squared_wind, dt);
        self.biases.add_noise(&mut noise, 6, &motion, dt);
        noise
    }
}

impl VehicleModel<8> for AirplaneFull {
    fn propagate(&self, state: &SVector<f64, 8>, input: &ControlInput, dt: f64) -> SVector<f64, 8> {
        let air = self.air_data.motion(input, state[6], state[7]).velocity();
        let mut next = *state;
        next[0] += (air.x + state[2]) * dt;
        next[1] += (air.y + state[3]) * dt;
        self.gusts.propagate(&mut next, 4, dt);
        next
    }

    fn transition(
        &self,
        state: &SVector<f64, 8>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 8, 8> {
        let mut transition = SMatrix::<f64, 8, 8>::identity();
        let motion = self.air_data.motion(input, state[6], state[7]);
        enter_velocity_slope(&mut transition, 2, dt);
        self.gusts.enter_slope(&mut transition, 4, dt);
        AirDataBiases::enter_slope(&mut transition, 6, &motion, dt);
        transition
    }

    fn process_noise(
        &self,
        state: &SVector<f64, 8>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 8, 8> {
        let squared_wind = state[2] * state[2] + state[3] * state[3];
        self.noise_in(state, squared_wind, input, dt)
    }

    fn noise_of_belief(
        &self,
        belief: &Gaussian<8>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 8, 8> {
        self.noise_in(&belief.mean, mean_squared_wind(belief, 2), input, dt)
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 8>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let air = self.air_data.motion(input, state[6], state[7]).velocity();
        Some(air + Vector2::new(state[2] + state[4], state[3] + state[5]))
    }

    fn layout(&self) -> [StateComponent; 8] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::WindNorth,
            StateComponent::WindEast,
            StateComponent::GustNorth,
            StateComponent::GustEast,
            StateComponent::AirspeedBias,
            StateComponent::HeadingBias,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<8> {
        let (p, w) = (position_deviation, self.start_wind_deviation);
        let g = self.gusts.deviation_in(2.0 * w * w);
        let mut mean = SVector::zeros();
        mean[0] = position.north;
        mean[1] = position.east;
        let deviations = SVector::from([
            p,
            p,
            w,
            w,
            g,
            g,
            self.biases.start_airspeed_bias_deviation,
            self.biases.start_heading_bias_deviation,
        ]);
        Gaussian::from_standard_deviations(mean, &deviations)
    }

    fn in_gusts(&self, deviation: f64, correlation_time: f64) -> Option<AnyVehicle<8>> {
        Some(Arc::new(Self {
            gusts: Gusts::even(deviation, correlation_time),
            ..*self
        }))
    }
}
