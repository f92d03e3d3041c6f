//! Parameters as they are sent: a name, four bytes, and a type.

use std::collections::HashMap;

use super::super::{FieldKind, Log, Parameter};
use super::row::{PayloadRow, Sender};

/// A parameter whose four bytes are not understood before the vehicle is known.
struct Sent {
    sender: (u8, u8),
    name: String,
    bytes: [u8; 4],
    /// `MAV_PARAM_TYPE`.
    kind: u8,
    time: f64,
}

/// The parameters of the vehicle.
#[derive(Default)]
pub(super) struct Parameters {
    waiting: Vec<Sent>,
    /// The latest value of each.
    latest: HashMap<String, f64>,
    is_known: bool,
    /// Whether the bytes are those of the type rather than of a float.
    by_type: bool,
    vehicle: (u8, u8),
}

impl Parameters {
    /// Takes a value that was sent.
    pub fn take(&mut self, sender: Sender, time: f64, row: &PayloadRow, log: &mut Log) {
        let sent = Sent {
            sender: (sender.system, sender.component),
            name: row.text("param_id"),
            bytes: row.four_bytes("param_value"),
            kind: row.integer("param_type") as u8,
            time,
        };
        if self.is_known {
            self.add(sent, log);
        } else {
            self.waiting.push(sent);
        }
    }

    /// The vehicle is known from here on, and how it sends its parameters.
    pub fn know(&mut self, vehicle: (u8, u8), by_type: bool, log: &mut Log) {
        (self.is_known, self.by_type, self.vehicle) = (true, by_type, vehicle);
        for sent in std::mem::take(&mut self.waiting) {
            self.add(sent, log);
        }
    }

    /// The log is over: without any vehicle, what the first sender sent counts, as floats.
    pub fn end(&mut self, log: &mut Log) {
        if let Some(first) = self.waiting.first() {
            self.know(first.sender, false, log);
        }
    }

    fn add(&mut self, sent: Sent, log: &mut Log) {
        if sent.sender != self.vehicle {
            return;
        }
        let kind = match sent.kind {
            1 if self.by_type => FieldKind::U8,
            2 if self.by_type => FieldKind::I8,
            3 if self.by_type => FieldKind::U16,
            4 if self.by_type => FieldKind::I16,
            5 if self.by_type => FieldKind::U32,
            6 if self.by_type => FieldKind::I32,
            _ => FieldKind::F32,
        };
        let Some(value) = kind.number(&sent.bytes) else {
            return;
        };
        let latest = self.latest.insert(sent.name.clone(), value);
        if latest.map(f64::to_bits) != Some(value.to_bits()) {
            log.parameters.push(Parameter {
                name: sent.name,
                value,
                time: sent.time,
            });
        }
    }
}
