//! Multirotor that tilts to move, in a wind that its drag tells of.

use nalgebra::{Matrix2, Matrix6, SMatrix, SVector, Vector2, Vector6};
use serde::{Deserialize, Serialize};

use super::airplane::density_of;
use super::held_heading::HeldHeading;
use super::noise::add_white_noise;
use super::unmodelled_air::STEEPEST;
use super::{ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;
use pilotage_base::frames::units::GRAVITY;

/// Time in which a multirotor flips over, seconds: as long may its thrust push anywhere.
const FLIP: f64 = 1.0;

/// Multirotor at constant height, pushed where it tilts and slowed down by the air.
///
/// State: north, east (m), wind north, wind east (m/s, velocity of the air), velocity through the air
/// forward and to the right (m/s, in the body's heading, level). DeAngelo 2016, eqs 49-54, with three
/// additions without which the printed model knows nothing of its wind:
///
/// ```text
/// forward' = -g tan θ         - k forward + r right
/// right'   =  g tan φ / cos θ - k right   - r forward
/// (north, east)' = R(ψ) (forward, right) + wind
/// ```
///
/// - The velocity is that through the air, so that the wind carries the vehicle (eqs 53 and 54 leave it
///   out) and the drag k, which rotors have in proportion to it, pulls towards the wind: who hovers tilted
///   hovers in a wind.
/// - r is the rate of the heading ψ: axes that turn.
/// - The thrust that holds the height pushes by g tan φ / cos θ to the right.
/// - There is such a thrust up to a tilt of some 75°. Beyond, it pushes by no more, from 90° on not at all, and what it does
///   push is noise as large.
///
/// With k = 0 and calm air it is the printed one.
///
/// ```
/// use nalgebra::Vector6;
/// use pilotage_base::frames::Attitude;
/// use pilotage_estimation::vehicle::{ControlInput, Multirotor, VehicleModel};
///
/// // A level multirotor that rests in air that moves north by 2 m/s goes with it.
/// let input = ControlInput::without_airspeed(Attitude::level(0.0));
/// let state = Vector6::new(0.0, 0.0, 2.0, 0.0, 0.0, 0.0);
/// let later = Multirotor::default().propagate(&state, &input, 10.0);
/// assert!((later[0] - 20.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Multirotor {
    /// Drag k: deceleration per velocity through the air, 1/s.
    pub drag: f64,
    /// White noise of the acceleration on each axis, m/s/√s: errors of tilt and drag, gusts.
    pub acceleration_noise_density: f64,
    /// Anything else that moves the position, m/√s, on each axis.
    pub position_noise_density: f64,
    /// Random walk of the wind, m/s/√s, on each axis. The vehicle's inertia keeps it going: a new wind
    /// changes its velocity through the air at once and that over ground by the drag only.
    pub wind_noise_density: f64,
    /// Standard deviation of the unknown wind at the start, m/s on each axis.
    pub start_wind_deviation: f64,
    /// Standard deviation of the velocity over ground at the start, m/s on each axis.
    pub start_velocity_deviation: f64,
}

impl Default for Multirotor {
    fn default() -> Self {
        Self {
            drag: 0.3,
            acceleration_noise_density: 0.1,
            position_noise_density: 0.0,
            wind_noise_density: 0.02,
            start_wind_deviation: 1.0,
            start_velocity_deviation: 0.5,
        }
    }
}

/// Turns forward and right into north and east.
fn earth_from_body(heading: f64) -> Matrix2<f64> {
    let (sin, cos) = heading.sin_cos();
    Matrix2::new(cos, -sin, sin, cos)
}

/// Motion against drag over a time, per unit of velocity and acceleration.
struct Glide {
    /// Share of a velocity that is left.
    persistence: f64,
    /// Way that a unit of velocity makes, s.
    travel: f64,
    /// Way that a unit of acceleration makes, s².
    pushed: f64,
}

impl Glide {
    /// Over `time` seconds against `drag` (1/s): e⁻ˣ, t (1 - e⁻ˣ)/x and t² (x - 1 + e⁻ˣ)/x² with x = drag
    /// × time, as series where they would cancel.
    fn over(drag: f64, time: f64) -> Self {
        let x = drag * time;
        let gone = -(-x).exp_m1();
        let (first, second) = if x < 1e-3 {
            (
                1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x / 24.0)),
                1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0)),
            )
        } else {
            (gone / x, (x - gone) / (x * x))
        };
        Self {
            persistence: 1.0 - gone,
            travel: time * first,
            pushed: time * time * second,
        }
    }
}

