//! Directions from true north, where a table has those from magnetic north with the variation beside them.

use std::borrow::Cow;

use super::table_text::{bare_cells, joined, name_separator};
use crate::cells::Separator;

/// Names of the columns that are added, degrees clockwise from true north.
const HEADING: &str = "true heading by variation [deg]";
const TRACK: &str = "track by variation [deg]";
/// Columns that the glass cockpits of Garmin have alone: their directions are magnetic, whatever they are called.
const GARMIN: [&str; 2] = ["Lcl Date", "UTCOfst"];
/// Lines within which the names of columns stand.
const HEAD: usize = 40;
/// Rows between two places whose direction is looked at, and the least way between them, degrees.
const STRIDE: usize = 10;
const WAY: f64 = 1e-4;

/// The columns of a table that matter here.
struct MagneticColumns {
    separator: Separator,
    count: usize,
    variation: usize,
    heading: Option<usize>,
    track: Option<usize>,
    /// Latitude and longitude.
    place: Option<(usize, usize)>,
}

/// The text of a table with columns of the true heading and track behind its own, where it has the magnetic ones and the
/// variation.
pub(super) fn with_true_directions(text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let head = text.split(|b| *b == b'\n').take(HEAD);
    let says = |line: &&[u8]| {
        let line = String::from_utf8_lossy(line).to_lowercase();
        line.contains("var") && (line.contains("hdg") || line.contains("heading"))
    };
    if !head.clone().any(|line| says(&line)) {
        return text;
    }
    let changed = changed(&String::from_utf8_lossy(&text));
    changed.map_or(text, |changed| Cow::Owned(changed.into_bytes()))
}

fn changed(text: &str) -> Option<String> {
    let mut head = text.lines().take(HEAD).enumerate();
    let (number, columns) = head.find_map(|(number, line)| Some((number, columns(line)?)))?;
    let rows = || text.lines().skip(number + 1);
    let magnetic = [(columns.heading, HEADING), (columns.track, TRACK)].map(|(column, name)| {
        let column = column?;
        Some((column, name, sign(rows(), &columns, column)?))
    });
    let separator = char::from(columns.separator.byte());
    let added = |line: &str, index: usize| -> String {
        let cells = bare_cells(line, columns.separator);
        let mut line = line.to_owned();
        for (column, name, sign) in magnetic.into_iter().flatten() {
            if index + 1 == number && line.starts_with('#') && cells.len() == columns.count {
                line = format!("{line}{separator}deg");
            } else if index == number {
                line = format!("{line}{separator}{name}");
            } else if index > number && cells.len() == columns.count {
                let pair = number_in(cells[column]).zip(number_in(cells[columns.variation]));
                let value =
                    pair.map(|(angle, by)| format!("{:.3}", (angle + sign * by).rem_euclid(360.0)));
                let mut value = value.unwrap_or_default();
                if cells[column].contains(',') {
                    value = format!("\"{}\"", value.replace('.', ","));
                }
                line = format!("{line}{separator}{value}");
            }
        }
        line
    };
    let is_any = magnetic.iter().any(Option::is_some);
    let lines = text.lines().enumerate();
    is_any.then(|| joined(lines.map(|(index, line)| added(line, index))))
}

fn number_in(cell: &str) -> Option<f64> {
    let number = cell.replacen(',', ".", 1).parse().ok();
    number.filter(|number: &f64| number.is_finite())
}

/// The columns of a line of names.
fn columns(line: &str) -> Option<MagneticColumns> {
    let separator = name_separator(line);
    let names = bare_cells(line, separator);
    let plain: Vec<String> = names.iter().map(|name| plain(name)).collect();
    let find = |wanted: &[&str]| {
        plain
            .iter()
            .position(|name| wanted.contains(&name.as_str()))
    };
    let variation = find(&[
        "magvar",
        "mag var",
        "magnetic variation",
        "mag variation",
        "magnetic declination",
    ])?;
    let is_garmin = GARMIN.iter().all(|name| names.contains(name));
    let (mut heading, mut track) = (
        find(&["magnetic heading", "mag heading", "hdg mag", "mag hdg"]),
        None,
    );
    if is_garmin {
        heading = heading.or_else(|| find(&["hdg"]));
        track = find(&["trk"]);
    }
    heading.or(track)?;
    Some(MagneticColumns {
        separator,
        count: names.len(),
        variation,
        heading,
        track,
        place: find(&["latitude", "lat"]).zip(find(&["longitude", "lon", "lng"])),
    })
}

/// A name in small letters without what stands in brackets.
fn plain(name: &str) -> String {
    let name = name.split(['(', '[']).next().unwrap_or("");
    let words: Vec<String> = name.split(['_', ' ']).map(str::to_lowercase).collect();
    words.join(" ").trim().to_owned()
}

