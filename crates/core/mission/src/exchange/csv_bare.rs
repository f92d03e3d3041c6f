//! Tables of places that have no line of names: control points and places of photos, as `OpenDroneMap`, `Pix4D` and Metashape
//! write them, and places with their names. They are given the names that other tables have.

use std::collections::HashSet;

use pilotage_base::frames::ReferenceSystem;
use pilotage_base::text::{csv_cell, in_quotes};

use super::angle;
use super::csv_cells::{cells_of_row, is_number};
use super::csv_fixed::fixed;
use super::csv_named::NamedTable;
use super::csv_preface::{is_comment, names_places};
use super::csv_system::{system, system_of_remark};

/// Digits behind the point of a latitude or longitude.
const DECIMALS: usize = 3;
/// Lines among which names of columns may stand behind a `#`.
const NAMES_WITHIN: usize = 40;
/// Names of what stands behind the place of a photo, as `OpenDroneMap` has it.
const BEHIND_PHOTO: [&str; 5] = ["yaw", "pitch", "roll", "accuracy", "vertical_accuracy"];

/// The table with names of its columns, where it has none of its own; `None` where it may have some.
///
/// # Errors
/// Its places are in a reference system that is not known; in words, about its first line.
pub(super) fn named(content: &str) -> Result<Option<NamedTable>, String> {
    let mut found = given_names(content)?;
    if let Some(table) = found.as_mut().filter(|_| !content.ends_with('\n')) {
        // A last line without an end may be cut off.
        let whole = table.text.trim_end_matches('\n').len();
        table.text.truncate(whole);
    }
    Ok(found)
}

fn given_names(content: &str) -> Result<Option<NamedTable>, String> {
    let first = content.lines().next().unwrap_or("");
    if let Some(system) = system(first) {
        let rows = content.lines().skip(1).map(of_open_drone_map);
        let rows: Vec<Option<Row>> = rows.collect();
        if rows.iter().flatten().next().is_some() {
            return Ok(Some(of_system(&system?, &rows)));
        }
        return Ok(None);
    }
    if let Some(table) = fixed(content)? {
        return Ok(Some(table));
    }
    if let Some(table) = of_dji_marks(content) {
        return Ok(Some(table));
    }
    if let Some(table) = between_blanks(content) {
        return Ok(Some(table));
    }
    if let Some(table) = of_metashape(content) {
        return Ok(Some(table));
    }
    by_values(content)
}

/// Whether a text is such a table, or begins as one.
pub(super) fn is_bare(head: &str) -> bool {
    // The last line may be cut off.
    let whole = head.rfind('\n').map_or(head, |end| &head[..end]);
    named(whole).map_or(true, |table| table.is_some())
}

/// A row: the name, the numbers of its place, and other cells.
struct Row {
    name: String,
    x: String,
    y: String,
    rest: Vec<String>,
    is_photo: bool,
}

/// `x y z pixel pixel picture name`, or `picture x y z yaw pitch roll`.
fn of_open_drone_map(line: &str) -> Option<Row> {
    let line = line.trim();
    let is_seam = |c: char| c.is_whitespace() || c == ',' || c == ';';
    let cells: Vec<&str> = line.split(is_seam).filter(|c| !c.is_empty()).collect();
    if line.starts_with('#') || cells.len() < 3 {
        return None;
    }
    let is_point = cells.len() >= 6 && cells[..5].iter().all(|cell| is_number(cell));
    let own = |cell: &&str| (*cell).to_owned();
    if is_point {
        return Some(Row {
            name: cells.get(6).map(own).unwrap_or_default(),
            x: cells[0].to_owned(),
            y: cells[1].to_owned(),
            rest: vec![cells[2].to_owned()],
            is_photo: false,
        });
    }
    let is_photo = !is_number(cells[0]) && cells[1..3].iter().all(|cell| is_number(cell));
    is_photo.then(|| Row {
        name: cells[0].to_owned(),
        x: cells[1].to_owned(),
        y: cells[2].to_owned(),
        rest: cells[3..].iter().map(own).collect(),
        is_photo: true,
    })
}

