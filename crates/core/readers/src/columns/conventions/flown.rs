//! Two made-up flights whose every quantity is known: an airplane in wind, a copter that looks elsewhere than it flies.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

const GRAVITY: f64 = 9.806_65;
const RATE: f64 = 10.0;
const SECONDS: f64 = 200.0;

/// Kind of aircraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Craft {
    Airplane,
    Copter,
}

/// Everything at a moment, SI and radians, axes north-east-down and forward-right-down.
#[derive(Clone, Debug)]
pub struct FlownMoment {
    pub time: f64,
    pub north: f64,
    pub east: f64,
    pub height: f64,
    pub velocity: Vector3<f64>,
    pub roll: f64,
    pub pitch: f64,
    pub heading: f64,
    pub rates: Vector3<f64>,
    pub acceleration: Vector3<f64>,
    pub airspeed: f64,
    /// Velocity of the air, north and east.
    pub wind: [f64; 2],
}

impl FlownMoment {
    pub fn latitude(&self) -> f64 {
        47.4_f64.to_radians() + self.north / 6_371_000.0
    }

    pub fn longitude(&self) -> f64 {
        8.5_f64.to_radians() + self.east / 6_371_000.0 / 47.4_f64.to_radians().cos()
    }

    /// Velocity over ground along forward, right, down.
    pub fn along_body(&self) -> Vector3<f64> {
        let turn = Rotation3::from_euler_angles(self.roll, self.pitch, self.heading);
        turn.inverse() * self.velocity
    }

    pub fn quaternion(&self, is_ros: bool) -> [f64; 4] {
        let half = std::f64::consts::FRAC_PI_2;
        let q = if is_ros {
            UnitQuaternion::from_euler_angles(self.roll, -self.pitch, half - self.heading)
        } else {
            UnitQuaternion::from_euler_angles(self.roll, self.pitch, self.heading)
        };
        [q.w, q.i, q.j, q.k]
    }
}

/// The attitude at a time, roll, pitch, heading.
fn attitude(craft: Craft, time: f64) -> [f64; 3] {
    match craft {
        Craft::Airplane => {
            let rate = turn_rate(time);
            let roll = (18.0 * rate / GRAVITY).atan();
            let pitch = 0.04 + 0.09 * (0.11 * time).sin();
            [roll, pitch, heading(time)]
        }
        Craft::Copter => {
            // It leans as its acceleration and its drag want, and looks anywhere.
            let heading = 0.7 + 1.4 * (0.05 * time).sin() + 0.2 * (0.4 * time).sin();
            let small = 1e-3;
            let change = velocity(craft, time + small) - velocity(craft, time - small);
            let lift = change / (2.0 * small) + 0.2 * velocity(craft, time)
                - Vector3::new(0.0, 0.0, GRAVITY);
            let down = -lift.normalize();
            let nose = Vector3::new(heading.cos(), heading.sin(), 0.0);
            let right = down.cross(&nose).normalize();
            let forward = right.cross(&down);
            let turn = nalgebra::Matrix3::from_columns(&[forward, right, down]);
            let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(turn).euler_angles();
            [roll, pitch, yaw]
        }
    }
}

/// Rate of turn of the airplane, rad/s, and the heading that it makes.
fn turn_rate(time: f64) -> f64 {
    0.12 + 0.16 * (0.06 * time).sin() + 0.1 * (0.21 * time).cos()
}

fn heading(time: f64) -> f64 {
    0.4 + 0.12 * time - 0.16 / 0.06 * (0.06 * time).cos() + 0.1 / 0.21 * (0.21 * time).sin()
}

fn velocity(craft: Craft, time: f64) -> Vector3<f64> {
    match craft {
        Craft::Airplane => {
            let [_, pitch, heading] = attitude(craft, time);
            let speed = 18.0 + 1.5 * (0.17 * time).sin();
            let climb = pitch - 0.04;
            Vector3::new(
                speed * heading.cos() + 4.0,
                speed * heading.sin() - 3.0,
                -speed * climb,
            )
        }
        Craft::Copter => Vector3::new(
            4.0 * (0.13 * time).sin() + 1.0,
            3.0 * (0.09 * time + 0.5).cos(),
            -0.8 * (0.2 * time).sin(),
        ),
    }
}

fn turn(craft: Craft, time: f64) -> Rotation3<f64> {
    let [roll, pitch, heading] = attitude(craft, time);
    Rotation3::from_euler_angles(roll, pitch, heading)
}

/// The whole flight.
pub fn moments(craft: Craft) -> Vec<FlownMoment> {
    let step = 1.0 / RATE;
    let small = 1e-4;
    let mut place = Vector3::new(0.0, 0.0, -60.0);
    let mut all = Vec::new();
    for index in 0..(SECONDS * RATE) as usize {
        let time = index as f64 * step;
        let [roll, pitch, heading] = attitude(craft, time);
        let v = velocity(craft, time);
        let change =
            (velocity(craft, time + small) - velocity(craft, time - small)) / (2.0 * small);
        let here = turn(craft, time);
        let apart = turn(craft, time - small).inverse() * turn(craft, time + small);
        all.push(FlownMoment {
            time,
            north: place.x,
            east: place.y,
            height: -place.z,
            velocity: v,
            roll,
            pitch,
            heading,
            rates: apart.scaled_axis() / (2.0 * small),
            acceleration: here.inverse() * (change - Vector3::new(0.0, 0.0, GRAVITY)),
            airspeed: (v - Vector3::new(4.0, -3.0, 0.0)).norm(),
            wind: [4.0, -3.0],
        });
        place += velocity(craft, time + 0.5 * step) * step;
    }
    all
}
