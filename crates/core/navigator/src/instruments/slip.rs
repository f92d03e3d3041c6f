//! Sideslip, by the force that it makes.
//!
//! An airplane that moves sideways through the air is pushed back. To first order the push is a specific force
//! f = -(ρ V² S c / 2m) β along the right wing, with the sideslip β, the air's density ρ, the wing's area S, the mass m
//! and the slope c of the side force (`-C_yβ` in the textbooks), so that the airplane moves to its right through the
//! air at V β = -L f / V. The length L = 2m / (ρ S c) is its own; both flights of the Skywalker X-8, a wing without a
//! fuselage to speak of, say 22 m where the heading is known.
//!
//! What is read for f is off by an amount b: by the accelerometer's own, by a roll that is off, by an airframe that is
//! not straight. So the slip is (B - L f) / V with B = L b. At one speed that is as good as another heading; an
//! airplane that changes its speed tells them apart.

use nalgebra::{Rotation2, Vector2};

use super::readings::Readings;
use super::series::Series;

/// Half the time over which the side force is averaged, seconds: engines shake.
const SHAKE: f64 = 0.1;
/// Airspeed below which the relation is not believed, m/s: a wing that hardly flies is pushed by other things.
const SLOWEST: f64 = 5.0;

/// Side force in the air, with where the wing points meanwhile.
#[derive(Clone, Debug, Default)]
pub(super) struct SideForce {
    /// Specific force along the right wing, m/s².
    force: Series,
    /// Horizontal part of that wing's direction, ahead and to the right of the heading: (sin φ sin θ, cos φ).
    wing: Series<Vector2<f64>>,
}

/// Velocity of the sideslip, by what it depends on; horizontal, north and east.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Slip {
    /// For each metre of L, 1/s.
    pub(super) per_length: Vector2<f64>,
    /// For each m²/s² of B, s/m.
    pub(super) per_offset: Vector2<f64>,
}

impl SideForce {
    /// Side force as read in the stretches in the air (seconds): a hand or a catapult pushes harder than the
    /// air. Where roll and pitch are missing the airplane counts as level.
    pub(super) fn of(readings: &Readings, airborne: &[(f64, f64)]) -> Self {
        let (mut in_the_air, mut wing) = (Series::new(), Series::new());
        for (time, force) in readings.side_force.iter() {
            if airborne.iter().any(|(a, b)| (*a..=*b).contains(&time)) {
                let roll = readings.roll.at(time).unwrap_or(0.0);
                let pitch = readings.pitch.at(time).unwrap_or(0.0);
                in_the_air.push(time, force);
                wing.push(time, Vector2::new(roll.sin() * pitch.sin(), roll.cos()));
            }
        }
        Self {
            force: in_the_air.averaged(SHAKE),
            wing,
        }
    }

