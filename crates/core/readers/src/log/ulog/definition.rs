//! Definitions of rows: `name:type field;type[length] field;…`, nested in one another.

use std::collections::HashMap;

use super::super::px4_units::unit_and_scale;
use super::super::{FieldKind, FieldLayout};

/// Longest name, in bytes.
const LONGEST_NAME: usize = 255;
/// Definitions within definitions within definitions…
const DEEPEST: usize = 8;
/// Most fields of a row, where an array counts as one more. Those of PX4 have some hundred.
const MOST_FIELDS: usize = 4096;
/// Longest row, in bytes: its frame tells its length, with two bytes of number, in sixteen bits.
const LONGEST_ROW: usize = u16::MAX as usize - 2;

/// Type of a field.
pub(super) enum DataType<'a> {
    /// Type with one number or letter per element.
    Plain(FieldKind),
    /// Type that another definition describes.
    Nested(&'a str),
}

impl<'a> DataType<'a> {
    /// The type and how many of it, from `type` or `type[length]`.
    pub fn parse(text: &'a str) -> Option<(Self, usize)> {
        let (name, count) = match text.split_once('[') {
            Some((name, count)) => (name, count.strip_suffix(']')?.parse().ok()?),
            None => (text, 1),
        };
        let data_type = match name {
            "int8_t" => Self::Plain(FieldKind::I8),
            "uint8_t" => Self::Plain(FieldKind::U8),
            "int16_t" => Self::Plain(FieldKind::I16),
            "uint16_t" => Self::Plain(FieldKind::U16),
            "int32_t" => Self::Plain(FieldKind::I32),
            "uint32_t" => Self::Plain(FieldKind::U32),
            "int64_t" => Self::Plain(FieldKind::I64),
            "uint64_t" => Self::Plain(FieldKind::U64),
            "float" => Self::Plain(FieldKind::F32),
            "double" => Self::Plain(FieldKind::F64),
            "bool" => Self::Plain(FieldKind::Bool),
            "char" => Self::Plain(FieldKind::Text(1)),
            _ if is_name(name) => Self::Nested(name),
            _ => return None,
        };
        Some((data_type, count))
    }
}

/// Whether it is made of the letters that names are made of.
pub(super) fn is_name(text: &str) -> bool {
    let is_letter = |b: u8| b.is_ascii_alphanumeric() || b"_-/.".contains(&b);
    !text.is_empty() && text.len() <= LONGEST_NAME && text.bytes().all(is_letter)
}

/// A definition as its message has it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct UlogDefinition {
    name: String,
    /// Type and name of each field.
    fields: Vec<(String, String)>,
}

impl UlogDefinition {
    /// From `name:type field;…`.
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let colon = bytes
            .iter()
            .take(LONGEST_NAME + 1)
            .position(|b| *b == b':')?;
        let name = str::from_utf8(&bytes[..colon]).ok()?;
        let fields = str::from_utf8(&bytes[colon + 1..]).ok()?;
        let field = |text: &str| {
            let (data_type, name) = text.split_once(' ')?;
            let is_good = is_name(name) && DataType::parse(data_type).is_some();
            is_good.then(|| (data_type.to_owned(), name.to_owned()))
        };
        let fields = fields.split(';').filter(|text| !text.is_empty());
        let fields = fields.map(field).collect::<Option<Vec<_>>>()?;
        is_name(name).then(|| Self {
            name: name.to_owned(),
            fields,
        })
    }
}

/// Every definition of a file.
#[derive(Default)]
pub(super) struct Definitions {
    by_name: HashMap<String, UlogDefinition>,
    lengths: HashMap<String, usize>,
}

/// Length of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowLength {
    /// Bytes without the padding at the end, which is not written.
    pub shortest: usize,
    /// Bytes with it.
    pub longest: usize,
}

