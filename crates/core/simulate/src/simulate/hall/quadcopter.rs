//! A small quadcopter that follows a moving point, as a point mass on a tilting thrust.

use nalgebra::{Matrix2, Vector2, Vector3};

use pilotage_base::frames::units::GRAVITY;
use pilotage_base::frames::{Attitude, wrap_pi};

/// Performance of a quadcopter, and gains with which its pilot flies it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadcopter {
    /// Drag of the rotors: deceleration per velocity through the air, 1/s.
    pub drag: f64,
    /// Time constant of roll and pitch towards their commands, seconds.
    pub tilt_lag: f64,
    /// Greatest roll and pitch, radians.
    pub tilt_limit: f64,
    /// Greatest turn rate, rad/s.
    pub turn_rate_limit: f64,
    /// Time constant of the heading towards its command, seconds.
    pub heading_lag: f64,
    /// Time constant of the height towards its command, seconds.
    pub height_lag: f64,
    /// Acceleration per distance from the point that is followed, 1/s².
    pub position_gain: f64,
    /// Acceleration per difference from that point's velocity, 1/s.
    pub velocity_gain: f64,
}

impl Default for Quadcopter {
    /// A quadcopter of some 1.5 kg and 0.55 m between its motors, flown gently: the IRIS+ of
    /// DeAngelo 2016, chapter 6, as far as it is known.
    fn default() -> Self {
        Self {
            drag: 0.3,
            tilt_lag: 0.15,
            tilt_limit: 15.0_f64.to_radians(),
            turn_rate_limit: 45.0_f64.to_radians(),
            heading_lag: 0.4,
            height_lag: 1.0,
            position_gain: 1.0,
            velocity_gain: 1.6,
        }
    }
}

/// A point that moves, and the heading to be held meanwhile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reference {
    /// North and east, metres.
    pub position: Vector2<f64>,
    /// North and east, m/s.
    pub velocity: Vector2<f64>,
    /// Height above the ground, metres.
    pub height: f64,
    /// Radians clockwise from north.
    pub heading: f64,
}

/// The true state of a quadcopter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadcopterState {
    /// North, east, down, metres; the ground is at zero.
    pub position: Vector3<f64>,
    /// Over ground, north and east, m/s.
    pub velocity: Vector2<f64>,
    /// Attitude of the body.
    pub attitude: Attitude,
}

/// Turns forward and right into north and east.
fn earth_from_body(heading: f64) -> Matrix2<f64> {
    let (sin, cos) = heading.sin_cos();
    Matrix2::new(cos, -sin, sin, cos)
}

impl QuadcopterState {
    /// At rest where `reference` is.
    pub fn hovering(reference: &Reference) -> Self {
        Self {
            position: reference.position.push(-reference.height),
            velocity: Vector2::zeros(),
            attitude: Attitude::level(reference.heading),
        }
    }

    /// Goes on by `dt` seconds towards `reference` in air that moves with `air` (north, east, down),
    /// m/s.
    ///
    /// DeAngelo 2016, eqs 51-54, over ground and with the drag of the rotors: the thrust that holds
    /// the height pushes by -g tan θ forward and by g tan φ / cos θ to the right.
    pub fn step(&mut self, craft: &Quadcopter, reference: &Reference, air: &Vector3<f64>, dt: f64) {
        let off = reference.position - self.position.xy();
        let slow = reference.velocity - self.velocity;
        let wanted = craft.position_gain * off + craft.velocity_gain * slow;
        let in_body = earth_from_body(self.attitude.yaw).tr_mul(&wanted);
        let limited = |tilt: f64| tilt.clamp(-craft.tilt_limit, craft.tilt_limit);
        let pitch = limited(-(in_body.x / GRAVITY).atan());
        let roll = limited((in_body.y * pitch.cos() / GRAVITY).atan());
        let turn = wrap_pi(reference.heading - self.attitude.yaw) / craft.heading_lag;
        let turn = turn.clamp(-craft.turn_rate_limit, craft.turn_rate_limit);

        let attitude = &mut self.attitude;
        attitude.pitch += (pitch - attitude.pitch) * (dt / craft.tilt_lag);
        attitude.roll += (roll - attitude.roll) * (dt / craft.tilt_lag);
        attitude.yaw = wrap_pi(attitude.yaw + turn * dt);
        let push = Vector2::new(
            -attitude.pitch.tan(),
            attitude.roll.tan() / attitude.pitch.cos(),
        );
        let through_air = self.velocity - air.xy();
        let acceleration =
            earth_from_body(attitude.yaw) * push * GRAVITY - craft.drag * through_air;
        let way = self.velocity * dt + 0.5 * dt * dt * acceleration;
        self.velocity += acceleration * dt;
        let sink = (-reference.height - self.position.z) / craft.height_lag + air.z;
        self.position += Vector3::new(way.x, way.y, sink * dt);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_hovers_in_a_draught_leans_into_it_and_drag_tells_how_strong_it_is() {
        let craft = Quadcopter::default();
        let reference = Reference {
            height: 3.0,
            heading: 0.7,
            ..Reference::default()
        };
        let mut state = QuadcopterState::hovering(&reference);
        let air = Vector3::new(0.6, -0.3, 0.0);
        for _ in 0..3000 {
            state.step(&craft, &reference, &air, 0.01);
        }
        assert!(state.velocity.norm() < 1e-6, "{state:?}");
        let push = Vector2::new(
            -state.attitude.pitch.tan(),
            state.attitude.roll.tan() / state.attitude.pitch.cos(),
        );
        let wind = -earth_from_body(0.7) * push * GRAVITY / craft.drag;
        assert!((wind - air.xy()).norm() < 1e-6, "{wind}");
        // It hangs where the gain holds the drag.
        let off = state.position.xy() - air.xy() * (craft.drag / craft.position_gain);
        assert!(off.norm() < 1e-6, "{off}");
    }
}
