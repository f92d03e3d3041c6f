//! Reading tables of way-points or landmarks whose columns anybody has named.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::csv_columns::{CsvColumn, CsvRole, Unit, columns};
use super::csv_geometry::geometry;
use super::csv_place::{PlaceOrder, is_name_of_places, is_place, is_surely_place, order, place};
use super::found::{GeodeticContent, POINT_BOX};
use super::item::frame_of_number;
use super::litchi_actions::litchi_stay;
use super::{ExchangeError, angle, geojson};
use crate::mission::found::{FoundLandmark, LandmarkExtent, LonLat, ReadRoute, on_globe};
use crate::mission::way_point_file::{ACTION_WORDS, StatedCircles, action_of_word, frame_of_word};
use crate::mission::{USUAL_ALTITUDE, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// Reads a table with a header line.
pub(super) fn read(file: &str, content: &str) -> Result<GeodeticContent, ExchangeError> {
    let header = content.lines().next().unwrap_or("");
    let count = |c: char| header.matches(c).count();
    let delimiter = [',', ';', '\t']
        .into_iter()
        .max_by_key(|c| (count(*c), *c == ','))
        .unwrap_or(',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter as u8)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(content.as_bytes());
    let error = |line: u64, cause: String| ExchangeError::Place {
        file: file.to_owned(),
        line: line as usize,
        column: 1,
        cause,
    };
    let names = reader.headers().map_err(|e| error(1, e.to_string()))?;
    let names: Vec<String> = names.iter().map(str::to_owned).collect();
    if names.iter().all(|name| name.trim().is_empty()) {
        return Err(error(1, String::from("the file is empty")));
    }
    let mut table = ReadCsvTable {
        file,
        columns: columns(&names).map_err(|cause| error(1, cause))?,
        has_decimal_comma: delimiter == ';',
        places: None,
    };
    let mut records = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| {
            let line = e.position().map_or(0, csv::Position::line);
            error(line, e.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        if record.iter().any(|cell| !cell.is_empty()) {
            records.push((line as usize, record));
        }
    }
    table.leave_metres(&records);
    if let Some(geometries) = table.geometries(&records) {
        return shapes(&table, &records, geometries);
    }
    let has_both = [CsvRole::Latitude, CsvRole::Longitude]
        .iter()
        .all(|role| table.has(*role));
    let mut xy = None;
    if !has_both {
        table.places = table.places(&records);
        xy = table
            .places
            .is_none()
            .then(|| table.take_xy(&records))
            .flatten();
    }
    for role in [CsvRole::Latitude, CsvRole::Longitude] {
        if !table.has(role) && table.places.is_none() {
            return Err(error(
                1,
                format!(
                    "there is no column for the {}; there are: {}",
                    role.name(),
                    names.join(", ")
                ),
            ));
        }
    }
    let rows: Vec<CsvRow> = records
        .into_iter()
        .map(|(line, record)| CsvRow {
            table: &table,
            line,
            record,
        })
        .collect();
    let mut found = if table.holds_way_points() {
        way_points(&table, &rows)?
    } else {
        landmarks(&table, &rows)?
    };
    found.notes.extend(xy);
    if let Some(places) = table.places.filter(|places| !places.is_told) {
        found.notes.push(format!(
            "nothing tells which number of `{}` is the latitude: the first is taken; call the column `lon lat` if it is the \
             second",
            table.columns[places.column].name
        ));
    }
    Ok(found)
}

/// Rows with the lines at which they begin.
type Records = [(usize, csv::StringRecord)];

/// Column that has latitude and longitude in each cell.
#[derive(Clone, Copy)]
struct PlaceColumn {
    column: usize,
    order: PlaceOrder,
    is_told: bool,
}

struct ReadCsvTable<'a> {
    file: &'a str,
    columns: Vec<CsvColumn>,
    has_decimal_comma: bool,
    places: Option<PlaceColumn>,
}

impl ReadCsvTable<'_> {
    /// The first column without a meaning of which all cells that say anything are as wanted.
    fn column_of(&self, records: &Records, is_wanted: impl Fn(&str) -> bool) -> Option<usize> {
        (0..self.columns.len()).find(|column| {
            let cells = records.iter().filter_map(|(_, row)| row.get(*column));
            let mut cells = cells.filter(|cell| !cell.is_empty()).peekable();
            let is_free = self.columns[*column].role.is_none();
            is_free && cells.peek().is_some() && cells.all(&is_wanted)
        })
    }

    /// Takes `lat_m` beside degrees with a fraction for the metres that it is then, and not for minutes.
    fn leave_metres(&mut self, records: &Records) {
        use CsvRole::{Latitude, LatitudeMinutes, LatitudeSeconds};
        use CsvRole::{Longitude, LongitudeMinutes, LongitudeSeconds};
        for (whole, parts) in [
            (Latitude, [LatitudeMinutes, LatitudeSeconds]),
            (Longitude, [LongitudeMinutes, LongitudeSeconds]),
        ] {
            let Some(degrees) = self.columns.iter().position(|c| c.role == Some(whole)) else {
                continue;
            };
            let has_fraction = |cell: &str| {
                let number = cell.replace(',', ".").parse::<f64>();
                number.is_ok_and(|number| number.fract() != 0.0)
            };
            let mut cells = records.iter().filter_map(|(_, row)| row.get(degrees));
            if !cells.any(has_fraction) {
                continue;
            }
            for column in &mut self.columns {
                let last = column.name.to_lowercase();
                let last = last.rsplit(|c: char| !c.is_alphabetic()).next();
                let is_short = matches!(last, Some("m" | "mm" | "s" | "ss"));
                if is_short && column.role.is_some_and(|role| parts.contains(&role)) {
                    column.role = None;
                }
            }
        }
    }

    /// The column of geometries, but beside columns of latitude and longitude, and where all are points that something says
    /// how to fly over.
    fn geometries(&self, records: &Records) -> Option<usize> {
        if self.has(CsvRole::Latitude) && self.has(CsvRole::Longitude) {
            return None;
        }
        let column = self.column_of(records, |cell| geometry(cell).is_some())?;
        let is_point = |(_, row): &(usize, csv::StringRecord)| {
            let read = row.get(column).and_then(geometry);
            read.is_none_or(|read| read.is_ok_and(|read| read["type"] == "Point"))
        };
        let are_points = self.is_flown() && records.iter().all(is_point);
        (!are_points).then_some(column)
    }

    /// The column that has a place in each cell.
    fn places(&self, records: &Records) -> Option<PlaceColumn> {
        let points = self.column_of(records, |cell| geometry(cell).is_some());
        if let Some(column) = points {
            return Some(PlaceColumn {
                column,
                order: PlaceOrder::LongitudeFirst,
                is_told: true,
            });
        }
        let are_sure = |column: &usize| {
            let mut cells = records.iter().filter_map(|(_, row)| row.get(*column));
            is_name_of_places(&self.columns[*column].name)
                || cells.all(|cell| cell.is_empty() || is_surely_place(cell))
        };
        let column = self.column_of(records, is_place).filter(are_sure)?;
        let cells = records.iter().filter_map(|(_, row)| row.get(column));
        let order = order(&self.columns[column].name, cells);
        Some(PlaceColumn {
            column,
            order: order.unwrap_or(PlaceOrder::LatitudeFirst),
            is_told: order.is_some(),
        })
    }

    /// Takes columns called X and Y, as geographic programs write them, for longitude and latitude where all their numbers
    /// are degrees with the decimals of a place; returns a note that says so.
    fn take_xy(&mut self, records: &Records) -> Option<String> {
        let names = [
            ["x", "y"],
            ["xcoord", "ycoord"],
            ["x_coord", "y_coord"],
            ["point_x", "point_y"],
        ];
        let is_called = |column: &CsvColumn, name: &str| {
            column.role.is_none() && column.name.eq_ignore_ascii_case(name)
        };
        let find = |name: &str| self.columns.iter().position(|c| is_called(c, name));
        let (x, y) = names.iter().find_map(|[x, y]| Some((find(x)?, find(y)?)))?;
        // With a height or a time beside them they may be metres of a track.
        let of_tracks = ["z", "t", "time", "timestamp", "time_s", "qw", "qx"];
        let is_of_track = |c: &CsvColumn| of_tracks.contains(&c.name.to_lowercase().as_str());
        if self.columns.iter().any(is_of_track) {
            return None;
        }
        let are_degrees = |column: usize, most: f64| {
            let cells = records.iter().filter_map(|(_, row)| row.get(column));
            let cells: Vec<String> = cells
                .filter(|cell| !cell.is_empty())
                .map(|cell| cell.replace(',', "."))
                .collect();
            let has_decimals = |cell: &&String| {
                cell.split_once('.')
                    .is_some_and(|(_, rest)| rest.len() >= 5)
            };
            let exact = cells.iter().filter(has_decimals).count();
            let is_degree = |cell: &String| cell.parse().is_ok_and(|n: f64| n.abs() <= most);
            2 * exact >= cells.len().max(1) && cells.iter().all(is_degree)
        };
        if !are_degrees(x, 180.0) || !are_degrees(y, 90.0) {
            return None;
        }
        self.columns[x].role = Some(CsvRole::Longitude);
        self.columns[y].role = Some(CsvRole::Latitude);
        Some(format!(
            "`{}` and `{}` are taken for longitude and latitude in degrees",
            self.columns[x].name, self.columns[y].name
        ))
    }

    /// Whether something says how places are flown over.
    fn is_flown(&self) -> bool {
        let roles = [
            CsvRole::Route,
            CsvRole::Altitude,
            CsvRole::Speed,
            CsvRole::Action,
            CsvRole::Frame,
        ];
        roles.iter().any(|role| self.has(*role))
    }

    fn has(&self, role: CsvRole) -> bool {
        self.columns.iter().any(|c| c.role == Some(role))
    }

    /// Whether the rows are way-points: something says how they are flown over.
    fn holds_way_points(&self) -> bool {
        let is_box = [CsvRole::BoxNorth, CsvRole::BoxEast, CsvRole::Enabled];
        !is_box.iter().any(|r| self.has(*r)) && (self.is_flown() || !self.has(CsvRole::Name))
    }
}

struct CsvRow<'a> {
    table: &'a ReadCsvTable<'a>,
    line: usize,
    record: csv::StringRecord,
}

