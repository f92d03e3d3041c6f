//! Changes of speed as commands.

use super::item::{CHANGE_SPEED, MissionItem};

/// Whether a change to `speed` is written as it is written where no file said how.
pub(super) fn is_usual_speed(item: &MissionItem, speed: Option<f64>) -> bool {
    let usual = change_of_speed(speed, item.parameters[0] == Some(1.0));
    let numbers = |item: &MissionItem| item.parameters.map(|p| p.unwrap_or(0.0));
    numbers(item) == numbers(&usual) && (item.frame, item.is_continued) == (2, true)
}

/// A change to `speed` (m/s; the vehicle's usual one if `None`), of the air or over the ground.
pub(super) fn change_of_speed(speed: Option<f64>, is_over_ground: bool) -> MissionItem {
    let zero = Some(0.0);
    // A speed of -2 is the vehicle's usual one, a throttle of -1 leaves the throttle alone.
    let speed = Some(speed.unwrap_or(-2.0));
    let kind = Some(f64::from(u8::from(is_over_ground)));
    MissionItem {
        command: CHANGE_SPEED,
        frame: 2,
        parameters: [kind, speed, Some(-1.0), zero, zero, zero, zero],
        is_continued: true,
    }
}
