//! Messages of Protocol Buffers, field by field.

use super::error::RoadFileError;
use pilotage_base::varint::{LONGEST, VarintError, take_varint, unzigzag};

/// Rest of a message; `place` is its first byte's in the file or block.
#[derive(Clone, Copy)]
pub struct ProtobufMessage<'a> {
    bytes: &'a [u8],
    place: usize,
}

/// Value of a field.
pub enum ProtobufValue<'a> {
    Number(u64),
    Bytes(&'a [u8]),
    /// Of a fixed size: nothing that is read here.
    Other,
}

impl<'a> ProtobufValue<'a> {
    /// Its bytes; none where it is a number.
    pub fn bytes(&self) -> &'a [u8] {
        match self {
            Self::Bytes(bytes) => bytes,
            _ => &[],
        }
    }

    /// It as a number; 0 where it is none.
    pub fn number(&self) -> i64 {
        match self {
            Self::Number(number) => number.cast_signed(),
            _ => 0,
        }
    }
}

impl<'a> ProtobufMessage<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, place: 0 }
    }

    fn broken(&self) -> RoadFileError {
        RoadFileError::broken(self.place, "a message ends too early")
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], RoadFileError> {
        let (taken, rest) = self.bytes.split_at_checked(count).ok_or(self.broken())?;
        self.bytes = rest;
        self.place += count;
        Ok(taken)
    }

    fn varint(&mut self) -> Result<u64, RoadFileError> {
        let before = self.bytes.len();
        let number = take_varint(&mut self.bytes, LONGEST);
        self.place += before - self.bytes.len();
        number.map_err(|cause| match cause {
            VarintError::EndsEarly => self.broken(),
            VarintError::TooLong => RoadFileError::broken(self.place, "a number has no end"),
        })
    }

    /// Number of the next field, and its value; `None` at the end.
    pub fn next(&mut self) -> Result<Option<(u64, ProtobufValue<'a>)>, RoadFileError> {
        if self.bytes.is_empty() {
            return Ok(None);
        }
        let key = self.varint()?;
        let value = match key & 7 {
            0 => ProtobufValue::Number(self.varint()?),
            2 => {
                let size = usize::try_from(self.varint()?).map_err(|_| self.broken())?;
                ProtobufValue::Bytes(self.take(size)?)
            }
            1 => self.take(8).map(|_| ProtobufValue::Other)?,
            5 => self.take(4).map(|_| ProtobufValue::Other)?,
            kind => {
                let cause = format!("no field is of kind {kind}");
                return Err(RoadFileError::broken(self.place, cause));
            }
        };
        Ok(Some((key >> 3, value)))
    }
}

/// Numbers of a packed field.
pub fn packed(bytes: &[u8]) -> Result<Vec<u64>, RoadFileError> {
    let mut message = ProtobufMessage::new(bytes);
    let mut numbers = Vec::new();
    while !message.bytes.is_empty() {
        numbers.push(message.varint()?);
    }
    Ok(numbers)
}

/// Numbers of a packed field of which each is the difference from the one before.
pub fn deltas(bytes: &[u8]) -> Result<Vec<i64>, RoadFileError> {
    let mut sum = 0_i64;
    let numbers = packed(bytes)?.into_iter().map(|number| {
        sum = sum.wrapping_add(unzigzag(number));
        sum
    });
    Ok(numbers.collect())
}
