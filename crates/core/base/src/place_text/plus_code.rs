//! Plus codes, after "Open Location Code: An Open Source Standard for Addresses", Google, 2014.

use super::PlaceTextError;
use crate::frames::Geodetic;

/// Digits of the codes.
const DIGITS: &str = "23456789CFGHJMPQRVWX";

/// The middle of the square that the first word of a text in capitals names, if it has the form `8FVC9G8F+6X`.
pub(super) fn read(text: &str) -> Option<Result<Geodetic, PlaceTextError>> {
    let word = text.split_whitespace().next()?;
    let (before, after) = word.split_once('+')?;
    let mut all = before.chars().chain(after.chars());
    if before.len() < 2 || !all.all(|c| c.is_ascii_alphanumeric()) {
        return None;
    }
    Some(place(before, after))
}

fn place(before: &str, after: &str) -> Result<Geodetic, PlaceTextError> {
    let pairs = before.trim_end_matches('0');
    let digits: Result<Vec<_>, _> = (pairs.chars().chain(after.chars()))
        .map(|letter| {
            DIGITS
                .find(letter)
                .ok_or(PlaceTextError::CodeLetter { letter })
        })
        .collect();
    let digits = digits?;
    if before.len() < 8 && before.len() == pairs.len() {
        return Err(PlaceTextError::ShortCode);
    }
    let is_whole = pairs.len() == 8 || after.is_empty();
    let is_on_earth = matches!(digits[..], [0..9, 0..18, ..]);
    let is_code = is_whole
        && is_on_earth
        && before.len() == 8
        && pairs.len().is_multiple_of(2)
        && !matches!(after.len(), 1 | 8..);
    if !is_code {
        return Err(PlaceTextError::Code);
    }
    // The south-western corner and the sides of ever smaller squares, degrees.
    let (mut south, mut west, mut high, mut wide) = (-90.0, -180.0, 400.0, 400.0);
    let (pairs, grid) = digits.split_at(digits.len().min(10));
    for pair in pairs.chunks_exact(2) {
        (high, wide) = (high / 20.0, wide / 20.0);
        south += high * pair[0] as f64;
        west += wide * pair[1] as f64;
    }
    for digit in grid {
        (high, wide) = (high / 5.0, wide / 4.0);
        south += high * (digit / 4) as f64;
        west += wide * (digit % 4) as f64;
    }
    let (latitude, longitude) = (south + 0.5 * high, west + 0.5 * wide);
    Ok(Geodetic::from_degrees(latitude, longitude, 0.0))
}
