//! Values written as text, put into the bytes that the binary log would have.

use super::super::{FieldKind, ValueScale};
use super::letters::Letter;

/// Appends the bytes of `text`, a value of that letter. Numbers of letters that imply a scale are written
/// after it.
///
/// # Errors
/// In words, if it is no such value.
pub fn put(text: &str, letter: &Letter, bytes: &mut Vec<u8>) -> Result<(), &'static str> {
    if letter.count == 1 {
        return put_one(text, letter, bytes);
    }
    let inner = text.trim_matches(|c: char| c == '[' || c == ']' || c.is_whitespace());
    let mut values = inner.split_whitespace();
    for _ in 0..letter.count {
        let value = values.next().ok_or("an array is too short")?;
        put_one(value.trim_end_matches(','), letter, bytes)?;
    }
    Ok(())
}

fn put_one(text: &str, letter: &Letter, bytes: &mut Vec<u8>) -> Result<(), &'static str> {
    const NONE: &str = "a value is no number";
    const LARGE: &str = "a number does not fit into its field";
    match letter.kind {
        FieldKind::Text(size) => put_text(text, usize::from(size), bytes),
        FieldKind::Bytes(size) => put_bytes(text.as_bytes(), usize::from(size), bytes),
        FieldKind::F16 => bytes.extend(half(real(text).ok_or(NONE)?).to_le_bytes()),
        FieldKind::F32 => bytes.extend(real_32(text).ok_or(NONE)?.to_le_bytes()),
        FieldKind::F64 => bytes.extend(real(text).ok_or(NONE)?.to_le_bytes()),
        kind => {
            let number = whole(text, letter.scale).ok_or(NONE)?;
            let (low, high) = bounds(kind);
            if number < low || number > high {
                return Err(LARGE);
            }
            bytes.extend(&number.to_le_bytes()[..kind.size()]);
        }
    }
    Ok(())
}

/// Least and greatest number of a kind of whole numbers.
fn bounds(kind: FieldKind) -> (i128, i128) {
    let bits = 8 * kind.size() as u32;
    match kind {
        FieldKind::I8 | FieldKind::I16 | FieldKind::I32 | FieldKind::I64 => {
            (-(1_i128 << (bits - 1)), (1_i128 << (bits - 1)) - 1)
        }
        _ => (0, (1_i128 << bits) - 1),
    }
}

/// The stored number of a written one, nearest where it has more decimals.
fn whole(text: &str, scale: ValueScale) -> Option<i128> {
    if scale == ValueScale::One
        && let Ok(number) = text.parse()
    {
        return Some(number);
    }
    let stored = match scale {
        ValueScale::One => real(text)?,
        ValueScale::Over(divisor) => real(text)? * divisor,
        ValueScale::Times(factor) => real(text)? / factor,
    };
    // Beyond 2⁶⁴ nothing fits anyway.
    (stored.abs() < 2e19).then(|| stored.round() as i128)
}

/// A number as programs write it, with their words for what is none.
fn real(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| strange(text))
}

/// The text with a point, where a computer of another language wrote a decimal comma.
fn with_point(text: &str) -> Option<String> {
    let (before, after) = text.split_once(',')?;
    let is_number = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    let digits = after.split(['e', 'E']).next().unwrap_or_default();
    let is_decimal = is_number(before.trim_start_matches('-')) && is_number(digits);
    is_decimal.then(|| format!("{before}.{after}"))
}

/// As [`real`], rounded once.
fn real_32(text: &str) -> Option<f32> {
    let strange = || strange(text).map(|number| number as f32);
    text.parse().ok().or_else(strange)
}

fn strange(text: &str) -> Option<f64> {
    if let Some(text) = with_point(text) {
        return text.parse().ok();
    }
    let text = text.to_ascii_lowercase();
    let (sign, word) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.as_str()),
    };
    if word == "∞" || word.starts_with("1.#inf") {
        Some(sign * f64::INFINITY)
    } else if word.starts_with("1.#") || word.starts_with("nan") {
        Some(f64::NAN)
    } else {
        None
    }
}

fn put_text(text: &str, size: usize, bytes: &mut Vec<u8>) {
    let end = text.floor_char_boundary(size);
    put_bytes(&text.as_bytes()[..end], size, bytes);
}

fn put_bytes(text: &[u8], size: usize, bytes: &mut Vec<u8>) {
    let end = bytes.len() + size;
    bytes.extend(&text[..text.len().min(size)]);
    bytes.resize(end, 0);
}

