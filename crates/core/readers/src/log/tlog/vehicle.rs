//! Who flew, with what software, and in which mode: heartbeats.

use super::super::ardupilot_modes::Vehicle;
use super::super::release::release;
use super::super::{Log, ModeChange, px4_modes};
use super::row::{PayloadRow, Sender};

/// `MAV_AUTOPILOT`: `ArduPilot`'s, PX4's, and what is no autopilot.
const ARDUPILOT: u8 = 3;
const PX4: u8 = 12;
const NO_AUTOPILOT: u8 = 8;
/// `MAV_TYPE`: an antenna that follows the vehicle, and a ground station.
const ON_GROUND: [u8; 2] = [5, 6];
/// Systems from here on are ground stations by custom, whatever they say of themselves.
const STATIONS: u8 = 250;

/// Vehicle as its heartbeats describe it; of several vehicles the first.
#[derive(Default)]
pub(super) struct Heartbeats {
    /// System and component of the vehicle.
    pub sender: Option<(u8, u8)>,
    autopilot: u8,
    kind: u8,
    mode: Option<u32>,
    release: String,
    is_named: bool,
}

impl Heartbeats {
    /// Takes a heartbeat; returns whether it is the first one of the vehicle.
    pub fn beat(&mut self, sender: Sender, time: f64, row: &PayloadRow, log: &mut Log) -> bool {
        let byte = |name| row.integer(name) as u8;
        let (autopilot, kind) = (byte("autopilot"), byte("type"));
        let is_station = ON_GROUND.contains(&kind) || sender.system >= STATIONS;
        if autopilot == NO_AUTOPILOT || is_station {
            return false;
        }
        log.hear(u32::from(sender.system));
        let own = (sender.system, sender.component);
        let is_first = self.sender.is_none();
        if *self.sender.get_or_insert(own) != own {
            return false;
        }
        if is_first || (self.autopilot, self.kind) != (autopilot, kind) {
            (self.autopilot, self.kind) = (autopilot, kind);
            self.name(log);
        }
        let mode = row.integer("custom_mode") as u32;
        if self.mode != Some(mode) {
            self.mode = Some(mode);
            let name = self.mode_name(mode).map(str::to_owned);
            log.modes.push(ModeChange {
                time,
                mode: name.unwrap_or_else(|| mode.to_string()),
            });
        }
        is_first
    }

    /// Whether parameters come with the bytes of whole numbers in the place of a float.
    pub fn has_bytes_in_floats(&self) -> bool {
        self.autopilot == PX4
    }

    /// Takes the version of the software.
    pub fn version(&mut self, sender: Sender, row: &PayloadRow, log: &mut Log) {
        if self.sender == Some((sender.system, sender.component)) {
            self.release = release(row.integer("flight_sw_version") as u32);
            self.name(log);
        }
    }

    /// Takes words in which the software may name itself, as `ArduPlane V4.5.1 (ab12cd34)`.
    pub fn words(&mut self, sender: Sender, text: &str, log: &mut Log) {
        let is_own = self
            .sender
            .is_none_or(|(system, _)| system == sender.system);
        if is_own && !self.is_named && Vehicle::named(text).is_some() && text.contains(" V") {
            self.is_named = true;
            text.clone_into(&mut log.vehicle);
        }
    }

    fn name(&self, log: &mut Log) {
        if self.is_named {
            return;
        }
        let autopilot = match self.autopilot {
            ARDUPILOT => "ArduPilot".to_owned(),
            PX4 => "PX4".to_owned(),
            number => format!("autopilot {number}"),
        };
        let kind =
            kind_name(self.kind).map_or_else(|| format!("type {}", self.kind), str::to_owned);
        let words = [autopilot.as_str(), self.release.as_str()];
        let words: Vec<_> = words.into_iter().filter(|word| !word.is_empty()).collect();
        log.vehicle = format!("{}, {kind}", words.join(" "));
    }

    fn mode_name(&self, mode: u32) -> Option<&'static str> {
        match self.autopilot {
            ARDUPILOT => vehicle_of(self.kind)?.mode(mode),
            PX4 => px4_modes::of_custom_mode(mode),
            _ => None,
        }
    }
}

/// Name of a `MAV_TYPE`.
fn kind_name(kind: u8) -> Option<&'static str> {
    Some(match kind {
        1 => "aeroplane",
        2 => "quadcopter",
        3 => "coaxial helicopter",
        4 => "helicopter",
        5 => "antenna tracker",
        7 => "airship",
        10 => "ground vehicle",
        11 => "boat",
        12 => "submarine",
        13 => "hexacopter",
        14 => "octocopter",
        15 => "tricopter",
        19..=25 | 47 => "vertical take-off aeroplane",
        29 => "dodecacopter",
        35 => "decacopter",
        _ => return None,
    })
}

/// The vehicle whose modes a `MAV_TYPE` has with `ArduPilot`.
fn vehicle_of(kind: u8) -> Option<Vehicle> {
    Some(match kind {
        1 | 19..=25 => Vehicle::Plane,
        2 | 3 | 4 | 13 | 14 | 15 | 29 | 35 => Vehicle::Copter,
        5 => Vehicle::Tracker,
        7 => Vehicle::Blimp,
        10 | 11 => Vehicle::Rover,
        12 => Vehicle::Sub,
        _ => return None,
    })
}