impl CsvRow<'_> {
    fn error(&self, column: &str, cause: &str) -> ExchangeError {
        ExchangeError::Place {
            file: self.table.file.to_owned(),
            line: self.line,
            column: 1,
            cause: format!("column `{column}`: {cause}"),
        }
    }

    /// The column and the cell of a role, if the cell is not empty.
    fn cell(&self, role: CsvRole) -> Option<(&CsvColumn, &str)> {
        let columns = self.table.columns.iter().enumerate();
        columns
            .filter(|(_, column)| column.role == Some(role))
            .find_map(|(i, column)| Some((column, self.record.get(i)?)))
            .filter(|(_, cell)| !cell.is_empty())
    }

    fn text(&self, role: CsvRole) -> Option<String> {
        self.cell(role).map(|(_, cell)| cell.to_owned())
    }

    /// A number as the table writes it, with a decimal point.
    fn with_point(&self, cell: &str) -> String {
        if self.table.has_decimal_comma {
            cell.replace(',', ".")
        } else {
            cell.to_owned()
        }
    }

    /// A number in SI, or in degrees.
    fn number(&self, role: CsvRole) -> Result<Option<f64>, ExchangeError> {
        let Some((column, cell)) = self.cell(role) else {
            return Ok(None);
        };
        let plain = self.with_point(cell);
        let value: f64 = plain
            .parse()
            .ok()
            .filter(|v: &f64| v.is_finite())
            .ok_or_else(|| self.error(&column.name, &format!("`{cell}` is no number")))?;
        Ok(Some(value * column.unit.map_or(1.0, Unit::factor)))
    }

    /// An angle on the globe in degrees, whose hemisphere is its sign, a letter at the number, or the
    /// cell of a column of its own.
    fn degrees(
        &self,
        role: CsvRole,
        hemisphere: CsvRole,
        letters: (char, char),
    ) -> Result<Option<f64>, ExchangeError> {
        let Some((column, cell)) = self.cell(role) else {
            return Ok(None);
        };
        let plain = self.with_point(cell);
        let mut degrees = angle::degrees(&plain, letters)
            .ok_or_else(|| self.error(&column.name, &format!("`{cell}` is no number")))?;
        let is_latitude = role == CsvRole::Latitude;
        let parts = if is_latitude {
            [CsvRole::LatitudeMinutes, CsvRole::LatitudeSeconds]
        } else {
            [CsvRole::LongitudeMinutes, CsvRole::LongitudeSeconds]
        };
        let mut rest = 0.0;
        for (part, unit) in parts.into_iter().zip([60.0, 3600.0]) {
            let value = self.number(part)?.unwrap_or(0.0);
            if !(0.0..=60.0).contains(&value) {
                let cause = format!("{value} is not from 0 to 60");
                return Err(self.error(part.name(), &cause));
            }
            rest += value / unit;
        }
        if rest != 0.0 && degrees.fract() != 0.0 {
            let cause = "degrees with a fraction have minutes beside them";
            return Err(self.error(&column.name, cause));
        }
        // Of -0 degrees only the sign tells.
        let is_below =
            plain.trim_start().starts_with(['-', '\u{2212}']) || degrees.is_sign_negative();
        degrees += if is_below { -rest } else { rest };
        let Some((column, word)) = self.cell(hemisphere) else {
            return Ok(Some(degrees));
        };
        let letter = word.chars().next().map(|c| c.to_ascii_uppercase());
        let is_negative = match letter {
            Some(c) if c == letters.0 => false,
            Some(c) if c == letters.1 => true,
            _ => {
                let cause = format!("`{word}` is neither {} nor {}", letters.0, letters.1);
                return Err(self.error(&column.name, &cause));
            }
        };
        // A sign or a letter at the number that says the same is heeded once.
        Ok(Some(if is_negative { -degrees.abs() } else { degrees }))
    }

    fn place(&self) -> Result<LonLat, ExchangeError> {
        if let Some(places) = self.table.places {
            let cell = self.record.get(places.column).unwrap_or("");
            let place = match geometry(cell) {
                Some(read) => read.ok().and_then(|read| {
                    let number = |i: usize| read["coordinates"].get(i)?.as_f64();
                    let place = (number(0)?, number(1)?);
                    on_globe(place.0, place.1).then_some(place)
                }),
                None => place(cell, places.order),
            };
            let name = &self.table.columns[places.column].name;
            let cause = || format!("`{cell}` is no place on the globe");
            return place.ok_or_else(|| self.error(name, &cause()));
        }
        let latitude = self.degrees(CsvRole::Latitude, CsvRole::NorthSouth, ('N', 'S'))?;
        let longitude = self.degrees(CsvRole::Longitude, CsvRole::EastWest, ('E', 'W'))?;
        match (longitude, latitude) {
            (Some(longitude), Some(latitude)) if on_globe(longitude, latitude) => {
                Ok((longitude, latitude))
            }
            _ => Err(ExchangeError::Place {
                file: self.table.file.to_owned(),
                line: self.line,
                column: 1,
                cause: "the row has no latitude and longitude in degrees".to_owned(),
            }),
        }
    }

    /// Height above the sea of a point whose cell has three numbers as geometries have them, metres.
    fn height_of_place(&self) -> Option<f64> {
        let cell = self.record.get(self.table.places?.column)?;
        geometry(cell)?.ok()?["coordinates"].get(2)?.as_f64()
    }

    /// Cells that we do not know, by the names of their columns, as JSON text.
    fn properties(&self) -> BTreeMap<String, String> {
        let columns = self.table.columns.iter().enumerate();
        columns
            .filter(|(_, column)| column.role.is_none() && !column.name.is_empty())
            .filter(|(i, _)| self.table.places.is_none_or(|places| places.column != *i))
            .filter_map(|(i, column)| Some((column, self.record.get(i)?)))
            .filter(|(_, cell)| !cell.is_empty())
            .map(|(column, cell)| {
                let is_nested =
                    cell.starts_with(['{', '[']) && serde_json::from_str::<Value>(cell).is_ok();
                let value = if is_nested {
                    cell.to_owned()
                } else {
                    Value::from(cell).to_string()
                };
                (column.name.clone(), value)
            })
            .collect()
    }
}

