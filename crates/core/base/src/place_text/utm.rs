//! UTM coordinates: a zone with its band or its half, easting, northing.

use super::PlaceTextError;
use super::degrees::GREATEST_ANGLE;
use crate::frames::{Geodetic, ReferenceSystem};

/// Letters of the latitude bands from 80° south, 8° each.
const BANDS: &str = "CDEFGHJKLMNPQRSTUVWX";

/// Latitudes between which zones are used, degrees, and a little more for what is rounded.
const LATITUDES: [f64; 2] = [-80.001, 84.001];

/// Southern and northern edge of a latitude band, degrees.
pub(super) fn band(letter: char) -> Result<[f64; 2], PlaceTextError> {
    if "ABYZ".contains(letter) {
        return Err(PlaceTextError::Polar);
    }
    let index = BANDS.find(letter).ok_or(PlaceTextError::Band { letter })?;
    let from = 8.0 * index as f64 - 80.0;
    // The last one is higher, to hold Spitsbergen.
    Ok([from, if letter == 'X' { 84.0 } else { from + 8.0 }])
}

/// Refuses a place that lies more than `margin` degrees outside of a band.
pub(super) fn within(
    place: Geodetic,
    letter: char,
    margin: f64,
) -> Result<Geodetic, PlaceTextError> {
    let [from, to] = band(letter)?;
    let latitude = place.latitude.to_degrees();
    if latitude >= from - margin && latitude <= to + margin {
        return Ok(place);
    }
    Err(PlaceTextError::OutsideBand {
        latitude,
        band: letter,
        from,
        to,
    })
}

/// The system of a zone, counted from 1.
pub(super) fn system(zone: u8, is_south: bool) -> Result<ReferenceSystem, PlaceTextError> {
    if !(1..=60).contains(&zone) {
        return Err(PlaceTextError::Zone { zone });
    }
    Ok(ReferenceSystem::Utm { zone, is_south })
}

/// The place of a text in capitals, if it has the form `32T 448251 5211932` or `32 NORTH 448251 5211932`; units may stand
/// apart from the numbers, as Google Earth writes them: `32 T 448251.5 M E 5211932.5 M N`.
pub(super) fn read(text: &str) -> Option<Result<Geodetic, PlaceTextError>> {
    let words = text.split([' ', '\t', ',', ';']);
    let words: Vec<_> = words
        .filter(|word| !["", "UTM", "ZONE"].contains(word))
        .collect();
    // The first number is that of the zone, and letters behind it are the zone's; those behind the others are units.
    let is_number = |word: &&str| word.starts_with(|c: char| c.is_ascii_digit());
    let first = 1 + words.iter().skip(1).position(is_number)?;
    let (zone, rest) = words.split_at(first);
    let second = 1 + rest.iter().skip(1).position(is_number)?;
    let [east, north] = [&rest[..second], &rest[second..]].map(|of_one| metres(&of_one.concat()));
    let (east, north) = (east.filter(|east| *east > GREATEST_ANGLE)?, north?);
    let zone = zone.concat();
    let half = zone.trim_start_matches(|c: char| c.is_ascii_digit());
    let number = zone.strip_suffix(half)?.parse().ok()?;
    if !half.bytes().all(|b| b.is_ascii_uppercase()) {
        return None;
    }
    let mut letters = half.chars();
    Some(match (half, letters.next()?, letters.next()) {
        ("N" | "NORTH", ..) => place(number, false, east, north),
        ("SOUTH", ..) => place(number, true, east, north),
        ("S", ..) => southern(number, east, north),
        (_, letter, None) => band(letter)
            .and_then(|_| place(number, letter < 'N', east, north))
            .and_then(|place| within(place, letter, 1e-4)),
        _ => return None,
    })
}

/// The place in the southern half of a zone, unless the letter S may as well mean the band of that name.
fn southern(zone: u8, east: f64, north: f64) -> Result<Geodetic, PlaceTextError> {
    let in_band = place(zone, false, east, north).and_then(|place| within(place, 'S', 0.0));
    match in_band {
        Ok(_) => Err(PlaceTextError::BandOrSouth { zone }),
        Err(_) => place(zone, true, east, north),
    }
}

fn place(zone: u8, is_south: bool, east: f64, north: f64) -> Result<Geodetic, PlaceTextError> {
    let found = system(zone, is_south)?.geodetic(east, north);
    let [least, most] = LATITUDES;
    found
        .filter(|_| (100_000.0..=900_000.0).contains(&east))
        .filter(|place| (least..=most).contains(&place.latitude.to_degrees()))
        .filter(|place| place.latitude == 0.0 || (place.latitude < 0.0) == is_south)
        .ok_or(PlaceTextError::OutsideZone { east, north })
}

/// Metres of a word like `448251`, `448251.5m` or `448251mE`.
fn metres(word: &str) -> Option<f64> {
    let number = word.trim_end_matches(['E', 'N']).trim_end_matches('M');
    let is_number = number.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    number.parse().ok().filter(|_| is_number)
}
