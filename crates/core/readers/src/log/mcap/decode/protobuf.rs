//! Messages of Protocol Buffers, after the descriptors that stand in their schemas.

use std::collections::HashMap;

use super::descriptor::{Descriptor, FieldDescriptor};
use super::varint::{Fields, WireField as Raw, WireValue};
use crate::log::FieldKind;
use crate::log::growing::{FieldStep, GrowingTable, MOST_ELEMENTS, Path, ValuePlace};

/// Messages within messages within messages…
const DEEPEST: usize = 16;
/// Most fields of all types of a schema together.
const MOST_FIELDS: usize = 1 << 14;

/// Encoding of the number of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Writing {
    /// Seven bits a byte.
    Plain,
    /// The same, with the sign in the lowest bit.
    ZigZag,
    /// As many bytes as it has.
    Fixed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FieldType {
    Number(FieldKind, Writing),
    Text,
    Bytes,
    /// Another type, by its number.
    Message(usize),
}

/// A field of a type.
#[derive(Clone, Debug, PartialEq)]
struct DescribedField {
    name: String,
    number: u32,
    element: FieldType,
    is_list: bool,
    /// Whether a message tells if it has it; those that do not have zero where they are left out.
    has_presence: bool,
}

/// A type of message.
pub(super) struct Protobuf {
    types: Vec<Vec<DescribedField>>,
    root: usize,
}

impl Protobuf {
    /// The message `name` after a `FileDescriptorSet`. The error says in words what is wrong with it.
    pub fn new(name: &str, descriptors: &[u8]) -> Result<Self, String> {
        let mut found = Vec::new();
        for field in Fields::new(descriptors) {
            let file = field.map_err(str::to_owned)?;
            if let (1, WireValue::Bytes(file)) = (file.number, file.value) {
                Descriptor::of_file(file, &mut found)?;
            }
        }
        let numbers: HashMap<&str, usize> = found
            .iter()
            .enumerate()
            .map(|(i, d)| (d.name.as_str(), i))
            .collect();
        let root = numbers.get(name.trim_start_matches('.'));
        let root = *root.ok_or_else(|| format!("{name} is not defined"))?;
        if found.iter().map(|d| d.fields.len()).sum::<usize>() > MOST_FIELDS {
            return Err("its definition is too long".to_owned());
        }
        let types = found.iter().map(|descriptor| {
            let fields = descriptor.fields.iter();
            fields
                .filter_map(|field| DescribedField::new(field, &numbers).transpose())
                .collect()
        });
        let types = types.collect::<Result<_, _>>()?;
        Ok(Self { types, root })
    }

