//! Positions that RTKLIB computed, as receivers of Emlid save them: without a line of names, and as baselines from a station.

use nalgebra::Point3;
use pilotage_base::frames::{Geodetic, LocalFrame};

use super::table_text::{joined, solution_cells, solution_separator};

/// Names of the first of three coordinates of a baseline.
const BASELINE: &str = "e-baseline(m)";
/// Names behind the time.
const NAMES: &str = "latitude(deg) longitude(deg) height(m) Q ns sdn(m) sde(m) sdu(m) sdne(m) sdeu(m) sdun(m) age(s) ratio";
/// Greatest number of the quality of a position, and of satellites.
const QUALITIES: std::ops::RangeInclusive<u8> = 0..=7;

/// The line of names of a table that has none, if its first line is a position: date and time, or week and seconds of it,
/// latitude, longitude, height, quality, satellites, and what they are good for.
pub(super) fn missing_names(text: &[u8]) -> Option<String> {
    let line = text
        .split(|b| *b == b'\n')
        .find(|line| !line.trim_ascii().is_empty())?;
    let line = std::str::from_utf8(line).ok()?;
    let separator = solution_separator(line);
    let cells = solution_cells(line.trim(), separator);
    let number = |at: usize| cells.get(at).and_then(|cell| cell.parse::<f64>().ok());
    let is_day = |cell: &str| {
        let parts: Vec<&str> = cell.split('/').collect();
        parts.len() == 3
            && parts[0].len() == 4
            && parts.iter().all(|part| part.parse::<u16>().is_ok())
    };
    let is_clock = |cell: &str| cell.split(':').count() == 3;
    // Date and time may be one cell.
    let (names, first) = match cells.first()?.split_once(' ') {
        Some((day, clock)) if is_day(day) && is_clock(clock) => ("GPST", 1),
        None if is_day(&cells[0]) && cells.get(1).is_some_and(|cell| is_clock(cell)) => ("GPST", 2),
        None if number(0)
            .is_some_and(|week| (1000.0..4096.0).contains(&week) && week.fract() == 0.0)
            && number(1).is_some_and(|second| (0.0..=604_800.0).contains(&second)) =>
        {
            ("GPST", 2)
        }
        _ => return None,
    };
    let small = |at: usize| cells.get(at).and_then(|cell| cell.parse::<u8>().ok());
    let is_position = number(first).is_some_and(|latitude| latitude.abs() <= 90.0)
        && number(first + 1).is_some_and(|longitude| longitude.abs() <= 180.0)
        && number(first + 2).is_some()
        && small(first + 3).is_some_and(|quality| QUALITIES.contains(&quality))
        && small(first + 4).is_some()
        && (8..=14).all(|at| at >= first + 13 || number(at).is_some());
    let count = cells.len().checked_sub(first)?;
    let told: Vec<&str> = NAMES.split(' ').collect();
    if !is_position || !(8..=told.len()).contains(&count) {
        return None;
    }
    Some(format!(
        "%{names}{separator}{}\n",
        told[..count].join(separator)
    ))
}

/// Whether the heights of a solution are above the ellipsoid, as its head or its coordinates say: RTKLIB's are unless
/// asked otherwise.
pub(crate) fn are_above_ellipsoid(text: &[u8]) -> bool {
    let text = &text[..text.len().min(1 << 14)];
    if missing_names(text).is_some() {
        return true;
    }
    let lines = text
        .split(|b| *b == b'\n')
        .take_while(|line| line.starts_with(b"%"));
    let head: String = lines
        .map(|line| String::from_utf8_lossy(line).into_owned())
        .collect();
    ["/ellipsoidal", "x-ecef(m)", BASELINE]
        .iter()
        .any(|word| head.contains(word))
}

