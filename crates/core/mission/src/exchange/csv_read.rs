//! Reading tables of way-points or landmarks whose columns anybody has named.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::ExchangeError;
use super::angle;
use super::csv_columns::{CsvColumn, CsvRole, Unit, columns};
use super::found::{GeodeticContent, POINT_BOX};
use super::litchi_actions::litchi_stay;
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
    let table = ReadCsvTable {
        file,
        columns: columns(&names).map_err(|cause| error(1, cause))?,
        has_decimal_comma: delimiter == ';',
    };
    for role in [CsvRole::Latitude, CsvRole::Longitude] {
        if !table.has(role) {
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
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| {
            let line = e.position().map_or(0, csv::Position::line);
            error(line, e.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        if record.iter().any(|cell| !cell.is_empty()) {
            rows.push(CsvRow {
                table: &table,
                line: line as usize,
                record,
            });
        }
    }
    if table.holds_way_points() {
        way_points(&table, &rows)
    } else {
        landmarks(&table, &rows)
    }
}

struct ReadCsvTable<'a> {
    file: &'a str,
    columns: Vec<CsvColumn>,
    has_decimal_comma: bool,
}

impl ReadCsvTable<'_> {
    fn has(&self, role: CsvRole) -> bool {
        self.columns.iter().any(|c| c.role == Some(role))
    }

    /// Whether the rows are way-points: something says how they are flown over.
    fn holds_way_points(&self) -> bool {
        let is_flown = [
            CsvRole::Route,
            CsvRole::Altitude,
            CsvRole::Speed,
            CsvRole::Action,
            CsvRole::Frame,
        ];
        let is_box = [CsvRole::BoxNorth, CsvRole::BoxEast, CsvRole::Enabled];
        !is_box.iter().any(|r| self.has(*r))
            && (is_flown.iter().any(|r| self.has(*r)) || !self.has(CsvRole::Name))
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
        let degrees = angle::degrees(&plain, letters)
            .ok_or_else(|| self.error(&column.name, &format!("`{cell}` is no number")))?;
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

    /// Cells that we do not know, by the names of their columns, as JSON text.
    fn properties(&self) -> BTreeMap<String, String> {
        let columns = self.table.columns.iter().enumerate();
        columns
            .filter(|(_, column)| column.role.is_none() && !column.name.is_empty())
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
    for row in rows {
        let place = row.place()?;
        let frame = match row.cell(CsvRole::Frame) {
            None => stated,
            Some((column, word)) => {
                let plain = word.to_lowercase().replace([' ', '-'], "_");
                let frame = frame_of_word(&plain).or_else(|| frame_of_abbreviation(&plain));
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
            None => USUAL_ALTITUDE,
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
    if !table.has(CsvRole::Altitude) {
        found.notes.push(format!(
            "the table states no altitude: {USUAL_ALTITUDE} is taken"
        ));
    }
    Ok(found)
}

fn frame_of_abbreviation(word: &str) -> Option<AltitudeFrame> {
    Some(match word {
        "msl" | "absolute" => AltitudeFrame::Amsl,
        // Litchi: 0 counts from take-off, 1 from the ground.
        "agl" | "terrain" | "1" => AltitudeFrame::AboveGround,
        "rel" | "relative" | "ato" | "home" | "0" => AltitudeFrame::AboveTakeOff,
        _ => return None,
    })
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
