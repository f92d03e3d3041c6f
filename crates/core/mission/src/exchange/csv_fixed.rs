//! Tables of places whose columns stand in the order of one program and have no names: way-points of `OziExplorer`, points of
//! Little Navmap, fences of old autopilots. They are given the names that other tables have.

use pilotage_base::text::csv_cell;

use super::csv_named::NamedTable;
use crate::mission::found::on_globe;

/// First words of a file of `OziExplorer`'s way-points, and the lines before these.
const OZI: &str = "oziexplorer waypoint file";
const OZI_HEAD: usize = 4;
/// Height that `OziExplorer` writes for one that is not known, feet.
const OZI_UNKNOWN: f64 = -777.0;
/// Decimals of a latitude or longitude.
const DECIMALS: usize = 3;

/// The table with names of its columns, where it is one of these.
///
/// # Errors
/// Its places are on a datum that is not known; in words.
pub(super) fn fixed(content: &str) -> Result<Option<NamedTable>, String> {
    if content.trim_start().to_lowercase().starts_with(OZI) {
        return of_ozi_explorer(content).map(Some);
    }
    let found = of_little_navmap(content).or_else(|| of_fence(content));
    Ok(found
        .or_else(|| of_osmosis(content))
        .or_else(|| of_geonames(content)))
}

fn cells_of(line: &str) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    record.iter().flatten().map(str::to_owned).collect()
}

/// A latitude and longitude with decimals, as they stand.
fn place<'a>(latitude: &'a str, longitude: &'a str) -> Option<[&'a str; 2]> {
    let number = |text: &str| {
        let decimals = text.split_once('.').map_or(0, |(_, rest)| rest.len());
        text.parse::<f64>().ok().filter(|_| decimals >= DECIMALS)
    };
    on_globe(number(longitude)?, number(latitude)?).then_some([latitude, longitude])
}

/// `number,name,latitude,longitude,…`, of which the eleventh is a description and the fifteenth the height in feet.
fn of_ozi_explorer(content: &str) -> Result<NamedTable, String> {
    let datum = content.lines().nth(1).unwrap_or("").trim();
    if !["wgs84", "wgs 84"].contains(&datum.to_lowercase().as_str()) {
        return Err(format!(
            "its places are on the datum `{datum}`, which is not read here: save it on WGS 84"
        ));
    }
    let row = |line: &str| {
        let cells = cells_of(line);
        let [latitude, longitude] = place(cells.get(2)?, cells.get(3)?)?;
        let feet = cells.get(14).and_then(|feet| feet.parse::<f64>().ok());
        let feet = feet.filter(|feet| *feet != OZI_UNKNOWN);
        let row = [
            csv_cell(cells.get(1)?),
            latitude.to_owned(),
            longitude.to_owned(),
            feet.map_or_else(String::new, |feet| feet.to_string()),
            // Commas stand there as Ñ, written in one byte.
            csv_cell(cells.get(10).map_or("", String::as_str)),
        ];
        Some(row.join(","))
    };
    let rows = content.lines().skip(OZI_HEAD);
    let rows: Vec<String> = rows.map(|line| row(line).unwrap_or_default()).collect();
    let before = "\n".repeat(OZI_HEAD - 1);
    Ok(NamedTable {
        text: format!(
            "{before}name,latitude,longitude,z [ft],description\n{}\n",
            rows.join("\n")
        ),
        added: 0,
        notes: vec!["it is read as way-points of OziExplorer, on WGS 84".to_owned()],
    })
}

