//! Tables of places whose names of columns say that they are of the grid of Switzerland or of Great Britain, or above which
//! a line names their system, brought to degrees on WGS 84: `Swiss-East`, `E_LV95`, `BNG-Zone`, `OSGB Easting`, `Grid Ref`.

use pilotage_base::frames::ReferenceSystem;
use pilotage_base::text::{csv_cell, without_decimal_comma};
use pilotage_mission::exchange::cells_of_row;

use crate::systems::by_code;

/// A grid: words of the names of its columns, its EPSG code, and what its eastings and northings lie between, metres.
struct NationalGrid {
    words: &'static [&'static str],
    code: u32,
    east: [f64; 2],
    north: [f64; 2],
}

const GRIDS: [NationalGrid; 3] = [
    NationalGrid {
        words: &["swiss", "ch1903", "lv95"],
        code: 2056,
        east: [2_400_000.0, 2_900_000.0],
        north: [1_000_000.0, 1_400_000.0],
    },
    NationalGrid {
        words: &["swiss", "ch1903", "lv03"],
        code: 21_781,
        east: [400_000.0, 900_000.0],
        north: [0.0, 400_000.0],
    },
    NationalGrid {
        words: &["bng", "osgb", "osgb36"],
        code: 27_700,
        east: [0.0, 800_000.0],
        north: [0.0, 1_400_000.0],
    },
];
const EASTS: [&str; 3] = ["east", "easting", "e"];
const NORTHS: [&str; 3] = ["north", "northing", "n"];
/// Names of columns of references to the grid of Great Britain: two letters and as many digits to the east as to the north.
const REFERENCES: [&str; 9] = [
    "grid ref",
    "gridref",
    "grid reference",
    "os grid ref",
    "os grid reference",
    "os gridref",
    "osgb grid ref",
    "ngr",
    "national grid reference",
];
/// Digits of a reference that is exact to a metre.
const TO_A_METRE: usize = 10;
/// Metres of a square that two letters name.
const SQUARE: f64 = 100_000.0;

/// The table with degrees in the place of its coordinates, their system and a sentence more on them, if there is one to say;
/// `None` of any other text.
pub(crate) fn grid_in_degrees(text: &str) -> Option<(String, ReferenceSystem, Option<String>)> {
    let (names, rows) = text.trim_start_matches('\u{feff}').split_once('\n')?;
    let seam = [';', '\t', ','].into_iter().find(|c| names.contains(*c))?;
    let cells = |line: &str| -> Vec<String> { line.trim_end().split(seam).map(bare).collect() };
    let mut names = cells(names);
    let is_reference = |name: &String| REFERENCES.contains(&plain(name).as_str());
    if let Some(column) = names.iter().position(is_reference) {
        let rows = rows.lines().map(cells).collect();
        return references_in_degrees(names, rows, column, seam);
    }
    let has = |grid: &NationalGrid, kinds: &[&str]| names.iter().any(|n| is_of(n, grid, kinds));
    let mut grids = GRIDS.iter();
    // Most tables are none, and large ones are not taken apart in vain.
    if !grids.any(|grid| has(grid, &EASTS) && has(grid, &NORTHS)) {
        return None;
    }
    let rows: Vec<Vec<String>> = rows.lines().map(cells).collect();
    // Seams within quotation marks would move cells into other columns.
    if rows.iter().any(|row| row.len() > names.len()) {
        return None;
    }
    let (grid, [east, north, zone]) = GRIDS.iter().find_map(|grid| {
        let find = |kinds: &[&str]| names.iter().position(|name| is_of(name, grid, kinds));
        let (east, north) = (find(&EASTS)?, find(&NORTHS)?);
        let columns = [Some(east), Some(north), find(&["zone"])];
        let place = rows.iter().find_map(|row| place(row, columns))?;
        let is_within = |value: f64, [least, most]: [f64; 2]| (least..=most).contains(&value);
        let fits = is_within(place.0, grid.east) && is_within(place.1, grid.north);
        fits.then_some((grid, columns))
    })?;
    let system = by_code(grid.code).ok()?;
    let (east_at, north_at) = (east?, north?);
    "Longitude".clone_into(&mut names[east_at]);
    "Latitude".clone_into(&mut names[north_at]);
    let in_degrees = |mut row: Vec<String>| {
        let place = place(&row, [east, north, zone]);
        if let Some([longitude, latitude]) = place.and_then(|(x, y)| degrees(&system, x, y)) {
            (row[east_at], row[north_at]) = (longitude, latitude);
        }
        row
    };
    let rows: Vec<Vec<String>> = rows.into_iter().map(in_degrees).collect();
    Some((table(&names, &rows, seam), system, None))
}

