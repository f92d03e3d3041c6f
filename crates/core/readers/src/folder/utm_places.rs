//! Tables of flights whose places are easting, northing and a zone of UTM in each row: the same on the globe.

use std::borrow::Cow;

use super::table_text::{bare_cells, name_separator, with_columns_behind};
use pilotage_base::place_text::place_of_text;

/// Names of the columns that are added.
const ADDED: [&str; 2] = ["latitude of utm [deg]", "longitude of utm [deg]"];
/// Lines within which the names of columns stand.
const HEAD: usize = 40;
const EASTINGS: [&str; 5] = ["utm e", "utm east", "utm easting", "utm x", "easting"];
const NORTHINGS: [&str; 5] = ["utm n", "utm north", "utm northing", "utm y", "northing"];
const ZONES: [&str; 5] = [
    "utm zone",
    "zone",
    "utm zone number",
    "zone number",
    "utm z",
];
/// Bands, of which an S is in the north, and halves, of which it is in the south.
const BANDS: [&str; 5] = [
    "band",
    "utm zone letter",
    "zone letter",
    "utm band",
    "utm letter",
];
const HALVES: [&str; 2] = ["utm hemisphere", "hemisphere"];

/// The text of a table with latitudes and longitudes behind its own cells, where it has none and says in which zones its
/// eastings and northings are.
pub(super) fn with_places_of_utm(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let head = text.split(|b| *b == b'\n').take(HEAD);
    let says = |line: &&[u8]| {
        let line = String::from_utf8_lossy(line).to_lowercase();
        line.contains("zone") && (line.contains("utm") || line.contains("easting"))
    };
    let Some(number) = head.clone().position(|line| says(&line)) else {
        return text;
    };
    let changed = changed(&String::from_utf8_lossy(&text), number);
    changed.map_or(text, |changed| Cow::Owned(changed.into_bytes()))
}

fn changed(text: &str, number: usize) -> Option<String> {
    let names = text.lines().nth(number)?;
    let separator = name_separator(names);
    let plain: Vec<String> = bare_cells(names, separator)
        .into_iter()
        .map(|name| {
            let name = name.trim_start_matches(['#', '%']).trim().to_lowercase();
            let name = name
                .split(['(', '['])
                .next()
                .unwrap_or("")
                .trim()
                .to_owned();
            name.replace(['_', '-', '.'], " ")
        })
        .collect();
    let find = |wanted: &[&str]| {
        plain
            .iter()
            .position(|name| wanted.contains(&name.as_str()))
    };
    let has_place = plain.iter().any(|name| {
        name.split(' ')
            .any(|word| word.starts_with("lat") && !word.starts_with("late"))
    });
    let (east, north, zone) = (find(&EASTINGS)?, find(&NORTHINGS)?, find(&ZONES)?);
    if has_place {
        return None;
    }
    let (band, half) = (find(&BANDS), find(&HALVES));
    let place = |cells: &[&str]| {
        let letter = match (half.map(|at| cells[at]), band.map(|at| cells[at])) {
            (Some(half), _) => half.get(..1)?.to_uppercase(),
            (None, Some("S" | "s")) => "N".to_owned(),
            (None, Some(band)) => band.to_owned(),
            (None, None) => String::new(),
        };
        let zone = cells[zone].trim_end_matches(".0");
        let place =
            place_of_text(&format!("{zone}{letter} {} {}", cells[east], cells[north])).ok()?;
        let degrees = [place.latitude, place.longitude].map(f64::to_degrees);
        Some(degrees.map(|angle| format!("{angle:.9}")))
    };
    with_columns_behind(text, number, ADDED, place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eastings_and_northings_beside_a_zone_are_places() {
        // By the series of Krüger, to a centimetre.
        for (names, cells) in [
            ("t,utm_e,utm_n,utm_zone", "0,465429.756,5246517.201,32N"),
            (
                "t,utm_x,utm_y,utm_zone,utm_zone_letter",
                "0,465429.756,5246517.201,32.0,T",
            ),
            (
                "t;Easting (m);Northing (m);Zone;Hemisphere",
                "0;465429.756;5246517.201;32;north",
            ),
            (
                "t,easting,northing,zone_number,zone_letter",
                "0,465429.756,5246517.201,32,S",
            ),
        ] {
            let text = format!("{names}\n{cells}\n");
            let found = with_places_of_utm(Cow::Borrowed(text.as_bytes()));
            let found = String::from_utf8(found.into_owned()).unwrap();
            let row = found.lines().nth(1).unwrap();
            let numbers: Vec<f64> = row
                .split([',', ';'])
                .rev()
                .take(2)
                .map(|n| n.parse().unwrap())
                .collect();
            assert!(
                (numbers[0] - 8.5421).hypot(numbers[1] - 47.3712) < 3e-7,
                "{found}"
            );
        }
        for other in [
            "t,utm_e,utm_n,utm_zone,lat,lon\n0,465429.756,5246517.201,32N,47,8\n",
            "t,utm_e,utm_n,utm_zone\n0,465429.756,5246517.201,32\n",
            "t,easting,northing\n0,1,2\n",
        ] {
            let found = with_places_of_utm(Cow::Borrowed(other.as_bytes()));
            assert_eq!(found, other.as_bytes());
        }
    }
}