/// `type,name,ident,latitude,longitude,elevation,declination,…` in every line.
fn of_little_navmap(content: &str) -> Option<NamedTable> {
    let row = |line: &str| {
        let cells = cells_of(line);
        let [
            kind,
            name,
            ident,
            latitude,
            longitude,
            feet,
            declination,
            ..,
        ] = &cells[..]
        else {
            return None;
        };
        place(latitude, longitude)?;
        let is_word = kind.chars().all(|c| c.is_alphabetic() || c == ' ') && !kind.is_empty();
        let are_numbers = [feet, declination]
            .iter()
            .all(|n| n.is_empty() || n.parse::<f64>().is_ok());
        let name = if name.is_empty() { ident } else { name };
        let is_name = name.parse::<f64>().is_err();
        (is_word && are_numbers && is_name).then(|| {
            let cells = [
                csv_cell(name),
                latitude.clone(),
                longitude.clone(),
                feet.clone(),
                csv_cell(kind),
            ];
            cells.join(",")
        })
    };
    let lines = content.lines();
    let rows: Option<Vec<String>> = lines
        .map(|line| {
            if line.trim().is_empty() {
                Some(String::new())
            } else {
                row(line)
            }
        })
        .collect();
    let rows = rows.filter(|rows| rows.iter().any(|row| !row.is_empty()))?;
    Some(NamedTable {
        text: format!("name,latitude,longitude,z [ft],type\n{}\n", rows.join("\n")),
        added: 1,
        notes: vec![
            "no line names its columns: it is read as points of Little Navmap, whose elevations are feet".to_owned(),
        ],
    })
}

/// Latitudes and longitudes between blanks: the place to return to, and behind it the corners of the fence, of which the
/// first closes it once more.
fn of_fence(content: &str) -> Option<NamedTable> {
    let is_saved = content.trim_start().to_lowercase().starts_with("#saved by");
    let is_told = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let row = |line: &str| {
        let cells: Vec<&str> = line.split_whitespace().collect();
        let &[latitude, longitude] = &cells[..] else {
            return None;
        };
        // Numbers below those words are places however many decimals they have.
        let is_place = || on_globe(longitude.parse().ok()?, latitude.parse().ok()?).then_some(());
        if !is_saved || is_place().is_none() {
            place(latitude, longitude)?;
        }
        Some(format!("{longitude} {latitude}"))
    };
    let rows: Option<Vec<String>> = content.lines().filter(is_told).map(row).collect();
    let rows = rows?;
    let (first, corners) = rows.split_first()?;
    if is_saved && rows.len() > 3 && first == &rows[rows.len() - 1] {
        return Some(NamedTable {
            text: format!("name,wkt\nPolygon,\"POLYGON (({}))\"\n", rows.join(", ")),
            added: 0,
            notes: vec!["it is read as a polygon of Mission Planner".to_owned()],
        });
    }
    let is_closed = corners.len() > 3 && corners.first() == corners.last();
    if is_saved && !is_closed && corners.len() > 1 {
        return Some(NamedTable {
            text: format!(
                "name,wkt\nPolygon,\"POLYGON (({}, {first}))\"\n",
                rows.join(", ")
            ),
            added: 0,
            notes: vec![
                "it is read as a polygon of Mission Planner, which its last place does not close: a side from there to the \
                 first is added"
                    .to_owned(),
            ],
        });
    }
    if !is_closed || corners.last() == Some(first) {
        return None;
    }
    Some(NamedTable {
        text: format!(
            "name,wkt\nFence,\"POLYGON (({}))\"\nReturn point,\"POINT ({first})\"\n",
            corners.join(", ")
        ),
        added: 0,
        notes: vec![
            "it is read as a fence of ArduPilot from before 2020: the first place is the one to return to, and the others are \
             the corners of the area that the aircraft keeps in, which is no no-fly area"
                .to_owned(),
        ],
    })
}

/// Polygons as Osmosis and Geofabrik write them (`.poly`): a name, and rings between a name and `END`, of which those whose
/// name begins with `!` are holes of the one before.
fn of_osmosis(content: &str) -> Option<NamedTable> {
    let mut lines = content
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty());
    let name = lines
        .next()
        .filter(|name| !name.contains([',', ';', '\t']))?;
    let mut polygons: Vec<Vec<String>> = Vec::new();
    while let Some(ring) = lines.next().filter(|line| *line != "END") {
        let mut corners = Vec::new();
        // A list of places that does not end so is another program's, who may write the latitude first.
        loop {
            let line = lines.next()?;
            if line == "END" {
                break;
            }
            let mut numbers = line.split_ascii_whitespace().map(str::parse::<f64>);
            let (Some(Ok(longitude)), Some(Ok(latitude)), None) =
                (numbers.next(), numbers.next(), numbers.next())
            else {
                return None;
            };
            on_globe(longitude, latitude).then_some(())?;
            corners.push(format!("{longitude} {latitude}"));
        }
        if corners.len() < 3 {
            return None;
        }
        let ring_text = format!("({}, {})", corners.join(", "), corners[0]);
        match polygons.last_mut() {
            Some(polygon) if ring.starts_with('!') => polygon.push(ring_text),
            _ => polygons.push(vec![ring_text]),
        }
    }
    let rows = polygons
        .iter()
        .map(|rings| format!("{},\"POLYGON ({})\"\n", csv_cell(name), rings.join(", ")));
    let rows: String = rows.collect();
    (!rows.is_empty()).then(|| NamedTable {
        text: format!("name,wkt\n{rows}"),
        added: 0,
        notes: vec!["it is read as polygons of Osmosis".to_owned()],
    })
}

