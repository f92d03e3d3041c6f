//! References of the Military Grid Reference System, after NGA.STND.0037, "Universal Grids and Grid Reference
//! Systems".

use super::PlaceTextError;
use super::utm::{band, system, within};
use crate::frames::Geodetic;

/// Letters of the columns of 100 km squares, by the zone's remainder.
const COLUMNS: [&str; 3] = ["STUVWXYZ", "ABCDEFGH", "JKLMNPQR"];
/// Letters of their rows, after which they begin anew.
const ROWS: &str = "ABCDEFGHJKLMNPQRSTUV";
/// Side of a square that is named by letters alone, metres.
const SIDE: f64 = 100_000.0;
/// Length of a degree of latitude where it is shortest, less than its fortieth for squares that stand oblique, metres.
const DEGREE: f64 = 108_000.0;

/// The middle of the square that a text in capitals names, if it has the form `32TMT4825111932`.
pub(super) fn read(text: &str) -> Option<Result<Geodetic, PlaceTextError>> {
    let text: String = text.split_whitespace().collect();
    let letters = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let zone = &text[..text.len() - letters.len()];
    let digits = letters.trim_start_matches(|c: char| c.is_ascii_uppercase());
    let letters = &letters[..letters.len() - digits.len()];
    let [letter, column, row] = letters.chars().collect::<Vec<_>>().try_into().ok()?;
    let is_polar = zone.is_empty() && "ABYZ".contains(letter);
    if !digits.bytes().all(|b| b.is_ascii_digit()) || (zone.is_empty() && !is_polar) {
        return None;
    }
    if is_polar {
        return Some(Err(PlaceTextError::Polar));
    }
    Some(place(zone.parse().ok()?, [letter, column, row], digits))
}

fn place(zone: u8, letters: [char; 3], digits: &str) -> Result<Geodetic, PlaceTextError> {
    let [letter, column, row] = letters;
    let system = system(zone, letter < 'N')?;
    let [from, to] = band(letter)?;
    let columns = COLUMNS[usize::from(zone % 3)];
    let across = columns.find(column).ok_or(PlaceTextError::Column {
        letter: column,
        zone,
        letters: columns,
    })?;
    let up = ROWS.find(row).ok_or(PlaceTextError::Row { letter: row })?;
    // Rows of even zones begin five letters later.
    let up = (up + 15 * usize::from(zone.is_multiple_of(2))) % ROWS.len();
    let count = digits.len();
    if count % 2 == 1 || count > 10 {
        return Err(PlaceTextError::DigitCount { count });
    }
    let (east, north) = digits.split_at(count / 2);
    let side = SIDE / 10_f64.powi((count / 2) as i32);
    let metres = |squares: usize, digits: &str| {
        SIDE * squares as f64 + side * (digits.parse().unwrap_or(0.0) + 0.5)
    };
    let (east, north) = (metres(across + 1, east), metres(up, north));
    // The rows come again every 2,000 km, which is more than two bands.
    let rounds = (0..5).map(|round| north + f64::from(round) * SIDE * ROWS.len() as f64);
    let off = |place: &Geodetic| (place.latitude.to_degrees() - 0.5 * (from + to)).abs();
    let nearest = rounds
        .filter_map(|north| system.geodetic(east, north))
        .min_by(|a, b| off(a).total_cmp(&off(b)));
    let nearest = nearest.ok_or(PlaceTextError::OutsideZone { east, north })?;
    // A square that the edge of the band cuts may have its middle beyond.
    within(nearest, letter, 0.5 * side / DEGREE)
}