/// The same of a table with the names of its columns, easting and northing among them, of which a line above it says that
/// they count in `system`.
pub(crate) fn named_in_degrees(text: &str, system: &ReferenceSystem) -> Option<String> {
    let (names, rows) = text.split_once('\n')?;
    let seam = [';', '\t', ','].into_iter().find(|c| names.contains(*c))?;
    let mut names = cells_of_row(names, seam);
    let find = |kinds: [&str; 3], axis: &str| {
        let is_kind = |name: &String| {
            let name = plain(name);
            name == axis || kinds.contains(&name.split(['(', '[']).next().unwrap_or("").trim())
        };
        names.iter().position(is_kind)
    };
    let (east, north) = (find(EASTS, "x")?, find(NORTHS, "y")?);
    "Longitude".clone_into(&mut names[east]);
    "Latitude".clone_into(&mut names[north]);
    let mut has_places = false;
    let rows = rows.lines().map(|line| {
        let mut row = cells_of_row(line, seam);
        let number = |column: usize| -> Option<f64> {
            let cell = row.get(column)?;
            let plain = without_decimal_comma(cell).filter(|_| seam != ',');
            plain.as_ref().unwrap_or(cell).parse().ok()
        };
        let place = number(east).zip(number(north));
        if let Some([longitude, latitude]) = place.and_then(|(x, y)| degrees(system, x, y)) {
            has_places = true;
            (row[east], row[north]) = (longitude, latitude);
        }
        row.iter().map(|cell| csv_cell(cell)).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    // An empty line keeps the lines' numbers.
    has_places.then(|| format!("\n{}", table(&names, &rows, ',')))
}

/// The table with a latitude in the place of each reference to the grid of Great Britain, and a longitude behind its row;
/// `None` where any cell below that name is something else.
fn references_in_degrees(
    mut names: Vec<String>,
    rows: Vec<Vec<String>>,
    column: usize,
    seam: char,
) -> Option<(String, ReferenceSystem, Option<String>)> {
    let british = GRIDS.last()?;
    let system = by_code(british.code).ok()?;
    let width = names.len();
    "Latitude".clone_into(&mut names[column]);
    names.push("Longitude".to_owned());
    let mut fewest = TO_A_METRE;
    let in_degrees = |mut row: Vec<String>| {
        let is_empty = row.iter().all(String::is_empty);
        let cell = row.get(column).filter(|cell| !cell.is_empty());
        let Some(cell) = cell else {
            return Some(row).filter(|_| is_empty);
        };
        let (x, y, digits) = reference(cell)?;
        let [longitude, latitude] = degrees(&system, x, y)?;
        fewest = fewest.min(digits);
        row[column] = latitude;
        row.resize(width, String::new());
        row.push(longitude);
        Some(row)
    };
    let rows: Option<Vec<Vec<String>>> = rows.into_iter().map(in_degrees).collect();
    let rows = rows.filter(|rows| rows.iter().any(|row| row.len() > width))?;
    let told = (fewest < TO_A_METRE).then(|| {
        let metres = SQUARE / 10_f64.powf(fewest as f64 / 2.0);
        format!(
            "some of its references to the grid have {fewest} digits: they are the south-western corners of squares of {metres} m"
        )
    });
    Some((table(&names, &rows, seam), system, told))
}

/// Easting and northing of a reference, `TQ 306 799` or `TQ3060079900`, metres, and the number of its digits.
fn reference(cell: &str) -> Option<(f64, f64, usize)> {
    let letters: String = cell.chars().filter(|c| !c.is_whitespace()).collect();
    let (square_name, digits) = letters.split_at_checked(2)?;
    let (x, y) = square(square_name)?;
    let half = digits.len() / 2;
    let is_whole = digits.len() == 2 * half && (2..=TO_A_METRE).contains(&digits.len());
    if !is_whole || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let unit = SQUARE / 10_f64.powf(half as f64);
    let metres = |digits: &str| digits.parse::<f64>().ok().map(|number| number * unit);
    Some((
        x + metres(&digits[..half])?,
        y + metres(&digits[half..])?,
        digits.len(),
    ))
}

/// Longitude and latitude of coordinates, degrees as text.
fn degrees(system: &ReferenceSystem, x: f64, y: f64) -> Option<[String; 2]> {
    let place = system.geodetic(x, y)?;
    Some([place.longitude, place.latitude].map(|angle| format!("{:.10}", angle.to_degrees())))
}

/// A table of names and rows.
fn table(names: &[String], rows: &[Vec<String>], seam: char) -> String {
    let seam = seam.to_string();
    let mut table = names.join(&seam) + "\n";
    for row in rows {
        table += &(row.join(&seam) + "\n");
    }
    table
}

/// A name in small letters, its words parted by blanks.
fn plain(name: &str) -> String {
    name.to_lowercase().replace(['_', '-'], " ")
}

/// A cell without blanks and quotation marks around it.
fn bare(cell: &str) -> String {
    cell.trim().trim_matches('"').to_owned()
}

/// Whether a column's name says the grid and one of `kinds`.
fn is_of(name: &str, grid: &NationalGrid, kinds: &[&str]) -> bool {
    let name = name.to_lowercase();
    let has = |words: &[&str]| {
        let mut own = name.split(|c: char| !c.is_alphanumeric());
        own.any(|word| words.contains(&word))
    };
    has(grid.words) && has(kinds)
}

/// Easting and northing of a row, metres, with the corner of the square that letters name in the column of zones.
fn place(row: &[String], [east, north, zone]: [Option<usize>; 3]) -> Option<(f64, f64)> {
    let number = |column: Option<usize>| row.get(column?)?.parse::<f64>().ok();
    let (east, north) = (number(east)?, number(north)?);
    let letters = zone.and_then(|zone| row.get(zone));
    let (x, y) = match letters.filter(|letters| !letters.is_empty()) {
        Some(letters) => square(letters)?,
        None => (0.0, 0.0),
    };
    Some((east + x, north + y))
}

/// The south-western corner of a square of Great Britain's grid, metres: `TQ`. Each letter is one of 25 in five rows from the
/// north, without I.
fn square(letters: &str) -> Option<(f64, f64)> {
    let place = |letter: u8| {
        let letter = letter.to_ascii_uppercase();
        let is_letter = letter.is_ascii_uppercase() && letter != b'I';
        let count = i32::from(letter) - i32::from(b'A') - i32::from(letter > b'I');
        is_letter.then_some((count % 5, 4 - count / 5))
    };
    let [first, second] = letters.as_bytes() else {
        return None;
    };
    let ((x, y), (column, row)) = (place(*first)?, place(*second)?);
    // The origin is the corner of SV.
    let (x, y) = (5 * (x - 2) + column, 5 * (y - 1) + row);
    Some((SQUARE * f64::from(x), SQUARE * f64::from(y)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first_row(text: &str) -> Option<String> {
        let (text, ..) = grid_in_degrees(text)?;
        text.lines().nth(1).map(str::to_owned)
    }

    /// Latitude and longitude in the third and second cell, degrees.
    fn degrees(text: &str) -> (f64, f64) {
        let row = first_row(text).unwrap();
        let cells: Vec<&str> = row.split([',', ';']).collect();
        (cells[2].parse().unwrap(), cells[1].parse().unwrap())
    }

    #[test]
    fn grids_are_known_by_the_names_of_their_columns() {
        // By pyproj 3.7.
        let zurich = (47.377_125_25, 8.541_070_44);
        for text in [
            "Name,Swiss-East,Swiss-North\nA,2683256,1247950\n",
            "Name,Swiss-East,Swiss-North\nA,683256,247950\n",
            "Name;E_LV95;N_LV95\nA;2683256;1247950\n",
        ] {
            let (latitude, longitude) = degrees(text);
            let off = (latitude - zurich.0).hypot(longitude - zurich.1);
            assert!(off < 2e-5, "{text}: {latitude} {longitude}");
        }
        let whole = degrees("Name,BNG-East,BNG-North\nA,538000,177000\n");
        let lettered = degrees("Name,BNG-East,BNG-North,BNG-Zone\nA,38000,77000,TQ\n");
        assert_eq!(whole, lettered);
        assert!(
            (whole.0 - 51.475_137_6).abs() < 4e-5 && (whole.1 + 0.014_334_1).abs() < 4e-5,
            "{whole:?}"
        );
        assert_eq!(square("SV"), Some((0.0, 0.0)));
        assert_eq!(square("NT"), Some((300_000.0, 600_000.0)));
    }

    #[test]
    fn references_to_the_grid_of_great_britain_are_places() {
        // The tower of the Ordnance Survey's example: TG 51409 13177 is 52° 39′ 27.2531″ N, 1° 43′ 4.5177″ E on its own datum,
        // and 52.657977° N, 1.716038° E on WGS 84 by the seven parameters.
        let table = "Name,Grid Ref,Height\nCaister,TG 51409 13177,10\nWide,TG5113,\n\n";
        let (text, _, told) = grid_in_degrees(table).unwrap();
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(rows[0], ["Name", "Latitude", "Height", "Longitude"]);
        let off = |row: &[&str]| {
            let [latitude, longitude] = [1, 3].map(|at: usize| row[at].parse::<f64>().unwrap());
            (latitude - 52.657_977).hypot(longitude - 1.716_038)
        };
        assert!(off(&rows[1]) < 4e-5, "{text}");
        assert!((4e-4..8e-3).contains(&off(&rows[2])), "{text}");
        assert!(told.unwrap().contains("4 digits") && rows[1][2] == "10");
        for text in [
            "Name,Grid Ref\nA,Q 306 799\n",
            "Name,Grid Ref\nA,TQ 306 79\n",
            "Name,Grid Ref\nA,TI 306 799\n",
            "Name,Grid Ref\nA,TQ 30680 79920\nB,somewhere\n",
        ] {
            assert_eq!(first_row(text), None, "{text}");
        }
    }

    #[test]
    fn a_line_above_the_names_says_what_eastings_and_northings_count_in() {
        let system = by_code(2193).unwrap();
        for table in [
            "Point,E,N,H\n\"A, 1\",1576041.15,5189200.5,12.5\n",
            "Point;Easting (m);Northing (m);H\n\"A, 1\";1.576.041,15;5.189.200,5;12,5\n",
        ] {
            let text = named_in_degrees(table, &system).unwrap();
            let rows: Vec<&str> = text.lines().collect();
            assert_eq!(rows[1], "Point,Longitude,Latitude,H");
            assert_eq!(rows[2], "\"A, 1\",172.7038878651,-43.4497156338,12.5");
        }
        assert!(named_in_degrees("Point,lat,lon\nA,1,2\n", &system).is_none());
    }

    #[test]
    fn other_tables_stay_as_they_are() {
        for text in [
            "Name,East,North\nA,2683256,1247950\n",
            "Name,Swiss-East,Swiss-North\nA,12,13\n",
            "Name,UTM-East,UTM-North\nA,500000,5000000\n",
            "Name,Latitude,Longitude\nA,47,8\n",
            "Swiss-East",
            "Name,Swiss-East,Swiss-North\n\"A, B\",2683256,1247950\n",
        ] {
            assert_eq!(first_row(text), None, "{text}");
        }
    }
}
