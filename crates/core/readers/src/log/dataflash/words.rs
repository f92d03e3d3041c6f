//! Words of the autopilot: its messages, its vehicle, its modes, its parameters.

use super::super::ardupilot_modes::Vehicle;
use super::super::{Log, LogMessage, ModeChange, Parameter};

/// Words of a log beside its numbers, as far as it was read.
#[derive(Clone, Debug, Default)]
pub struct LogTexts {
    vehicle: Option<Vehicle>,
    /// Whether the vehicle was named with a version, as firmware does when it starts.
    is_versioned: bool,
    /// Whether a VER message said what it is.
    is_told: bool,
    /// Modes that were told by number, by their place in the log.
    numbered: Vec<(usize, u32)>,
    /// Number and sequence of the last piece of a message in pieces.
    piece: Option<(f64, f64)>,
}

/// Whether a text has a version in it, such as `V3.8.2`.
fn has_version(text: &str) -> bool {
    let is_v = |b: u8| b == b'V' || b == b'v';
    let bytes = text.as_bytes();
    bytes
        .windows(2)
        .any(|pair| is_v(pair[0]) && pair[1].is_ascii_digit())
}

impl LogTexts {
    /// Takes a message. Longer ones come in pieces of equal number, counted from zero.
    pub fn message(&mut self, time: f64, text: &str, piece: Option<(f64, f64)>, log: &mut Log) {
        let follows = match (self.piece, piece) {
            (Some((last, before)), Some((number, sequence))) => {
                number == last && sequence > 0.0 && sequence == before + 1.0
            }
            _ => false,
        };
        self.piece = piece;
        match log.messages.last_mut() {
            Some(message) if follows => message.text.push_str(text),
            _ => log.messages.push(LogMessage {
                time,
                source: None,
                severity: None,
                text: text.to_owned(),
            }),
        }
        self.talk(text, log);
    }

    /// Looks for the vehicle in what was said. The first text that names one with its version counts, or
    /// else the first that names one at all.
    pub fn talk(&mut self, text: &str, log: &mut Log) {
        let Some(vehicle) = Vehicle::named(text) else {
            return;
        };
        let has_version = has_version(text);
        if self.vehicle.is_none() || (has_version && !self.is_versioned) {
            self.is_versioned = has_version;
            text.trim().clone_into(&mut log.vehicle);
            self.set_vehicle(vehicle, log);
        }
    }

    /// Takes what the first VER message says.
    pub fn version(&mut self, build: Option<f64>, firmware: Option<&str>, log: &mut Log) {
        if std::mem::replace(&mut self.is_told, true) {
            return;
        }
        if let Some(firmware) = firmware.filter(|text| !text.is_empty()) {
            self.is_versioned = true;
            firmware.trim().clone_into(&mut log.vehicle);
        }
        let built = build.and_then(|number| Vehicle::built(number as u8));
        let vehicle = built.or_else(|| firmware.and_then(Vehicle::named));
        if let Some(vehicle) = vehicle {
            self.set_vehicle(vehicle, log);
        }
    }

    /// Names the modes that were numbers so far.
    fn set_vehicle(&mut self, vehicle: Vehicle, log: &mut Log) {
        if self.vehicle == Some(vehicle) {
            return;
        }
        self.vehicle = Some(vehicle);
        for (place, number) in &self.numbered {
            if let Some(change) = log.modes.get_mut(*place) {
                change.mode = mode_name(self.vehicle, *number);
            }
        }
    }

    /// Takes a mode by its number.
    pub fn mode_number(&mut self, time: f64, number: u32, log: &mut Log) {
        if self
            .numbered
            .last()
            .is_some_and(|(place, last)| *last == number && place + 1 == log.modes.len())
        {
            return;
        }
        self.numbered.push((log.modes.len(), number));
        log.modes.push(ModeChange {
            time,
            mode: mode_name(self.vehicle, number),
        });
    }

    /// Takes a mode by its name.
    pub fn mode_name(time: f64, name: &str, log: &mut Log) {
        let mode = name.trim().to_uppercase();
        if log.modes.last().is_none_or(|last| last.mode != mode) {
            log.modes.push(ModeChange { time, mode });
        }
    }

    /// Takes a parameter.
    pub fn parameter(time: f64, name: String, value: f64, log: &mut Log) {
        log.parameters.push(Parameter { name, value, time });
    }
}

fn mode_name(vehicle: Option<Vehicle>, number: u32) -> String {
    let name = vehicle.and_then(|vehicle| vehicle.mode(number));
    name.map_or_else(|| number.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::super::super::LogFormat;
    use super::*;

    fn log() -> Log {
        Log::new("a.bin", LogFormat::Dataflash)
    }

    fn modes(log: &Log) -> Vec<&str> {
        log.modes.iter().map(|m| m.mode.as_str()).collect()
    }

    #[test]
    fn modes_get_their_names_when_the_vehicle_is_known() {
        let (mut words, mut log) = (LogTexts::default(), log());
        for (time, number) in [(1.0, 5), (2.0, 5), (3.0, 10), (4.0, 99)] {
            words.mode_number(time, number, &mut log);
        }
        assert_eq!(modes(&log), ["5", "10", "99"]);
        words.talk("Plane ahead", &mut log);
        assert_eq!(modes(&log), ["FBWA", "AUTO", "99"]);
        words.talk("ArduCopter V4.3 (abc)", &mut log);
        words.talk("ArduPlane V3.8.2", &mut log);
        words.mode_number(5.0, 3, &mut log);
        assert_eq!(modes(&log), ["LOITER", "OF_LOITER", "99", "AUTO"]);
        assert_eq!(log.vehicle, "ArduCopter V4.3 (abc)");
    }

    #[test]
    fn a_version_message_knows_the_vehicle_best() {
        let (mut words, mut log) = (LogTexts::default(), log());
        words.mode_number(1.0, 19, &mut log);
        words.talk("ArduPlane V4.1", &mut log);
        words.version(Some(7.0), Some("Bluefin V4.1.0"), &mut log);
        assert_eq!(modes(&log), ["MANUAL"]);
        assert_eq!(log.vehicle, "Bluefin V4.1.0");
        words.version(Some(3.0), Some("ArduPlane V4"), &mut log);
        assert_eq!(log.vehicle, "Bluefin V4.1.0");
    }

    #[test]
    fn pieces_of_a_message_are_joined_if_they_follow() {
        let (mut words, mut log) = (LogTexts::default(), log());
        words.message(1.0, "one ", Some((7.0, 0.0)), &mut log);
        words.message(1.1, "text", Some((7.0, 1.0)), &mut log);
        words.message(2.0, "lost", Some((7.0, 3.0)), &mut log);
        words.message(3.0, "new", Some((8.0, 0.0)), &mut log);
        words.message(4.0, "plain", None, &mut log);
        words.message(5.0, "plain", None, &mut log);
        let texts: Vec<_> = log.messages.iter().map(|m| m.text.as_str()).collect();
        assert_eq!(texts, ["one text", "lost", "new", "plain", "plain"]);
        assert_eq!(log.messages[0].time, 1.0);
    }

    #[test]
    fn a_mode_that_is_a_name_is_a_change_only_once() {
        let mut log = log();
        for name in ["Auto", "AUTO", "Rtl"] {
            LogTexts::mode_name(1.0, name, &mut log);
        }
        assert_eq!(modes(&log), ["AUTO", "RTL"]);
    }
}