/// Latitude, longitude and height for baselines from the station that the head names; `None` where it names none.
pub(super) fn of_baselines(text: &str) -> Option<String> {
    let mut head = text.lines().take_while(|line| line.starts_with('%'));
    let station = head.clone().find_map(|line| {
        let numbers = line
            .trim_start_matches('%')
            .trim()
            .strip_prefix("ref pos")?;
        let numbers = numbers.trim_start().strip_prefix(':')?.split_whitespace();
        let numbers: Option<Vec<f64>> = numbers.map(|n| n.parse().ok()).collect();
        <[f64; 3]>::try_from(numbers?).ok()
    })?;
    let is_geodetic = station[0].abs() <= 90.0 && station[1].abs() <= 180.0;
    let names = head
        .find(|line| line.contains(BASELINE))
        .filter(|_| is_geodetic)?;
    let frame = LocalFrame::new(Geodetic::from_degrees(station[0], station[1], station[2]));
    let separator = solution_separator(names);
    let columns = solution_cells(names.trim_start_matches('%'), separator);
    let first = columns.iter().position(|name| name == BASELINE)?;
    let line = |line: &str| {
        if line.starts_with('%') {
            let names = line
                .replace(BASELINE, "latitude(deg)")
                .replace("n-baseline(m)", "longitude(deg)")
                .replace("u-baseline(m)", "height(m)");
            return names;
        }
        let mut cells = solution_cells(line, separator);
        // Date and time of day have one name.
        let at = first + cells.len().saturating_sub(columns.len());
        let number = |index: usize| cells.get(index)?.parse::<f64>().ok();
        let Some(((east, north), up)) = number(at).zip(number(at + 1)).zip(number(at + 2)) else {
            return line.to_owned();
        };
        let place = frame.geodetic_from_world(&Point3::new(north, east, -up));
        cells[at] = format!("{:.10}", place.latitude.to_degrees());
        cells[at + 1] = format!("{:.10}", place.longitude.to_degrees());
        cells[at + 2] = format!("{:.4}", place.height);
        cells.join(separator)
    };
    Some(joined(text.lines().map(line)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_given_to_positions_alone() {
        let quality = "1 12 0.012 0.009 0.03 0.001 0.001 0.001 0.8 20.5";
        for line in [
            format!("2024/05/01 10:00:00.000  -33.85 151.2 40.1 {quality}"),
            format!("2312 208818.000  -33.85 151.2 40.1 {quality}"),
            format!(
                "2024/05/01,10:00:00.000,-33.85,151.2,40.1,{}",
                quality.replace(' ', ",")
            ),
        ] {
            let names = missing_names(line.as_bytes()).unwrap_or_else(|| panic!("{line}"));
            assert!(
                names.contains("latitude(deg)") && names.ends_with("ratio\n"),
                "{names}"
            );
        }
        for line in [
            "",
            "%",
            "a b c",
            "2024/05/01 10:00:00 1 2 3",
            "2000 100 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16",
            "2024/05/01 10:00:00 -33.85 151.2 40.1 5.5 120.3 1 2 3 4 5 6 7 8",
        ] {
            assert_eq!(missing_names(line.as_bytes()), None, "{line}");
        }
    }

    #[test]
    fn baselines_are_places_about_their_station() {
        // By pyproj: topocentric to geodetic.
        let table = "% ref pos   : -33.850000000  151.200000000    30.0000\n\
                     %  GPST e-baseline(m)  n-baseline(m)  u-baseline(m)   Q  ns\n\
                     2024/05/01 10:00:00.000  3000.0  -4000.0  12.5  1 9\n";
        let found = of_baselines(table).unwrap();
        let row: Vec<&str> = found.lines().last().unwrap().split(' ').collect();
        let near = |at: usize, right: f64, by: f64| {
            let found: f64 = row[at].parse().unwrap();
            assert!((found - right).abs() < by, "{found} {right}");
        };
        near(2, -33.886_057_511_8, 1e-9);
        near(3, 151.232_429_419_6, 1e-9);
        near(4, 44.4636, 1e-3);
        assert!(found.contains("latitude(deg)  longitude(deg)  height(m)"));
        assert_eq!(of_baselines(&table.replace("ref pos", "base")), None);
    }
}