impl Multirotor {
    /// Tangent (forward, right) of the tilt; `None` where the thrust does not point up.
    fn tilt(input: &ControlInput) -> Option<Vector2<f64>> {
        let (roll, pitch) = (input.attitude.roll, input.attitude.pitch);
        let tangent = Vector2::new(-pitch.tan(), roll.tan() / pitch.cos());
        (roll.cos() * pitch.cos() > 0.0).then_some(tangent)
    }

    /// Acceleration (forward, right) by the tilt of the thrust that holds the height, m/s².
    fn push(input: &ControlInput) -> Vector2<f64> {
        let tilt = Self::tilt(input).unwrap_or_else(Vector2::zeros);
        tilt.cap_magnitude(STEEPEST) * GRAVITY
    }

    /// White noise of the acceleration (m/s/√s) in two directions (north, east) at right angles: with what a heading or a
    /// tilt that is not read may push.
    fn push_noise(&self, input: &ControlInput) -> [(Vector2<f64>, f64); 2] {
        let push = earth_from_body(input.heading()) * Self::push(input);
        let speeding = push.norm();
        let along = push.try_normalize(0.0).unwrap_or_else(Vector2::x);
        let across = Vector2::new(-along.y, along.x);
        let tilt = density_of(GRAVITY * input.tilt_deviation);
        let mut usual = self.acceleration_noise_density.hypot(tilt).powi(2);
        if Self::tilt(input).is_none_or(|tilt| tilt.norm() > STEEPEST) {
            usual += (GRAVITY * STEEPEST).powi(2) * FLIP;
        }
        let [of_along, of_across] = HeldHeading::of(input).rates(speeding);
        [
            (along, (usual + of_along).sqrt()),
            (across, (usual + of_across).sqrt()),
        ]
    }

    /// Headings at the beginning and at the end of a step whose middle the input describes, radians.
    fn headings(input: &ControlInput, dt: f64) -> (f64, f64) {
        let half = 0.5 * input.turn_rate * dt;
        (input.heading() - half, input.heading() + half)
    }
}

impl VehicleModel<6> for Multirotor {
    fn propagate(&self, state: &SVector<f64, 6>, input: &ControlInput, dt: f64) -> Vector6<f64> {
        let glide = Glide::over(self.drag, dt);
        let (begin, end) = Self::headings(input, dt);
        let through_air = earth_from_body(begin) * Vector2::new(state[4], state[5]);
        let push = earth_from_body(input.heading()) * Self::push(input);
        let push = push * HeldHeading::of(input).left;
        let wind = Vector2::new(state[2], state[3]);
        let way = wind * dt + through_air * glide.travel + push * glide.pushed;
        let later = through_air * glide.persistence + push * glide.travel;
        let later = earth_from_body(end).tr_mul(&later);
        Vector6::new(
            state[0] + way.x,
            state[1] + way.y,
            wind.x,
            wind.y,
            later.x,
            later.y,
        )
    }

    fn transition(
        &self,
        _state: &SVector<f64, 6>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        let glide = Glide::over(self.drag, dt);
        let (begin, end) = Self::headings(input, dt);
        let mut transition = Matrix6::identity();
        transition[(0, 2)] = dt;
        transition[(1, 3)] = dt;
        transition
            .fixed_view_mut::<2, 2>(0, 4)
            .copy_from(&(earth_from_body(begin) * glide.travel));
        transition
            .fixed_view_mut::<2, 2>(4, 4)
            .copy_from(&(earth_from_body(begin - end) * glide.persistence));
        transition
    }

    fn process_noise(
        &self,
        _state: &SVector<f64, 6>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, 6, 6> {
        let (_, end) = Self::headings(input, dt);
        let body_from_earth = earth_from_body(end).transpose();
        let effect = |towards: Vector2<f64>, way: f64, wind: f64, velocity: f64| {
            let in_body = body_from_earth * towards * velocity;
            let (way, wind) = (towards * way, towards * wind);
            Vector6::new(way.x, way.y, wind.x, wind.y, in_body.x, in_body.y)
        };
        let mut noise = Matrix6::zeros();
        for (towards, density) in self.push_noise(input) {
            add_white_noise(&mut noise, density, dt, |s| {
                let glide = Glide::over(self.drag, s);
                effect(towards, glide.travel, 0.0, glide.persistence)
            });
        }
        for (axis, towards) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
            add_white_noise(&mut noise, self.wind_noise_density, dt, |s| {
                let glide = Glide::over(self.drag, s);
                effect(towards, s - glide.travel, 1.0, -glide.persistence)
            });
            noise[(axis, axis)] += self.position_noise_density.powi(2) * dt;
        }
        noise
    }

    fn ground_velocity(
        &self,
        state: &SVector<f64, 6>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let through_air = Vector2::new(state[4], state[5]);
        let wind = Vector2::new(state[2], state[3]);
        Some(earth_from_body(input.heading()) * through_air + wind)
    }

