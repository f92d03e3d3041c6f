//! Airplane in wind and gusts whose airspeed reads by a factor wrong and whose heading by an angle.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::airplane::{AirData, AirMotion};
use super::noise::add_integrated_random_walk;
use super::parts::{Gusts, add_velocity_noise, mean_squared_wind, position_effect};
use super::{AnyVehicle, ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Slow errors of the air data of a real airplane.
///
/// A pitot tube reads by a factor wrong rather than by an amount: the place of the tube, the sensor's
/// gain and the air's density all act on the pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirDataErrors {
    /// Standard deviation of the airspeed's factor (true over measured) about 1 at the start.
    pub start_scale_deviation: f64,
    /// Random walk of that factor, 1/√s.
    pub scale_noise_density: f64,
    /// Standard deviation of the heading's bias (reading minus truth) at the start, radians.
    pub start_heading_bias_deviation: f64,
    /// Random walk of that bias, rad/√s.
    pub heading_bias_noise_density: f64,
}

impl Default for AirDataErrors {
    fn default() -> Self {
        Self {
            start_scale_deviation: 0.1,
            scale_noise_density: 0.001,
            start_heading_bias_deviation: 0.1,
            heading_bias_noise_density: 0.005,
        }
    }
}

/// Airplane in a slowly changing wind and in gusts of finite memory, with a factor on its airspeed and a
/// bias of its heading.
///
/// State: north, east (m), wind north, wind east, gust north, gust east (m/s), airspeed scale (true over
/// measured), heading bias (rad). The velocity over ground is
/// `scale · V cos θ · (cos(ψ - bias), sin(ψ - bias)) + wind + gust`: DeAngelo 2016, eqs 27 and 28, with the
/// horizontal part of the airspeed (θ the pitch), which the thesis leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirplaneScaled {
    /// Trust in the air data.
    pub air_data: AirData,
    /// Random walk of the steady wind, m/s/√s, on each axis.
    pub wind_noise_density: f64,
    /// Standard deviation of the unknown wind at the start, m/s on each axis.
    pub start_wind_deviation: f64,
    /// Motion of the air besides the steady wind, which is remembered for a while.
    pub gusts: Gusts,
    /// The same while no airspeed is measured: how the airspeed strays from the assumed one comes on top.
    pub gusts_without_airspeed: Gusts,
    /// Slow errors of the air data.
    pub errors: AirDataErrors,
}

impl Default for AirplaneScaled {
    fn default() -> Self {
        Self {
            air_data: AirData::default(),
            wind_noise_density: 0.02,
            start_wind_deviation: 4.0,
            gusts: Gusts::default(),
            gusts_without_airspeed: Gusts {
                deviation: 4.0,
                per_wind: 0.0,
                correlation_time: 10.0,
            },
            errors: AirDataErrors::default(),
        }
    }
}

/// Indices of components in the state.
const SCALE: usize = 6;
const HEADING_BIAS: usize = 7;

impl AirplaneScaled {
    /// Horizontal motion through the air, with the errors of `state` taken out.
    fn motion(&self, state: &SVector<f64, 8>, input: &ControlInput) -> AirMotion {
        let mut motion = self.air_data.motion(input, 0.0, state[HEADING_BIAS]);
        motion.airspeed *= input.attitude.pitch.cos();
        if motion.measured {
            motion.airspeed *= state[SCALE];
        }
        motion
    }

    /// Gusts that are expected with this input.
    fn gusts_with(&self, input: &ControlInput) -> &Gusts {
        match input.airspeed {
            Some(_) => &self.gusts,
            None => &self.gusts_without_airspeed,
        }
    }

    /// Process noise in winds whose mean square is `squared_wind` (m/s)².
    fn noise_in(
        &self,
        state: &SVector<f64, 8>,
        squared_wind: f64,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 8, 8> {
        let motion = self.motion(state, input);
        let mut noise = SMatrix::<f64, 8, 8>::zeros();
        noise
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&self.air_data.position_noise(&motion, dt));
        add_velocity_noise(&mut noise, 2, self.wind_noise_density, dt);
        self.gusts_with(input)
            .add_noise(&mut noise, 4, squared_wind, dt);
        let scaled = match input.airspeed {
            Some(reading) => motion.ahead * (reading * input.attitude.pitch.cos()),
            None => Vector2::zeros(),
        };
        for (index, density, velocity) in [
            (SCALE, self.errors.scale_noise_density, scaled),
            (
                HEADING_BIAS,
                self.errors.heading_bias_noise_density,
                -motion.right() * motion.airspeed,
            ),
        ] {
            add_integrated_random_walk(&mut noise, index, &position_effect(velocity), density, dt);
        }
        noise
    }
}

impl VehicleModel<8> for AirplaneScaled {
    fn propagate(&self, state: &SVector<f64, 8>, input: &ControlInput, dt: f64) -> SVector<f64, 8> {
        let air = self.motion(state, input).velocity();
        let mut next = *state;
        next[0] += (air.x + state[2]) * dt;
        next[1] += (air.y + state[3]) * dt;
        self.gusts_with(input).propagate(&mut next, 4, dt);
        next
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
        let air = self.motion(state, input).velocity();
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
            StateComponent::AirspeedScale,
            StateComponent::HeadingBias,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<8> {
        let (p, w) = (position_deviation, self.start_wind_deviation);
        let g = self.gusts.deviation_in(2.0 * w * w);
        let mut mean = SVector::zeros();
        mean[0] = position.north;
        mean[1] = position.east;
        mean[SCALE] = 1.0;
        let deviations = SVector::from([
            p,
            p,
            w,
            w,
            g,
            g,
            self.errors.start_scale_deviation,
            self.errors.start_heading_bias_deviation,
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