/// The table of rows whose first line was the system; that of points has a line for each picture that shows them.
fn of_system(system: &ReferenceSystem, rows: &[Option<Row>]) -> NamedTable {
    let are_photos = rows.iter().flatten().all(|row| row.is_photo);
    let behind: &[&str] = if are_photos { &BEHIND_PHOTO } else { &[] };
    let mut text = ["name,longitude,latitude,z", &behind.join(",")].join(",");
    let mut seen = HashSet::new();
    for row in rows {
        text.push('\n');
        let Some(row) = row else { continue };
        let place = [&row.x, &row.y, row.rest.first().unwrap_or(&row.y)];
        if !row.is_photo && !seen.insert(place.map(String::clone)) {
            continue;
        }
        let mut row_name = row.name.clone();
        if row_name.is_empty() {
            row_name = format!("point {}", seen.len());
        }
        text.push_str(&cells(system, &row_name, &row.x, &row.y, &row.rest));
    }
    let mut notes = vec![format!(
        "it has no names of columns, and is read as the {} of OpenDroneMap",
        if are_photos {
            "places of photos"
        } else {
            "control points"
        }
    )];
    if !are_photos {
        notes.push("where photos show the points is left out".to_owned());
    }
    NamedTable {
        text: text + "\n",
        added: 0,
        notes,
    }
}

/// The cells of a row below `name,longitude,latitude`, degrees on WGS 84; what has no place keeps its cells.
fn cells(system: &ReferenceSystem, name: &str, x: &str, y: &str, rest: &[String]) -> String {
    let name = in_quotes(name);
    let mut text = match place(system, x, y) {
        Some((longitude, latitude)) => format!("{name},{longitude},{latitude}"),
        None => format!("{name},{x},{y}"),
    };
    for cell in rest {
        text.push(',');
        text.push_str(&csv_cell(cell));
    }
    text
}

/// Longitude and latitude of coordinates in a system of metres, degrees as text.
fn place(system: &ReferenceSystem, x: &str, y: &str) -> Option<(String, String)> {
    if system.is_geographic() {
        return None;
    }
    let place = system.geodetic(x.parse().ok()?, y.parse().ok()?)?;
    let degrees = |radians: f64| format!("{:.10}", radians.to_degrees());
    Some((degrees(place.longitude), degrees(place.latitude)))
}

/// The marks of photos that DJI's aircraft write (`.MRK`): number, seconds of the week, `[week]`, millimetres to the antenna,
/// `47.1,Lat`, `8.5,Lon`, `500.0,Ellh`.
fn of_dji_marks(content: &str) -> Option<NamedTable> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('\t').map(str::trim).collect();
        let find = |name: &str| cells.iter().find_map(|cell| cell.strip_suffix(name));
        let values = [find(",Lat")?, find(",Lon")?, find(",Ellh")?];
        let are_numbers = values.into_iter().all(is_number) && is_number(cells[0]);
        are_numbers.then(|| format!("mark {},{}", cells[0], values.join(",")))
    };
    row(content.lines().next()?)?;
    let rows = content.lines().map(|line| row(line).unwrap_or_default());
    let text = rows.fold("name,latitude,longitude,z".to_owned(), |text, row| {
        text + "\n" + &row
    });
    Some(NamedTable {
        text: text + "\n",
        added: 1,
        notes: vec![
            "it has no names of columns, and is read as the marks of DJI's photos (.MRK); heights (z) are above the ellipsoid"
                .to_owned(),
        ],
    })
}

/// A reference table of Metashape in metres of the system that its first remark names.
fn of_metashape(content: &str) -> Option<NamedTable> {
    let mut lines = content.lines();
    let system = system_of_remark(lines.next()?.trim())?;
    let names = lines.next()?.trim().strip_prefix('#')?;
    let seam = [',', ';', '\t'].into_iter().find(|c| names.contains(*c))?;
    let mut names: Vec<&str> = names.split(seam).map(str::trim).collect();
    let find = |name: &str| {
        names
            .iter()
            .position(|other| other.eq_ignore_ascii_case(name))
    };
    let (x, y) = (find("X/Easting")?, find("Y/Northing")?);
    for (own, other) in [
        (Some(x), "longitude"),
        (Some(y), "latitude"),
        (find("Z/Altitude"), "z"),
    ] {
        if let Some(own) = own {
            names[own] = other;
        }
    }
    let mut text = format!("\n{}", names.join(","));
    for line in lines {
        text.push('\n');
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let mut cells = cells_of_row(line, seam);
        if let Some((longitude, latitude)) = cells
            .get(x)
            .zip(cells.get(y))
            .and_then(|(x, y)| place(&system, x, y))
        {
            (cells[x], cells[y]) = (longitude, latitude);
        }
        let cells = cells.iter().map(|cell| csv_cell(cell));
        text.push_str(&cells.collect::<Vec<_>>().join(","));
    }
    Some(NamedTable {
        text: text + "\n",
        added: 0,
        notes: vec![format!("its places are read in {}", system.name())],
    })
}

