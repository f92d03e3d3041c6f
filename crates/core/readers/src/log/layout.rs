//! Layout of a field: its place in a row, and the kind of its bytes.

use serde::{Deserialize, Serialize};

use super::ValueScale;

/// Kind of the bytes of one field. All numbers have their lowest byte first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FieldKind {
    /// Single byte, signed.
    I8,
    /// Single byte.
    U8,
    /// Two bytes, signed.
    I16,
    /// Two bytes.
    U16,
    /// Four bytes, signed.
    I32,
    /// Four bytes.
    U32,
    /// Eight bytes, signed.
    I64,
    /// Eight bytes.
    U64,
    /// IEEE half precision.
    F16,
    /// IEEE single precision.
    F32,
    /// IEEE double precision.
    F64,
    /// Single byte: zero, or true.
    Bool,
    /// Letters up to the first zero byte, at most so many bytes.
    Text(u16),
    /// So many bytes that are no number.
    Bytes(u16),
}

impl FieldKind {
    /// Bytes that it takes in a row.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 | Self::Bool => 1,
            Self::I16 | Self::U16 | Self::F16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
            Self::Text(size) | Self::Bytes(size) => usize::from(size),
        }
    }

    /// Whether it is a number.
    pub fn is_number(self) -> bool {
        !matches!(self, Self::Text(_) | Self::Bytes(_))
    }

    /// The number in `bytes`, or `None` where it is none or `bytes` are too few.
    ///
    /// Integers of 64 bits beyond 2⁵³ lose their last digits; [`FieldKind::integer`] does not.
    #[inline]
    pub fn number(self, bytes: &[u8]) -> Option<f64> {
        Some(match self {
            Self::I8 => f64::from(i8::from_le_bytes(head(bytes)?)),
            Self::U8 => f64::from(u8::from_le_bytes(head(bytes)?)),
            Self::Bool => f64::from(u8::from(u8::from_le_bytes(head(bytes)?) != 0)),
            Self::I16 => f64::from(i16::from_le_bytes(head(bytes)?)),
            Self::U16 => f64::from(u16::from_le_bytes(head(bytes)?)),
            Self::I32 => f64::from(i32::from_le_bytes(head(bytes)?)),
            Self::U32 => f64::from(u32::from_le_bytes(head(bytes)?)),
            Self::I64 => i64::from_le_bytes(head(bytes)?) as f64,
            Self::U64 => u64::from_le_bytes(head(bytes)?) as f64,
            Self::F16 => half(u16::from_le_bytes(head(bytes)?)),
            Self::F32 => f64::from(f32::from_le_bytes(head(bytes)?)),
            Self::F64 => f64::from_le_bytes(head(bytes)?),
            Self::Text(_) | Self::Bytes(_) => return None,
        })
    }

    /// The whole number in `bytes`, or `None` where it is none.
    #[inline]
    pub fn integer(self, bytes: &[u8]) -> Option<i128> {
        Some(match self {
            Self::I8 => i128::from(i8::from_le_bytes(head(bytes)?)),
            Self::U8 => i128::from(u8::from_le_bytes(head(bytes)?)),
            Self::Bool => i128::from(u8::from_le_bytes(head(bytes)?) != 0),
            Self::I16 => i128::from(i16::from_le_bytes(head(bytes)?)),
            Self::U16 => i128::from(u16::from_le_bytes(head(bytes)?)),
            Self::I32 => i128::from(i32::from_le_bytes(head(bytes)?)),
            Self::U32 => i128::from(u32::from_le_bytes(head(bytes)?)),
            Self::I64 => i128::from(i64::from_le_bytes(head(bytes)?)),
            Self::U64 => i128::from(u64::from_le_bytes(head(bytes)?)),
            Self::F16 | Self::F32 | Self::F64 | Self::Text(_) | Self::Bytes(_) => return None,
        })
    }

    /// The letters in `bytes` up to the first zero; what is no UTF-8 is taken for Latin-1, so that no two
    /// texts look alike.
    pub fn text(self, bytes: &[u8]) -> Option<String> {
        let Self::Text(size) = self else {
            return None;
        };
        let bytes = bytes.get(..usize::from(size))?;
        let end = bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len());
        Some(match str::from_utf8(&bytes[..end]) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes[..end].iter().copied().map(char::from).collect(),
        })
    }
}

