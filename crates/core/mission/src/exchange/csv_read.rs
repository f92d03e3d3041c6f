//! Reading tables of way-points or landmarks whose columns anybody has named.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::csv_axes::easting_and_northing;
use super::csv_bare::named;
use super::csv_columns::{CsvColumn, CsvRole, columns};
use super::csv_geometry::geometry;
use super::csv_preface::preface;
use super::csv_table::{CsvRow, ReadCsvTable, Records};
use super::csv_utm::in_degrees;
use super::found::{GeodeticContent, POINT_BOX};
use super::item::frame_of_number;
use super::item_route::{GROUND_SPEED, OVER_GROUND};
use super::litchi_actions::{is_litchis, legs_of_speeds, litchi_stay};
use super::see_you::{add_tasks, without_tasks};
use super::{ExchangeError, geojson, rally};
use crate::mission::found::{FoundLandmark, LandmarkExtent, ReadRoute};
use crate::mission::way_point_file::{ACTION_WORDS, StatedCircles, action_of_word, frame_of_word};
use crate::mission::{USUAL_ALTITUDE, WayPoint, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};
use pilotage_base::text::{LastRow, last_row};

/// Reads a table, and the tasks behind it.
pub(super) fn read(file: &str, content: &str) -> Result<GeodeticContent, ExchangeError> {
    if let Some(rally) = rally::of_lines(content) {
        return Ok(GeodeticContent {
            rally,
            notes: vec!["it is read as rally points of ArduPilot (.ral)".to_owned()],
            ..GeodeticContent::default()
        });
    }
    // The lines of tasks have other cells.
    let (content, tasks) = without_tasks(content);
    let given = named(content).map_err(|cause| ExchangeError::File {
        file: file.to_owned(),
        cause: format!("line 1: {cause}"),
    })?;
    let mut found = match given {
        Some(table) => {
            let mut found = read_named(file, &table.text, table.added)?;
            found.notes.extend(table.notes);
            found
        }
        None => read_named(file, content, 0)?,
    };
    if let Some(tasks) = tasks {
        add_tasks(tasks, &mut found);
    }
    Ok(found)
}

/// A table with a header line, as it was opened.
pub(super) struct OpenedTable<'a> {
    pub table: ReadCsvTable<'a>,
    pub records: Vec<(usize, csv::StringRecord)>,
    /// Names of its columns, of which this line of the file has them.
    names: Vec<String>,
    first_line: usize,
    /// Words on a last line that may be cut off.
    end: Option<String>,
    /// Words on places in UTM.
    utm: Option<String>,
}

impl<'a> OpenedTable<'a> {
    /// Opens a table with a header line, of which so many lines were `added`.
    pub fn of(file: &'a str, content: &str, added: u64) -> Result<Self, ExchangeError> {
        let preface = preface(content);
        let delimiter = preface.delimiter;
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(delimiter as u8)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(preface.table.as_bytes());
        let line_of = |line: u64| (line + preface.lines).saturating_sub(added) as usize;
        let error = |line: u64, cause: String| ExchangeError::Place {
            file: file.to_owned(),
            line: line_of(line),
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
            o_is: None,
        };
        let mut records = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| {
                let line = e.position().map_or(0, csv::Position::line);
                error(line, e.to_string())
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            if record.iter().any(|cell| !cell.is_empty()) {
                records.push((line_of(line), record));
            }
        }
        table.has_decimal_comma |= table.writes_commas(&records);
        table.take_angles_with_letters(&records);
        table.leave_thousands(&mut records);
        let end = end_of_file(&table, content, &records)?;
        table.leave_metres(&records);
        table.take_hemispheres(&records);
        let utm = in_degrees(&mut table, &mut records)?;
        Ok(Self {
            table,
            records,
            names,
            first_line: line_of(1),
            end,
            utm,
        })
    }

    /// Finds places that no columns of latitude and longitude have, in a column of both or in X and Y. Words on what was
    /// taken for them; without any, an error that names the columns there are.
    pub fn find_places(&mut self) -> Result<Option<String>, ExchangeError> {
        let roles = [CsvRole::Latitude, CsvRole::Longitude];
        let table = &mut self.table;
        let mut xy = None;
        if !roles.iter().all(|role| table.has(*role)) {
            table.places = table.places(&self.records);
            xy = table
                .places
                .is_none()
                .then(|| table.take_xy(&self.records))
                .flatten();
        }
        for role in roles {
            if !table.has(role) && table.places.is_none() {
                return Err(ExchangeError::Place {
                    file: table.file.to_owned(),
                    line: self.first_line,
                    column: 1,
                    cause: format!(
                        "there is no column for the {}; there are: {}{}",
                        role.name(),
                        self.names.join(", "),
                        self.names_of_metres()
                    ),
                });
            }
        }
        table.o_is = table.meaning_of_o(&self.records);
        Ok(xy.or(table.take_ten_millionths(&self.records)))
    }

