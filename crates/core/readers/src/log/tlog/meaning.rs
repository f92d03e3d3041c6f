//! Messages that say more than their row: heartbeats, versions, parameters, words.

use super::super::{FieldKind, FieldLayout, Log};
use super::parameters::Parameters;
use super::vehicle::Heartbeats;
use super::words::Words;

/// Longest payload, in bytes.
const LONGEST: usize = 255;

/// Who sent a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sender {
    /// Number of the system.
    pub system: u8,
    /// Number of the component.
    pub component: u8,
    /// The instance of the topic in which its messages of this kind are.
    pub instance: u32,
}

/// The payload of a message with its fields.
pub(super) struct Row<'a> {
    fields: &'a [FieldLayout],
    bytes: [u8; LONGEST],
}

impl<'a> Row<'a> {
    /// A payload of which zeros at the end may have been left out.
    pub fn new(fields: &'a [FieldLayout], payload: &[u8]) -> Self {
        let mut bytes = [0; LONGEST];
        let length = payload.len().min(LONGEST);
        bytes[..length].copy_from_slice(&payload[..length]);
        Self { fields, bytes }
    }

    fn field(&self, name: &str) -> Option<(&FieldLayout, &[u8])> {
        let field = self.fields.iter().find(|field| field.name == name)?;
        Some((field, self.bytes.get(field.offset..)?))
    }

    /// A whole number, or zero where there is none of that name.
    pub fn integer(&self, name: &str) -> i128 {
        let field = self.field(name);
        field
            .and_then(|(field, bytes)| field.kind.integer(bytes))
            .unwrap_or(0)
    }

    /// Letters, or none where there are none of that name.
    pub fn text(&self, name: &str) -> String {
        let field = self.field(name);
        field
            .and_then(|(field, bytes)| field.kind.text(bytes))
            .unwrap_or_default()
    }

    /// The bytes of a field of four, or zeros where there is none of that name.
    pub fn four_bytes(&self, name: &str) -> [u8; 4] {
        let field = self
            .field(name)
            .filter(|(field, _)| field.kind == FieldKind::F32);
        field
            .and_then(|(_, bytes)| bytes.first_chunk().copied())
            .unwrap_or_default()
    }
}

/// What messages have told beside their rows.
#[derive(Default)]
pub(super) struct Meaning {
    heartbeats: Heartbeats,
    parameters: Parameters,
    words: Words,
}

impl Meaning {
    /// Takes a message by the number of its kind.
    pub fn take<'a>(
        &mut self,
        number: u32,
        sender: Sender,
        time: f64,
        row: impl Fn() -> Row<'a>,
        log: &mut Log,
    ) {
        match number {
            0 if self.heartbeats.beat(sender, time, &row(), log) => {
                let by_type = self.heartbeats.has_bytes_in_floats();
                let vehicle = (sender.system, sender.component);
                self.parameters.know(vehicle, by_type, log);
            }
            22 => self.parameters.take(sender, time, &row(), log),
            148 => self.heartbeats.version(sender, &row(), log),
            253 => {
                let text = self.words.take(sender, time, &row(), log);
                self.heartbeats.words(sender, &text, log);
            }
            _ => {}
        }
    }

    /// The log is over.
    pub fn end(&mut self, log: &mut Log) {
        self.parameters.end(log);
    }
}
