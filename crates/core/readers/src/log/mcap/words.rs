//! Messages that are words of the vehicle or tell its mode.

use crate::log::schema::plain;
use crate::log::{Log, LogMessage, ModeChange, Topic, px4_modes};

/// Meaning of a schema's messages beside their rows.
pub(super) enum SchemaMeaning {
    Nothing,
    /// Words, in a field of that name, with what makes an urgency as syslog counts it of the field `level`.
    Words(&'static str, fn(f64) -> u8),
    /// The name of a mode in the field `mode`, and the last one.
    ModeName(String),
    /// A mode of PX4 by its number, and the last one.
    ModeNumber(Option<u8>),
}

impl SchemaMeaning {
    pub fn of(schema: &str) -> Self {
        match plain(schema).as_str() {
            "rosgraph_msgs/Log" => Self::Words("msg", of_first_ros),
            "rcl_interfaces/Log" => Self::Words("msg", of_second_ros),
            "foxglove/Log" => Self::Words("message", of_foxglove),
            "mavros_msgs/State" => Self::ModeName(String::new()),
            "vehicle_status" => Self::ModeNumber(None),
            _ => Self::Nothing,
        }
    }

    /// Puts into the log what the last row of the topic at that place tells.
    pub fn tell(&mut self, place: usize, log: &mut Log) {
        if matches!(self, Self::Nothing) {
            return;
        }
        let topic = &log.topics[place];
        let Some(time) = topic.times.last().copied() else {
            return;
        };
        match self {
            Self::Nothing => {}
            Self::Words(field, urgency) => {
                if let Some(text) = last_text(topic, field) {
                    log.messages.push(LogMessage {
                        time,
                        source: None,
                        severity: last_number(topic, "level").map(*urgency),
                        text,
                    });
                }
            }
            Self::ModeName(last) => {
                let mode = last_text(topic, "mode").filter(|mode| mode != last);
                if let Some(mode) = mode {
                    last.clone_from(&mode);
                    log.modes.push(ModeChange { time, mode });
                }
            }
            Self::ModeNumber(last) => {
                let state = last_number(topic, "nav_state").map(|state| state as u8);
                if let Some(state) = state.filter(|state| *last != Some(*state)) {
                    *last = Some(state);
                    let name = px4_modes::of_navigation_state(state);
                    let mode = name.map_or_else(|| state.to_string(), str::to_owned);
                    log.modes.push(ModeChange { time, mode });
                }
            }
        }
    }
}

fn last_number(topic: &Topic, name: &str) -> Option<f64> {
    topic.value(topic.field(name)?, topic.len().checked_sub(1)?)
}

fn last_text(topic: &Topic, name: &str) -> Option<String> {
    topic
        .field(name)?
        .text(topic.rows.get(topic.len().checked_sub(1)?)?)
}

/// ROS 1 counts 1 (debug), 2, 4, 8, 16 (fatal).
fn of_first_ros(level: f64) -> u8 {
    match level as u8 {
        0..2 => 7,
        2..4 => 6,
        4..8 => 4,
        8..16 => 3,
        _ => 2,
    }
}

/// ROS 2 counts 10 (debug), 20, 30, 40, 50 (fatal).
fn of_second_ros(level: f64) -> u8 {
    of_foxglove((level / 10.0).floor())
}

/// Foxglove counts 1 (debug) to 5 (fatal).
fn of_foxglove(level: f64) -> u8 {
    match level as u8 {
        0..2 => 7,
        2 => 6,
        3 => 4,
        4 => 3,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_warnings_however_they_are_counted() {
        assert_eq!(
            [of_first_ros(4.0), of_second_ros(30.0), of_foxglove(3.0)],
            [4; 3]
        );
        assert_eq!(
            [of_first_ros(16.0), of_second_ros(50.0), of_foxglove(5.0)],
            [2; 3]
        );
        assert_eq!(
            [of_first_ros(1.0), of_second_ros(10.0), of_foxglove(1.0)],
            [7; 3]
        );
    }
}
