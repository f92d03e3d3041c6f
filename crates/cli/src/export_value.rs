//! A value of a log as it is exported.

use std::collections::BTreeSet;

use pilotage_core::flight::log::{FieldLayout, Topic, ValueScale};

/// A value of a row.
pub enum ExportValue {
    /// Of an integer that nothing scales.
    Whole(i128),
    /// In the unit of its field.
    Real(f64),
    /// Letters, or bytes as hexadecimal digits.
    Text(String),
}

/// The value of a field in its unit; whole numbers that nothing scales keep all their digits, and bytes that are neither
/// number nor letters are written as hexadecimal digits.
pub fn value(field: &FieldLayout, row: &[u8]) -> Option<ExportValue> {
    let bytes = field.bytes(row)?;
    if field.scale == ValueScale::One
        && let Some(whole) = field.kind.integer(bytes)
    {
        return Some(ExportValue::Whole(whole));
    }
    let real = field.value(row).map(ExportValue::Real);
    let text = || field.text(row).map(ExportValue::Text);
    real.or_else(text)
        .or_else(|| Some(ExportValue::Text(hex_digits(bytes))))
}

fn hex_digits(bytes: &[u8]) -> String {
    let digits = bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]);
    let letters = digits.filter_map(|digit| char::from_digit(u32::from(digit), 16));
    letters.collect()
}

/// Names of the columns of a topic behind `time_s`, none of which is that one's or another's: with a number behind those
/// that would be.
pub fn column_names(topic: &Topic) -> Vec<String> {
    let mut taken = BTreeSet::from(["time_s".to_owned()]);
    let distinct = |field: &FieldLayout| {
        let name = &field.name;
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let mut possible = std::iter::once(name.clone()).chain(numbered);
        let free = possible.find(|name| taken.insert(name.clone()));
        free.unwrap_or_else(|| name.clone())
    };
    topic.fields.iter().map(distinct).collect()
}
