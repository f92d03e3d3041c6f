//! Addresses of maps, and `geo:` addresses after RFC 5870.

use super::PlaceTextError;
use super::degrees::on_globe;
use crate::frames::Geodetic;

/// Parameters that name a place, and then those that name the middle of what is shown.
const PAIRS: [&str; 11] = [
    "Q",
    "QUERY",
    "DESTINATION",
    "DADDR",
    "COORDINATE",
    "SP",
    "VIEWPOINT",
    "LL",
    "SLL",
    "CENTER",
    "CP",
];
/// Parameters that name a place by two numbers.
const HALVES: [[&str; 2]; 4] = [
    ["MLAT", "MLON"],
    ["LAT", "LON"],
    ["LAT", "LNG"],
    ["LATITUDE", "LONGITUDE"],
];
/// Signs that addresses write in hexadecimal digits.
const SIGNS: [(&str, &str); 8] = [
    ("%2C", ","),
    ("%3A", ":"),
    ("%3B", ";"),
    ("%3D", "="),
    ("%2F", "/"),
    ("%7E", "~"),
    ("%20", " "),
    ("%21", "!"),
];

/// The place that an address in capitals names: its mark, or else the middle of the map that it shows. `None` if the text is
/// no address.
pub(super) fn read(text: &str) -> Option<Result<Geodetic, PlaceTextError>> {
    let found = match text.strip_prefix("GEO:") {
        Some(rest) => of_geo(rest),
        None if is_address(text) => of_map(&plain(text)),
        None => return None,
    };
    let place = |[latitude, longitude]: [f64; 2]| on_globe(latitude, longitude);
    Some(found.map_or(Err(PlaceTextError::Address), place))
}

/// Whether a text has the form of an address, of the web or of `geo:`, which may name a place.
pub fn is_map_address(text: &str) -> bool {
    let text = text.trim();
    begins(text, "geo:") || is_address(text)
}

/// Whether a text is an address of the web, with its scheme or without it: `maps.google.com/…`.
fn is_address(text: &str) -> bool {
    let host = text.split(['/', '?', '#']).next().unwrap_or("");
    let end = host.rsplit_once('.').map_or("", |(_, end)| end);
    let is_host = end.len() > 1 && end.bytes().all(|b| b.is_ascii_alphabetic());
    begins(text, "http://")
        || begins(text, "https://")
        || is_host && host.len() < text.len() && !host.contains(char::is_whitespace)
}

/// Whether a text begins with `scheme`, in capitals or not.
fn begins(text: &str, scheme: &str) -> bool {
    let begin = text.as_bytes().get(..scheme.len());
    begin.is_some_and(|begin| begin.eq_ignore_ascii_case(scheme.as_bytes()))
}

/// The address with its signs as they are meant.
fn plain(text: &str) -> String {
    let signs = SIGNS.iter();
    signs.fold(text.to_owned(), |text, (code, sign)| {
        text.replace(code, sign)
    })
}

/// Latitude and longitude of `47.5,8.5,430;CRS=WGS84;U=10`, or of the `0,0?Q=47.5,8.5(NAME)` of telephones.
fn of_geo(text: &str) -> Option<[f64; 2]> {
    let text = plain(text);
    let (place, rest) = text.split_once('?').unwrap_or((&text, ""));
    if let Some(asked) = parameter(rest, "Q").and_then(pair) {
        return Some(asked);
    }
    let (numbers, rest) = place.split_once(';').unwrap_or((place, ""));
    let mut systems = rest.split(';').filter_map(|part| part.strip_prefix("CRS="));
    let is_known = systems.all(|system| system == "WGS84");
    pair(numbers).filter(|_| is_known)
}

fn of_map(text: &str) -> Option<[f64; 2]> {
    let (rest, fragment) = text.split_once('#').unwrap_or((text, ""));
    let (path, query) = rest.split_once('?').unwrap_or((rest, ""));
    let number = |name: &str| parameter(query, name)?.trim().parse().ok();
    let both = |names: [&str; 2]| Some([number(names[0])?, number(names[1])?]);
    let mut segments = path.split('/');
    of_data(path)
        .or_else(|| HALVES.into_iter().find_map(both))
        .or_else(|| {
            PAIRS
                .into_iter()
                .find_map(|name| pair(parameter(query, name)?))
        })
        .or_else(|| segments.clone().rev().find_map(pair))
        .or_else(|| segments.find_map(|segment| pair(segment.strip_prefix('@')?)))
        .or_else(|| of_fragment(fragment))
}

/// The mark in what Google writes of a place: `!3D47.5!4D8.5`.
fn of_data(path: &str) -> Option<[f64; 2]> {
    let parts: Vec<&str> = path.split('!').collect();
    parts.windows(2).rev().find_map(|both| {
        let latitude = both[0].strip_prefix("3D")?.parse().ok()?;
        let longitude = both[1]
            .split('/')
            .next()?
            .strip_prefix("4D")?
            .parse()
            .ok()?;
        Some([latitude, longitude])
    })
}

/// The middle of a map that is shown: `MAP=12/47.5/8.5`, also without the name.
fn of_fragment(fragment: &str) -> Option<[f64; 2]> {
    let shown = parameter(fragment, "MAP").unwrap_or(fragment);
    let mut numbers = shown.split('/').map(|part| part.parse::<f64>().ok());
    numbers.next()??;
    Some([numbers.next()??, numbers.next()??])
}

fn parameter<'a>(query: &'a str, name: &str) -> Option<&'a str> {
    let mut parts = query.split('&').filter_map(|part| part.split_once('='));
    parts.find(|(own, _)| *own == name).map(|(_, value)| value)
}

/// The two numbers with which a text begins: `47.5,8.5,15Z`, `47.5~8.5`, `POINT.47.5_8.5_NAME`, `LOC:47.5,+8.5`.
fn pair(text: &str) -> Option<[f64; 2]> {
    let text = text.strip_prefix("LOC:").unwrap_or(text);
    let text = text.strip_prefix("POINT.").unwrap_or(text);
    let text = text.split('(').next()?;
    let mut parts = text.split([',', '~', '_']);
    let mut number = || {
        // A blank is written as a plus.
        let part = parts.next()?.trim_matches([' ', '+']);
        part.parse().ok().filter(|number: &f64| number.is_finite())
    };
    Some([number()?, number()?])
}