fn way_points(table: &ReadCsvTable, rows: &[CsvRow]) -> Result<GeodeticContent, ExchangeError> {
    let mut found = GeodeticContent::default();
    let mut assumed_frames = 0;
    let stated = table
        .columns
        .iter()
        .find(|c| c.role == Some(CsvRole::Altitude))
        .and_then(|c| c.frame);
    let is_mavlink = counts_by_mavlink(table, rows);
    let placed = placed(table, rows);
    if placed.len() < rows.len() {
        found.notes.push(format!(
            "{} of the rows stand at 0° N, 0° E, which is no place, and are left out",
            rows.len() - placed.len()
        ));
    }
    for row in placed {
        let place = row.place()?;
        let frame = match row.cell(CsvRole::Frame) {
            None => stated,
            Some((column, word)) => {
                let plain = word.to_lowercase().replace([' ', '-'], "_");
                let frame = frame_of_word(&plain)
                    .or_else(|| frame_of_digits(is_mavlink, &plain))
                    .or_else(|| frame_of_abbreviation(&plain));
                Some(frame.ok_or_else(|| {
                    let cause =
                        format!("`{word}` is none of amsl, above_take_off and above_ground");
                    row.error(&column.name, &cause)
                })?)
            }
        };
        let altitude = match row.number(CsvRole::Altitude)? {
            Some(metres) => {
                assumed_frames += usize::from(frame.is_none());
                Altitude::new(metres, frame.unwrap_or(USUAL_ALTITUDE.frame))
            }
            None => row.height_of_place().map_or(USUAL_ALTITUDE, |metres| {
                Altitude::new(metres, AltitudeFrame::Amsl)
            }),
        };
        let mut way_point = WayPoint::new(GroundPoint::default(), altitude);
        // Planners of missions write 0 for the aircraft's cruise: nobody flies at no speed.
        way_point.speed = row.number(CsvRole::Speed)?.filter(|speed| *speed > 0.0);
        if let Some((column, word)) = row.cell(CsvRole::Action) {
            let plain = word.to_lowercase().replace([' ', '-'], "_");
            let circles = StatedCircles {
                radius: row.number(CsvRole::Radius)?,
                turns: row.number(CsvRole::Turns)?,
                seconds: row.number(CsvRole::Seconds)?,
            };
            way_point.action = action_of_word(&plain, &circles).ok_or_else(|| {
                let cause = format!("`{word}` is none of {ACTION_WORDS}");
                row.error(&column.name, &cause)
            })?;
        }
        way_point.properties = row.properties();
        if !table.has(CsvRole::Action)
            && let Some(seconds) = litchi_stay(&way_point.properties)
        {
            way_point.action = WayPointAction::Wait {
                radius: 0.0,
                seconds: Some(seconds),
            };
        }
        for (role, key) in [(CsvRole::Name, "name"), (CsvRole::Id, "id")] {
            if let Some(text) = row.text(role) {
                let text = Value::from(text).to_string();
                way_point.properties.insert(key.to_owned(), text);
            }
        }
        let name = row.text(CsvRole::Route);
        match found.routes.last_mut() {
            Some(route) if route.name == name => route.way_points.push((place, way_point)),
            _ => found.routes.push(ReadRoute {
                name,
                way_points: vec![(place, way_point)],
                ..ReadRoute::default()
            }),
        }
    }
    found
        .notes
        .push("the rows are read as way-points".to_owned());
    if assumed_frames > 0 {
        found.notes.push(format!(
            "the table does not say what altitudes count from: {} is taken",
            USUAL_ALTITUDE.frame.name()
        ));
    }
    let has_heights = || rows.iter().any(|row| row.height_of_place().is_some());
    if !table.has(CsvRole::Altitude) && !has_heights() {
        found.notes.push(format!(
            "the table states no altitude: {USUAL_ALTITUDE} is taken"
        ));
    }
    Ok(found)
}