    /// Puts what a message says into the row.
    pub fn decode(
        &self,
        data: &[u8],
        root: &mut ValuePlace,
        table: &mut GrowingTable,
    ) -> Result<(), &'static str> {
        self.message(self.root, data, root, &Path::default(), 0, table)
    }

    fn message(
        &self,
        number: usize,
        data: &[u8],
        place: &mut ValuePlace,
        path: &Path,
        depth: usize,
        table: &mut GrowingTable,
    ) -> Result<(), &'static str> {
        let fields = &self.types[number];
        let Some(places) = table
            .parts(place, fields.len())
            .filter(|_| depth <= DEEPEST)
        else {
            return Ok(());
        };
        for (field, place) in fields.iter().zip(places.iter_mut()) {
            if !field.is_list && !field.has_presence {
                put_zero(field, place, path, table);
            }
        }
        let mut counts = Vec::new();
        if fields.iter().any(|field| field.is_list) {
            counts.resize(fields.len(), 0_usize);
        }
        for raw in Fields::new(data) {
            let raw = raw?;
            let Some(index) = fields.iter().position(|field| field.number == raw.number) else {
                continue;
            };
            let field = &fields[index];
            let path = path.then(FieldStep::Name(&field.name));
            let place = &mut places[index];
            if field.is_list {
                self.list(field, &raw, place, &path, depth, &mut counts[index], table)?;
            } else {
                self.element(field.element, &raw, place, &path, depth, table)?;
            }
        }
        for (index, field) in fields.iter().enumerate().filter(|(_, field)| field.is_list) {
            let path = path.then(FieldStep::Name(&field.name));
            if let Some([length, ..]) = table.parts(&mut places[index], 1) {
                table.length(length, &path, counts[index]);
            }
            if counts[index] > MOST_ELEMENTS {
                table.cut_list(&path, MOST_ELEMENTS);
            }
        }
        Ok(())
    }

    #[allow(
        clippy::too_many_arguments,
        reason = "a place in the message and one in the row"
    )]
    fn list(
        &self,
        field: &DescribedField,
        raw: &Raw,
        place: &mut ValuePlace,
        path: &Path,
        depth: usize,
        count: &mut usize,
        table: &mut GrowingTable,
    ) -> Result<(), &'static str> {
        let mut one = |raw: &Raw, table: &mut GrowingTable| {
            let index = *count;
            *count += 1;
            if index >= MOST_ELEMENTS {
                return Ok(());
            }
            let Some(places) = table.parts(place, 2 + index) else {
                return Ok(());
            };
            let path = path.then(FieldStep::Index(index));
            self.element(
                field.element,
                raw,
                &mut places[1 + index],
                &path,
                depth,
                table,
            )
        };
        match (field.element, &raw.value) {
            // Numbers may stand side by side without their field's number.
            (FieldType::Number(kind, writing), WireValue::Bytes(packed)) => {
                let mut packed = *packed;
                while !packed.is_empty() {
                    let value = match writing {
                        Writing::Fixed => WireValue::fixed(&mut packed, kind.size()),
                        _ => WireValue::varint(&mut packed),
                    };
                    let value = value.ok_or("numbers side by side are cut off")?;
                    let number = raw.number;
                    one(&Raw { number, value }, table)?;
                }
                Ok(())
            }
            _ => one(raw, table),
        }
    }

    fn element(
        &self,
        element: FieldType,
        raw: &Raw,
        place: &mut ValuePlace,
        path: &Path,
        depth: usize,
        table: &mut GrowingTable,
    ) -> Result<(), &'static str> {
        match (element, &raw.value) {
            (FieldType::Number(kind, writing), value) => {
                let bits = match (writing, value) {
                    (Writing::Plain, WireValue::Varint(bits)) => *bits,
                    (Writing::ZigZag, WireValue::Varint(bits)) => {
                        (bits >> 1) ^ (bits & 1).wrapping_neg()
                    }
                    (Writing::Fixed, WireValue::Word(bits)) if kind.size() == 4 => u64::from(*bits),
                    (Writing::Fixed, WireValue::Long(bits)) if kind.size() == 8 => *bits,
                    _ => return Err("a field is written otherwise than its schema says"),
                };
                let bits = if kind == FieldKind::Bool {
                    u64::from(bits != 0)
                } else {
                    bits
                };
                table.number(place, path, kind, &bits.to_le_bytes()[..kind.size()]);
            }
            (FieldType::Text, WireValue::Bytes(letters)) => table.text(place, path, letters),
            (FieldType::Bytes, WireValue::Bytes(bytes)) => {
                if let Some([length]) = table.parts(place, 1) {
                    table.length(length, path, bytes.len());
                }
                if !bytes.is_empty() {
                    table.cut_list(path, 0);
                }
            }
            (FieldType::Message(number), WireValue::Bytes(data)) => {
                self.message(number, data, place, path, depth + 1, table)?;
            }
            _ => return Err("a field is written otherwise than its schema says"),
        }
        Ok(())
    }
}

impl DescribedField {
    /// A field after its descriptor; `None` for a group, which nobody writes any more.
    fn new(
        descriptor: &FieldDescriptor,
        types: &HashMap<&str, usize>,
    ) -> Result<Option<Self>, String> {
        let number = |kind, writing| FieldType::Number(kind, writing);
        let element = match descriptor.kind {
            1 => number(FieldKind::F64, Writing::Fixed),
            2 => number(FieldKind::F32, Writing::Fixed),
            3 => number(FieldKind::I64, Writing::Plain),
            4 => number(FieldKind::U64, Writing::Plain),
            5 | 14 => number(FieldKind::I32, Writing::Plain),
            6 => number(FieldKind::U64, Writing::Fixed),
            7 => number(FieldKind::U32, Writing::Fixed),
            8 => number(FieldKind::Bool, Writing::Plain),
            9 => FieldType::Text,
            10 => return Ok(None),
            11 => {
                let name = &descriptor.type_name;
                let known = types.get(name.as_str());
                FieldType::Message(*known.ok_or_else(|| format!("{name} is not defined"))?)
            }
            12 => FieldType::Bytes,
            13 => number(FieldKind::U32, Writing::Plain),
            15 => number(FieldKind::I32, Writing::Fixed),
            16 => number(FieldKind::I64, Writing::Fixed),
            17 => number(FieldKind::I32, Writing::ZigZag),
            18 => number(FieldKind::I64, Writing::ZigZag),
            kind => return Err(format!("{kind} is the number of no type")),
        };
        Ok(Some(Self {
            name: descriptor.name.clone(),
            number: descriptor.number,
            element,
            is_list: descriptor.is_list,
            has_presence: descriptor.has_presence,
        }))
    }
}

/// Puts what a field has that is left out.
fn put_zero(field: &DescribedField, place: &mut ValuePlace, path: &Path, table: &mut GrowingTable) {
    let path = path.then(FieldStep::Name(&field.name));
    match field.element {
        FieldType::Number(kind, _) => {
            table.number(place, &path, kind, &[0; 8][..kind.size()]);
        }
        FieldType::Bytes => {
            if let Some([length]) = table.parts(place, 1) {
                table.length(length, &path, 0);
            }
        }
        FieldType::Text => table.text(place, &path, b""),
        FieldType::Message(_) => {}
    }
}
