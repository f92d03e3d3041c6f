//! Descriptors of Protocol Buffers: what `descriptor.proto` says of messages and their fields.

use super::varint::{Fields, WireField, WireValue};

/// Types within types within types…
const DEEPEST: usize = 16;

/// A type of message.
pub(super) struct Descriptor {
    /// Name with its package.
    pub name: String,
    pub fields: Vec<FieldDescriptor>,
}

/// A field of it.
#[derive(Default)]
pub(super) struct FieldDescriptor {
    pub name: String,
    pub number: u32,
    pub is_list: bool,
    /// Number of its type after `FieldDescriptorProto.Type`.
    pub kind: u64,
    /// Name of its type, where that is a message.
    pub type_name: String,
    pub has_presence: bool,
}

fn text(value: WireValue) -> String {
    match value {
        WireValue::Bytes(bytes) => String::from_utf8_lossy(bytes).into_owned(),
        _ => String::new(),
    }
}

fn fields(bytes: &[u8]) -> Result<Vec<WireField<'_>>, String> {
    let fields: Result<Vec<_>, _> = Fields::new(bytes).collect();
    fields.map_err(|cause| format!("its descriptor cannot be read: {cause}"))
}

impl Descriptor {
    /// Adds all types of a `FileDescriptorProto`.
    pub fn of_file(file: &[u8], found: &mut Vec<Self>) -> Result<(), String> {
        let fields = fields(file)?;
        let last = |number| {
            fields
                .iter()
                .rev()
                .find(|f| f.number == number)
                .map(|f| text(f.value))
        };
        let package = last(2).unwrap_or_default();
        // Later than the third edition every field has presence, unless it says otherwise.
        let is_third = last(12).is_some_and(|syntax| syntax == "proto3");
        for field in &fields {
            if let (4, WireValue::Bytes(message)) = (field.number, field.value) {
                Self::of_message(message, &package, is_third, 0, found)?;
            }
        }
        Ok(())
    }

    fn of_message(
        message: &[u8],
        scope: &str,
        is_third: bool,
        depth: usize,
        found: &mut Vec<Self>,
    ) -> Result<(), String> {
        if depth > DEEPEST {
            return Err("its definition is too deep".to_owned());
        }
        let fields = fields(message)?;
        let name = fields.iter().find(|field| field.number == 1);
        let name = name.map(|field| text(field.value)).unwrap_or_default();
        let name = if scope.is_empty() {
            name
        } else {
            format!("{scope}.{name}")
        };
        let mut members = Vec::new();
        for field in &fields {
            match (field.number, field.value) {
                (2, WireValue::Bytes(field)) => {
                    members.push(FieldDescriptor::parse(field, is_third)?);
                }
                (3, WireValue::Bytes(nested)) => {
                    Self::of_message(nested, &name, is_third, depth + 1, found)?;
                }
                _ => {}
            }
        }
        found.push(Self {
            name,
            fields: members,
        });
        Ok(())
    }
}

impl FieldDescriptor {
    fn parse(bytes: &[u8], is_third: bool) -> Result<Self, String> {
        let mut parsed = Self {
            has_presence: !is_third,
            ..Self::default()
        };
        for field in fields(bytes)? {
            match (field.number, field.value) {
                (1, name) => parsed.name = text(name),
                (3, WireValue::Varint(number)) => parsed.number = number as u32,
                (4, WireValue::Varint(label)) => parsed.is_list = label == 3,
                (5, WireValue::Varint(kind)) => parsed.kind = kind,
                (6, name) => text(name)
                    .trim_start_matches('.')
                    .clone_into(&mut parsed.type_name),
                // One of several, of which others may be there; or optional by its own word.
                (9 | 17, _) => parsed.has_presence = true,
                _ => {}
            }
        }
        Ok(parsed)
    }
}
