//! Definitions of the messages of `MAVLink`.

use std::collections::HashMap;

use super::super::{FieldKind, FieldLayout};
use super::checksum::Checksum;
use super::units::unit_and_scale;

/// A line for each message, as `tests/oracles/mavlink_dialect.py` says.
const TABLE: &str = include_str!("dialect.txt");
/// Arrays of more bytes than this are data of other protocols, not numbers.
const MOST_NUMBERS: u16 = 64;

/// A kind of message.
#[derive(Debug)]
pub(super) struct MessageDefinition {
    /// Name.
    pub name: &'static str,
    /// Fields in the order of the definition; they lie in another order in the row.
    pub fields: Vec<FieldLayout>,
    /// Seed of the checksum of each message of this kind, counted after the message's bytes: a reader with
    /// another definition comes to another checksum.
    pub seed: u8,
}

/// The kinds of messages.
pub(super) struct Dialect {
    lines: HashMap<u32, &'static str>,
    read: HashMap<u32, MessageDefinition>,
}

impl Default for Dialect {
    fn default() -> Self {
        let number = |line: &'static str| Some((line.split(';').next()?.parse().ok()?, line));
        Self {
            lines: TABLE.lines().filter_map(number).collect(),
            read: HashMap::new(),
        }
    }
}

impl Dialect {
    /// The kind with that number.
    pub fn get(&mut self, number: u32) -> Option<&MessageDefinition> {
        if !self.read.contains_key(&number) {
            let definition = MessageDefinition::from_line(self.lines.get(&number)?)?;
            self.read.insert(number, definition);
        }
        self.read.get(&number)
    }
}

/// A field as the table has it.
struct DialectField {
    letter: u8,
    /// Length, if it is an array.
    array: Option<u16>,
    name: &'static str,
    unit: &'static str,
    offset: usize,
}

impl DialectField {
    fn parse(text: &'static str) -> Option<Self> {
        let mut words = text.split(' ');
        let (letter, array) = words.next()?.split_at_checked(1)?;
        Some(Self {
            letter: *letter.as_bytes().first()?,
            array: if array.is_empty() {
                None
            } else {
                Some(array.parse().ok()?)
            },
            name: words.next()?,
            unit: words.next().unwrap_or_default(),
            offset: 0,
        })
    }

    fn kind(&self) -> Option<(FieldKind, &'static str)> {
        Some(match self.letter {
            b'c' => (FieldKind::Text(1), "char"),
            b'b' => (FieldKind::I8, "int8_t"),
            b'B' => (FieldKind::U8, "uint8_t"),
            b'h' => (FieldKind::I16, "int16_t"),
            b'H' => (FieldKind::U16, "uint16_t"),
            b'i' => (FieldKind::I32, "int32_t"),
            b'I' => (FieldKind::U32, "uint32_t"),
            b'q' => (FieldKind::I64, "int64_t"),
            b'Q' => (FieldKind::U64, "uint64_t"),
            b'f' => (FieldKind::F32, "float"),
            b'd' => (FieldKind::F64, "double"),
            _ => return None,
        })
    }

    fn layouts(&self, kind: FieldKind) -> Vec<FieldLayout> {
        let (unit, scale) = unit_and_scale(self.unit);
        let layout = |name: String, kind, offset| FieldLayout {
            unit: unit.to_owned(),
            scale,
            ..FieldLayout::plain(name, kind, offset)
        };
        let alone = |kind| vec![layout(self.name.to_owned(), kind, self.offset)];
        match (kind, self.array) {
            (FieldKind::Text(_), length) => alone(FieldKind::Text(length.unwrap_or(1))),
            (FieldKind::U8, Some(length)) if length > MOST_NUMBERS => {
                alone(FieldKind::Bytes(length))
            }
            (_, None) => alone(kind),
            (_, Some(length)) => (0..length)
                .map(|index| {
                    let offset = self.offset + usize::from(index) * kind.size();
                    layout(format!("{}[{index}]", self.name), kind, offset)
                })
                .collect(),
        }
    }
}

impl MessageDefinition {
    fn from_line(line: &'static str) -> Option<Self> {
        let mut parts = line.split(';').skip(1);
        let name = parts.next()?;
        let mut fields = Vec::new();
        let mut first_extension = None;
        for part in parts {
            if part == "+" {
                first_extension = Some(fields.len());
            } else {
                fields.push((DialectField::parse(part)?, FieldKind::U8, ""));
            }
        }
        for (field, kind, word) in &mut fields {
            (*kind, *word) = field.kind()?;
        }
        let basic = first_extension.unwrap_or(fields.len());
        // On the way the largest numbers come first; what came with version 2 stays at the end.
        let mut order: Vec<usize> = (0..fields.len()).collect();
        order[..basic].sort_by_key(|index| std::cmp::Reverse(fields[*index].1.size()));
        let mut checksum = Checksum::default();
        checksum.add(name.as_bytes());
        checksum.add(b" ");
        let mut offset = 0;
        for (place, index) in order.into_iter().enumerate() {
            let (field, kind, word) = &mut fields[index];
            field.offset = offset;
            offset += kind.size() * usize::from(field.array.unwrap_or(1));
            if place < basic {
                checksum.add(word.as_bytes());
                checksum.add(b" ");
                checksum.add(field.name.as_bytes());
                checksum.add(b" ");
                if let Some(length) = field.array {
                    checksum.add(&[length as u8]);
                }
            }
        }
        let [low, high] = checksum.bytes();
        let layouts = fields
            .iter()
            .flat_map(|(field, kind, _)| field.layouts(*kind));
        Some(Self {
            name,
            fields: layouts.collect(),
            seed: low ^ high,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_table_is_a_definition() {
        let mut dialect = Dialect::default();
        assert_eq!(dialect.lines.len(), TABLE.lines().count());
        let numbers: Vec<u32> = dialect.lines.keys().copied().collect();
        for number in numbers {
            let definition = dialect.get(number).unwrap_or_else(|| panic!("{number}"));
            let ends = definition.fields.iter().map(|f| f.offset + f.kind.size());
            assert!(ends.max().unwrap() <= 255, "{}", definition.name);
        }
    }

    #[test]
    fn large_fields_come_first_and_those_of_version_2_last() {
        let mut dialect = Dialect::default();
        let heartbeat = dialect.get(0).unwrap();
        assert_eq!((heartbeat.name, heartbeat.seed), ("HEARTBEAT", 50));
        let offsets: Vec<_> = heartbeat
            .fields
            .iter()
            .map(|f| (f.name.as_str(), f.offset))
            .collect();
        assert_eq!(offsets[0], ("type", 4));
        assert_eq!(offsets[3], ("custom_mode", 0));
        let words = dialect.get(253).unwrap();
        assert_eq!(words.seed, 83);
        let offsets: Vec<_> = words.fields.iter().map(|f| (f.kind, f.offset)).collect();
        assert_eq!(
            offsets,
            [
                (FieldKind::U8, 0),
                (FieldKind::Text(50), 1),
                (FieldKind::U16, 51),
                (FieldKind::U8, 53)
            ]
        );
        assert!(dialect.get(9_999_999).is_none());
    }
}
