//! Writes `ArduPilot`'s dataflash logs, binary or as text.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use pilotage_core::flight::log::FieldKind;

/// Form of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Messages of bytes.
    Binary,
    /// Lines.
    Text,
}

/// A value as the binary log stores it: hundredths of degrees are a whole number.
#[derive(Clone, Debug, PartialEq)]
pub enum DataflashValue {
    /// A whole number.
    Whole(i128),
    /// A number with a fraction.
    Real(f64),
    /// The bits of a number of half precision.
    Half(u16),
    /// Letters.
    Text(String),
    /// Thirty-two numbers.
    Array([i16; 32]),
}

/// A whole number.
pub fn whole(number: impl Into<i128>) -> DataflashValue {
    DataflashValue::Whole(number.into())
}

/// A number with a fraction.
pub fn real(number: impl Into<f64>) -> DataflashValue {
    DataflashValue::Real(number.into())
}

/// Letters.
pub fn text(text: &str) -> DataflashValue {
    DataflashValue::Text(text.to_owned())
}

/// Numbers of the messages about units.
const UNIT: u8 = 201;
const MULTIPLIER: u8 = 202;
const LABELS: u8 = 203;

/// Writes a log.
#[derive(Clone, Debug)]
pub struct DataflashWriter {
    /// Bytes that were written and not taken.
    pub bytes: Vec<u8>,
    form: Form,
    /// Name and letters of the kinds of message.
    kinds: BTreeMap<u8, (String, String)>,
}

/// Bytes that a letter's field takes.
///
/// # Panics
/// If no field has this letter.
fn size(letter: char) -> usize {
    match letter {
        'b' | 'B' | 'M' => 1,
        'h' | 'H' | 'c' | 'C' | 'g' => 2,
        'i' | 'I' | 'e' | 'E' | 'L' | 'f' | 'n' => 4,
        'q' | 'Q' | 'd' => 8,
        'N' => 16,
        'Z' | 'a' => 64,
        _ => panic!("no field has the letter {letter}"),
    }
}

impl DataflashWriter {
    /// A log that says what its announcements are.
    pub fn new(form: Form) -> Self {
        let kind = ("FMT".to_owned(), "BBnNZ".to_owned());
        let mut writer = Self {
            bytes: Vec::new(),
            form,
            kinds: BTreeMap::from([(0x80, kind)]),
        };
        writer.announce(0x80, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns");
        writer
    }

    /// Announces a kind of message.
    pub fn announce(&mut self, number: u8, name: &str, letters: &str, columns: &str) {
        let length = 3 + letters.chars().map(size).sum::<usize>();
        self.kinds
            .insert(number, (name.to_owned(), letters.to_owned()));
        self.row(
            0x80,
            &[
                whole(number),
                DataflashValue::Whole(length as i128),
                text(name),
                text(letters),
                text(columns),
            ],
        );
    }

    /// Announces the messages about units, and says what the letters of units and multipliers mean.
    pub fn tables(&mut self, time: u64, units: &[(char, &str)], multipliers: &[(char, f64)]) {
        self.announce(UNIT, "UNIT", "QbZ", "TimeUS,Id,Label");
        self.announce(MULTIPLIER, "MULT", "Qbd", "TimeUS,Id,Mult");
        self.announce(LABELS, "FMTU", "QBNN", "TimeUS,FmtType,UnitIds,MultIds");
        for (letter, unit) in units {
            let id = whole(u32::from(*letter));
            self.row(UNIT, &[whole(time), id, text(unit)]);
        }
        for (letter, factor) in multipliers {
            let id = whole(u32::from(*letter));
            self.row(MULTIPLIER, &[whole(time), id, real(*factor)]);
        }
    }

    /// Says what the units and multipliers of a kind of message are.
    pub fn labels(&mut self, time: u64, number: u8, units: &str, multipliers: &str) {
        let values = [whole(time), whole(number), text(units), text(multipliers)];
        self.row(LABELS, &values);
    }

    /// Writes a message.
    ///
    /// # Panics
    /// If its kind was not announced, or its values are not those of its letters.
    pub fn row(&mut self, number: u8, values: &[DataflashValue]) {
        let (name, letters) = &self.kinds[&number];
        assert_eq!(values.len(), letters.len(), "{name}: {letters}");
        match self.form {
            Form::Binary => {
                self.bytes.extend([0xa3, 0x95, number]);
                for (letter, value) in letters.chars().zip(values) {
                    put_bytes(letter, value, &mut self.bytes);
                }
            }
            Form::Text => {
                let mut line = name.clone();
                for (letter, value) in letters.chars().zip(values) {
                    line.push_str(", ");
                    put_text(letter, value, &mut line);
                }
                line.push_str("\r\n");
                self.bytes.extend(line.into_bytes());
            }
        }
    }
}

fn put_bytes(letter: char, value: &DataflashValue, bytes: &mut Vec<u8>) {
    let end = bytes.len() + size(letter);
    match (letter, value) {
        ('f', DataflashValue::Real(number)) => bytes.extend((*number as f32).to_le_bytes()),
        ('d', DataflashValue::Real(number)) => bytes.extend(number.to_le_bytes()),
        ('g', DataflashValue::Half(bits)) => bytes.extend(bits.to_le_bytes()),
        ('a', DataflashValue::Array(numbers)) => {
            bytes.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
        }
        ('n' | 'N' | 'Z', DataflashValue::Text(text)) => {
            bytes.extend(text.bytes().take(size(letter)));
        }
        (_, DataflashValue::Whole(number)) => bytes.extend(&number.to_le_bytes()[..size(letter)]),
        _ => panic!("the letter {letter} is not for {value:?}"),
    }
    bytes.resize(end, 0);
}

fn put_text(letter: char, value: &DataflashValue, line: &mut String) {
    let written = match (letter, value) {
        ('f', DataflashValue::Real(number)) => write!(line, "{}", *number as f32),
        ('d', DataflashValue::Real(number)) => write!(line, "{number}"),
        ('g', DataflashValue::Half(bits)) => {
            let number = FieldKind::F16.number(&bits.to_le_bytes());
            write!(line, "{}", number.unwrap_or(f64::NAN))
        }
        ('a', DataflashValue::Array(numbers)) => {
            let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
            write!(line, "[{}]", numbers.join(" "))
        }
        ('n' | 'N' | 'Z', DataflashValue::Text(text)) => write!(line, "{text}"),
        ('c' | 'C' | 'e' | 'E', DataflashValue::Whole(number)) => decimal(*number, 2, line),
        ('L', DataflashValue::Whole(number)) => decimal(*number, 7, line),
        (_, DataflashValue::Whole(number)) => write!(line, "{number}"),
        _ => panic!("the letter {letter} is not for {value:?}"),
    };
    written.expect("a string takes what it is given");
}

/// Writes a whole number with a point before its last digits.
fn decimal(number: i128, digits: u32, line: &mut String) -> std::fmt::Result {
    let one = 10_u128.pow(digits);
    let (sign, size) = (if number < 0 { "-" } else { "" }, number.unsigned_abs());
    let (before, after) = (size / one, size % one);
    write!(
        line,
        "{sign}{before}.{after:0digits$}",
        digits = digits as usize
    )
}
