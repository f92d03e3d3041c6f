//! The messages of a `ULog` file, each in a frame that tells its length and kind.

use super::{definition::UlogDefinition, value::Keyed};

/// Bytes of a frame before its message: two of length, one of kind.
pub(super) const FRAME: usize = 3;
/// Longest message of an unknown kind that may follow, in bytes; pyulog draws the line there, too.
const LONGEST_UNKNOWN: usize = 10_000;
/// Bytes of a sync message.
const SYNC: [u8; 8] = [0x2f, 0x73, 0x13, 0x20, 0x25, 0x0c, 0xbb, 0x12];

/// A message as it stands in the file.
pub(super) enum UlogMessage<'a> {
    /// Deviations of the file from the plain format, and the places at which data were appended.
    Flags { unknown: bool, appended: [u64; 3] },
    /// Definition of a kind of row or of a part of one.
    Definition(UlogDefinition),
    /// Something that the log says of itself.
    Fact(Keyed<'a>),
    /// A parameter's value.
    Parameter(Keyed<'a>),
    /// A parameter's default value and for what it holds.
    Default { kinds: u8, value: Keyed<'a> },
    /// Rows with this number are of this kind from now on.
    Subscribe {
        number: u16,
        instance: u8,
        name: &'a str,
    },
    /// No more rows with a number.
    Unsubscribe,
    /// A row.
    Row { number: u16, row: &'a [u8] },
    /// Words.
    Words {
        severity: u8,
        tag: Option<u16>,
        microseconds: u64,
        text: &'a [u8],
    },
    /// A mark by which readers find their way back.
    Sync,
    /// Rows were lost for so many milliseconds.
    Dropout(u16),
    /// A kind of later versions.
    Unknown,
}

/// Length of the message and its kind, from the first bytes of its frame.
pub(super) fn frame(bytes: &[u8]) -> Option<(usize, u8)> {
    let length = u16::from_le_bytes(bytes.get(..2)?.try_into().ok()?);
    Some((usize::from(length), *bytes.get(2)?))
}

/// The message of that kind, or why it makes no sense.
pub(super) fn parse(kind: u8, bytes: &[u8]) -> Result<UlogMessage<'_>, &'static str> {
    let message = match kind {
        b'B' => flags(bytes),
        b'F' => UlogDefinition::parse(bytes).map(UlogMessage::Definition),
        b'I' => Keyed::parse(bytes).map(UlogMessage::Fact),
        b'M' => Keyed::parse(bytes.get(1..).unwrap_or_default()).map(UlogMessage::Fact),
        b'P' => Keyed::parse(bytes).map(UlogMessage::Parameter),
        b'Q' => default(bytes),
        b'A' => subscribe(bytes),
        b'R' => (bytes.len() == 2).then_some(UlogMessage::Unsubscribe),
        b'D' => take(bytes).map(|(number, row)| UlogMessage::Row {
            number: u16::from_le_bytes(number),
            row,
        }),
        b'L' => words(bytes, false),
        b'C' => words(bytes, true),
        b'S' => (bytes == SYNC).then_some(UlogMessage::Sync),
        b'O' => (bytes.len() == 2)
            .then(|| UlogMessage::Dropout(u16::from_le_bytes([bytes[0], bytes[1]]))),
        _ if kind.is_ascii_alphabetic() && !bytes.is_empty() => Some(UlogMessage::Unknown),
        _ => return Err("no kind of message"),
    };
    message.ok_or(match kind {
        b'F' => "a definition that makes no sense",
        b'I' | b'M' => "a fact that makes no sense",
        b'P' | b'Q' => "a parameter that makes no sense",
        b'A' => "an announcement of rows that makes no sense",
        b'L' | b'C' => "words that make no sense",
        _ => "a message that makes no sense",
    })
}

/// Whether a message may well begin with these bytes, of which there are at least [`FRAME`].
pub(super) fn may_begin(bytes: &[u8]) -> bool {
    let Some((length, kind)) = frame(bytes) else {
        return false;
    };
    match kind {
        b'S' => length == 8,
        b'O' | b'R' => length == 2,
        b'D' => length >= 2,
        b'A' | b'F' | b'I' => length >= 4,
        b'P' | b'M' | b'Q' => length >= 5,
        b'L' => length >= 9,
        b'C' => length >= 11,
        _ => kind.is_ascii_alphabetic() && (1..=LONGEST_UNKNOWN).contains(&length),
    }
}

fn take<const N: usize>(bytes: &[u8]) -> Option<([u8; N], &[u8])> {
    let (head, rest) = bytes.split_at_checked(N)?;
    Some((head.try_into().ok()?, rest))
}

fn flags(bytes: &[u8]) -> Option<UlogMessage<'_>> {
    let (_compatible, rest) = take::<8>(bytes)?;
    let (incompatible, rest) = take::<8>(rest)?;
    let has_appended = incompatible[0] & 1 == 1;
    let mut appended = [0; 3];
    let mut rest = rest;
    for offset in &mut appended {
        let (number, after) = take(rest)?;
        *offset = if has_appended {
            u64::from_le_bytes(number)
        } else {
            0
        };
        rest = after;
    }
    let unknown = incompatible[0] & !1 != 0 || incompatible[1..].iter().any(|flags| *flags != 0);
    Some(UlogMessage::Flags { unknown, appended })
}

fn default(bytes: &[u8]) -> Option<UlogMessage<'_>> {
    let ([kinds], rest) = take(bytes)?;
    let value = Keyed::parse(rest)?;
    Some(UlogMessage::Default { kinds, value })
}

fn subscribe(bytes: &[u8]) -> Option<UlogMessage<'_>> {
    let ([instance, low, high], name) = take(bytes)?;
    let name = str::from_utf8(name).ok().filter(|name| !name.is_empty())?;
    Some(UlogMessage::Subscribe {
        number: u16::from_le_bytes([low, high]),
        instance,
        name,
    })
}

