//! The letters that say what the fields of a message are.

use super::super::{FieldKind, ValueScale};

/// Elements of the only letter that is an array.
const ARRAY: usize = 32;

/// Type of a field by its letter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Letter {
    /// Kind of an element.
    pub kind: FieldKind,
    /// The scale that the letter implies; then a multiplier of the log says nothing new.
    pub scale: ValueScale,
    /// Number of elements.
    pub count: usize,
}

impl Letter {
    /// The meaning of a letter (`AP_Logger`'s `LogStructure.h`), or `None` if it has none.
    pub fn of(letter: u8) -> Option<Self> {
        use FieldKind::{F16, F32, F64, I8, I16, I32, I64, Text, U8, U16, U32, U64};
        let (kind, factor) = match letter {
            b'a' | b'h' => (I16, 1.0),
            b'b' => (I8, 1.0),
            b'B' | b'M' => (U8, 1.0),
            b'c' => (I16, 0.01),
            b'C' => (U16, 0.01),
            b'd' => (F64, 1.0),
            b'e' => (I32, 0.01),
            b'E' => (U32, 0.01),
            b'f' => (F32, 1.0),
            b'g' => (F16, 1.0),
            b'H' => (U16, 1.0),
            b'i' => (I32, 1.0),
            b'I' => (U32, 1.0),
            b'L' => (I32, 1e-7),
            b'n' => (Text(4), 1.0),
            b'N' => (Text(16), 1.0),
            b'q' => (I64, 1.0),
            b'Q' => (U64, 1.0),
            b'Z' => (Text(64), 1.0),
            _ => return None,
        };
        Some(Self {
            kind,
            scale: ValueScale::by(factor),
            count: if letter == b'a' { ARRAY } else { 1 },
        })
    }

    /// Bytes that it takes in a message.
    pub fn size(self) -> usize {
        self.kind.size() * self.count
    }
}
