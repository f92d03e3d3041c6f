//! Messages of IMUs of ROS that are not as REP 103 and REP 145 want them: with axes forward, right, down and north, east, down, or
//! accelerations in multiples of gravity. Gravity tells, turned into the axes of the world where the message has an attitude.

use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector4};

use crate::log::{FieldLayout, Topic};
use crate::role::Role;

/// Most rows that are asked.
const ROWS: usize = 2000;
/// Share of gravity along the third axis of the world, or of the body where there is no attitude, beyond which that points down.
const DOWN: f64 = -0.5;
/// Amounts of the force, on the average, that are one gravity in multiples of it.
const ONE: std::ops::Range<f64> = 0.7..1.5;

/// Share of the forces that is gravity, where they hold it.
const MOSTLY: f64 = 0.8;

/// Difference of the messages of an IMU from those of ROS.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BoardReading {
    /// The third axis points down, and the world's as well.
    pub is_down: bool,
    /// Accelerations are multiples of gravity.
    pub is_in_gravity: bool,
}

impl BoardReading {
    /// That of a topic; none of its kind differ where it is none of an IMU.
    pub fn of(topic: &Topic) -> Self {
        if topic.kind() != "sensor_msgs/Imu" {
            return Self::default();
        }
        let field = |part: &str| topic.field(part);
        let axes = ["x", "y", "z"].map(|axis| field(&format!("linear_acceleration.{axis}")));
        let turn = ["x", "y", "z", "w"].map(|part| field(&format!("orientation.{part}")));
        let (mut sum, mut amount, mut count) = (Vector3::zeros(), 0.0, 0.0);
        // Of rows that tell the attitude, in the axes of its world.
        let (mut world, mut world_amount) = (Vector3::zeros(), 0.0);
        for row in topic.rows.iter().take(ROWS) {
            let value = |field: Option<&FieldLayout>| field?.value(row).filter(|v| v.is_finite());
            let force = Vector3::from(axes.map(|axis| value(axis).unwrap_or(0.0)));
            let turn = Vector4::from(turn.map(|part| value(part).unwrap_or(0.0)));
            if let Some(attitude) = UnitQuaternion::try_new(Quaternion::from(turn), 1e-6) {
                world += attitude * force;
                world_amount += force.norm();
            }
            sum += force;
            amount += force.norm();
            count += 1.0;
        }
        // Without gravity the forces of a flight cancel out.
        let is_one = ONE.contains(&(amount / count)) && sum.norm() > MOSTLY * amount;
        // An IMU that hangs upside down has a world that is up all the same.
        let is_down = if world_amount > 0.0 {
            world.z < DOWN * world_amount
        } else {
            sum.z < DOWN * amount
        };
        Self {
            is_down,
            is_in_gravity: is_one,
        }
    }

    /// Words for people on the values of a role that were read so.
    pub fn told(self, role: Role) -> &'static str {
        let is_force = matches!(
            role,
            Role::AccelerationForward | Role::AccelerationRight | Role::AccelerationDown
        );
        match (self.is_down, self.is_in_gravity && is_force) {
            (true, true) => {
                " (in multiples of gravity, with axes north, east, down, as gravity says)"
            }
            (true, false) => " (with axes north, east, down, as gravity says)",
            (false, true) => " (in multiples of gravity)",
            (false, false) => "",
        }
    }

    /// Factor of the values of a role, of which ROS would have `usual`.
    pub fn factor(self, role: Role, usual: f64) -> f64 {
        let sign = if self.is_down { usual.abs() } else { usual };
        let is_force = matches!(
            role,
            Role::AccelerationForward | Role::AccelerationRight | Role::AccelerationDown
        );
        if self.is_in_gravity && is_force {
            sign * pilotage_base::frames::units::GRAVITY
        } else {
            sign
        }
    }
}
