//! Airplane in a steady wind: position and wind.

use nalgebra::{Matrix4, SMatrix, SVector, Vector2, Vector4};
use serde::{Deserialize, Serialize};

use super::airplane::AirData;
use super::parts::{add_velocity_noise, enter_velocity_slope, mean_squared_wind};
use super::{ControlInput, StateComponent, ThesisNoise, UnmodelledAir, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Airplane that flies its airspeed along its heading in a slowly changing wind.
///
/// State: north, east (m), wind north, wind east (m/s, velocity of the air). DeAngelo 2016,
/// eqs 25-30, with x east and y south turned into north and east:
/// `north' = V cos ψ + wind_north`, `east' = V sin ψ + wind_east`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AirplaneWind {
    /// Trust in the air data.
    pub air_data: AirData,
    /// Random walk of the wind, m/s/√s, on each axis.
    pub wind_noise_density: f64,
    /// Standard deviation of the unknown wind at the start, m/s on each axis.
    pub start_wind_deviation: f64,
    /// Changes of the wind by what the model has no states for.
    pub unmodelled: UnmodelledAir,
    /// The thesis' noise per step in place of the densities.
    pub thesis_noise: Option<ThesisNoise>,
}

impl Default for AirplaneWind {
    fn default() -> Self {
        Self {
            air_data: AirData::default(),
            wind_noise_density: 0.05,
            start_wind_deviation: 4.0,
            unmodelled: UnmodelledAir::default(),
            thesis_noise: None,
        }
    }
}

impl AirplaneWind {
    /// With the process noise of DeAngelo 2016, Table 4.
    pub fn with_thesis_noise(noise: ThesisNoise) -> Self {
        Self {
            thesis_noise: Some(noise),
            ..Self::default()
        }
    }

    /// Process noise in winds whose mean square is `squared_wind` (m/s)².
    fn noise_in(&self, squared_wind: f64, input: &ControlInput, dt: f64) -> Matrix4<f64> {
        if let Some(thesis) = self.thesis_noise {
            let (position, wind) = (thesis.position_variance(), thesis.wind_variance());
            return Matrix4::from_diagonal(&Vector4::new(position, position, wind, wind));
        }
        let mut noise = Matrix4::zeros();
        let motion = self.air_data.motion(input, 0.0, 0.0);
        noise
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&self.air_data.position_noise(&motion, dt));
        let density =
            (self.unmodelled).density_with(self.wind_noise_density, &motion, input, squared_wind);
        add_velocity_noise(&mut noise, 2, density, dt);
        noise
    }
}

impl VehicleModel<4> for AirplaneWind {
    fn propagate(&self, state: &SVector<f64, 4>, input: &ControlInput, dt: f64) -> Vector4<f64> {
        let air = self.air_data.motion(input, 0.0, 0.0).velocity();
        Vector4::new(
            state[0] + (air.x + state[2]) * dt,
            state[1] + (air.y + state[3]) * dt,
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
        state: &SVector<f64, 4>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 4, 4> {
        self.noise_in(state[2] * state[2] + state[3] * state[3], input, dt)
    }

    fn noise_of_belief(
        &self,
        belief: &Gaussian<4>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 4, 4> {
        // Gusts that are taken for wind here make no stronger gusts: beyond its mean the wind counts as it was at the start.
        let wind = belief.mean[2].powi(2) + belief.mean[3].powi(2);
        let at_start = 2.0 * self.start_wind_deviation.powi(2);
        let squared_wind = mean_squared_wind(belief, 2).min(wind + at_start);
        self.noise_in(squared_wind, input, dt)
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 4>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let air = self.air_data.motion(input, 0.0, 0.0).velocity();
        Some(air + Vector2::new(state[2], state[3]))
    }

    fn layout(&self) -> [StateComponent; 4] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::WindNorth,
            StateComponent::WindEast,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<4> {
        let (p, w) = (position_deviation, self.start_wind_deviation);
        let w = match self.thesis_noise {
            // The thesis knows of nothing else.
            Some(_) => w,
            None => (self.unmodelled).start_deviation_with(w, self.air_data.cruise_airspeed),
        };
        Gaussian::from_standard_deviations(
            Vector4::new(position.north, position.east, 0.0, 0.0),
            &Vector4::new(p, p, w, w),
        )
    }
}