/// Whether a column has commands of `MAVLink`.
fn has_commands(table: &ReadCsvTable) -> bool {
    let commands = ["cid", "cmd", "command", "mav_cmd"];
    let mut names = table.columns.iter().map(|c| c.name.to_lowercase());
    names.any(|name| commands.contains(&name.as_str()))
}

/// The rows without those of a table of commands that have no place, as logs of missions have them (`DO_JUMP`): they stand
/// at 0° N, 0° E.
fn placed<'a, 'b>(table: &ReadCsvTable, rows: &'a [CsvRow<'b>]) -> Vec<&'a CsvRow<'b>> {
    let has_commands = has_commands(table);
    let is_null =
        |row: &&CsvRow| has_commands && row.place().is_ok_and(|place| place == (0.0, 0.0));
    let placed: Vec<&CsvRow> = rows.iter().filter(|row| !is_null(row)).collect();
    if placed.is_empty() {
        return rows.iter().collect();
    }
    placed
}

/// Whether numbers of frames are those of `MAV_FRAME`: where the column is none of modes, and holds one that nothing else
/// has, or commands stand beside it.
fn counts_by_mavlink(table: &ReadCsvTable, rows: &[CsvRow]) -> bool {
    let named = table
        .columns
        .iter()
        .find(|c| c.role == Some(CsvRole::Frame));
    if named.is_none_or(|column| column.name.to_lowercase().contains("mode")) {
        return false;
    }
    let number = |row: &CsvRow| row.cell(CsvRole::Frame)?.1.trim().parse::<f64>().ok();
    has_commands(table) || rows.iter().filter_map(number).any(|n| n > 1.0)
}

