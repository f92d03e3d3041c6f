//! Coordinates as people type them.

use nalgebra::Point2;
use pilotage_core::angle_text::{degrees_of_text, sexagesimal};
use pilotage_core::frames::{Geodetic, ReferenceSystem};

/// The place in the plane of `system` that a text names: latitude and longitude in degrees (also with
/// letters N, S, E, W, and minutes and seconds), or east and north in metres of that system. The
/// error says what would be read.
pub fn parse(text: &str, system: Option<ReferenceSystem>) -> Result<Typed, String> {
    let advice = "type latitude and longitude like 46.8571, -92.0765, or east and north in metres";
    let numbers = numbers(text).ok_or(advice)?;
    let [a, b] = numbers;
    if a.abs() <= 90.0 && b.abs() <= 180.0 {
        return Ok(Typed::Globe(Geodetic::from_degrees(a, b, 0.0)));
    }
    let system = system.ok_or("type a latitude and longitude first: the zone is not known yet")?;
    match system.geodetic(a, b) {
        Some(_) => Ok(Typed::Plane(Point2::new(a, b))),
        None => Err(format!(
            "{a} east, {b} north lie outside of {}",
            system.name()
        )),
    }
}

/// Coordinates that were typed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Typed {
    /// A place on the globe.
    Globe(Geodetic),
    /// East and north in metres.
    Plane(Point2<f64>),
}

/// The two numbers of a text; degrees, minutes and seconds count as one, and S and W are negative.
fn numbers(text: &str) -> Option<[f64; 2]> {
    let [first, second] = halves(text.trim())?;
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

/// An angle in degrees, or a bare number with its sign.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    degrees_of_text(text).or_else(|| match text.strip_prefix('-') {
        Some(size) => sexagesimal(size).map(|size| -size),
        None => sexagesimal(text.strip_prefix('+').unwrap_or(text)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(text: &str) -> Option<(f64, f64)> {
        match parse(text, None).ok()? {
            Typed::Globe(place) => {
                Some((place.latitude.to_degrees(), place.longitude.to_degrees()))
            }
            Typed::Plane(_) => None,
        }
    }

    #[test]
    fn latitude_and_longitude_are_read_as_people_write_them() {
        for text in [
            "46.5, -92.25",
            "46.5 -92.25",
            "46.5;-92.25",
            "46.5° N, 92.25° W",
            "46°30'N 92°15'W",
            "46° 30' 0\" N, 92° 15' 0\" W",
            "46 30 N 92 15 W",
            "N46.5 W92.25",
            "N 46° 30', W 92° 15'",
            "46°30', -92°15'",
        ] {
            let (latitude, longitude) = degrees(text).unwrap_or((0.0, 0.0));
            assert!(
                (latitude - 46.5).abs() < 1e-12 && (longitude + 92.25).abs() < 1e-12,
                "{text}: {latitude} {longitude}"
            );
        }
    }

    #[test]
    fn metres_need_a_zone_and_must_lie_in_it() {
        let utm = ReferenceSystem::from_epsg(32_615);
        let typed = parse("570400 5189700", utm);
        assert_eq!(typed, Ok(Typed::Plane(Point2::new(570_400.0, 5_189_700.0))));
        assert!(parse("570400 5189700", None).is_err());
        assert!(parse("570400 98765432", utm).is_err());
    }

    #[test]
    fn what_is_no_place_is_refused_with_an_example() {
        for text in ["", "here", "46.5", "46.5, x", "1, 2, 3", "46 30 92 15"] {
            let why = parse(text, None).unwrap_err();
            assert!(why.contains("46.8571"), "{text}: {why}");
        }
    }
}
