//! Tables of places whose names of columns say that they are of the grid of Switzerland or of Great Britain, brought to degrees on
//! WGS 84: `Swiss-East`, `E_LV95`, `BNG-Zone`, `OSGB Easting`.

use pilotage_base::frames::ReferenceSystem;

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
/// Metres of a square that two letters name.
const SQUARE: f64 = 100_000.0;

/// The table with degrees in the place of its coordinates, and their system; `None` of any other text.
pub(crate) fn grid_in_degrees(text: &str) -> Option<(String, ReferenceSystem)> {
    let (names, rows) = text.trim_start_matches('\u{feff}').split_once('\n')?;
    let seam = [';', '\t', ','].into_iter().find(|c| names.contains(*c))?;
    let cells = |line: &str| -> Vec<String> { line.trim_end().split(seam).map(bare).collect() };
    let mut names = cells(names);
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
    let seam = seam.to_string();
    let mut table = names.join(&seam) + "\n";
    for mut row in rows {
        if let Some((x, y)) = place(&row, [east, north, zone])
            && let Some(found) = system.geodetic(x, y)
        {
            row[east_at] = format!("{:.10}", found.longitude.to_degrees());
            row[north_at] = format!("{:.10}", found.latitude.to_degrees());
        }
        table += &(row.join(&seam) + "\n");
    }
    Some((table, system))
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
        let (text, _) = grid_in_degrees(text)?;
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
