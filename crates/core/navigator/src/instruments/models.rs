//! What dead reckoning asks of a process model beyond what every vehicle promises.

use pilotage_estimation::vehicle::{
    AIRSPEED_MEMORY, AirplaneScaled, AirplaneWind, Gusts, VehicleModel,
};

/// An airplane whose airspeed may be missing.
pub trait Airplane<const N: usize>: VehicleModel<N> + Clone {
    /// The same airplane, assumed to fly at `speed` with standard deviation `deviation` (m/s) wherever no
    /// airspeed is measured.
    #[must_use]
    fn cruising(&self, speed: f64, deviation: f64) -> Self;
}

impl Airplane<8> for AirplaneScaled {
    fn cruising(&self, speed: f64, deviation: f64) -> Self {
        let mut model = *self;
        model.air_data.cruise_airspeed = speed;
        model.air_data.cruise_airspeed_noise_density = self.air_data.airspeed_noise_density;
        model.gusts_without_airspeed = Gusts {
            deviation: deviation.hypot(self.gusts.deviation),
            per_wind: 0.0,
            correlation_time: AIRSPEED_MEMORY,
        };
        model
    }
}

impl Airplane<4> for AirplaneWind {
    /// Without a state that remembers it, the deviation becomes the white noise that moves the airplane as far
    /// in the long run: σ √(2τ).
    fn cruising(&self, speed: f64, deviation: f64) -> Self {
        let mut model = *self;
        model.air_data = model.air_data.cruising(speed, deviation);
        model
    }
}
