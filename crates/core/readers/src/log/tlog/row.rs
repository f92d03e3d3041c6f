//! A message's payload with its fields, and who sent it.

use super::super::{FieldKind, FieldLayout};

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
pub(super) struct PayloadRow<'a> {
    fields: &'a [FieldLayout],
    bytes: [u8; LONGEST],
}

impl<'a> PayloadRow<'a> {
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