impl Definitions {
    /// Adds a definition, in place of an earlier one of the same name.
    pub fn add(&mut self, definition: UlogDefinition) {
        if self.by_name.get(&definition.name) != Some(&definition) {
            self.lengths.clear();
            self.by_name.insert(definition.name.clone(), definition);
        }
    }

    /// Whether there is one of that name.
    pub fn has(&self, name: &str) -> bool {
        self.by_name.contains_key(name)
    }

    /// Length of rows of that name; `None` if a definition is missing, contains itself or is longer than a
    /// message can be.
    pub fn row_length(&mut self, name: &str) -> Option<RowLength> {
        let longest = self.length(name, 0)?;
        let fields = &self.by_name.get(name)?.fields;
        let is_padding = |field: &&(String, String)| field.1.starts_with("_padding");
        let padding = fields.iter().rev().take_while(is_padding);
        let padding = padding.map(|(data_type, _)| match DataType::parse(data_type)? {
            (DataType::Plain(kind), count) => kind.size().checked_mul(count),
            (DataType::Nested(_), _) => None,
        });
        Some(RowLength {
            shortest: longest.checked_sub(padding.sum::<Option<usize>>()?)?,
            longest,
        })
    }

    fn length(&mut self, name: &str, depth: usize) -> Option<usize> {
        if let Some(length) = self.lengths.get(name) {
            return Some(*length);
        }
        let fields = self
            .by_name
            .get(name)
            .filter(|_| depth < DEEPEST)?
            .fields
            .clone();
        let mut sum = 0_usize;
        for (data_type, _) in &fields {
            let (data_type, count) = DataType::parse(data_type)?;
            let one = match data_type {
                DataType::Plain(kind) => kind.size(),
                DataType::Nested(name) => self.length(name, depth + 1)?,
            };
            sum = sum.checked_add(one.checked_mul(count)?)?;
        }
        if sum > LONGEST_ROW {
            return None;
        }
        self.lengths.insert(name.to_owned(), sum);
        Some(sum)
    }

    /// The fields of rows of that name, named as pyulog names them (`field[0]`, `nested.field`), but
    /// letters together as one text and padding left out. `None` where there is no
    /// [`row_length`](Self::row_length), or with too many fields or too long names.
    pub fn fields(&mut self, name: &str) -> Option<Vec<FieldLayout>> {
        self.row_length(name)?;
        let mut flat = Flat {
            topic: name,
            fields: Vec::new(),
            offset: 0,
            steps: 0,
        };
        self.flatten(name, "", 0, &mut flat)?;
        Some(flat.fields)
    }

    fn flatten(&self, name: &str, prefix: &str, depth: usize, flat: &mut Flat<'_>) -> Option<()> {
        let fields = &self.by_name.get(name).filter(|_| depth < DEEPEST)?.fields;
        for (data_type, name) in fields {
            flat.step()?;
            let (data_type, count) = DataType::parse(data_type)?;
            let full = format!("{prefix}{name}");
            if full.len() > LONGEST_NAME {
                return None;
            }
            match data_type {
                DataType::Plain(kind) if name.starts_with("_padding") => {
                    flat.offset += kind.size() * count;
                }
                DataType::Plain(FieldKind::Text(_)) if count == 0 => {}
                DataType::Plain(FieldKind::Text(_)) => {
                    flat.push(full, FieldKind::Text(u16::try_from(count).ok()?));
                }
                DataType::Plain(kind) if count == 1 => flat.push(full, kind),
                DataType::Plain(kind) => {
                    for index in 0..count {
                        flat.step()?;
                        flat.push(format!("{full}[{index}]"), kind);
                    }
                }
                DataType::Nested(nested) if count == 1 => {
                    self.flatten(nested, &format!("{full}."), depth + 1, flat)?;
                }
                DataType::Nested(nested) => {
                    for index in 0..count {
                        flat.step()?;
                        let prefix = format!("{full}[{index}].");
                        self.flatten(nested, &prefix, depth + 1, flat)?;
                    }
                }
            }
        }
        Some(())
    }
}