/// A table with names whose cells stand between blanks; those with blanks in them stand in quotation marks.
fn between_blanks(content: &str) -> Option<NamedTable> {
    let joined = |line: &str| {
        let cells = cells_of_row(line, ' ');
        let cells: Vec<String> = cells.iter().map(|cell| csv_cell(cell)).collect();
        cells.join(",")
    };
    // Names may stand behind a `#`.
    let named = |line: &&str| {
        line.starts_with('#') && !line.contains(',') && names_places(&joined(&line[1..]))
    };
    let first = content.lines().find(named);
    let is_remark = |line: &str| {
        Some(line) != first && (line.trim().is_empty() || line.trim_start().starts_with('#'))
    };
    let mut rows = content.lines().filter(|line| !is_remark(line));
    let names = rows.next()?;
    let names = names.strip_prefix('#').unwrap_or(names);
    let count = names.split_whitespace().count();
    let is_plain = |line: &str| !line.contains([';', '\t', '|']);
    let has_seams = |line: &str| line.contains(',') && cells_of_row(line, ',').len() >= count;
    let is_row =
        |line: &str| is_plain(line) && !has_seams(line) && cells_of_row(line, ' ').len() == count;
    let are_names = is_plain(names) && !names.contains([',', '"']);
    if count < 2 || !are_names || !names_places(&joined(names)) || !rows.all(is_row) {
        return None;
    }
    let line = |line: &str| {
        if is_remark(line) {
            return line.to_owned();
        }
        joined(line.strip_prefix('#').unwrap_or(line))
    };
    Some(NamedTable {
        text: content
            .lines()
            .map(line)
            .fold(String::new(), |text, line| text + &line + "\n"),
        added: 0,
        notes: Vec::new(),
    })
}

/// The cells of a row whose latitude and longitude have the letters of their hemispheres, without these and the latitude
/// first; south and west are negative.
fn without_letters(mut cells: Vec<String>) -> Vec<String> {
    let of = |cell: &String, letters: (char, char)| {
        let last = cell.chars().next_back().map(|c| c.to_ascii_uppercase());
        let has_letter = last.is_some_and(|c| c == letters.0 || c == letters.1);
        let is_angle = has_letter && cell.starts_with(|c: char| c.is_ascii_digit());
        angle::degrees(cell, letters).filter(|_| is_angle)
    };
    for at in 0..cells.len().min(3).saturating_sub(1) {
        let (latitude, longitude) = (('N', 'S'), ('E', 'W'));
        let [first, second] = [&cells[at], &cells[at + 1]];
        let found = of(first, latitude)
            .zip(of(second, longitude))
            .or_else(|| of(second, latitude).zip(of(first, longitude)));
        if let Some((latitude, longitude)) = found {
            (cells[at], cells[at + 1]) = (latitude.to_string(), longitude.to_string());
            break;
        }
    }
    cells
}

/// Whether a cell is a name, and neither a number nor a time.
fn is_name(cell: &str) -> bool {
    !is_number(cell)
        && cell.contains(|c: char| c.is_alphabetic())
        && !cell.contains(':')
        && !cell.starts_with(['$', '<', '{', '[', '+'])
}