/// Factor of the variation in the sum with a direction: one where variations to the east are positive, as they mostly are,
/// minus one where the track tells so, and `None` where it tells that the direction is from true north already.
fn sign<'a>(
    rows: impl Iterator<Item = &'a str>,
    columns: &MagneticColumns,
    angle: usize,
) -> Option<f64> {
    const FACTORS: [f64; 3] = [1.0, -1.0, 0.0];
    let Some((latitude, longitude)) = columns.place else {
        return Some(1.0);
    };
    let numbers = |row: &str| -> Option<[f64; 4]> {
        let cells = bare_cells(row, columns.separator);
        let number = |at: usize| number_in(cells.get(at)?);
        Some([
            number(latitude)?,
            number(longitude)?,
            number(angle)?,
            number(columns.variation)?,
        ])
    };
    let rows: Vec<[f64; 4]> = rows.filter_map(numbers).collect();
    // By how much the direction in the middle is off the way between two rows, with each factor.
    let mut off = [(0.0, 0.0); 3];
    for part in rows.windows(2 * STRIDE + 1).step_by(STRIDE) {
        let (from, middle, to) = (part[0], part[STRIDE], part[2 * STRIDE]);
        let north = to[0] - from[0];
        let east = (to[1] - from[1]) * middle[0].to_radians().cos();
        if north.hypot(east) < WAY {
            continue;
        }
        let course = east.atan2(north);
        for (off, factor) in off.iter_mut().zip(FACTORS) {
            let by = (middle[2] + factor * middle[3]).to_radians() - course;
            *off = (off.0 + by.sin(), off.1 + by.cos());
        }
    }
    let [east, west, none] = off.map(|(sine, cosine): (f64, f64)| sine.atan2(cosine).abs());
    // Wind turns headings off the track by a few degrees.
    match () {
        () if west < 0.5 * east.min(none) => Some(-1.0),
        () if none < 0.5 * east.min(west) => None,
        () => Some(1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flight towards the north-east, 45°, with a heading and a variation.
    fn table(heading: f64, variation: f64) -> String {
        let row = |i: u32| {
            let way = 1e-4 * f64::from(i);
            format!("{i},{way:.6},{way:.6},{heading},{variation}\n")
        };
        let rows: String = (0..60).map(row).collect();
        format!("time,Latitude (deg),Longitude (deg),Magnetic Heading (deg),Mag Var (deg)\n{rows}")
    }

    #[test]
    fn headings_are_turned_by_the_variation_beside_them_whatever_its_sign() {
        for variation in [12.0, -12.0] {
            let found = changed(&table(33.0, variation)).unwrap();
            let lines: Vec<&str> = found.lines().collect();
            assert!(
                lines[0].ends_with(&format!("Mag Var (deg),{HEADING}")),
                "{}",
                lines[0]
            );
            assert!(lines[30].ends_with(",45.000"), "{}", lines[30]);
        }
        assert_eq!(changed(&table(44.5, 12.0)), None);
    }

    #[test]
    fn cells_in_quotation_marks_have_a_variation_as_well() {
        let names = "\"time\",\"Magnetic Heading (deg)\",\"Note, free\",\"Mag Var (deg)\"";
        for (row, right) in [
            ("\"0\",\"350.0\",\"a, b\",\"15.0\"", "5.000"),
            ("0,\"350,5\",,\"-15,25\"", "\"335,250\""),
        ] {
            let found = changed(&format!("{names}\n{row}\n")).unwrap();
            let end = format!("\n{row},{right}\n");
            assert!(found.ends_with(&end), "{found}");
        }
        let found = changed("Magnetic Heading|Mag Var\n350|15\n").unwrap();
        assert!(found.ends_with("350|15|5.000\n"), "{found}");
    }

    #[test]
    fn the_directions_of_garmin_are_magnetic_and_those_of_others_stay() {
        let names = "Lcl Date, UTCOfst, HDG, TRK, MagVar";
        let found = changed(&format!(
            "#a, b, deg, deg, deg\n {names}\n x, +00:00, 350.0, 5.0, 15.0\n, , , , \n"
        ))
        .unwrap();
        let lines: Vec<&str> = found.lines().collect();
        assert_eq!(lines[0], "#a, b, deg, deg, deg,deg,deg");
        assert_eq!(lines[2], " x, +00:00, 350.0, 5.0, 15.0,5.000,20.000");
        assert_eq!(lines[3], ", , , , ,,");
        for other in [
            "heading,variance\n1,2\n",
            "HDG,MagVar\n1,2\n",
            "Magnetic Heading\n1\n",
        ] {
            assert!(changed(other).is_none(), "{other}");
        }
    }
}