/// Fields one after the other, and how much work they were.
struct Flat<'a> {
    topic: &'a str,
    fields: Vec<FieldLayout>,
    offset: usize,
    steps: usize,
}

impl Flat<'_> {
    fn step(&mut self) -> Option<()> {
        self.steps += 1;
        (self.steps <= MOST_FIELDS).then_some(())
    }

    fn push(&mut self, name: String, kind: FieldKind) {
        let (unit, scale) = unit_and_scale(self.topic, &name, kind);
        self.fields.push(FieldLayout {
            unit: unit.to_owned(),
            scale,
            ..FieldLayout::plain(name, kind, self.offset)
        });
        self.offset += kind.size();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn definitions(texts: &[&str]) -> Definitions {
        let mut all = Definitions::default();
        for text in texts {
            all.add(UlogDefinition::parse(text.as_bytes()).unwrap());
        }
        all
    }

    #[test]
    fn arrays_and_nested_definitions_become_names_of_their_own() {
        let mut all = definitions(&[
            "esc_report:uint32_t esc_errorcount;int16_t rpm;uint8_t[2] _padding0;",
            "esc_status:uint64_t timestamp;esc_report[2] esc;float[2] load;char[5] name;esc_report last;bool ok;uint8_t[3] _padding0;",
        ]);
        let length = all.row_length("esc_status");
        assert_eq!(
            length,
            Some(RowLength {
                shortest: 46,
                longest: 49
            })
        );
        let fields = all.fields("esc_status").unwrap();
        let found: Vec<_> = fields.iter().map(|f| (f.name.as_str(), f.offset)).collect();
        assert_eq!(
            found,
            [
                ("timestamp", 0),
                ("esc[0].esc_errorcount", 8),
                ("esc[0].rpm", 12),
                ("esc[1].esc_errorcount", 16),
                ("esc[1].rpm", 20),
                ("load[0]", 24),
                ("load[1]", 28),
                ("name", 32),
                ("last.esc_errorcount", 37),
                ("last.rpm", 41),
                ("ok", 45),
            ]
        );
        assert_eq!(fields[7].kind, FieldKind::Text(5));
    }

    #[test]
    fn definitions_that_contain_themselves_or_are_endless_are_refused() {
        let mut all = definitions(&[
            "a:b x;",
            "b:a x;",
            "empty:",
            "endless:empty[4000000000] x;",
            "long:uint64_t[18446744073709551615] x;",
            "wide:uint8_t[70000] x;",
            "many:uint8_t[5000] x;",
            "missing:nowhere x;",
        ]);
        for name in ["a", "b", "long", "wide", "missing", "absent"] {
            assert_eq!(all.row_length(name), None, "{name}");
            assert_eq!(all.fields(name), None, "{name}");
        }
        for name in ["endless", "many"] {
            assert!(all.row_length(name).is_some() && all.fields(name).is_none());
        }
        assert_eq!(all.fields("empty"), Some(Vec::new()));
    }

    #[test]
    fn what_is_no_definition_is_told_from_one() {
        for text in [
            &b""[..],
            b"name",
            b":float x;",
            b"name:float;",
            b"name:float[x] y;",
            b"name:float[3 y;",
            b"name:float x\xff;",
            b"na me:float x;",
        ] {
            assert!(UlogDefinition::parse(text).is_none());
        }
        let long = format!("{}:float x;", "n".repeat(300));
        assert!(UlogDefinition::parse(long.as_bytes()).is_none());
    }

    #[test]
    fn a_later_definition_takes_the_place_of_an_earlier_one() {
        let mut all = definitions(&["inner:float x;", "outer:inner i;"]);
        assert_eq!(all.row_length("outer").map(|l| l.longest), Some(4));
        all.add(UlogDefinition::parse(b"inner:double x;").unwrap());
        assert_eq!(all.row_length("outer").map(|l| l.longest), Some(8));
    }
}