/// A row of a name and two numbers, in either order.
fn row_of(cells: &[String], seam: char) -> Option<Row> {
    let are_numbers = |from: usize| {
        let pair = cells.get(from..from + 2);
        pair.is_some_and(|pair| pair.iter().all(|cell| is_number(cell)))
    };
    if cells.len() >= 3 && is_name(&cells[0]) && are_numbers(1) {
        return Some(Row {
            name: cells[0].clone(),
            x: cells[1].clone(),
            y: cells[2].clone(),
            rest: cells[3..].to_vec(),
            is_photo: false,
        });
    }
    let numbers = cells.iter().take_while(|cell| is_number(cell)).count();
    // Between blanks they may be a fence or a model.
    if cells.len() == 2 && numbers == 2 && seam != ' ' {
        return Some(Row {
            name: String::new(),
            x: cells[0].clone(),
            y: cells[1].clone(),
            rest: Vec::new(),
            is_photo: false,
        });
    }
    // A height may lack.
    let lacks_height = numbers == 2 && cells.get(2).is_some_and(String::is_empty);
    let behind = cells.get(numbers + usize::from(lacks_height)..)?;
    let is_named = (2..=3).contains(&numbers) && behind.first().is_some_and(|c| is_name(c));
    let mut rest = vec![
        cells
            .get(2)
            .filter(|_| numbers == 3)
            .cloned()
            .unwrap_or_default(),
    ];
    let name = if seam == ' ' {
        behind.join(" ")
    } else {
        rest.extend(behind.iter().skip(1).cloned());
        behind.first().cloned().unwrap_or_default()
    };
    is_named.then(|| Row {
        name,
        x: cells[0].clone(),
        y: cells[1].clone(),
        rest,
        is_photo: false,
    })
}

/// Names and places, where every line has them at the same cells and the numbers are those of places.
fn by_values(content: &str) -> Result<Option<NamedTable>, String> {
    let lines = || content.lines().map(str::trim);
    // Names may stand behind a `#`.
    let has_names = |line: &str| line.starts_with('#') && !is_comment(line);
    if lines().take(NAMES_WITHIN).any(has_names) {
        return Ok(None);
    }
    let is_told = |line: &&str| !line.is_empty() && !line.starts_with('#');
    let Some(first) = lines().find(is_told) else {
        return Ok(None);
    };
    let seams = ['\t', ';', ','].into_iter();
    let seam = seams
        .clone()
        .find(|seam| first.contains(*seam))
        .unwrap_or(' ');
    let rows = lines().map(|line| {
        is_told(&line).then(|| row_of(&without_letters(cells_of_row(line, seam)), seam))
    });
    let rows: Vec<Option<Option<Row>>> = rows.collect();
    let told: Option<Vec<&Row>> = rows.iter().flatten().map(Option::as_ref).collect();
    let Some(told) = told.filter(|rows| !rows.is_empty()) else {
        return Ok(None);
    };
    let numbers = |cell: fn(&Row) -> &String| -> Vec<f64> {
        told.iter()
            .filter_map(|row| cell(row).parse().ok())
            .collect()
    };
    let (x, y) = (numbers(|row| &row.x), numbers(|row| &row.y));
    let most = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
    let has_decimals = |row: &&&Row| {
        let digits = |cell: &str| cell.split_once('.').map_or(0, |(_, rest)| rest.len());
        digits(&row.x) >= DECIMALS && digits(&row.y) >= DECIMALS
    };
    let exact = told.iter().filter(has_decimals).count();
    let far = |numbers: &[f64]| numbers.iter().all(|n| n.abs() > 10_000.0);
    if far(&x) && far(&y) {
        return Err(
            "its places are metres of a reference system that nothing names, and no line names its columns: write \
             `name,easting,northing,zone` above it with the zone of UTM in each line, or save it in degrees (WGS 84)"
                .to_owned(),
        );
    }
    if 2 * exact < told.len() || most(&x).min(most(&y)) > 90.0 || most(&x).max(most(&y)) > 180.0 {
        return Ok(None);
    }
    let is_longitude_first = most(&x) > 90.0;
    let is_open = !is_longitude_first && most(&y) <= 90.0;
    let (names, order) = if is_longitude_first {
        (
            "name,longitude,latitude",
            "the longitude is the first of its numbers",
        )
    } else {
        (
            "name,latitude,longitude",
            "the latitude is the first of its numbers",
        )
    };
    // Nothing but places is a route, and landmarks have names.
    let is_nameless = told.iter().all(|row| row.name.is_empty());
    let names = if is_nameless {
        names.trim_start_matches("name,")
    } else {
        names
    };
    let width = told.iter().map(|row| row.rest.len()).max().unwrap_or(0);
    let more = (0..width).map(|column| match column {
        0 => ",z".to_owned(),
        column => format!(",value {}", column + 4),
    });
    let mut text = names.to_owned() + &more.collect::<String>();
    for row in &rows {
        text.push('\n');
        if let Some(Some(row)) = row {
            let cells = cells(
                &ReferenceSystem::Geographic,
                &row.name,
                &row.x,
                &row.y,
                &row.rest,
            );
            text.push_str(if is_nameless {
                cells.trim_start_matches("\"\",")
            } else {
                &cells
            });
        }
    }
    let why = if is_open {
        ", as Pix4D has it; nothing tells, so write `name,longitude,latitude` above it if it is the second, as Metashape has it"
    } else {
        ", as the other one is beyond 90"
    };
    let notes = vec![format!("no line names its columns: {order}{why}")];
    Ok(Some(NamedTable {
        text: text + "\n",
        added: 1,
        notes,
    }))
}