/// The frame of a number: `MAV_FRAME` of `MAVLink`, else that of Litchi.
fn frame_of_digits(is_mavlink: bool, word: &str) -> Option<AltitudeFrame> {
    let number: f64 = word.parse().ok().filter(|n: &f64| n.fract() == 0.0)?;
    let number = (0.0..=255.0).contains(&number).then_some(number as u8)?;
    match (is_mavlink, number) {
        (true, number) => frame_of_number(number),
        (false, 0) => Some(AltitudeFrame::AboveTakeOff),
        (false, 1) => Some(AltitudeFrame::AboveGround),
        _ => None,
    }
}

fn frame_of_abbreviation(word: &str) -> Option<AltitudeFrame> {
    let word = word.strip_prefix("mav_frame_").unwrap_or(word);
    Some(match word.strip_suffix("_int").unwrap_or(word) {
        "global" | "msl" | "absolute" => AltitudeFrame::Amsl,
        "global_terrain_alt" | "agl" | "terrain" | "ground" => AltitudeFrame::AboveGround,
        "global_relative_alt" | "rel" | "relative" | "ato" | "home" | "takeoff" | "take_off" => {
            AltitudeFrame::AboveTakeOff
        }
        _ => return None,
    })
}

/// Rows with geometries: read as GeoJSON with the other cells as properties.
fn shapes(
    table: &ReadCsvTable,
    records: &Records,
    column: usize,
) -> Result<GeodeticContent, ExchangeError> {
    let mut features = Vec::with_capacity(records.len());
    for (line, record) in records {
        let shape = match record.get(column).and_then(geometry) {
            Some(shape) => shape.map_err(|cause| ExchangeError::Place {
                file: table.file.to_owned(),
                line: *line,
                column: 1,
                cause: format!("column `{}`: {cause}", table.columns[column].name),
            })?,
            None => Value::Null,
        };
        let cells = table.columns.iter().zip(record).enumerate();
        let cells = cells.filter(|(i, (_, cell))| *i != column && !cell.is_empty());
        let properties: serde_json::Map<String, Value> = cells
            .map(|(_, (named, cell))| {
                let is_name = named.role == Some(CsvRole::Name);
                let key = if is_name { "name" } else { named.name.as_str() };
                (key.to_owned(), Value::from(cell))
            })
            .collect();
        features.push(json!({ "type": "Feature", "geometry": shape, "properties": properties }));
    }
    let collection = json!({ "type": "FeatureCollection", "features": features });
    let mut found =
        geojson::read(table.file, &collection.to_string()).map_err(|error| match error {
            // Lines are those of the collection.
            ExchangeError::Place { file, cause, .. } => ExchangeError::File { file, cause },
            other => other,
        })?;
    found.notes.push(format!(
        "the column `{}` has the places",
        table.columns[column].name
    ));
    Ok(found)
}

