//! Airplane in a steady wind with gusts.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::airplane::AirData;
use super::parts::{Gusts, add_velocity_noise, enter_velocity_slope, mean_squared_wind};
use super::{AnyVehicle, ControlInput, StateComponent, UnmodelledAir, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Airplane in a wind with two parts: one nearly steady, one that comes and goes in seconds.
///
/// State: north, east (m), wind north, wind east, gust north, gust east (m/s). The velocity of the
/// air is wind + gust; the gust is a first-order Gauss-Markov process, integrated exactly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirplaneWindGust {
    /// Trust in the air data.
    pub air_data: AirData,
    /// Random walk of the steady wind, m/s/√s, on each axis.
    pub wind_noise_density: f64,
    /// Standard deviation of the unknown wind at the start, m/s on each axis.
    pub start_wind_deviation: f64,
    /// Wind that changes by the second.
    pub gusts: Gusts,
    /// Changes of the wind by what the model has no states for.
    pub unmodelled: UnmodelledAir,
}

impl Default for AirplaneWindGust {
    fn default() -> Self {
        Self {
            air_data: AirData::default(),
            wind_noise_density: 0.02,
            start_wind_deviation: 4.0,
            gusts: Gusts::default(),
            unmodelled: UnmodelledAir::default(),
        }
    }
}

impl AirplaneWindGust {
    /// Process noise in winds whose mean square is `squared_wind` (m/s)².
    fn noise_in(&self, squared_wind: f64, input: &ControlInput, dt: f64) -> SMatrix<f64, 6, 6> {
        let motion = self.air_data.motion(input, 0.0, 0.0);
        let mut noise = SMatrix::<f64, 6, 6>::zeros();
        noise
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&self.air_data.position_noise(&motion, dt));
        let density =
            (self.unmodelled).density_with(self.wind_noise_density, &motion, input, squared_wind);
        add_velocity_noise(&mut noise, 2, density, dt);
        self.gusts.add_noise(&mut noise, 4, squared_wind, dt);
        noise
    }
}

impl VehicleModel<6> for AirplaneWindGust {
    fn propagate(&self, state: &SVector<f64, 6>, input: &ControlInput, dt: f64) -> SVector<f64, 6> {
        let air = self.air_data.motion(input, 0.0, 0.0).velocity();
        let mut next = *state;
        next[0] += (air.x + state[2]) * dt;
        next[1] += (air.y + state[3]) * dt;
        self.gusts.propagate(&mut next, 4, dt);
        next
    }

    fn transition(
        &self,
        _state: &SVector<f64, 6>,
        _input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        let mut transition = SMatrix::<f64, 6, 6>::identity();
        enter_velocity_slope(&mut transition, 2, dt);
        self.gusts.enter_slope(&mut transition, 4, dt);
        transition
    }

    fn process_noise(
        &self,
        state: &SVector<f64, 6>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        self.noise_in(state[2] * state[2] + state[3] * state[3], input, dt)
    }

    fn noise_of_belief(
        &self,
        belief: &Gaussian<6>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        self.noise_in(mean_squared_wind(belief, 2), input, dt)
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 6>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let air = self.air_data.motion(input, 0.0, 0.0).velocity();
        Some(air + Vector2::new(state[2] + state[4], state[3] + state[5]))
    }

    fn layout(&self) -> [StateComponent; 6] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::WindNorth,
            StateComponent::WindEast,
            StateComponent::GustNorth,
            StateComponent::GustEast,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<6> {
        let (p, w) = (position_deviation, self.start_wind_deviation);
        let g = self.gusts.deviation_in(2.0 * w * w);
        let w = (self.unmodelled).start_deviation_with(w, self.air_data.cruise_airspeed);
        let mut mean = SVector::zeros();
        mean[0] = position.north;
        mean[1] = position.east;
        let deviations = SVector::from([p, p, w, w, g, g]);
        Gaussian::from_standard_deviations(mean, &deviations)
    }

    fn in_gusts(&self, deviation: f64, correlation_time: f64) -> Option<AnyVehicle<6>> {
        Some(Arc::new(Self {
            gusts: Gusts::even(deviation, correlation_time),
            ..*self
        }))
    }
}