/// A field of a topic: its name, its unit, and where it lies in a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FieldLayout {
    /// Name as the file has it; elements of arrays as `name[3]`.
    pub name: String,
    /// Unit of the values after [`scale`](Self::scale), as the file says it (`m/s`, `deg`), or empty.
    pub unit: String,
    /// Scale from the stored number to a value.
    pub scale: ValueScale,
    /// Kind of the stored bytes.
    pub kind: FieldKind,
    /// First byte in a row.
    pub offset: usize,
}

impl FieldLayout {
    /// A field without a unit whose stored numbers count as they are.
    pub fn plain(name: impl Into<String>, kind: FieldKind, offset: usize) -> Self {
        Self {
            name: name.into(),
            unit: String::new(),
            scale: ValueScale::One,
            kind,
            offset,
        }
    }

    /// The value in `row`, scaled, or `None` where it is no number.
    #[inline]
    pub fn value(&self, row: &[u8]) -> Option<f64> {
        let number = self.kind.number(row.get(self.offset..)?)?;
        Some(self.scale.apply(number))
    }

    /// The letters in `row`, or `None` where the field has none.
    pub fn text(&self, row: &[u8]) -> Option<String> {
        self.kind.text(row.get(self.offset..)?)
    }

    /// The bytes of the field in `row`.
    pub fn bytes<'a>(&self, row: &'a [u8]) -> Option<&'a [u8]> {
        row.get(self.offset..self.offset + self.kind.size())
    }
}

#[inline]
fn head<const N: usize>(bytes: &[u8]) -> Option<[u8; N]> {
    bytes.get(..N)?.try_into().ok()
}

/// The value of an IEEE 754 half precision number.
fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let exponent = i32::from(bits >> 10 & 0x1f);
    let fraction = f64::from(bits & 0x3ff) / 1024.0;
    sign * match exponent {
        0 => fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_every_kind_are_read_from_their_bytes() {
        let bytes = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff];
        assert_eq!(FieldKind::I8.number(&bytes), Some(-1.0));
        assert_eq!(FieldKind::U16.number(&bytes), Some(65_535.0));
        assert_eq!(FieldKind::U64.integer(&bytes), Some(i128::from(u64::MAX)));
        assert_eq!(FieldKind::Bool.number(&bytes), Some(1.0));
        assert_eq!(FieldKind::F32.number(&1.5_f32.to_le_bytes()), Some(1.5));
        assert_eq!(FieldKind::F64.number(&bytes[..7]), None);
        assert_eq!(FieldKind::Bytes(4).number(&bytes), None);
    }

    #[test]
    fn half_precision_has_its_fractions_and_its_ends() {
        let value = |bits: u16| FieldKind::F16.number(&bits.to_le_bytes());
        assert_eq!(value(0x3c00), Some(1.0));
        assert_eq!(value(0xc000), Some(-2.0));
        assert_eq!(value(0x3555), Some(0.333_251_953_125));
        assert_eq!(value(0x0001), Some(2.0_f64.powi(-24)));
        assert_eq!(value(0x7c00), Some(f64::INFINITY));
        assert!(value(0x7c01).is_some_and(f64::is_nan));
    }

    #[test]
    fn a_value_carries_its_scale_and_a_text_ends_at_its_zero() {
        let field = FieldLayout {
            scale: ValueScale::by(0.01),
            ..FieldLayout::plain("Roll", FieldKind::I16, 1)
        };
        assert_eq!(field.value(&[9, 0x2c, 0x01]), Some(3.0));
        assert_eq!(field.value(&[9, 0x2c]), None);
        let name = FieldLayout::plain("Name", FieldKind::Text(4), 0);
        assert_eq!(name.text(b"AB\0D"), Some("AB".to_owned()));
        assert_eq!(name.text(b"AB"), None);
        assert_eq!(name.text(b"5\xb0C\0"), Some("5°C".to_owned()));
    }
}