#[cfg(test)]
mod tests {
    use super::super::csv_read::read;
    use super::super::{Format, read_any};

    /// Names and places of a table, longitude first.
    fn places(table: &str) -> Vec<(String, f64, f64)> {
        let found = read("a.txt", table).unwrap_or_else(|error| panic!("{table}: {error}"));
        assert!(found.routes.is_empty(), "{table}");
        let landmarks = found.landmarks.into_iter();
        landmarks
            .map(|landmark| {
                let (longitude, latitude) = landmark.reference.unwrap();
                (landmark.name.unwrap(), longitude, latitude)
            })
            .collect()
    }

    fn assert_at(table: &str, right: &[(&str, f64, f64)]) {
        let found = places(table);
        assert_eq!(found.len(), right.len(), "{table}: {found:?}");
        for ((name, longitude, latitude), (other, x, y)) in found.iter().zip(right) {
            let off = (longitude - x).hypot(latitude - y);
            assert!(name == other && off < 3e-7, "{table}: {found:?}");
        }
    }

    #[test]
    fn marks_of_djis_photos_are_landmarks() {
        let mark = |number: u32, latitude: &str| {
            let rest = "400373.488877\t[2264]\t  -40,N\t    0,E\t  86,V";
            format!(
                "{number}\t{rest}\t{latitude},Lat\t-1.26196331,Lon\t359.494,Ellh\t0.028, 0.031, 0.055\t16,Q\n"
            )
        };
        let found = places(&(mark(1, "-44.42824637") + &mark(2, "-44.42834637")));
        let right = [
            ("mark 1".to_owned(), -1.261_963_31, -44.428_246_37),
            ("mark 2".to_owned(), -1.261_963_31, -44.428_346_37),
        ];
        assert_eq!(found, right);
    }

    #[test]
    fn a_height_may_lack_before_a_name() {
        let found = places("-28.606309,41.491196,85.9,a,x\n-28.605513,41.492136,,b,y\n");
        let right = [
            ("a".to_owned(), 41.491_196, -28.606_309),
            ("b".to_owned(), 41.492_136, -28.605_513),
        ];
        assert_eq!(found, right);
    }

    #[test]
    fn control_points_of_open_drone_map_are_landmarks_once_each() {
        // Places by pyproj.
        let row = "465429.756 5246517.201 410.5 1200 800 IMG_1.JPG a\n";
        let again = "465429.756 5246517.201 410.5 300 200 IMG_2.JPG a\n";
        let right = [("a", 8.5421, 47.3712)];
        for system in [
            "EPSG:32632",
            "WGS84 UTM 32N",
            "+proj=utm +zone=32 +datum=WGS84 +units=m",
        ] {
            assert_at(&format!("{system}\n{row}{again}"), &right);
        }
        let south = "360505.620 6303362.288 1 2 3 a.jpg\n360505.620 6303362.288 1 9 9 b.jpg\n";
        let of_south = format!("+proj=utm +zone=19 +south +datum=WGS84\n{south}");
        assert_at(&of_south, &[("point 1", -70.5, -33.4)]);
        assert_at(
            "EPSG:4326\n8.5421\t47.3712\t410\t1\t2\ta.jpg\n",
            &[("point 1", 8.5421, 47.3712)],
        );
    }

    #[test]
    fn places_of_photos_are_landmarks_of_their_names() {
        let right = [("a.jpg", 8.5421, 47.3712), ("b.jpg", 8.5421, 47.3712)];
        assert_at(
            "EPSG:4326\na.jpg 8.5421 47.3712 410\nb.jpg 8.5421 47.3712 410 1 2 3 4 5\n",
            &right,
        );
        let utm = "EPSG:32632\na.jpg 465429.756 5246517.201\nb.jpg 465429.756 5246517.201 3\n";
        assert_at(utm, &right);
    }

