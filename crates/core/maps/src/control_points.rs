//! Control points, places of photos of `OpenDroneMap` and Metashape and GeoJSON in systems that readers of missions do not know,
//! brought to degrees on WGS 84.

use pilotage_base::frames::ReferenceSystem;
use pilotage_base::text::csv_cell;
use pilotage_mission::exchange::cells_of_row;

use crate::geojson_system::geojson_in_degrees;
use crate::grid_columns::{grid_in_degrees, named_in_degrees};
use crate::systems::by_name;

/// Lines among which the names of Metashape's columns stand.
const HEAD: usize = 10;

/// The table with degrees in the place of its coordinates, and sentences on what they were; `None` where its first line names
/// no system, or one in which it is read as it stands.
///
/// ```
/// use pilotage_maps::places_in_degrees;
///
/// let (text, notes) = places_in_degrees("EPSG:2193\n1576041.15 5189200.5 12.5 640 480 a.jpg p\n").unwrap();
/// assert_eq!(text, "EPSG:4326\n172.7038878651 -43.4497156338 12.5 640 480 a.jpg p\n");
/// assert!(notes[0].contains("Transverse Mercator"), "{notes:?}");
/// assert!(places_in_degrees("EPSG:32632\n500000 5000000 1 640 480 a.jpg p\n").is_none());
/// ```
pub fn places_in_degrees(text: &str) -> Option<(String, Vec<String>)> {
    if let Some(found) = geojson_in_degrees(text) {
        return Some(found);
    }
    let first = text.lines().next()?.trim();
    let remark = first.strip_prefix('#').map(str::trim_start);
    let found = match remark.and_then(|remark| remark.split_once(':')) {
        Some((before, name)) if before.trim() == "CoordinateSystem" => {
            let system = by_name(name).ok()?;
            (of_metashape(text, &system)?, system, None)
        }
        None if is_system(first) => {
            let system = by_name(first).ok()?;
            let rest = text.split_once('\n')?.1;
            let named = named_in_degrees(rest, &system);
            let found =
                named.or_else(|| is_name(first).then(|| of_open_drone_map(text, &system))?);
            (found?, system, None)
        }
        _ => grid_in_degrees(text)?,
    };
    let (text, system, more) = found;
    let mut notes = vec![format!("its places are read in {}", system.name())];
    notes.extend(system.note());
    notes.extend(more);
    Some((text, notes))
}

/// Whether a line names a system of metres by its code or its projection.
fn is_system(line: &str) -> bool {
    let lower = line.to_lowercase();
    lower.starts_with("epsg:") || lower.starts_with("+proj=") && !lower.contains("+proj=longlat")
}

/// Whether a line names a system as `OpenDroneMap` has it, and none of WGS 84.
fn is_name(line: &str) -> bool {
    let lower = line.to_lowercase();
    match lower.strip_prefix("epsg:") {
        Some(code) => code
            .trim()
            .parse()
            .is_ok_and(|code| ReferenceSystem::from_epsg(code).is_none()),
        None => lower.starts_with("+proj=") && !lower.contains("+proj=longlat"),
    }
}

/// Longitude and latitude of two cells, degrees.
fn degrees(system: &ReferenceSystem, x: &str, y: &str) -> Option<[String; 2]> {
    let place = system.geodetic(x.parse().ok()?, y.parse().ok()?)?;
    Some([place.longitude, place.latitude].map(|angle| format!("{:.10}", angle.to_degrees())))
}

/// `x y z pixel pixel picture name`, or `picture x y z yaw pitch roll`.
fn of_open_drone_map(text: &str, system: &ReferenceSystem) -> Option<String> {
    let mut has_places = false;
    let line = |line: &str| {
        let seam = |c: char| c.is_whitespace() || c == ',' || c == ';';
        let mut cells: Vec<&str> = line.split(seam).filter(|cell| !cell.is_empty()).collect();
        let from = usize::from(
            cells
                .first()
                .is_some_and(|cell| cell.parse::<f64>().is_err()),
        );
        let pair = cells.get(from).zip(cells.get(from + 1));
        let place = pair.and_then(|(x, y)| degrees(system, x, y));
        if let Some([longitude, latitude]) = place.as_ref().filter(|_| !line.starts_with('#')) {
            has_places = true;
            (cells[from], cells[from + 1]) = (longitude, latitude);
        }
        cells.join(" ") + "\n"
    };
    let rows: String = text.lines().skip(1).map(line).collect();
    has_places.then(|| format!("EPSG:4326\n{rows}"))
}

