//! Errors of the velocity through the air where its readings are held or assumed.

use nalgebra::{Matrix2, Vector2};

use pilotage_estimation::vehicle::{ControlInput, VehicleSettings};
use pilotage_mission::settings::Cruise;

/// Velocity through the air as a vehicle model takes it, where no reading tells it.
#[derive(Clone, Copy, Debug, Default)]
pub struct AssumedAir {
    /// Covariance of the velocity's error by an assumed airspeed and a held heading (north, east), (m/s)².
    pub velocity: Matrix2<f64>,
    /// Whether the heading is not read but held from earlier.
    pub holds_heading: bool,
}

impl AssumedAir {
    /// Of the readings `input` as `vehicle` takes them, with the airspeed of `cruise` where none is read.
    pub fn of(input: &ControlInput, vehicle: &VehicleSettings, cruise: Cruise) -> Self {
        let is_read = input.airspeed.is_some() && input.heading_deviation <= 0.0;
        let (speed, deviation) = match input.airspeed {
            Some(reading) => (reading, 0.0),
            None => (cruise.airspeed, cruise.deviation),
        };
        // Of a heading that strays by a Gaussian angle of deviation σ, q = e^(-σ²/2) of the speed is left along it, which
        // is what the model takes; squares about that have the means V² (1 - q²)² / 2 along it and V² (1 - q⁴) / 2 across.
        let left = (-input.heading_deviation.powi(2)).exp();
        let along = 0.5 * (speed * (1.0 - left)).powi(2) + left * deviation.powi(2);
        let across = 0.5 * speed.powi(2) * (1.0 - left * left);
        let (sin, cos) = input.heading().sin_cos();
        let (ahead, right) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let velocity = if is_read || !vehicle.uses_airspeed() {
            Matrix2::zeros()
        } else {
            ahead * ahead.transpose() * along + right * right.transpose() * across
        };
        Self {
            velocity,
            holds_heading: input.heading_deviation > 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::super::super::engine::{place_in_state, vehicle};
    use super::*;
    use pilotage_base::frames::Attitude;
    use pilotage_estimation::vehicle::{ConstantVelocity, StateComponent};
    use pilotage_mission::settings::{NavigatorSettings, VehicleChoice};

    const CRUISE: Cruise = Cruise {
        airspeed: 20.0,
        deviation: 2.0,
    };

    fn of(input: &ControlInput) -> Matrix2<f64> {
        AssumedAir::of(input, &VehicleSettings::default(), CRUISE).velocity
    }

    #[test]
    fn an_assumed_airspeed_errs_along_the_heading_and_a_held_heading_across_it() {
        let east = Attitude::level(FRAC_PI_2);
        let read = ControlInput::new(18.0, east);
        assert_eq!(of(&read), Matrix2::zeros());
        let assumed = of(&ControlInput::without_airspeed(east));
        assert!(
            (assumed - Matrix2::new(0.0, 0.0, 0.0, 4.0)).norm() < 1e-9,
            "{assumed}"
        );
        let held = ControlInput {
            heading_deviation: 0.05,
            ..read
        };
        // 18² (1 - e^-0.005) / 2 = 0.8080 across, near (18 · 0.05)² = 0.81; 18² (1 - e^-0.0025)² / 2 = 0.00101 along.
        let held = of(&held);
        assert!((held[(0, 0)] - 0.807_978).abs() < 1e-5, "{held}");
        assert!((held[(1, 1)] - 0.001_010).abs() < 1e-5, "{held}");
    }

    #[test]
    fn a_heading_of_which_nothing_is_known_leaves_half_of_the_square_of_the_speed_each_way() {
        let lost = ControlInput {
            heading_deviation: 9.0,
            ..ControlInput::new(18.0, Attitude::level(0.3))
        };
        assert!((of(&lost) - Matrix2::identity() * 162.0).norm() < 1e-6);
        let other = VehicleSettings::ConstantVelocity(ConstantVelocity::default());
        let other = AssumedAir::of(&lost, &other, CRUISE);
        assert_eq!(other.velocity, Matrix2::zeros());
        assert!(other.holds_heading);
    }

    #[test]
    fn every_vehicle_that_knows_the_wind_and_has_no_velocity_of_its_own_flies_by_air() {
        let unread = ControlInput::without_airspeed(Attitude::level(0.3));
        for choice in VehicleChoice::ALL {
            let settings = NavigatorSettings {
                vehicle: choice,
                ..NavigatorSettings::default()
            };
            let has = |component| place_in_state(&settings, component).is_some();
            let by_air = has(StateComponent::WindNorth) && !has(StateComponent::VelocityForward);
            let assumed = AssumedAir::of(&unread, &vehicle(&settings), CRUISE);
            assert_eq!(assumed.velocity != Matrix2::zeros(), by_air, "{choice:?}");
        }
    }
}