    /// Words on eastings and northings of a system that the table does not name.
    fn names_of_metres(&self) -> String {
        easting_and_northing(&self.names).map_or_else(String::new, |[east, north]| {
            format!(
                ". `{east}` and `{north}` are metres of a system that nothing names: put it into a line above the names, such as \
                 EPSG:32632, or the zone of UTM, such as 32T, into a column `Zone`"
            )
        })
    }
}

/// Reads a table with a header line, of which so many lines were `added`.
fn read_named(file: &str, content: &str, added: u64) -> Result<GeodeticContent, ExchangeError> {
    let mut opened = OpenedTable::of(file, content, added)?;
    if let Some(geometries) = opened.table.geometries(&opened.records) {
        let mut found = shapes(&opened.table, &opened.records, geometries)?;
        found.notes.extend(opened.end);
        return Ok(found);
    }
    let xy = opened.find_places()?;
    let OpenedTable {
        mut table,
        mut records,
        end,
        utm,
        ..
    } = opened;
    let unplaced = table.leave_unplaced(&mut records);
    table.take_flown_height();
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
    let told = [unplaced, xy, utm, end];
    found.notes.extend(told.into_iter().flatten());
    if let Some(places) = table.places.filter(|places| !places.is_told) {
        found.notes.push(format!(
            "nothing tells which number of `{}` is the latitude: the first is taken; call the column `lon lat` if it is the \
             second",
            table.columns[places.column].name
        ));
    }
    Ok(found)
}

/// Words on a last line that may be cut off.
///
/// # Errors
/// It lacks a place, or digits of one.
fn end_of_file(
    table: &ReadCsvTable,
    content: &str,
    records: &Records,
) -> Result<Option<String>, ExchangeError> {
    let line = records.last().map_or(0, |(line, _)| *line);
    let needed = table.needed();
    let end = last_row(
        content.as_bytes(),
        records,
        |(_, row), column| row.get(column),
        &needed,
    );
    match end {
        LastRow::Whole => Ok(None),
        LastRow::MayBeCut => Ok(Some(format!(
            "line {line}, the last, has no end, and fewer cells or digits than those before it: the file may be cut off there"
        ))),
        LastRow::Cut => {
            Err(ExchangeError::Place {
                file: table.file.to_owned(),
                line,
                column: 1,
                cause: "the file ends within this line, as if it was cut off; copy or export it again, or put an end to the line \
                        if nothing is missing"
                    .to_owned(),
            })
        }
    }
}

/// Seconds of waiting in a row. A column called by its unit alone may be the time of the row, which is none.
fn waited(row: &CsvRow) -> Option<f64> {
    let (column, _) = row.cell(CsvRole::Seconds)?;
    let is_time = column.name.trim().to_lowercase().starts_with("seconds");
    let seconds = row.number(CsvRole::Seconds).ok()??;
    Some(seconds).filter(|it| !is_time && *it > 0.0)
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
        let stay = litchi_stay(&way_point.properties);
        if !table.has(CsvRole::Action)
            && let Some(seconds) = stay.or_else(|| waited(row))
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
    let are_litchis = table.columns.iter().any(|column| is_litchis(&column.name));
    if are_litchis || has_ground_speeds(table) {
        mark_speeds(&mut found, are_litchis);
    }
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

/// Whether the column of speeds says that they are over ground.
fn has_ground_speeds(table: &ReadCsvTable) -> bool {
    let says_so = |column: &CsvColumn| column.name.to_lowercase().contains("ground");
    let mut columns = table.columns.iter();
    columns.any(|column| column.role == Some(CsvRole::Speed) && says_so(column))
}

/// Marks the speeds of a table as those over ground, and tells what is assumed of them, and of Litchi's legs.
fn mark_speeds(found: &mut GeodeticContent, are_litchis: bool) {
    for route in &mut found.routes {
        let speeds: Vec<Option<f64>> = route.way_points.iter().map(|(_, w)| w.speed).collect();
        for (_, way_point) in &mut route.way_points {
            if way_point.speed.is_some() {
                let mark = Value::Bool(true).to_string();
                way_point.properties.insert(GROUND_SPEED.to_owned(), mark);
            }
        }
        if speeds.iter().any(Option::is_some) {
            found.notes.push(OVER_GROUND.to_owned());
        }
        if are_litchis {
            found.notes.extend(legs_of_speeds(&speeds));
        }
    }
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
