//! Places in one cell of a table: two numbers, whose order letters, the column's name or the numbers tell.

use pilotage_base::angle_text::angle_of_text;
use pilotage_base::place_text::{is_map_address, place_of_text, two_numbers};

use crate::mission::found::{LonLat, on_globe};

/// The order of both numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlaceOrder {
    /// Latitude first, as people write places.
    LatitudeFirst,
    /// Longitude first, as programs do.
    LongitudeFirst,
}

/// A cell without what stands around its numbers, and without a height behind them; commas of decimals as points.
fn plain(cell: &str) -> String {
    let cell = cell.trim();
    if is_map_address(cell) {
        return cell.to_owned();
    }
    // As Google's and Leaflet's libraries print places.
    let lower = cell.to_lowercase();
    let printed = ["lat/lng:", "latlng"]
        .iter()
        .find(|word| lower.starts_with(**word));
    let cell = cell[printed.map_or(0, |word| word.len())..].trim();
    let cell = cell.trim_matches(['(', ')', '[', ']', '{', '}', ' ', '"']);
    // `47.5/8.5`.
    if let (1, [a, b]) = (
        cell.matches('/').count(),
        &cell.split('/').collect::<Vec<_>>()[..],
    ) {
        return format!(
            "{}, {}",
            a.trim().replace(',', "."),
            b.trim().replace(',', ".")
        );
    }
    let commas = cell.matches(',').count();
    let is_between_digits = |at: usize| {
        let is_digit = |at: Option<usize>| {
            at.and_then(|at| cell.as_bytes().get(at))
                .is_some_and(u8::is_ascii_digit)
        };
        is_digit(at.checked_sub(1)) && is_digit(Some(at + 1))
    };
    // `47,5 8,5`, `47,5; 8,5`, `47,5, 8,5`.
    let decimals = cell
        .match_indices(',')
        .filter(|(at, _)| is_between_digits(*at));
    let has_points = cell.contains('.');
    if !has_points && decimals.clone().count() == 2 && (commas == 3 || has_seam(cell)) {
        let mut text: Vec<char> = Vec::with_capacity(cell.len());
        for (at, letter) in cell.char_indices() {
            let is_decimal = letter == ',' && is_between_digits(at);
            text.push(if is_decimal { '.' } else { letter });
        }
        return text.into_iter().collect();
    }
    // A height behind both.
    let parts: Vec<&str> = cell.split([',', ';']).map(str::trim).collect();
    let are_numbers = parts.iter().all(|part| part.parse::<f64>().is_ok());
    if let ([a, b, _], true) = (&parts[..], are_numbers) {
        return format!("{a}, {b}");
    }
    cell.to_owned()
}

/// Whether a blank or a semicolon parts two numbers.
fn has_seam(cell: &str) -> bool {
    let parts = cell.split([' ', ';', '/']).filter(|part| !part.is_empty());
    parts.count() == 2
}

/// The numbers of a cell in their order, degrees; `None` where it has not two.
pub(super) fn numbers(cell: &str) -> Option<[f64; 2]> {
    let plain = plain(cell);
    let numbers = two_numbers(&plain).filter(|numbers| numbers.iter().all(|n| n.is_finite()));
    numbers.filter(|[a, b]| a.abs().max(b.abs()) <= 360.0)
}

/// Whether letters in the cell say which number is which.
fn says_order(cell: &str) -> bool {
    let letters = ["N", "S", "E", "W", "n", "s", "e", "w"];
    letters.iter().any(|letter| cell.contains(letter)) && numbers(cell).is_some()
}

/// Whether a cell names a place.
pub(super) fn is_place(cell: &str) -> bool {
    let plain = plain(cell);
    // Whole numbers without a mark may be anything.
    let is_marked = plain.contains(['.', '°']) || says_order(&plain);
    let is_text = || place_of_text(&plain).is_ok();
    if is_map_address(&plain) {
        return is_text();
    }
    // One angle with a decimal comma is no pair.
    is_marked && angle_of_text(&plain).is_none() && (numbers(&plain).is_some() || is_text())
        || (plain.contains('+') || is_square(&plain)) && is_text()
}

/// Whether a cell has the form of a reference of MGRS: zone, three letters, an even number of digits.
fn is_square(cell: &str) -> bool {
    let cell: String = cell.split_whitespace().collect();
    let rest = cell.trim_start_matches(|c: char| c.is_ascii_digit());
    let digits = rest.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let (zone, letters) = (cell.len() - rest.len(), rest.len() - digits.len());
    (1..=2).contains(&zone)
        && letters == 3
        && [4, 6, 8, 10].contains(&digits.len())
        && digits.bytes().all(|b| b.is_ascii_digit())
}

/// Whether the name of a column says that places stand in it.
pub(super) fn is_name_of_places(name: &str) -> bool {
    let name = name.to_lowercase();
    let words = [
        "coord", "posit", "locat", "gps", "where", "lat", "lon", "lng", "place", "point", "geo",
        "wkt", "koord", "ort", "mgrs", "usng", "utm",
    ];
    let is_short = |word: &str| ["pos", "grid", "ll"].contains(&word);
    words.iter().any(|word| name.contains(word))
        || name.split(|c: char| !c.is_alphabetic()).any(is_short)
}

