//! Short links of `OpenStreetMap`: `https://osm.org/go/0EEQjE--`.
//!
//! Each letter has three bits of the longitude and three of the latitude in turn
//! (<https://wiki.openstreetmap.org/wiki/Shortlink>); big and small letters differ.

use super::PlaceTextError;
use super::degrees::on_globe;
use crate::frames::Geodetic;

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_~";
const HOSTS: [&str; 3] = ["osm.org", "openstreetmap.org", "www.openstreetmap.org"];
/// Letters of the most exact links, of 30 bits an angle.
const MOST: usize = 10;

/// The place that such a link means, the south-western corner of its square as the map's own pages have it; `None` of any
/// other text.
pub(super) fn read(text: &str) -> Option<Result<Geodetic, PlaceTextError>> {
    let address = ["https://", "http://"].iter().find_map(|scheme| {
        let begin = text.get(..scheme.len())?;
        begin
            .eq_ignore_ascii_case(scheme)
            .then(|| &text[scheme.len()..])
    });
    let (host, path) = address.unwrap_or(text).split_once('/')?;
    let is_host = HOSTS.iter().any(|own| own.eq_ignore_ascii_case(host));
    let code = path.strip_prefix("go/").filter(|_| is_host)?;
    let code = code.split(['?', '#', '/']).next().unwrap_or("");
    Some(place(code).unwrap_or(Err(PlaceTextError::Address)))
}

fn place(code: &str) -> Option<Result<Geodetic, PlaceTextError>> {
    // Signs at the end tell how near the map is shown.
    let letters = code.trim_end_matches(['-', '=']);
    if letters.is_empty() || letters.len() > MOST {
        return None;
    }
    let (mut east, mut north) = (0_u64, 0_u64);
    for letter in letters.bytes() {
        // An at sign in older links.
        let letter = if letter == b'@' { b'~' } else { letter };
        let bits = LETTERS.iter().position(|own| *own == letter)? as u64;
        for pair in [bits >> 4, bits >> 2, bits] {
            east = (east << 1) | ((pair >> 1) & 1);
            north = (north << 1) | (pair & 1);
        }
    }
    let parts = f64::from(2_u32.pow(3 * letters.len() as u32));
    let share = |number: u64| number as f64 / parts;
    Some(on_globe(
        share(north) * 180.0 - 90.0,
        share(east) * 360.0 - 180.0,
    ))
}