/// Places as `GeoNames` has them, in nineteen cells between tabulators.
fn of_geonames(content: &str) -> Option<NamedTable> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        if cells.len() != 19 {
            return None;
        }
        let place = on_globe(cells[5].parse().ok()?, cells[4].parse().ok()?);
        let is_class = matches!(cells[6].as_bytes(), [b'A'..=b'Z']);
        let is_number = cells[0].bytes().all(|b| b.is_ascii_digit()) && !cells[0].is_empty();
        (place && is_class && is_number).then(|| {
            [
                csv_cell(cells[1]),
                cells[4].to_owned(),
                cells[5].to_owned(),
                cells[7].to_owned(),
            ]
            .join(",")
        })
    };
    let rows: Option<Vec<String>> = content.lines().map(row).collect();
    let rows = rows.filter(|rows| !rows.is_empty())?;
    Some(NamedTable {
        text: format!("name,latitude,longitude,feature\n{}\n", rows.join("\n")),
        added: 1,
        notes: vec!["it is read as places of GeoNames".to_owned()],
    })
}

#[cfg(test)]
mod tests {
    use super::super::csv_read::read;
    use super::super::read_any;
    use crate::mission::found::LandmarkExtent;

    const OZI: &str = "OziExplorer Waypoint File Version 1.1\r\nWGS 84\r\nReserved 2\r\nReserved 3\r\n\
        1,WP1   , -33.850000,  18.420000,39123.1234567, 0, 1, 3, 0, 65535,The well, 0, 0, 0,   328,6, 0,17\r\n\
        2,WP2   , -33.851000,  18.421000,39123.1234567, 0, 1, 3, 0, 65535,, 0, 0, 0, -777,6, 0,17\r\n";

    #[test]
    fn way_points_of_ozi_explorer_are_landmarks_on_wgs_84() {
        let found = read_any("a.wpt", OZI.as_bytes(), None).unwrap();
        let names: Vec<_> = found.landmarks.iter().map(|l| l.name.as_str()).collect();
        assert_eq!(names, ["WP1", "WP2"]);
        let place = found
            .frame
            .geodetic_from_ground(&found.landmarks[1].reference);
        assert!((place.latitude.to_degrees() + 33.851).abs() < 1e-9);
        assert!((place.longitude.to_degrees() - 18.421).abs() < 1e-9);
        let other = OZI.replace("WGS 84", "Cape");
        let told = read_any("a.wpt", other.as_bytes(), None)
            .unwrap_err()
            .to_string();
        assert!(told.contains("`Cape`"), "{told}");
    }

    #[test]
    fn points_of_little_navmap_are_landmarks_without_a_line_of_names() {
        let text = "VRP,\"Table, top\",TT,-33.8500,18.4200,3500,-25.1,,\"A mountain\",,150,2024-05-01T10:00:00\n\
                    POI,,X1,-33.8510,18.4210,,,,,,150,\n";
        let found = read("a.csv", text).unwrap();
        let places: Vec<_> = found
            .landmarks
            .iter()
            .map(|l| l.reference.unwrap())
            .collect();
        assert_eq!(places, [(18.42, -33.85), (18.421, -33.851)]);
        assert_eq!(found.landmarks[0].name.as_deref(), Some("Table, top"));
        assert_eq!(found.landmarks[1].name.as_deref(), Some("X1"));
    }

