//! Fields of Protocol Buffers one after another, whatever they mean.

use pilotage_base::varint::{LONGEST, take_varint};

/// Groups within groups within groups…
const DEEPEST: usize = 16;
const CUT: &str = "a field is cut off";

/// Value of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WireValue<'a> {
    Varint(u64),
    Word(u32),
    Long(u64),
    Bytes(&'a [u8]),
}

impl<'a> WireValue<'a> {
    /// A number of seven bits a byte.
    pub fn varint(bytes: &mut &'a [u8]) -> Option<Self> {
        number(bytes).map(Self::Varint)
    }

    /// A number of four or eight bytes.
    pub fn fixed(bytes: &mut &'a [u8], size: usize) -> Option<Self> {
        if size == 4 {
            let (head, rest) = bytes.split_first_chunk()?;
            *bytes = rest;
            Some(Self::Word(u32::from_le_bytes(*head)))
        } else {
            let (head, rest) = bytes.split_first_chunk()?;
            *bytes = rest;
            Some(Self::Long(u64::from_le_bytes(*head)))
        }
    }
}

/// A field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct WireField<'a> {
    pub number: u32,
    pub value: WireValue<'a>,
}

/// The fields of a message; ends after the first that cannot be read.
pub(super) struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    pub fn new(message: &'a [u8]) -> Self {
        Self { rest: message }
    }

    /// The next field; `None` for a group, which nobody writes any more.
    fn field(&mut self) -> Result<Option<WireField<'a>>, &'static str> {
        let key = number(&mut self.rest).ok_or(CUT)?;
        let number = u32::try_from(key >> 3).map_err(|_| "a field of impossible number")?;
        let value = match key & 7 {
            0 => WireValue::varint(&mut self.rest),
            1 => WireValue::fixed(&mut self.rest, 8),
            2 => bytes(&mut self.rest).map(WireValue::Bytes),
            5 => WireValue::fixed(&mut self.rest, 4),
            3 => {
                return skip_group(&mut self.rest, 0).map(|()| None).ok_or(CUT);
            }
            _ => return Err("a field of impossible form"),
        };
        let value = value.ok_or(CUT)?;
        Ok(Some(WireField { number, value }))
    }
}

impl<'a> Iterator for Fields<'a> {
    type Item = Result<WireField<'a>, &'static str>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.rest.is_empty() {
            let field = self.field();
            if field.is_err() {
                self.rest = &[];
            }
            if let Some(field) = field.transpose() {
                return Some(field);
            }
        }
        None
    }
}

fn number(bytes: &mut &[u8]) -> Option<u64> {
    take_varint(bytes, LONGEST).ok()
}

fn bytes<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    let length = usize::try_from(number(rest)?).ok()?;
    let (bytes, after) = rest.split_at_checked(length)?;
    *rest = after;
    Some(bytes)
}

fn skip_group(rest: &mut &[u8], depth: usize) -> Option<()> {
    loop {
        match number(rest)? & 7 {
            0 => number(rest).map(|_| ())?,
            1 => WireValue::fixed(rest, 8).map(|_| ())?,
            2 => bytes(rest).map(|_| ())?,
            3 if depth < DEEPEST => skip_group(rest, depth + 1)?,
            4 => return Some(()),
            5 => WireValue::fixed(rest, 4).map(|_| ())?,
            _ => return None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_of_every_form_are_read_and_groups_passed_over() {
        let message = [
            0x08, 0x96, 0x01, // 1: 150
            0x13, 0x08, 0x01, 0x1a, 0x01, 0x00, 0x14, // 2: a group
            0x1a, 0x02, b'h', b'i', // 3
            0x25, 1, 0, 0, 0, // 4
            0x29, 2, 0, 0, 0, 0, 0, 0, 0, // 5
        ];
        let fields = Fields::new(&message).collect::<Result<Vec<_>, _>>();
        let expected = [
            (1, WireValue::Varint(150)),
            (3, WireValue::Bytes(b"hi")),
            (4, WireValue::Word(1)),
            (5, WireValue::Long(2)),
        ];
        let expected = expected.map(|(number, value)| WireField { number, value });
        assert_eq!(fields, Ok(expected.to_vec()));
    }

    #[test]
    fn what_is_cut_off_ends_the_message() {
        for message in [
            &[0x08, 0x96][..],
            &[0x1a, 9, 0],
            &[0x0b, 0x08],
            &[0x0c],
            &[0xff; 12],
        ] {
            let fields: Vec<_> = Fields::new(message).collect();
            assert!(fields.len() == 1 && fields[0].is_err(), "{message:?}");
        }
    }
}
