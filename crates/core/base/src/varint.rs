//! Whole numbers of variable length: seven bits a byte, the lowest first, the highest bit set where more follow.

/// Most bytes of a number of 64 bits.
pub const LONGEST: usize = 10;

/// Refusal to take a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VarintError {
    /// The bytes end before it does.
    EndsEarly,
    /// It has more bytes than it may.
    TooLong,
}

/// Appends a number.
///
/// ```
/// use pilotage_base::varint::{LONGEST, put_varint, take_varint};
///
/// let mut bytes = Vec::new();
/// put_varint(&mut bytes, 300);
/// assert_eq!(bytes, [0xac, 0x02]);
/// assert_eq!(take_varint(&mut &bytes[..], LONGEST), Ok(300));
/// ```
pub fn put_varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// Takes a number of at most `most` bytes (up to [`LONGEST`]) off the front of `bytes`; what was looked at of one that
/// is refused is taken off as well.
///
/// # Errors
/// The number has no end.
pub fn take_varint(bytes: &mut &[u8], most: usize) -> Result<u64, VarintError> {
    let mut value = 0;
    for place in 0..most.min(LONGEST) {
        let (byte, rest) = bytes.split_first().ok_or(VarintError::EndsEarly)?;
        *bytes = rest;
        value |= u64::from(byte & 0x7f) << (7 * place);
        if *byte < 0x80 {
            return Ok(value);
        }
    }
    Err(VarintError::TooLong)
}

/// Folds a number that may be negative, so that small ones are short: 0, -1, 1, -2 become 0, 1, 2, 3.
pub fn zigzag(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)).cast_unsigned()
}

/// Unfolds what [`zigzag`] folded.
pub fn unzigzag(value: u64) -> i64 {
    (value >> 1).cast_signed() ^ -(value & 1).cast_signed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_one_after_the_other() {
        let numbers = [0, 1, -1, 63, -64, 64, 70_000, i64::MAX, i64::MIN];
        let mut bytes = Vec::new();
        for number in numbers {
            put_varint(&mut bytes, zigzag(number));
        }
        let mut rest = &bytes[..];
        for number in numbers {
            let taken = take_varint(&mut rest, LONGEST).map(unzigzag);
            assert_eq!(taken, Ok(number));
        }
        assert!(rest.is_empty());
    }

    #[test]
    fn numbers_without_an_end_are_refused_and_passed_over() {
        let mut cut = &[0x96, 0x80][..];
        assert_eq!(take_varint(&mut cut, 9), Err(VarintError::EndsEarly));
        let mut long = &[0xff; 12][..];
        assert_eq!(take_varint(&mut long, 5), Err(VarintError::TooLong));
        assert_eq!((cut.len(), long.len()), (0, 7));
    }
}
