//! Noise that stands for gusts and biases in a model without states for them.

use std::f64::consts::PI;

use pilotage_base::frames::units::GRAVITY;
use serde::{Deserialize, Serialize};

use super::airplane::AirMotion;
use super::{ControlInput, Gusts};

/// Airspeed below which nothing turns by its bank, m/s.
const SLOWEST: f64 = 5.0;
/// Tangent of the bank beyond which nothing turns faster, some 75°: who rolls over, or stands on its tail, does not turn.
pub(super) const STEEPEST: f64 = 3.7;

/// Motion of the air and errors of the air data that a model has no states for.
///
/// Its wind is then what all of them together do, and changes as they do. A gust of deviation σ and correlation time τ
/// strays, in times shorter than τ, as a random walk of density σ √(2/τ). A bias of airspeed or heading is a wind that
/// turns with the aircraft: after a turn by Θ it has changed by 2 sin(Θ/2) times itself, of whose mean square a random walk
/// of 4σ²/π for each radian has as much after a quarter and after half a turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct UnmodelledAir {
    /// Gusts; `None` where a model has states for them, or there are none.
    pub gusts: Option<Gusts>,
    /// Standard deviation of the airspeed's bias, m/s.
    pub airspeed_bias: f64,
    /// Standard deviation of the heading's bias, radians.
    pub heading_bias: f64,
}

impl UnmodelledAir {
    /// Variance per axis of the wind that biases make at an airspeed of `airspeed` m/s, (m/s)².
    fn of_biases(&self, airspeed: f64) -> f64 {
        0.5 * (self.airspeed_bias.powi(2) + (airspeed * self.heading_bias).powi(2))
    }

    /// Density of the random walk of a wind that itself walks at `density` m/s/√s and stands for them, m/s/√s, in winds
    /// whose mean square is `squared_wind` (m/s)².
    pub(super) fn density_with(
        &self,
        density: f64,
        motion: &AirMotion,
        input: &ControlInput,
        squared_wind: f64,
    ) -> f64 {
        let of_gusts = self.gusts.map_or(0.0, |gusts| {
            2.0 * gusts.deviation_in(squared_wind).powi(2) / gusts.correlation_time
        });
        // A turn without slip; the heading's own rate is a difference of noisy readings.
        let bank = input.attitude.roll.tan().abs().min(STEEPEST);
        let turn_rate = GRAVITY * bank / motion.airspeed.abs().max(SLOWEST);
        let of_turns = 4.0 / PI * self.of_biases(motion.airspeed) * turn_rate;
        density.hypot((of_gusts + of_turns).sqrt())
    }

    /// Standard deviation per axis, at the start, of a wind that stands for them and itself is unknown by `wind`, m/s; at an
    /// airspeed of `airspeed` m/s.
    pub(super) fn start_deviation_with(&self, wind: f64, airspeed: f64) -> f64 {
        let squared_wind = 2.0 * wind * wind;
        let of_gusts = self
            .gusts
            .map_or(0.0, |gusts| gusts.deviation_in(squared_wind).powi(2));
        wind.hypot((of_gusts + self.of_biases(airspeed)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use approx::assert_relative_eq;
    use nalgebra::{Rotation2, Vector2, Vector4};
    use pilotage_base::frames::{Attitude, GroundPoint};

    use super::super::{AirplaneWind, VehicleModel as _};
    use super::*;

    const AIRSPEED: f64 = 19.0;

    fn model(unmodelled: UnmodelledAir) -> AirplaneWind {
        AirplaneWind {
            wind_noise_density: 0.0,
            unmodelled,
            ..AirplaneWind::default()
        }
    }

    /// Variance of the wind per axis that a model adds in `seconds` of a bank of `roll`, radians.
    fn added(model: &AirplaneWind, roll: f64, seconds: f64) -> f64 {
        let attitude = Attitude {
            roll,
            ..Attitude::level(0.3)
        };
        let input = ControlInput::new(AIRSPEED, attitude);
        model.process_noise(&Vector4::zeros(), &input, seconds)[(2, 2)]
    }

    #[test]
    fn who_rolls_over_or_stands_does_not_turn_as_if_in_a_bank() {
        let model = model(UnmodelledAir {
            gusts: None,
            airspeed_bias: 0.2,
            heading_bias: 0.5_f64.to_radians(),
        });
        for roll in [FRAC_PI_2 - 1e-9, FRAC_PI_2, -FRAC_PI_2, 1.6, PI] {
            let deviation = added(&model, roll, 0.1).sqrt();
            assert!(deviation < 0.1, "{deviation} m/s in a tenth of a second");
        }
    }

    #[test]
    fn biases_change_the_wind_by_as_much_as_they_turn_with_the_aircraft() {
        let (airspeed_bias, heading_bias) = (0.2, 0.4_f64.to_radians());
        let model = model(UnmodelledAir {
            gusts: None,
            airspeed_bias,
            heading_bias,
        });
        assert!(added(&model, 0.0, 60.0).abs() < 1e-12, "no turn, no change");
        let roll = 0.3_f64;
        let turn_rate = GRAVITY * roll.tan() / AIRSPEED;
        for turn in [FRAC_PI_2, PI] {
            // The velocities of the two biases, turned with the aircraft, less themselves; per axis on average.
            let biases = [
                Vector2::new(airspeed_bias, 0.0),
                Vector2::new(0.0, AIRSPEED * heading_bias),
            ];
            let changes = biases.map(|bias| (Rotation2::new(turn) * bias - bias).norm_squared());
            let expected = 0.5 * (changes[0] + changes[1]);
            for side in [-1.0, 1.0] {
                let added = added(&model, side * roll, turn / turn_rate);
                assert_relative_eq!(added, expected, max_relative = 1e-9);
            }
        }
    }

    #[test]
    fn gusts_change_the_wind_at_first_as_they_do_themselves_and_never_by_less() {
        let (deviation, correlation_time) = (0.5, 15.0);
        let model = model(UnmodelledAir {
            gusts: Some(Gusts {
                deviation,
                per_wind: 0.0,
                correlation_time,
            }),
            ..UnmodelledAir::default()
        });
        for seconds in [0.05, 0.5, 5.0, 50.0] {
            // Mean square of the change of a process with the correlation σ² exp(-t/τ).
            let change = 2.0 * deviation.powi(2) * -(-seconds / correlation_time).exp_m1();
            let added = added(&model, 0.0, seconds);
            assert!(added >= change, "{seconds} s: {added} {change}");
            if seconds < 0.01 * correlation_time {
                assert_relative_eq!(added, change, max_relative = 0.01);
            }
        }
    }

    #[test]
    fn unmodelled_gusts_are_as_strong_as_the_wind_and_part_of_it_at_the_start() {
        let model = model(UnmodelledAir {
            gusts: Some(Gusts {
                deviation: 0.1,
                per_wind: 0.05,
                correlation_time: 15.0,
            }),
            ..UnmodelledAir::default()
        });
        let input = ControlInput::new(AIRSPEED, Attitude::level(TAU));
        let in_wind = |wind| {
            let state = Vector4::new(0.0, 0.0, wind, 0.0);
            model.process_noise(&state, &input, 1.0)[(3, 3)]
        };
        assert_relative_eq!(in_wind(10.0), 25.0 * in_wind(1.0), max_relative = 1e-9);
        let start = model.prior(GroundPoint::default(), 3.0).covariance[(2, 2)];
        let wind = model.start_wind_deviation.powi(2);
        assert_relative_eq!(
            start,
            wind + 0.05_f64.powi(2) * 2.0 * wind,
            max_relative = 1e-9
        );
    }
}