    /// The slip at `time` (seconds) with the nose pointing along `nose` (north, east), at an airspeed in m/s; none
    /// where no force is measured.
    pub(super) fn slip(&self, time: f64, nose: &Vector2<f64>, airspeed: f64) -> Slip {
        let known = self.force.at(time).zip(self.wing.at(time));
        let Some((force, wing)) = known.filter(|_| airspeed >= SLOWEST) else {
            return Slip::default();
        };
        let per_offset = Rotation2::new(nose.y.atan2(nose.x)) * wing / airspeed;
        Slip {
            per_length: -per_offset * force,
            per_offset,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fit::AirFit;
    use super::super::problem::{FitPrior, FitProblem};
    use super::*;

    const LENGTH: f64 = 20.0;
    const WIND: [f64; 2] = [-3.0, 4.0];

    /// Round and round through the wind at `speed` (m/s) by heading, slipping by `force` (m/s²) by heading of which
    /// `read` is read, banked by 0.4 rad.
    fn fitted(
        speed: impl Fn(f64) -> f64,
        force: impl Fn(f64) -> f64,
        read: impl Fn(f64) -> Option<f64>,
        slip_offset: f64,
    ) -> AirFit {
        let mut readings = Readings::default();
        let (mut airspeed, mut nose) = (Series::new(), Series::new());
        for i in 0..1200 {
            let time = 0.1 * f64::from(i);
            let heading = 0.2 * time;
            let (speed, force) = (speed(heading), force(heading));
            let ahead = Vector2::new(heading.cos(), heading.sin());
            let right = Vector2::new(-ahead.y, ahead.x);
            let roll = 0.4_f64;
            if let Some(read) = read(force) {
                readings.side_force.push(time, read);
                readings.roll.push(time, roll);
            }
            airspeed.push(time, speed);
            nose.push(time, ahead);
            let slip = right * (-LENGTH * force * roll.cos() / speed);
            let over_ground = ahead * speed + slip + Vector2::from(WIND);
            readings.velocities.push(time, over_ground);
        }
        let problem = FitProblem {
            velocities: &readings.velocities,
            airspeed: &airspeed,
            nose: &nose,
            side_force: &SideForce::of(&readings, &[(0.0, 120.0)]),
            span: (0.0, 120.0),
            memory: 1.0,
            prior: FitPrior {
                scale: 0.1,
                heading: 0.2,
                drift: 0.0,
                wind: 5.0,
                slip_length: 30.0,
                slip_offset,
            },
        };
        problem.solve(0.0, 0.0, None).expect("a fit")
    }

    /// Error of the wind, m/s.
    fn wind_error(fit: &AirFit) -> f64 {
        (fit.wind - Vector2::from(WIND)).norm()
    }

    #[test]
    fn a_slip_that_comes_with_the_heading_is_not_taken_for_wind() {
        let pushed = |heading: f64| 2.0 * heading.cos();
        let fit = fitted(|_| 20.0, pushed, Some, 15.0);
        assert!((fit.slip_length - LENGTH).abs() < 0.5, "{fit:?}");
        assert!(fit.slip_deviation < 1.0, "{fit:?}");
        assert!(wind_error(&fit) < 0.1, "{fit:?}");
        let fit = fitted(|_| 20.0, pushed, |_| None, 15.0);
        assert!(fit.slip_length == 0.0 && wind_error(&fit) > 0.7, "{fit:?}");
    }

    #[test]
    fn a_side_force_that_reads_too_much_is_told_from_a_heading_by_the_speed() {
        let speed = |heading: f64| 20.0 + 8.0 * heading.cos();
        let pushed = |heading: f64| (3.0 * heading).sin();
        let too_much = |force: f64| Some(force + 0.5);
        let fit = fitted(speed, pushed, too_much, 15.0);
        let is_told = (fit.slip_offset - 0.5 * LENGTH).abs() < 0.5;
        assert!(is_told && fit.heading_offset.abs() < 0.005, "{fit:?}");
        assert!(wind_error(&fit) < 0.05, "{fit:?}");
        let fit = fitted(speed, pushed, too_much, 1e-9);
        assert!(
            fit.heading_offset.abs() > 0.01 && wind_error(&fit) > 0.1,
            "{fit:?}"
        );
    }

    #[test]
    fn a_push_to_the_right_moves_to_the_left_and_a_wing_that_points_down_nowhere() {
        let mut readings = Readings::default();
        readings.side_force.push(0.0, 1.5);
        let air = [(0.0, 1.0)];
        let east = Vector2::new(0.0, 1.0);
        let slip = |readings: &Readings, airspeed| {
            SideForce::of(readings, &air).slip(0.0, &east, airspeed)
        };
        let level = slip(&readings, 15.0);
        let north = Vector2::new(0.1, 0.0);
        assert!((level.per_length - north).norm() < 1e-12, "{level:?}");
        assert!((level.per_offset + north / 1.5).norm() < 1e-12, "{level:?}");
        let none = Slip {
            per_length: Vector2::zeros(),
            per_offset: Vector2::zeros(),
        };
        assert_eq!(slip(&readings, 2.0), none);
        let before = SideForce::of(&readings, &[(1.0, 2.0)]);
        assert_eq!(before.slip(0.0, &east, 15.0), none);
        readings.roll.push(0.0, std::f64::consts::FRAC_PI_2);
        assert!(slip(&readings, 15.0).per_length.norm() < 1e-12);
    }
}
