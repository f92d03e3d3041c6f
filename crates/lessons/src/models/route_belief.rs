//! The belief of a flight along a route, before it is flown.

use nalgebra::{Matrix2, Matrix4, SMatrix, vector};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirplaneWind, ControlInput, VehicleModel};

/// Speed along the route, m/s.
pub const SPEED: f64 = 20.0;

/// Belief of the unscented filter along a route that is flown in calm air which the filter does not know to be calm.
///
/// State: north, east (m), wind north, wind east (m/s). Every look is taken to say what was expected of it, so that only
/// the covariance changes.
#[derive(Clone, Debug)]
pub struct RouteBelief {
    vehicle: AirplaneWind,
    filter: Ukf<4>,
}

impl RouteBelief {
    /// Belief at the start: place to `place` metres, wind to `wind` m/s on each axis; `None` for numbers that are none.
    pub fn new(place: f64, wind: f64) -> Option<Self> {
        let vehicle = AirplaneWind {
            start_wind_deviation: wind,
            ..AirplaneWind::default()
        };
        let prior = vehicle.prior(GroundPoint::new(0.0, 0.0), place);
        let filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
        Some(Self { vehicle, filter })
    }

    /// Noise that `seconds` on a heading add, radians clockwise from north.
    pub fn noise(&self, heading: f64, seconds: f64) -> Matrix4<f64> {
        let input = ControlInput::new(SPEED, Attitude::level(heading));
        self.vehicle
            .process_noise(self.filter.mean(), &input, seconds)
    }

    /// Flies on for `seconds` on a heading, radians clockwise from north.
    pub fn fly(&mut self, heading: f64, seconds: f64) {
        let input = ControlInput::new(SPEED, Attitude::level(heading));
        let (vehicle, noise) = (self.vehicle, self.noise(heading, seconds));
        // Fails only for numbers that are none, and then nothing moves.
        let _ = self
            .filter
            .predict(|x| vehicle.propagate(x, &input, seconds), &noise);
    }

    /// Looks at a landmark that tells the place to `deviation` metres on each axis; the gain.
    ///
    /// ```
    /// use pilotage_lessons::models::RouteBelief;
    ///
    /// // A place known to 5 m on each axis and a look that tells as much: 5 m / √2 on each, 5 m together.
    /// let mut belief = RouteBelief::new(5.0, 1.0).ok_or("no number")?;
    /// belief.look(5.0).ok_or("no look")?;
    /// assert!((belief.error() - 5.0).abs() < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn look(&mut self, deviation: f64) -> Option<SMatrix<f64, 4, 2>> {
        let noise = Matrix2::from_diagonal_element(deviation * deviation);
        let predicted = self
            .filter
            .predict_measurement(|x| Some(vector![x[0], x[1]]), &noise)
            .ok()?;
        let expected = vector![self.filter.mean()[0], self.filter.mean()[1]];
        Some(self.filter.correct(&predicted, &expected).ok()?.gain)
    }

    /// The belief.
    pub fn state(&self) -> Gaussian<4> {
        self.filter.state()
    }

    /// Root of the mean square of the error of the place, north and east together, metres.
    pub fn error(&self) -> f64 {
        let root = self.filter.covariance_root();
        root.fixed_rows::<2>(0).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_minute_in_a_wind_that_is_known_to_1_m_s_leaves_60_m_on_each_axis_and_a_look_takes_them() {
        let mut belief = RouteBelief::new(0.0, 1.0).unwrap();
        belief.fly(0.0, 60.0);
        let east = belief.state().standard_deviations()[1];
        // The wind that changes adds 0.05² 60³ / 3, the instruments (0.2² + 0.05²) 60.
        let wanted = (3600.0 + 0.0025 * 216_000.0 / 3.0 + 0.0425 * 60.0f64).sqrt();
        assert!((east - wanted).abs() < 1e-6, "{east} {wanted}");
        belief.look(5.0);
        assert!((belief.error() / 2.0f64.sqrt() - 5.0).abs() < 0.05);
    }
}