/// `#Label,X/Easting,Y/Northing,Z/Altitude` and its rows, as a table with commas.
fn of_metashape(text: &str, system: &ReferenceSystem) -> Option<String> {
    let of = |name: &str, wanted: &str| name.eq_ignore_ascii_case(wanted);
    let found = text.lines().take(HEAD).find_map(|line| {
        let seam = [',', ';', '\t'].into_iter().find(|c| line.contains(*c))?;
        let names = cells_of_row(line, seam);
        let find = |wanted: &str| names.iter().position(|name| of(name, wanted));
        let (x, y) = (find("X/Easting")?, find("Y/Northing")?);
        Some((line, seam, names, [x, y]))
    });
    let (head, seam, mut names, [x, y]) = found?;
    "X/Longitude".clone_into(&mut names[x]);
    "Y/Latitude".clone_into(&mut names[y]);
    let mut has_places = false;
    let line = |line: &str| {
        if line == head {
            return names.join(",") + "\n";
        }
        if line.starts_with('#') {
            return line.to_owned() + "\n";
        }
        let mut cells = cells_of_row(line, seam);
        let pair = cells.get(x).zip(cells.get(y));
        if let Some([longitude, latitude]) = pair.and_then(|(x, y)| degrees(system, x, y)) {
            has_places = true;
            (cells[x], cells[y]) = (longitude, latitude);
        }
        let cells: Vec<String> = cells.iter().map(|cell| csv_cell(cell)).collect();
        cells.join(",") + "\n"
    };
    let rows: String = text.lines().skip(1).map(line).collect();
    has_places.then(|| format!("# CoordinateSystem: WGS 84 (EPSG::4326)\n{rows}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> String {
        let (text, _) = places_in_degrees(text).unwrap();
        text.lines().skip(1).collect::<Vec<_>>().join("\n")
    }

    /// Places by pyproj 3.7.
    #[test]
    fn national_systems_become_degrees() {
        let photo = rows("EPSG:25832\na.jpg\t514521.45\t6681455.436\t220.1 173.5 -12 0\n");
        assert_eq!(photo, "a.jpg 9.2624835003 60.2695102741 220.1 173.5 -12 0");
        let table = rows("EPSG:32632\nname,E,N\nA,500000,5000000\n");
        assert!(
            table.starts_with("name,Longitude,Latitude\nA,9.0000000000,45.15"),
            "{table}"
        );
        let table = "#CoordinateSystem: EPSG::25832\n#Label,X/Easting,Y/Northing,Z/Altitude\n924-01,514521.45,6681455.436,220.1\n";
        let right =
            "#Label,X/Longitude,Y/Latitude,Z/Altitude\n924-01,9.2624835003,60.2695102741,220.1";
        assert_eq!(rows(table), right);
        // Seams within quotation marks, decimal commas, names in other letters.
        for (table, label) in [
            (
                "#CoordinateSystem: EPSG::25832\n#Label,X/Easting,Y/Northing,Z/Altitude\n\"P, 1\",514521.45,6681455.436,220.1\n",
                "\"P, 1\"",
            ),
            (
                "#CoordinateSystem: EPSG::25832\n#Label;X/easting;Y/northing;Z/Altitude\nP 1;514521,45;6681455,436;220,1\n",
                "P 1",
            ),
        ] {
            assert_eq!(rows(table), right.replace("924-01", label));
        }
    }

    #[test]
    fn what_is_known_elsewhere_or_nowhere_stays() {
        for text in [
            "",
            "EPSG:4326\n8 47 400 1 2 a.jpg\n",
            "WGS84 UTM 32N\n500000 5000000 400 1 2 a.jpg\n",
            "EPSG:999999\n1 2 3 4 5 a.jpg\n",
            "EPSG:2193\nname,lat,lon\n",
            "#Label,X/Easting,Y/Northing,Z/Altitude\na,1,2,3\n",
            "name,latitude,longitude\na,47,8\n",
        ] {
            assert_eq!(places_in_degrees(text), None, "{text}");
        }
    }
}