    #[test]
    fn tables_without_names_of_columns_are_read_by_their_values() {
        let near = [("a b", 8.5421, 47.3712)];
        for table in [
            "a b,47.3712,8.5421,410.5\n",
            "\"a b\",47.3712,8.5421,410.5,0.1,0.2\n",
            "a b;47,3712;8,5421;410,5\n",
            "47.3712\t8.5421\ta b\n",
            "47.3712 8.5421 a b\n",
            "47.3712,8.5421,a b,12\n",
            "a b,47.3712N,8.5421E\n",
            "a b,8.5421 E,47.3712 N\n",
            "47.3712N;8.5421E;a b\n",
            "# points\n\n47.3712,8.5421,410.5,a b\n",
        ] {
            assert_at(table, &near);
            assert_eq!(
                Format::of("a.txt", table.as_bytes()),
                Some(Format::Csv),
                "{table}"
            );
        }
        let east = [("a", 151.2, -33.851), ("b", 151.3, -33.852)];
        assert_at("a,-33.851,151.200\nb,-33.852,151.300\n", &east);
        assert_at("a,151.200,-33.851\nb,151.300,-33.852\n", &east);
    }

    #[test]
    fn names_of_columns_may_stand_between_blanks() {
        assert_at(
            "# x\nname  lat lon\nA 47.3712   8.5421\n",
            &[("A", 8.5421, 47.3712)],
        );
        // Mission Planner's places of photos.
        let photos = read(
            "location.txt",
            "#name latitude/Y longitude/X height/Z yaw pitch roll SAlt\na.jpg 47.3712 8.5421 123.5 3 2 1 0\n",
        )
        .unwrap();
        assert_eq!(photos.landmarks[0].reference, Some((8.5421, 47.3712)));
        assert_eq!(photos.landmarks[0].properties["yaw"], "\"3\"");
        for text in [
            "name lat lon\nA b 47.3712 8.5421\n",
            "one two three\n1 2 3\n",
        ] {
            assert!(!super::is_bare(text), "{text}");
        }
    }

    #[test]
    fn pairs_of_numbers_alone_are_a_route_over_their_places() {
        let found = read("a.csv", "47.3712,8.5421\n47.3722,8.5431\n").unwrap();
        let places: Vec<_> = found.routes[0]
            .way_points
            .iter()
            .map(|(place, _)| *place)
            .collect();
        assert_eq!(places, [(8.5421, 47.3712), (8.5431, 47.3722)]);
    }

    #[test]
    fn a_reference_table_of_metashape_is_read_in_its_zone() {
        let table = "# CoordinateSystem: PROJCS[\"WGS 84 / UTM zone 32N\",GEOGCS[\"WGS 84\"]]\n\
                     #Label,X/Easting,Y/Northing,Z/Altitude\na,465429.756,5246517.201,410.5\n";
        assert_at(table, &[("a", 8.5421, 47.3712)]);
    }

    #[test]
    fn what_has_no_known_system_is_refused_with_what_to_do() {
        for (table, words) in [
            ("EPSG:2056\n2683000 1247000 400 1 2 a.jpg\n", "EPSG:2056"),
            ("a,465429.756,5246517.201,410.5\n", "zone of UTM"),
        ] {
            let told = read_any("a.txt", table.as_bytes(), None)
                .unwrap_err()
                .to_string();
            assert!(told.contains(words) && told.contains("line 1"), "{told}");
        }
    }

    #[test]
    fn tables_with_names_times_or_other_numbers_are_no_such() {
        for text in [
            "name,lat,lon\na,47.3712,8.5421\n",
            "2024-05-01T10:00:00,47.3712,8.5421\n",
            "10:00:00,47.3712,8.5421\n",
            "$GPGGA,100000.00,4717.1132\n",
            "a,1,2\nb,3,4\n",
            "QGC WPL 110\n",
            "47.3712 8.5421\n47.3713 8.5422\n",
            "47.3,8.5\n47.4,8.5\n",
            "a,47.3712,8.5421\nb,c,d\n",
            "# WGS 84\n#Label,X/Longitude,Y/Latitude\na,8.5421,47.3712\n",
            "#Label,X/Easting,Y/Northing\na,465429.756,5246517.201\n",
        ] {
            assert!(!super::is_bare(text), "{text}");
        }
    }
}
