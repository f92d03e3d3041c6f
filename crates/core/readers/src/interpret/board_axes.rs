//! Messages of ROS whose axes are forward, right, down and north, east, down, as some drivers have them, in place of those of
//! REP 103: told by gravity.

use crate::log::Topic;

/// Most rows that are asked.
const ROWS: usize = 2000;
/// What an accelerometer reads along the third axis on the average, beyond which that points down, m/s².
const DOWN: f64 = -5.0;

/// Words for people where the rows of an IMU have the third axis downward; `None` of others.
pub(super) fn board_axes(topic: &Topic) -> Option<&'static str> {
    if topic.kind() != "sensor_msgs/Imu" {
        return None;
    }
    let field = topic.field("linear_acceleration.z")?;
    let values = topic
        .rows
        .iter()
        .take(ROWS)
        .filter_map(|row| field.value(row));
    let (sum, count) = values
        .filter(|value| value.is_finite())
        .fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    let is_down = count > 0.0 && sum / count < DOWN;
    is_down.then_some(" (with axes north, east, down, as gravity says)")
}
