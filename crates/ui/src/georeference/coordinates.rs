//! Coordinates as people type them.

use nalgebra::Point2;
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
    let mut found: Vec<Vec<f64>> = vec![Vec::new()];
    let mut signs = vec![1.0];
    let has_letters = text.chars().any(|c| "NSEWnsew".contains(c));
    let mut word = String::new();
    let flush = |word: &mut String, found: &mut Vec<Vec<f64>>| -> Option<()> {
        if !word.is_empty() {
            let value: f64 = word.parse().ok().filter(|v: &f64| v.is_finite())?;
            found.last_mut()?.push(value);
            word.clear();
        }
        Some(())
    };
    let next = |found: &mut Vec<Vec<f64>>, signs: &mut Vec<f64>| {
        if found.last().is_some_and(|v| !v.is_empty()) {
            found.push(Vec::new());
            signs.push(1.0);
        }
    };
    for c in text.trim().chars() {
        match c {
            '0'..='9' | '.' | '-' | '+' => word.push(c),
            'N' | 'n' | 'E' | 'e' | 'S' | 's' | 'W' | 'w' => {
                flush(&mut word, &mut found)?;
                if "SsWw".contains(c) {
                    *signs.last_mut()? = -1.0;
                }
                // A letter stands behind its number, or before it.
                next(&mut found, &mut signs);
            }
            ',' | ';' => {
                flush(&mut word, &mut found)?;
                next(&mut found, &mut signs);
            }
            _ if c.is_whitespace() => {
                flush(&mut word, &mut found)?;
                if !has_letters && !text.contains(['°', '\'', ',', ';']) {
                    next(&mut found, &mut signs);
                }
            }
            '°' | '\'' | '"' | '′' | '″' => flush(&mut word, &mut found)?,
            _ => return None,
        }
    }
    flush(&mut word, &mut found)?;
    let values: Vec<f64> = found
        .iter()
        .zip(&signs)
        .filter(|(parts, _)| !parts.is_empty() && parts.len() <= 3)
        .map(|(parts, sign)| {
            let negative = parts[0].is_sign_negative();
            let size: f64 = parts
                .iter()
                .enumerate()
                .map(|(i, v)| v.abs() / 60_f64.powi(i as i32))
                .sum();
            if negative { -sign * size } else { sign * size }
        })
        .collect();
    values.try_into().ok()
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
        for text in ["", "here", "46.5", "46.5, x", "1, 2, 3"] {
            let why = parse(text, None).unwrap_err();
            assert!(why.contains("46.8571"), "{text}: {why}");
        }
    }
}
