//! Tables of places in zones of UTM: easting, northing and the zone of each row.

use pilotage_base::place_text::place_of_text;
use pilotage_base::text::without_decimal_comma;

use super::ExchangeError;
use super::csv_axes::{EASTINGS, NORTHINGS, plain_name};
use super::csv_columns::CsvRole;
use super::csv_table::{ReadCsvTable, Records};

const ZONES: [&str; 5] = ["zone", "utm zone", "grid zone", "zone number", "utm z"];
const HALVES: [&str; 3] = ["hemisphere", "half", "n/s"];
/// Those of the letter of a band, of which the northern ones begin with N; the last two are of `GPSBabel`.
const BANDS: [&str; 6] = [
    "band",
    "utm band",
    "zone letter",
    "latitude band",
    "utm ch",
    "utm c",
];

/// Writes latitude and longitude on WGS 84, degrees, where northing and easting stand, in a table that has no place beside
/// them; returns a note that says so.
///
/// # Errors
/// A row has no place in its zone.
pub(super) fn in_degrees(
    table: &mut ReadCsvTable,
    records: &mut Records,
) -> Result<Option<String>, ExchangeError> {
    let find = |names: &[&str]| {
        let is_called = |name: &str| names.contains(&plain_name(name).as_str());
        table.columns.iter().position(|c| is_called(&c.name))
    };
    let (Some(east), Some(north), Some(zone)) = (find(&EASTINGS), find(&NORTHINGS), find(&ZONES))
    else {
        return Ok(None);
    };
    if table.has(CsvRole::Latitude) || table.has(CsvRole::Longitude) {
        return Ok(None);
    }
    let half = find(&HALVES).map(|column| (column, false));
    let half = half.or_else(|| Some((find(&BANDS)?, true)));
    for (line, row) in records.iter_mut() {
        let cell = |column: usize| row.get(column).unwrap_or("").trim();
        let metres = |column: usize| {
            let cell = cell(column);
            if table.has_decimal_comma {
                without_decimal_comma(cell).unwrap_or_else(|| cell.replace(',', "."))
            } else {
                cell.to_owned()
            }
        };
        let half = half.map_or("", |(column, is_band)| match cell(column) {
            // Alone an S would be the south.
            "S" | "s" if is_band => "N",
            letter => letter,
        });
        let zone = format!("{}{half}", cell(zone));
        let text = format!("{zone} {} {}", metres(east), metres(north));
        let place = place_of_text(&text).map_err(|error| ExchangeError::Place {
            file: table.file.to_owned(),
            line: *line,
            column: 1,
            cause: format!("`{text}`, read as zone, easting and northing of UTM: {error}"),
        })?;
        let degrees = |radians: f64| format!("{:.10}", radians.to_degrees());
        let (latitude, longitude) = (degrees(place.latitude), degrees(place.longitude));
        let cells = row.iter().enumerate().map(|(column, cell)| match column {
            _ if column == north => latitude.as_str(),
            _ if column == east => longitude.as_str(),
            _ => cell,
        });
        *row = cells.collect();
    }
    for (column, role) in [
        (north, Some(CsvRole::Latitude)),
        (east, Some(CsvRole::Longitude)),
    ]
    .into_iter()
    .chain(half.map(|(half, _)| (half, None)))
    {
        let column = &mut table.columns[column];
        (column.role, column.unit, column.hemisphere) = (role, None, None);
    }
    Ok(Some(format!(
        "places are read of `{}` and `{}` in the zones of UTM in `{}`, on WGS 84",
        table.columns[east].name, table.columns[north].name, table.columns[zone].name
    )))
}

#[cfg(test)]
mod tests {
    use super::super::csv_read::read;

    fn places(table: &str) -> Result<Vec<(f64, f64)>, String> {
        let found = read("a.csv", table).map_err(|error| error.to_string())?;
        let is_told = found.notes.iter().any(|note| note.contains("UTM"));
        assert!(is_told, "{:?}", found.notes);
        Ok(found
            .landmarks
            .iter()
            .map(|landmark| landmark.reference.unwrap())
            .collect())
    }

    #[test]
    fn easting_and_northing_are_places_where_a_zone_stands_beside_them() {
        // By the series of Krüger, to a centimetre.
        let north = (8.5421, 47.3712);
        for table in [
            "name,easting,northing,zone\nA,465429.756,5246517.201,32T\n",
            "name,zone,utm_e,utm_n\nA,32N,465429.756,5246517.201\n",
            // A band, as GPSBabel has it.
            "No,UTM-Zone,UTM-Ch,UTM-East,UTM-North,Name\n1,32,T,465429.756,5246517.201,A\n",
            "name,band,zone,easting,northing\nA,S,32,465429.756,5246517.201\n",
            "name;Zone;Easting;Northing\nA;32N;465.429,756;5.246.517,201\n",
            "name\tZone\tEasting\tNorthing\nA\t32N\t465 429,756\t5 246 517,201\n",
            "name;Zone;Hemisphere;Easting (m);Northing (m)\nA;32;N;465429,756;5246517,201\n",
        ] {
            let found = places(table).unwrap()[0];
            let off = (found.0 - north.0).hypot(found.1 - north.1);
            assert!(off < 3e-7, "{table}: {found:?}");
        }
        let south =
            places("name,easting,northing,zone\nA,360505.620,6303362.288,19H\n").unwrap()[0];
        let off = (south.0 + 70.5).hypot(south.1 + 33.4);
        assert!(off < 3e-7, "{south:?}");
    }

    #[test]
    fn a_zone_that_cannot_be_is_refused_with_its_line() {
        for zone in ["32", "61T", "32C", ""] {
            let table = format!("name,easting,northing,zone\nA,465429.756,5246517.201,{zone}\n");
            let told = places(&table).unwrap_err();
            assert!(told.contains("line 2") && told.contains("UTM"), "{told}");
        }
    }
}