/// Whether a cell is a place whatever its column is called: by letters, signs of degrees, or the decimals of a place.
pub(super) fn is_surely_place(cell: &str) -> bool {
    let decimals = |part: &str| {
        let rest = part.split_once('.').map_or("", |(_, rest)| rest);
        rest.chars().take_while(char::is_ascii_digit).count()
    };
    let plain = plain(cell);
    let parts = plain.split([',', ';', ' ']);
    let exact = parts.filter(|part| decimals(part) >= 4).count();
    plain.contains(['°', '+']) || is_map_address(&plain) || says_order(&plain) || exact >= 2
}

/// The order that a column's name states, or that the numbers of its cells tell; `None` where both could be.
pub(super) fn order<'a>(
    name: &str,
    cells: impl Iterator<Item = &'a str> + Clone,
) -> Option<PlaceOrder> {
    use PlaceOrder::{LatitudeFirst, LongitudeFirst};
    let name = name.to_lowercase();
    let long = ["lon", "lng"]
        .into_iter()
        .filter_map(|word| name.find(word));
    match (name.find("lat"), long.min()) {
        (Some(latitude), Some(longitude)) if latitude < longitude => return Some(LatitudeFirst),
        (Some(_), Some(_)) => return Some(LongitudeFirst),
        _ => {}
    }
    if cells
        .clone()
        .all(|cell| says_order(cell) || numbers(cell).is_none())
    {
        return Some(LatitudeFirst);
    }
    let found = cells.filter(|cell| !says_order(cell)).filter_map(numbers);
    let beyond = |of: fn([f64; 2]) -> f64| found.clone().any(|pair| of(pair).abs() > 90.0);
    match (beyond(|[a, _]| a), beyond(|[_, b]| b)) {
        (true, false) => Some(LongitudeFirst),
        (false, true) => Some(LatitudeFirst),
        _ => None,
    }
}

/// The place of a cell, degrees; letters at its numbers outweigh the order.
pub(super) fn place(cell: &str, order: PlaceOrder) -> Option<LonLat> {
    let plain = plain(cell);
    let is_told = says_order(&plain) || is_map_address(&plain);
    if order == PlaceOrder::LongitudeFirst && !is_told {
        let [longitude, latitude] = numbers(&plain)?;
        return on_globe(longitude, latitude).then_some((longitude, latitude));
    }
    let bare = angle_of_text(&plain).is_none();
    let place = place_of_text(&plain).ok().filter(|_| bare)?;
    // As they were written, to the last digit.
    let (longitude, latitude) = (place.longitude.to_degrees(), place.latitude.to_degrees());
    let round = |degrees: f64| (degrees * 1e12).round() / 1e12;
    Some((round(longitude), round(latitude)))
}

#[cfg(test)]
mod tests {
    use super::PlaceOrder::{LatitudeFirst, LongitudeFirst};
    use super::*;

    #[test]
    fn both_numbers_are_read_in_the_spellings_that_people_use() {
        for cell in [
            "47.5, 8.5",
            "47.5 8.5",
            "47.5;8.5",
            "(47.5, 8.5)",
            "[47.5,8.5]",
            "47,5 8,5",
            "47,5; 8,5",
            "47,5, 8,5",
            "47.5, 8.5, 430",
            "47.5,8.5,430.0",
            "47°30'N 8°30'E",
            "47°30'0\"N, 8°30'0\"E",
            "N47.5 E8.5",
            "8.5E 47.5N",
            "geo:47.5,8.5",
            "geo:47.5,8.5,430;u=10",
            "https://www.google.com/maps/@47.5,8.5,15z",
            "https://www.openstreetmap.org/?mlat=47.5&mlon=8.5#map=15/47.6/8.6",
            "47.5/8.5",
            "lat/lng: (47.5,8.5)",
            "LatLng(47.5, 8.5)",
        ] {
            assert!(is_place(cell), "{cell}");
            let found = place(cell, LatitudeFirst);
            let is_it = found
                .is_some_and(|(lon, lat)| (lon - 8.5).abs() < 1e-9 && (lat - 47.5).abs() < 1e-9);
            assert!(is_it, "{cell}: {found:?}");
        }
        assert_eq!(place("8.5, 47.5", LongitudeFirst), Some((8.5, 47.5)));
        assert_eq!(
            place("33.85S 18.42W", LongitudeFirst),
            Some((-18.42, -33.85))
        );
        assert_eq!(place("geo:47.5,8.5", LongitudeFirst), Some((8.5, 47.5)));
        for cell in [
            "",
            "Alpha",
            "https://example.org/47",
            "12, 13",
            "1.5",
            "100.5, 200.5",
            "2024-05-01 10:00:00",
            // One angle with a decimal comma.
            "47,85° S",
            "12ABC3",
        ] {
            let is_place = is_place(cell) && place(cell, LatitudeFirst).is_some();
            assert!(!is_place, "{cell}");
        }
    }

    #[test]
    fn the_order_is_told_by_name_letters_or_numbers() {
        let of = |name: &str, cells: &[&'static str]| order(name, cells.iter().copied());
        assert_eq!(of("coordinates", &["47.5, 8.5"]), None);
        assert_eq!(of("lat/lon", &["47.5, 8.5"]), Some(LatitudeFirst));
        assert_eq!(of("LonLat", &["8.5, 47.5"]), Some(LongitudeFirst));
        assert_eq!(of("place", &["47.5N 8.5E"]), Some(LatitudeFirst));
        assert_eq!(
            of("place", &["1.5, 8.5", "-120.5 45.5"]),
            Some(LongitudeFirst)
        );
        assert_eq!(of("place", &["45.5, -120.5"]), Some(LatitudeFirst));
    }
}
