//! Plus codes, after "Open Location Code: An Open Source Standard for Addresses", Google, 2014.

use super::PlaceTextError;
use crate::frames::Geodetic;

/// Digits of the codes.
const DIGITS: &str = "23456789CFGHJMPQRVWX";

/// The middle of the square that the first word of a text in capitals names, if it has the form `8FVC9G8F+6X`, or
/// `9G8F+6X`, which means the square of that name that is nearest to `near`.
pub(super) fn read(
    text: &str,
    near: Option<&Geodetic>,
) -> Option<Result<Geodetic, PlaceTextError>> {
    let (before, after) = halves(text)?;
    if !matches!(before.len(), 2 | 4 | 6) {
        return Some(place(before, after));
    }
    let Some(near) = near else {
        return Some(Err(PlaceTextError::ShortCode));
    };
    let missing = 8 - before.len();
    let whole = "2".repeat(missing) + before;
    Some(place(&whole, after).map(|place| nearest(&place, missing, near)))
}

/// The words behind a short code, which name the town near which it lies: empty if there are none, `None` if the text
/// begins with no short code.
///
/// ```
/// use pilotage_base::place_text::town_of_short_code;
///
/// assert_eq!(town_of_short_code("9G8F+6X Zürich"), Some("Zürich"));
/// assert_eq!(town_of_short_code("9G8F+6X"), Some(""));
/// assert_eq!(town_of_short_code("8FVC9G8F+6X Zürich"), None);
/// ```
pub fn town_of_short_code(text: &str) -> Option<&str> {
    let text = text.trim();
    let (before, _) = halves(text)?;
    let town = text.split_once(char::is_whitespace).map_or("", |it| it.1);
    matches!(before.len(), 2 | 4 | 6).then(|| town.trim_start_matches([' ', ',']))
}

/// Parts of the first word of a text before and behind its plus, if it looks like a code.
fn halves(text: &str) -> Option<(&str, &str)> {
    let word = text.split_whitespace().next()?;
    let (before, after) = word.trim_end_matches(',').split_once('+')?;
    let mut all = before.chars().chain(after.chars());
    (before.len() >= 2 && all.all(|c| c.is_ascii_alphanumeric())).then_some((before, after))
}

/// The square of a code without so many of its first digits, `place` in the most south-western of its cells, in the
/// cell where it lies nearest to `near`.
fn nearest(place: &Geodetic, missing: usize, near: &Geodetic) -> Geodetic {
    let cell = 400.0 / 20.0_f64.powi(missing as i32 / 2);
    let moved = |from: f64, to: f64| from + cell * ((to - from) / cell).round();
    let [first, wanted] = [place, near].map(|it| it.latitude.to_degrees());
    let mut latitude = moved(first, wanted);
    if latitude > 90.0 {
        latitude -= cell;
    } else if latitude < -90.0 {
        latitude += cell;
    }
    let longitude = moved(place.longitude.to_degrees(), near.longitude.to_degrees());
    Geodetic::from_degrees(latitude, (longitude + 180.0).rem_euclid(360.0) - 180.0, 0.0)
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
