//! Values that bear their type and name: facts and parameters.

use super::super::FieldKind;
use super::definition::{DataType, is_name};

/// Longest array of bytes that is spelled out, in bytes.
const SPELLED: usize = 64;

/// A value with its type and name.
pub(super) struct Keyed<'a> {
    /// Name.
    pub name: &'a str,
    data_type: &'a str,
    bytes: &'a [u8],
}

impl<'a> Keyed<'a> {
    /// From one byte of length, `type name`, and the value.
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        let (length, rest) = bytes.split_first()?;
        let (key, bytes) = rest.split_at_checked(usize::from(*length))?;
        let (data_type, name) = str::from_utf8(key).ok()?.split_once(' ')?;
        let keyed = Self {
            name,
            data_type,
            bytes,
        };
        (is_name(name) && keyed.kind().is_some()).then_some(keyed)
    }

    fn kind(&self) -> Option<(DataType<'a>, usize)> {
        DataType::parse(self.data_type)
    }

    /// Whether the value is as long as its type says.
    pub fn is_whole(&self) -> bool {
        let length = |(data_type, count): (DataType<'_>, usize)| match data_type {
            DataType::Plain(kind) => kind.size().checked_mul(count),
            DataType::Nested(_) => None,
        };
        self.kind().and_then(length) == Some(self.bytes.len())
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self.kind()? {
            (DataType::Plain(kind), 1) if kind.size() == self.bytes.len() => {
                kind.number(self.bytes)
            }
            _ => None,
        }
    }

    /// The number of a parameter, which is of one of two types.
    pub fn parameter(&self) -> Option<f64> {
        let is_parameter = matches!(self.data_type, "int32_t" | "float");
        self.number().filter(|_| is_parameter)
    }

    /// The value for people: words, a number, or bytes in hexadecimal digits.
    pub fn text(&self) -> String {
        if let Some((DataType::Plain(FieldKind::Text(_)), _)) = self.kind() {
            let text = String::from_utf8_lossy(self.bytes);
            return text.trim_end_matches('\0').to_owned();
        }
        if let Some((DataType::Plain(kind), 1)) = self.kind() {
            let integer = kind.integer(self.bytes).map(|number| number.to_string());
            let number = || kind.number(self.bytes).map(|number| number.to_string());
            return integer.or_else(number).unwrap_or_default();
        }
        if self.bytes.len() > SPELLED {
            return format!("{} bytes", self.bytes.len());
        }
        let digit = |bits: u8| char::from_digit(u32::from(bits), 16).unwrap_or('0');
        let digits = self
            .bytes
            .iter()
            .flat_map(|b| [digit(b >> 4), digit(b & 15)]);
        digits.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keyed(bytes: &[u8]) -> Keyed<'_> {
        Keyed::parse(bytes).unwrap()
    }

    #[test]
    fn words_and_numbers_are_shown_as_such() {
        let words = keyed(b"\x0echar[6] ver_swv1.2.3");
        assert_eq!((words.name, words.text().as_str()), ("ver_sw", "v1.2.3"));
        assert!(words.is_whole());
        assert!(!keyed(b"\x0echar[6] ver_swv1.2").is_whole());
        let number = keyed(b"\x0cint32_t zone\xf0\xff\xff\xff");
        assert_eq!(number.text(), "-16");
        assert_eq!(keyed(b"\x0cuint8_t[2] a\x0f\xa0").text(), "0fa0");
    }

    #[test]
    fn a_parameter_is_a_float_or_an_integer_of_four_bytes() {
        assert_eq!(keyed(b"\x07float P\0\0\xc0\x3f").parameter(), Some(1.5));
        assert_eq!(keyed(b"\x09int32_t P\x02\0\0\0").parameter(), Some(2.0));
        assert_eq!(keyed(b"\x09int32_t P\x02\0\0").parameter(), None);
        assert_eq!(keyed(b"\x08double P\0\0\0\0\0\0\0\0").parameter(), None);
    }

    #[test]
    fn a_key_without_type_or_name_is_none() {
        for bytes in [
            &b""[..],
            b"\x05float",
            b"\x20float P",
            b"\x06float ",
            b"\x04\xff\xff a",
        ] {
            assert!(Keyed::parse(bytes).is_none());
        }
    }
}