    fn layout(&self) -> [StateComponent; 6] {
        [
            StateComponent::PositionNorth,
            StateComponent::PositionEast,
            StateComponent::WindNorth,
            StateComponent::WindEast,
            StateComponent::VelocityForward,
            StateComponent::VelocityRight,
        ]
    }

    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<6> {
        let (p, w) = (position_deviation, self.start_wind_deviation);
        // Velocity through the air is that over ground less the wind.
        let v = self.start_velocity_deviation.hypot(w);
        let mut mean = Vector6::zeros();
        mean[0] = position.north;
        mean[1] = position.east;
        Gaussian::from_standard_deviations(mean, &Vector6::new(p, p, w, w, v, v))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use approx::assert_relative_eq;
    use nalgebra::{Matrix2, Vector2};

    use super::*;
    use crate::filter::{Ukf, UnscentedSettings};
    use pilotage_base::frames::Attitude;

    fn tilted(roll: f64, pitch: f64, yaw: f64) -> ControlInput {
        ControlInput::without_airspeed(Attitude { roll, pitch, yaw })
    }

    #[test]
    fn without_drag_and_wind_it_is_the_printed_model() {
        // DeAngelo 2016, eqs 51-54: u' = -g tan θ, v' = g tan φ, x' = u sin ψ + v cos ψ (east),
        // y' = -u cos ψ + v sin ψ (south); integrated exactly over a second from rest.
        let model = Multirotor {
            drag: 0.0,
            ..Multirotor::default()
        };
        let (roll, pitch, yaw) = (0.05, -0.1, 0.7);
        let next = model.propagate(&Vector6::zeros(), &tilted(roll, pitch, yaw), 1.0);
        let (u, v) = (-GRAVITY * pitch.tan(), GRAVITY * roll.tan() / pitch.cos());
        let (east, south) = (
            u * yaw.sin() + v * yaw.cos(),
            -u * yaw.cos() + v * yaw.sin(),
        );
        let expected = Vector6::new(-south / 2.0, east / 2.0, 0.0, 0.0, u, v);
        assert_relative_eq!(next, expected, epsilon = 1e-12);
    }

    #[test]
    fn nose_down_ends_at_the_speed_where_drag_holds_the_push() {
        let model = Multirotor::default();
        let pitch = -0.08_f64;
        let next = model.propagate(&Vector6::zeros(), &tilted(0.0, pitch, FRAC_PI_2), 100.0);
        let terminal = -GRAVITY * pitch.tan() / model.drag;
        assert_relative_eq!(next[4], terminal, max_relative = 1e-9);
        assert!(next[1] > 0.9 * 100.0 * terminal && next[0].abs() < 1e-9);
    }

    #[test]
    fn turning_on_the_spot_does_not_turn_the_way_through_the_air() {
        let model = Multirotor {
            drag: 0.0,
            ..Multirotor::default()
        };
        let mut state = Vector6::zeros();
        state[4] = 2.0;
        let dt = 0.1;
        let turn_rate = PI / 10.0;
        for k in 0..100 {
            let yaw = turn_rate * dt * (f64::from(k) + 0.5);
            let input = ControlInput {
                turn_rate,
                ..tilted(0.0, 0.0, yaw)
            };
            state = model.propagate(&state, &input, dt);
        }
        // Ten seconds northward, and it now flies backwards.
        assert_relative_eq!(state[0], 20.0, epsilon = 1e-9);
        assert_relative_eq!(state[4], -2.0, epsilon = 1e-9);
        assert_relative_eq!(state[5], 0.0, epsilon = 1e-9);
    }

    #[test]
    fn who_hovers_tilted_hovers_in_a_wind_and_the_filter_finds_it() {
        let model = Multirotor::default();
        let wind = Vector2::new(1.5, -0.8);
        // Over the same place: velocity through the air is minus the wind, held by the tilt.
        let yaw = 0.6;
        let through_air = earth_from_body(yaw).tr_mul(&-wind);
        let pitch = -(model.drag * through_air.x / GRAVITY).atan();
        let roll = (model.drag * through_air.y / GRAVITY * pitch.cos()).atan();
        let prior = model.prior(GroundPoint::new(0.0, 0.0), 0.5);
        let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
        for _ in 0..300 {
            let (input, dt) = (tilted(roll, pitch, yaw), 0.2);
            let noise = model.process_noise(filter.mean(), &input, dt);
            filter
                .predict(|x| model.propagate(x, &input, dt), &noise)
                .unwrap();
            let fix = Matrix2::identity() * 0.01;
            let predicted = filter
                .predict_measurement(|x| Some(Vector2::new(x[0], x[1])), &fix)
                .unwrap();
            filter.correct(&predicted, &Vector2::zeros()).unwrap();
        }
        let state = filter.state();
        assert_relative_eq!(model.wind(&state.mean).unwrap(), wind, epsilon = 0.05);
        let deviation = state.standard_deviations()[2];
        assert!(deviation < 0.3 * model.start_wind_deviation, "{deviation}");
        // Without drag nothing tells the wind from the velocity through the air.
        let printed = Multirotor { drag: 0.0, ..model };
        let input = tilted(0.0, 0.0, yaw);
        let unknown = printed.transition(&state.mean, &input, 1.0);
        let back = earth_from_body(yaw).transpose();
        let same_way = unknown.fixed_view::<2, 2>(0, 4) * back;
        assert_relative_eq!(same_way, unknown.fixed_view::<2, 2>(0, 2).into_owned());
    }

    #[test]
    fn a_tilt_that_nobody_reads_and_a_heading_that_is_held_leave_the_push_open() {
        let model = Multirotor::default();
        let way = |input: &ControlInput, axis: usize| {
            let noise = model.process_noise(&Vector6::zeros(), input, 10.0);
            noise[(axis, axis)].sqrt()
        };
        let read = tilted(0.0, -5_f64.to_radians(), 0.0);
        assert!(way(&read, 0) < 3.0 && way(&read, 1) < 3.0);
        // 0.858 m/s² against a drag of 0.3/s make 19.5 m in ten seconds.
        let pushed = model.propagate(&Vector6::zeros(), &read, 10.0)[0];
        assert!((pushed - 19.5).abs() < 0.1, "{pushed}");
        let open = ControlInput {
            tilt_deviation: 5_f64.to_radians(),
            ..read
        };
        assert!(way(&open, 0) > pushed && way(&open, 1) > pushed);
        // Held for long, it may point anywhere: half of its square on each axis.
        let held = ControlInput {
            heading_deviation: 2.0,
            heading_held: 10.0,
            ..read
        };
        assert!(way(&held, 1) > way(&read, 1) + 5.0, "{}", way(&held, 1));
        assert!(model.propagate(&Vector6::zeros(), &held, 10.0)[0] < 0.2 * pushed);
    }

    #[test]
    fn who_lies_on_the_side_or_upside_down_is_pushed_no_harder_than_the_thrust_can() {
        let model = Multirotor::default();
        let most = 3.7 * GRAVITY * 0.1;
        let speed = |roll: f64, pitch: f64| {
            let input = tilted(roll.to_radians(), pitch.to_radians(), 0.4);
            let later = model.propagate(&Vector6::zeros(), &input, 0.1);
            later[4].hypot(later[5])
        };
        for (roll, pitch) in [(76.0, 0.0), (89.0, 0.0), (-89.99, 0.0), (70.0, 70.0)] {
            let speed = speed(roll, pitch);
            assert!(speed <= most && speed > 0.9 * most, "{roll}: {speed}");
        }
        for (roll, pitch) in [(120.0, 0.0), (180.0, 5.0), (0.0, -100.0)] {
            assert_eq!(speed(roll, pitch), 0.0, "{roll} {pitch}");
        }
        // Both turned over are level.
        assert!(speed(180.0, 170.0) > 0.1, "{}", speed(180.0, 170.0));
        let deviation = |roll: f64, seconds: f64| {
            let input = tilted(roll.to_radians(), 0.0, 0.4);
            let noise = model.process_noise(&Vector6::zeros(), &input, seconds);
            noise[(4, 4)].sqrt().min(noise[(5, 5)].sqrt())
        };
        assert!(deviation(60.0, 0.1) < 0.1);
        // In a second as much as the thrust makes, less what drag of 0.3/s takes.
        for roll in [80.0, 89.0, 120.0, 180.0] {
            let share = deviation(roll, 1.0) / (10.0 * most);
            assert!((0.8..1.0).contains(&share), "{roll}: {share}");
        }
    }

    #[test]
    fn a_new_wind_takes_hold_of_the_vehicle_by_its_drag_only() {
        let model = Multirotor {
            acceleration_noise_density: 0.0,
            wind_noise_density: 1.0,
            ..Multirotor::default()
        };
        let noise = |dt| model.process_noise(&Vector6::zeros(), &tilted(0.0, 0.0, 0.0), dt);
        let short = noise(0.01);
        assert_relative_eq!(short[(2, 2)], 0.01, max_relative = 1e-12);
        assert_relative_eq!(short[(2, 4)], -0.01, max_relative = 1e-2);
        // Over ground: the sum of both has hardly moved.
        let ground = short[(2, 2)] + 2.0 * short[(2, 4)] + short[(4, 4)];
        assert!(ground < 1e-4 * short[(2, 2)], "{ground}");
    }
}
