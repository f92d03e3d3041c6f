//! Latitude and longitude in degrees.

use super::PlaceTextError;
use crate::angle_text::{AngleText, angle_of_text};
use crate::frames::Geodetic;

/// Greatest number that may be meant as an angle, degrees.
pub(super) const GREATEST_ANGLE: f64 = 360.0;

/// The place that two angles name: latitude first, unless letters say otherwise.
pub(super) fn read(text: &str) -> Result<Geodetic, PlaceTextError> {
    let [a, b] = two_numbers(text).ok_or(PlaceTextError::Unread)?;
    let letter = |half: &str| angle_of_text(half).and_then(|angle| angle.letter);
    let letters = halves(text).map(|halves| halves.map(letter));
    let is_north = |letter| matches!(letter, Some('N' | 'S'));
    let is_east = |letter| matches!(letter, Some('E' | 'W'));
    let [first, second] = letters.unwrap_or_default();
    let (latitude, longitude) = match (is_east(first), is_north(second)) {
        (true, false) if is_east(second) => return Err(PlaceTextError::Hemispheres),
        (false, true) if is_north(first) => return Err(PlaceTextError::Hemispheres),
        (false, false) => (a, b),
        _ => (b, a),
    };
    let found = on_globe(latitude, longitude);
    if found.is_err() && a.abs().max(b.abs()) > GREATEST_ANGLE {
        return of_ten_millionths(latitude, longitude).ok_or(PlaceTextError::Metres);
    }
    found
}

/// The place of a latitude and longitude, degrees.
pub(super) fn on_globe(latitude: f64, longitude: f64) -> Result<Geodetic, PlaceTextError> {
    if latitude.abs() <= 90.0 && longitude.abs() <= 180.0 {
        return Ok(Geodetic::from_degrees(latitude, longitude, 0.0));
    }
    Err(PlaceTextError::Degrees {
        latitude,
        longitude,
    })
}

/// The place of whole numbers of ten-millionths of a degree, as autopilots count them; `None` where they may as well be
/// millionths, or metres.
fn of_ten_millionths(latitude: f64, longitude: f64) -> Option<Geodetic> {
    let are_whole = latitude.fract() == 0.0 && longitude.fract() == 0.0;
    let are_clear = latitude.abs() > 90e6 || longitude.abs() > 180e6;
    let place = on_globe(latitude / 1e7, longitude / 1e7).ok();
    place.filter(|_| are_whole && are_clear)
}

/// The two numbers of a text; degrees, minutes and seconds count as one, and S and W are negative.
pub fn two_numbers(text: &str) -> Option<[f64; 2]> {
    let [first, second] = halves(text.trim())?;
    let number = |half| angle_of_text(half).as_ref().map(AngleText::signed);
    Some([number(first)?, number(second)?])
}

/// The parts of a text at its comma or semicolon, or beside the letters N, S, E, W, or at its only blank.
fn halves(text: &str) -> Option<[&str; 2]> {
    let is_part = |part: &&str| !part.trim().is_empty();
    if text.contains([',', ';']) {
        let parts: Vec<_> = text.split([',', ';']).filter(is_part).collect();
        return parts.try_into().ok();
    }
    let letters: Vec<_> = text
        .char_indices()
        .filter(|(_, c)| "NSEWnsew".contains(*c))
        .map(|(place, _)| place)
        .collect();
    match letters[..] {
        // A letter stands before its number, or behind it.
        [0, second] => Some(text.split_at(second).into()),
        [first, _] => Some(text.split_at(first + 1).into()),
        [] => {
            let parts: Vec<_> = text.split_whitespace().collect();
            parts.try_into().ok()
        }
        _ => None,
    }
}
