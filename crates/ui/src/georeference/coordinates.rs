//! Coordinates as people type them for a picture.

use nalgebra::Point2;
use pilotage_core::frames::{Geodetic, ReferenceSystem};
use pilotage_core::place_text::{place_of_text, two_numbers};

/// The place in the plane of `system` that a text names: any text that names a place on the globe, or east and north
/// in metres of that system. The error says what would be read.
pub fn parse(text: &str, system: Option<ReferenceSystem>) -> Result<Typed, String> {
    let advice = "type latitude and longitude like 46.8571, -92.0765, or east and north in metres";
    if let Ok(place) = place_of_text(text) {
        return Ok(Typed::Globe(place));
    }
    let [a, b] = two_numbers(text).ok_or(advice)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_on_the_globe_need_no_zone() {
        for text in ["47.0588796 8.3185777", "32TMT4825111932"] {
            let Ok(Typed::Globe(place)) = parse(text, None) else {
                panic!("{text} is no place");
            };
            assert!((place.latitude.to_degrees() - 47.058_88).abs() < 1e-6);
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
