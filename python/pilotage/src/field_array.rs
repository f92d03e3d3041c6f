//! The values of a field as an array, of the kind in which the file has them.

use numpy::Element;
use pilotage_core::flight::log::{FieldKind, FieldLayout, Topic, ValueScale};
use pyo3::prelude::*;

use crate::arrays::{rows, vector};

/// Values of a field, one for each row.
pub enum FieldArray {
    I8(Vec<i8>),
    U8(Vec<u8>),
    I16(Vec<i16>),
    U16(Vec<u16>),
    I32(Vec<i32>),
    U32(Vec<u32>),
    I64(Vec<i64>),
    U64(Vec<u64>),
    F32(Vec<f32>),
    F64(Vec<f64>),
    Bool(Vec<bool>),
    Texts(Vec<String>),
    /// Bytes that are no number, so many for each row.
    Bytes(usize, Vec<u8>),
}

/// Name of the kind in which a field's values come: that of `NumPy`, `str` or `bytes`.
pub fn kind_name(field: &FieldLayout) -> &'static str {
    if field.kind.is_number() && field.scale != ValueScale::One {
        return "float64";
    }
    match field.kind {
        FieldKind::I8 => "int8",
        FieldKind::U8 => "uint8",
        FieldKind::I16 => "int16",
        FieldKind::U16 => "uint16",
        FieldKind::I32 => "int32",
        FieldKind::U32 => "uint32",
        FieldKind::I64 => "int64",
        FieldKind::U64 => "uint64",
        FieldKind::F32 => "float32",
        FieldKind::F16 | FieldKind::F64 => "float64",
        FieldKind::Bool => "bool",
        FieldKind::Text(_) => "str",
        FieldKind::Bytes(_) => "bytes",
    }
}

/// An answer for each row of a topic.
fn of_rows<'a, T>(topic: &'a Topic, of: impl Fn(&'a [u8]) -> Option<T>) -> Vec<T> {
    let mut answers = Vec::with_capacity(topic.len());
    // A row that has a field has bytes.
    let width = topic.rows.width().max(1);
    for piece in topic.rows.pieces() {
        answers.extend(piece.chunks_exact(width).filter_map(&of));
    }
    answers
}

/// The stored numbers of a field, none of them changed.
fn stored<const N: usize, T>(
    topic: &Topic,
    field: &FieldLayout,
    of: impl Fn([u8; N]) -> T,
) -> Vec<T> {
    let (from, to) = (field.offset, field.offset + N);
    of_rows(topic, |row| {
        let bytes: [u8; N] = row.get(from..to)?.try_into().ok()?;
        Some(of(bytes))
    })
}

impl FieldArray {
    /// The values of `field` in all rows of `topic`: as they are stored, or as floats where the file scales them.
    pub fn of(topic: &Topic, field: &FieldLayout) -> Self {
        if field.kind.is_number() && field.scale != ValueScale::One {
            return Self::F64(values(topic, field));
        }
        match field.kind {
            FieldKind::I8 => Self::I8(stored(topic, field, i8::from_le_bytes)),
            FieldKind::U8 => Self::U8(stored(topic, field, u8::from_le_bytes)),
            FieldKind::I16 => Self::I16(stored(topic, field, i16::from_le_bytes)),
            FieldKind::U16 => Self::U16(stored(topic, field, u16::from_le_bytes)),
            FieldKind::I32 => Self::I32(stored(topic, field, i32::from_le_bytes)),
            FieldKind::U32 => Self::U32(stored(topic, field, u32::from_le_bytes)),
            FieldKind::I64 => Self::I64(stored(topic, field, i64::from_le_bytes)),
            FieldKind::U64 => Self::U64(stored(topic, field, u64::from_le_bytes)),
            FieldKind::F32 => Self::F32(stored(topic, field, f32::from_le_bytes)),
            FieldKind::F64 => Self::F64(stored(topic, field, f64::from_le_bytes)),
            FieldKind::F16 => Self::F64(values(topic, field)),
            FieldKind::Bool => Self::Bool(stored(topic, field, |[byte]: [u8; 1]| byte != 0)),
            FieldKind::Text(_) => Self::Texts(of_rows(topic, |row| field.text(row))),
            FieldKind::Bytes(_) => {
                let bytes = of_rows(topic, |row| field.bytes(row));
                Self::Bytes(field.kind.size(), bytes.concat())
            }
        }
    }

    /// The array, which takes over the memory of the values; of texts a list.
    pub fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        fn array<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyAny> {
            vector(py, values).into_any()
        }
        Ok(match self {
            Self::I8(values) => array(py, values),
            Self::U8(values) => array(py, values),
            Self::I16(values) => array(py, values),
            Self::U16(values) => array(py, values),
            Self::I32(values) => array(py, values),
            Self::U32(values) => array(py, values),
            Self::I64(values) => array(py, values),
            Self::U64(values) => array(py, values),
            Self::F32(values) => array(py, values),
            Self::F64(values) => array(py, values),
            Self::Bool(values) => array(py, values),
            Self::Texts(texts) => texts.into_pyobject(py)?,
            Self::Bytes(size, bytes) => rows(py, size, bytes)?.into_any(),
        })
    }
}

fn values(topic: &Topic, field: &FieldLayout) -> Vec<f64> {
    of_rows(topic, |row| field.value(row))
}