fn landmarks(table: &ReadCsvTable, rows: &[CsvRow]) -> Result<GeodeticContent, ExchangeError> {
    let mut found = GeodeticContent::default();
    let mut ids = BTreeSet::new();
    for row in rows {
        let place = row.place()?;
        let (north, east) = (
            row.number(CsvRole::BoxNorth)?,
            row.number(CsvRole::BoxEast)?,
        );
        let size = (
            north.or(east).unwrap_or(POINT_BOX),
            east.or(north).unwrap_or(POINT_BOX),
        );
        let offset = (
            row.number(CsvRole::OffsetNorth)?.unwrap_or(0.0),
            row.number(CsvRole::OffsetEast)?.unwrap_or(0.0),
        );
        let mut properties = row.properties();
        let id = row.text(CsvRole::Id);
        let own_id = id.as_ref().and_then(|id| id.parse::<u32>().ok());
        if let (Some(id), None) = (id, own_id.filter(|id| ids.insert(*id))) {
            properties.insert("id_in_file".to_owned(), Value::from(id).to_string());
        }
        let enabled = row.text(CsvRole::Enabled).map(|text| text.to_lowercase());
        found.landmarks.push(FoundLandmark {
            reference: Some(place),
            id: own_id,
            name: row.text(CsvRole::Name),
            height: row.number(CsvRole::Height)?.unwrap_or(0.0),
            enabled: !enabled.is_some_and(|e| ["false", "0", "no", "off"].contains(&e.as_str())),
            properties,
            ..FoundLandmark::new(if north.or(east).is_none() {
                LandmarkExtent::Point(place)
            } else {
                LandmarkExtent::Around {
                    point: place,
                    offset,
                    size,
                }
            })
        });
    }
    found
        .notes
        .push("the rows are read as landmarks".to_owned());
    if !table.has(CsvRole::BoxNorth) && !table.has(CsvRole::BoxEast) {
        found.notes.push(format!(
            "the table states no sizes: each landmark gets a box of {POINT_BOX} m"
        ));
    }
    Ok(found)
}