    #[test]
    fn polygons_of_mission_planner_and_osmosis_and_places_of_geonames_are_landmarks() {
        let polygon = "#saved by Mission Planner 1.3.38\n-35.362 149.164\n-35.362 149.168\n-35.365 149.168\n-35.362 149.164\n";
        let osmosis = "australia_v\n1\n   0.149164E+03    -0.35362E+02\n   0.149168E+03    -0.35362E+02\n   0.149168E+03    -0.35365E+02\nEND\n\
                       !2\n 149.166 -35.363\n 149.167 -35.363\n 149.167 -35.364\nEND\nEND\n";
        // All numbers may be latitudes.
        let europe =
            read_landmark("#saved by Mission Planner 1.3.80\n47 8\n47 8.001\n47.001 8.001\n47 8\n");
        let LandmarkExtent::Corners(corners) = europe.extent else {
            panic!("Europe");
        };
        assert_eq!(corners[2], (8.001, 47.001));
        // Its last corner was taken out by hand.
        for line_end in ["\n", "\r\n"] {
            let open =
                format!("#saved by Mission Planner 1.3.80\n47 8\n47 8.1\n47.1 8.1{line_end}");
            let read = read_any("open.poly", open.as_bytes(), None).unwrap();
            assert!(
                read.notes
                    .iter()
                    .any(|note| note.contains("does not close")),
                "{:?}",
                read.notes
            );
            let LandmarkExtent::Corners(corners) = read_landmark(&open).extent else {
                panic!("open");
            };
            assert_eq!(
                (corners.len(), corners[2], corners[3]),
                (4, (8.1, 47.1), (8.0, 47.0))
            );
        }
        for (name, text, holes) in [("a.poly", polygon, 0), ("b.poly", osmosis, 1)] {
            let read = read_any(name, text.as_bytes(), None).unwrap();
            assert_eq!(read.landmarks.len(), 1, "{name}");
            let found = read_landmark(text);
            let LandmarkExtent::Corners(corners) = found.extent else {
                panic!("{name}");
            };
            assert_eq!(corners[2], (149.168, -35.365));
            assert_eq!(found.holes.len(), holes);
        }
        let geonames = "2657896\tZürich\tZurich\tZRH\t47.36667\t8.55\tP\tPPLA\tCH\t\tZH\t112\t261\t\t341730\t\t429\tEurope/Zurich\t2019-03-06\n";
        let found = read_landmark(geonames);
        assert_eq!(found.name.as_deref(), Some("Zürich"));
        assert_eq!(found.reference, Some((8.55, 47.366_67)));
    }

    fn read_landmark(text: &str) -> crate::mission::found::FoundLandmark {
        read("a.txt", text).unwrap().landmarks.remove(0)
    }

    #[test]
    fn a_fence_of_old_autopilots_is_its_area() {
        let text = "#saved by APM Planner 1.0\n-35.363\t149.165\n-35.360\t149.160\n-35.360\t149.170\n\
                    -35.366\t149.170\n-35.360\t149.160\n";
        let found = read_any("fence.txt", text.as_bytes(), None).unwrap();
        assert!(found.routes.is_empty() && found.no_fly.is_empty());
        let found = read("fence.txt", text).unwrap();
        let LandmarkExtent::Corners(corners) = &found.landmarks[0].extent else {
            panic!("no area");
        };
        assert_eq!(corners[1], (149.17, -35.36));
        assert!(matches!(
            found.landmarks[1].extent,
            LandmarkExtent::Point((149.165, -35.363))
        ));
        let europe = "#saved by APM Planner 1.3\n47.0005 8.0005\n47 8\n47.001 8\n47.001 8.001\n47 8.001\n47 8\n";
        let found = read("fence.fen", europe).unwrap();
        assert!(matches!(
            found.landmarks[1].extent,
            LandmarkExtent::Point((8.0005, 47.0005))
        ));
        // A way that is walked round and back is a route.
        let walk = "-35.360\t149.160\n-35.361\t149.161\n-35.362\t149.162\n-35.363\t149.163\n-35.360\t149.160\n";
        assert!(super::of_fence(walk).is_none());
    }
}