/// The bits of the half-precision number nearest to `number`, to the even one of two (IEEE 754).
fn half(number: f64) -> u16 {
    let sign = u16::from(number.is_sign_negative()) << 15;
    let size = number.abs();
    if size.is_nan() {
        return sign | 0x7e00;
    }
    // Half precision steps by 2^(exponent - 10), and by 2^-24 from the smallest exponent down.
    let exponent = if size < 2.0_f64.powi(-14) {
        -14
    } else {
        size.log2().floor() as i32
    };
    let steps = (size / 2.0_f64.powi(exponent - 10)).round_ties_even();
    if exponent > 15 || steps * 2.0_f64.powi(exponent - 10) >= 65_520.0 {
        return sign | 0x7c00;
    }
    // What rounds up to 2048 steps, or to 1024 below the smallest exponent, carries over by itself.
    let bits = i32::max(exponent + 14, 0) * 1024 + steps as i32;
    sign | bits as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes_of(letter: u8, text: &str) -> Result<Vec<u8>, &'static str> {
        let mut bytes = Vec::new();
        put(text, &Letter::of(letter).unwrap(), &mut bytes).map(|()| bytes)
    }

    fn value_of(letter: u8, text: &str) -> Option<f64> {
        let kind = Letter::of(letter).unwrap();
        let bytes = bytes_of(letter, text).ok()?;
        assert_eq!(bytes.len(), kind.size());
        Some(kind.scale.apply(kind.kind.number(&bytes)?))
    }

    #[test]
    fn numbers_come_back_as_they_were_written() {
        assert_eq!(value_of(b'c', "-12.34"), Some(-12.34));
        assert_eq!(value_of(b'C', "655.35"), Some(655.35));
        assert_eq!(value_of(b'L', "-37.9596764"), Some(-37.959_676_4));
        assert_eq!(value_of(b'E', "3"), Some(3.0));
        assert_eq!(value_of(b'B', "12.0"), Some(12.0));
        assert_eq!(
            value_of(b'Q', "18446744073709551615"),
            Some(u64::MAX as f64)
        );
        assert_eq!(value_of(b'f', "0.1"), Some(f64::from(0.1_f32)));
        assert_eq!(value_of(b'd', "1e-300"), Some(1e-300));
        assert!(value_of(b'f', "1.#QNAN").is_some_and(f64::is_nan));
        assert!(value_of(b'f', "-nan(ind)").is_some_and(f64::is_nan));
        assert_eq!(value_of(b'f', "-∞"), Some(f64::NEG_INFINITY));
    }

    #[test]
    fn what_is_no_such_value_is_told() {
        assert_eq!(bytes_of(b'B', "AUTO").unwrap_err(), "a value is no number");
        assert!(bytes_of(b'B', "256").unwrap_err().contains("does not fit"));
        assert!(bytes_of(b'b', "-129").is_err());
        assert_eq!(bytes_of(b'b', "-128"), Ok(vec![0x80]));
        assert!(bytes_of(b'c', "400").is_err());
        assert!(bytes_of(b'Q', "1e30").is_err());
        assert!(bytes_of(b'h', "nan").is_err());
        assert!(bytes_of(b'a', "[1 2 3]").is_err());
    }

    #[test]
    fn arrays_are_numbers_in_brackets() {
        let numbers: Vec<String> = (0..32).map(|i| (i * 100 - 1600).to_string()).collect();
        let bytes = bytes_of(b'a', &format!("[{}]", numbers.join(" "))).unwrap();
        assert_eq!(bytes.len(), 64);
        assert_eq!(bytes[62..], 1500_i16.to_le_bytes());
        assert_eq!(bytes_of(b'a', &numbers.join(", ")), Ok(bytes));
    }

    #[test]
    fn letters_are_filled_with_zeros_or_cut_between_two_of_them() {
        assert_eq!(bytes_of(b'n', "AB"), Ok(b"AB\0\0".to_vec()));
        assert_eq!(bytes_of(b'n', "abcdef"), Ok(b"abcd".to_vec()));
        assert_eq!(bytes_of(b'n', "abc°"), Ok(b"abc\0".to_vec()));
    }

    #[test]
    fn every_half_precision_number_is_found_again() {
        for bits in 0..=u16::MAX {
            let number = FieldKind::F16.number(&bits.to_le_bytes()).unwrap();
            if number.is_nan() {
                assert_eq!(half(number) & 0x7c00, 0x7c00);
            } else {
                assert_eq!(half(number), bits, "{number}");
            }
        }
        assert_eq!(half(65_519.9), 0x7bff);
        assert_eq!(half(65_520.0), 0x7c00);
        assert_eq!(half(1.0 + 2.0_f64.powi(-11)), 0x3c00);
        assert_eq!(half(1.0 + 3.0 * 2.0_f64.powi(-11)), 0x3c02);
        assert_eq!(half(2.0_f64.powi(-25)), 0);
        assert_eq!(half(2.0_f64.powi(-24) * 0.6), 1);
    }
}