fn words(bytes: &[u8], tagged: bool) -> Option<UlogMessage<'_>> {
    let ([level], rest) = take(bytes)?;
    let (tag, rest) = if tagged {
        let (tag, rest) = take(rest)?;
        (Some(u16::from_le_bytes(tag)), rest)
    } else {
        (None, rest)
    };
    let (microseconds, text) = take(rest)?;
    // The level is a digit, as the Linux kernel writes it.
    let severity = level.checked_sub(b'0').filter(|severity| *severity < 8)?;
    Some(UlogMessage::Words {
        severity,
        tag,
        microseconds: u64::from_le_bytes(microseconds),
        text,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_a_severity_a_time_and_perhaps_a_tag() {
        let message = parse(b'C', b"3\x07\0\x40\x42\x0f\0\0\0\0\0low battery");
        let Ok(UlogMessage::Words {
            severity,
            tag,
            microseconds,
            text,
        }) = message
        else {
            panic!("these are words");
        };
        assert_eq!((severity, tag, microseconds), (3, Some(7), 1_000_000));
        assert_eq!(text, b"low battery");
        assert!(parse(b'L', b"9\0\0\0\0\0\0\0\0no such level").is_err());
        assert!(parse(b'L', b"3\0\0").is_err());
    }

    #[test]
    fn appended_data_count_only_where_the_flag_says_so() {
        let mut bytes = [0_u8; 40];
        bytes[16] = 200;
        let appended = |bytes: &[u8]| match parse(b'B', bytes) {
            Ok(UlogMessage::Flags { appended, unknown }) => (appended, unknown),
            _ => panic!("these are flags"),
        };
        assert_eq!(appended(&bytes), ([0, 0, 0], false));
        bytes[8] = 1;
        assert_eq!(appended(&bytes), ([200, 0, 0], false));
        bytes[15] = 4;
        assert!(appended(&bytes).1);
        assert!(parse(b'B', &bytes[..39]).is_err());
    }

    #[test]
    fn a_later_version_may_have_further_kinds_but_a_zero_is_none() {
        assert!(matches!(parse(b'Z', b"new"), Ok(UlogMessage::Unknown)));
        assert!(parse(0, b"new").is_err());
        assert!(may_begin(&[8, 0, b'Z']) && !may_begin(&[8, 80, b'Z']));
        assert!(may_begin(&[8, 0, b'S']) && !may_begin(&[9, 0, b'S']));
    }
}
