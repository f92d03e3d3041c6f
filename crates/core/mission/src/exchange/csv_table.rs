//! Table of places as it was read: its columns by their meaning, and its rows.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde_json::Value;

use super::csv_axes::is_grid_axis;
use super::csv_columns::{CsvColumn, CsvRole, Unit};
use super::csv_geometry::geometry;
use super::csv_heights::flown_height;
use super::csv_letter_o::without_o;
use super::csv_place::{PlaceOrder, is_name_of_places, is_place, is_surely_place, order, place};
use super::{ExchangeError, angle};
use crate::mission::found::{LonLat, on_globe};
use pilotage_base::angle_text::hemisphere as hemisphere_of;
use pilotage_base::text::{by_count, without_decimal_comma};

/// Rows with the lines at which they begin.
pub(super) type Records = [(usize, csv::StringRecord)];

/// Column that has latitude and longitude in each cell.
#[derive(Clone, Copy)]
pub(super) struct PlaceColumn {
    pub column: usize,
    pub order: PlaceOrder,
    pub is_told: bool,
}

/// Names of columns of longitudes and latitudes that are those of other things as well: of geographic programs, of
/// photogrammetry (`x_est` of Metashape), and the German words for length and width.
const XY: [[&str; 2]; 7] = [
    ["x", "y"],
    ["xcoord", "ycoord"],
    ["x_coord", "y_coord"],
    ["point_x", "point_y"],
    ["x_est", "y_est"],
    ["länge", "breite"],
    ["laenge", "breite"],
];

/// Whether columns so called may be longitudes and latitudes of what has names.
pub(super) fn are_named_xy(names: &[String]) -> bool {
    let has = |name: &str| names.iter().any(|other| other.to_lowercase() == name);
    XY.iter().any(|pair| pair.iter().all(|name| has(name))) && (has("name") || has("label"))
}

pub(super) struct ReadCsvTable<'a> {
    pub file: &'a str,
    pub columns: Vec<CsvColumn>,
    pub has_decimal_comma: bool,
    pub places: Option<PlaceColumn>,
    /// Letter that an O at a longitude stands for, where something tells.
    pub o_is: Option<char>,
}

impl ReadCsvTable<'_> {
    /// The first column without a meaning of which all cells that say anything are as wanted.
    pub(super) fn column_of(
        &self,
        records: &Records,
        is_wanted: impl Fn(&str) -> bool,
    ) -> Option<usize> {
        self.columns_of(records, is_wanted).first().copied()
    }

    /// The columns without a meaning of which all cells that say anything are as wanted.
    pub(super) fn columns_of(
        &self,
        records: &Records,
        is_wanted: impl Fn(&str) -> bool,
    ) -> Vec<usize> {
        let is_such = |column: &usize| {
            let cells = records.iter().filter_map(|(_, row)| row.get(*column));
            let mut cells = cells.filter(|cell| !cell.is_empty()).peekable();
            let is_free = self.columns[*column].role.is_none();
            is_free && cells.peek().is_some() && cells.all(&is_wanted)
        };
        (0..self.columns.len()).filter(is_such).collect()
    }

    /// Whether numbers have commas before their decimals, by the cells of latitudes and longitudes: none has a point, and some
    /// have one comma between digits.
    pub(super) fn writes_commas(&self, records: &Records) -> bool {
        let roles = [CsvRole::Latitude, CsvRole::Longitude];
        let is_angle = |column: &CsvColumn| match column.role {
            Some(role) => roles.contains(&role),
            None => is_grid_axis(&column.name),
        };
        let columns = self.columns.iter().enumerate();
        let angles: Vec<usize> = columns
            .filter_map(|(at, column)| is_angle(column).then_some(at))
            .collect();
        let cells = records
            .iter()
            .flat_map(|(_, row)| angles.iter().filter_map(|at| row.get(*at)));
        let is_with_comma =
            |cell: &str| cell.contains(',') && without_decimal_comma(cell).is_some();
        let has_point = |cell: &str| cell.contains('.') && !is_with_comma(cell);
        !cells.clone().any(has_point) && cells.clone().any(is_with_comma)
    }

    /// Takes the dots before every three digits out of columns in which a number has such dots and a comma before its
    /// decimals: there `1.120` is no number between 1 and 2.
    pub(super) fn leave_thousands(&self, records: &mut Vec<(usize, csv::StringRecord)>) {
        let is_grouped = |cell: &str| {
            let plain = without_decimal_comma(cell);
            cell.contains('.') && cell.contains(',') && plain.is_some()
        };
        let is_such = |column: &usize| {
            let mut cells = records.iter().filter_map(|(_, row)| row.get(*column));
            cells.any(is_grouped)
        };
        let columns: Vec<usize> = (0..self.columns.len()).filter(is_such).collect();
        if !self.has_decimal_comma || columns.is_empty() {
            return;
        }
        for (_, row) in records {
            let cells = row.iter().enumerate().map(|(column, cell)| {
                let is_whole = columns.contains(&column) && !cell.contains(',');
                let whole = is_whole.then(|| without_decimal_comma(&format!("{cell},0")));
                match whole.flatten() {
                    Some(whole) => Cow::Owned(whole),
                    None => Cow::Borrowed(cell),
                }
            });
            let cells: csv::StringRecord =
                cells.collect::<Vec<_>>().iter().map(|it| &**it).collect();
            *row = cells;
        }
    }

    /// Takes `lat_m` beside degrees with a fraction for the metres that it is then, and not for minutes.
    pub(super) fn leave_metres(&mut self, records: &Records) {
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

    /// Takes the first column of heights to fly at for the altitude of way-points, where no column is called one.
    pub(super) fn take_flown_height(&mut self) {
        if !self.holds_way_points() || self.has(CsvRole::Altitude) {
            return;
        }
        let mut columns = self.columns.iter_mut();
        let found = columns.find_map(|column| {
            let is_free = column.role.is_none_or(|role| role == CsvRole::Height);
            let height = flown_height(&column.name).filter(|_| is_free)?;
            Some((column, height))
        });
        if let Some((column, height)) = found {
            *column = height;
        }
    }

    /// The column of geometries, but beside columns of latitude and longitude, and where all are points that something says
    /// how to fly over.
    pub(super) fn geometries(&self, records: &Records) -> Option<usize> {
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
    pub(super) fn places(&self, records: &Records) -> Option<PlaceColumn> {
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

    /// Takes columns called X and Y, as geographic programs write them, or by the German words that are also those of length
    /// and width, for longitude and latitude where all their cells are degrees with the decimals, signs or letters of a place;
    /// returns a note that says so.
    pub(super) fn take_xy(&mut self, records: &Records) -> Option<String> {
        let is_called = |column: &CsvColumn, name: &str| {
            column.role.is_none() && column.name.to_lowercase() == name
        };
        let find = |name: &str| self.columns.iter().position(|c| is_called(c, name));
        let (x, y) = XY.iter().find_map(|[x, y]| Some((find(x)?, find(y)?)))?;
        // With a height or a time beside them they may be metres of a track.
        let of_tracks = ["z", "t", "time", "timestamp", "time_s", "qw", "qx"];
        // What has names are places, whose height GDAL calls Z.
        let of_tracks = &of_tracks[usize::from(self.has(CsvRole::Name))..];
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
                    || cell.contains('°')
            };
            let exact = cells.iter().filter(has_decimals).count();
            let letters = if most > 90.0 { ('E', 'W') } else { ('N', 'S') };
            let is_degree = |cell: &String| {
                let plain = without_o(cell, Some('E')).unwrap_or_default();
                angle::degrees(&plain, letters).is_some_and(|n| n.abs() <= most)
            };
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

    /// Takes latitudes and longitudes for ten-millionths of a degree where all are whole numbers and some are beyond what
    /// millionths could be; returns a note that says so.
    pub(super) fn take_ten_millionths(&mut self, records: &Records) -> Option<String> {
        let find = |role| self.columns.iter().position(|c| c.role == Some(role));
        let (latitude, longitude) = (find(CsvRole::Latitude)?, find(CsvRole::Longitude)?);
        let of = [(latitude, 90.0), (longitude, 180.0)];
        let mut is_beyond = false;
        for (column, most) in of {
            if self.columns[column].unit.is_some() {
                return None;
            }
            let cells = records.iter().filter_map(|(_, row)| row.get(column));
            for cell in cells.filter(|cell| !cell.is_empty()) {
                let number = cell.parse::<i32>().ok().map(f64::from)?;
                if number.abs() > most * 1e7 {
                    return None;
                }
                is_beyond |= number.abs() > most * 1e6;
            }
        }
        if !is_beyond {
            return None;
        }
        for (column, _) in of {
            self.columns[column].unit = Some(Unit::TenMillionth);
        }
        Some(format!(
            "the whole numbers of `{}` and `{}` are taken for ten-millionths of a degree",
            self.columns[latitude].name, self.columns[longitude].name
        ))
    }

    /// Leaves out the rows of landmarks that state neither latitude nor longitude, and returns a note of how many. Of
    /// way-points none may lack, nor all of either.
    pub(super) fn leave_unplaced(
        &self,
        records: &mut Vec<(usize, csv::StringRecord)>,
    ) -> Option<String> {
        if self.holds_way_points() {
            return None;
        }
        let of_place = |column: usize| match self.places {
            Some(places) => places.column == column,
            None => self.columns.get(column).is_some_and(|c| {
                [Some(CsvRole::Latitude), Some(CsvRole::Longitude)].contains(&c.role)
            }),
        };
        let is_placed = |(_, row): &(usize, csv::StringRecord)| {
            let mut cells = row.iter().enumerate();
            cells.any(|(column, cell)| of_place(column) && !cell.is_empty())
        };
        let count = records.iter().filter(|row| !is_placed(row)).count();
        if count == 0 || count == records.len() {
            return None;
        }
        records.retain(is_placed);
        Some(format!(
            "{count} {} no place, and {} left out",
            by_count(count, "row has", "rows have"),
            by_count(count, "is", "are")
        ))
    }

    /// Of each column, whether a row is of no use without it: those of latitude and longitude, and all where nothing is called
    /// so and any may have the places.
    pub(super) fn needed(&self) -> Vec<bool> {
        use CsvRole::{EastWest, Latitude, LatitudeMinutes, LatitudeSeconds};
        use CsvRole::{Longitude, LongitudeMinutes, LongitudeSeconds, NorthSouth};
        let of_place = [
            Latitude,
            LatitudeMinutes,
            LatitudeSeconds,
            NorthSouth,
            Longitude,
            LongitudeMinutes,
            LongitudeSeconds,
            EastWest,
        ];
        let is_told = self.has(Latitude) && self.has(Longitude);
        let is_of_place = |column: &CsvColumn| column.role.is_some_and(|r| of_place.contains(&r));
        self.columns
            .iter()
            .map(|column| !is_told || is_of_place(column))
            .collect()
    }

    /// Whether something says how places are flown over.
    pub(super) fn is_flown(&self) -> bool {
        let roles = [
            CsvRole::Route,
            CsvRole::Altitude,
            CsvRole::Speed,
            CsvRole::Action,
            CsvRole::Frame,
        ];
        roles.iter().any(|role| self.has(*role))
    }

    pub(super) fn has(&self, role: CsvRole) -> bool {
        self.columns.iter().any(|c| c.role == Some(role))
    }

    /// Whether the rows are way-points: something says how they are flown over.
    pub(super) fn holds_way_points(&self) -> bool {
        let is_box = [CsvRole::BoxNorth, CsvRole::BoxEast, CsvRole::Enabled];
        !is_box.iter().any(|r| self.has(*r)) && (self.is_flown() || !self.has(CsvRole::Name))
    }
}

pub(super) struct CsvRow<'a> {
    pub table: &'a ReadCsvTable<'a>,
    pub line: usize,
    pub record: csv::StringRecord,
}

impl CsvRow<'_> {
    pub(super) fn error(&self, column: &str, cause: &str) -> ExchangeError {
        ExchangeError::Place {
            file: self.table.file.to_owned(),
            line: self.line,
            column: 1,
            cause: format!("column `{column}`: {cause}"),
        }
    }

    /// The column and the cell of a role, if the cell is not empty.
    pub(super) fn cell(&self, role: CsvRole) -> Option<(&CsvColumn, &str)> {
        let columns = self.table.columns.iter().enumerate();
        columns
            .filter(|(_, column)| column.role == Some(role))
            .find_map(|(i, column)| Some((column, self.record.get(i)?)))
            .filter(|(_, cell)| !cell.is_empty())
    }

    pub(super) fn text(&self, role: CsvRole) -> Option<String> {
        self.cell(role).map(|(_, cell)| cell.to_owned())
    }

    /// A number as the table writes it, with a decimal point.
    pub(super) fn with_point(&self, cell: &str) -> String {
        if self.table.has_decimal_comma {
            without_decimal_comma(cell).unwrap_or_else(|| cell.replace(',', "."))
        } else {
            cell.to_owned()
        }
    }

    /// A number in SI, or in degrees.
    pub(super) fn number(&self, role: CsvRole) -> Result<Option<f64>, ExchangeError> {
        let Some((column, cell)) = self.cell(role) else {
            return Ok(None);
        };
        let finite = |text: &str| text.parse::<f64>().ok().filter(|v| v.is_finite());
        let plain = self.with_point(cell);
        // A unit behind the number goes before that of the column.
        let with_unit = || {
            let end = plain.rfind(|c: char| c.is_ascii_digit())? + 1;
            let unit = Unit::of(&plain[end..].trim().to_lowercase())?;
            let is_of_role = role.units().contains(&unit);
            Some((finite(&plain[..end])?, unit)).filter(|_| is_of_role)
        };
        let (value, unit) = finite(&plain)
            .map(|value| (value, column.unit))
            .or_else(|| with_unit().map(|(value, unit)| (value, Some(unit))))
            .ok_or_else(|| self.error(&column.name, &format!("`{cell}` is no number")))?;
        Ok(Some(value * unit.map_or(1.0, Unit::factor)))
    }

    /// An angle on the globe in degrees, whose hemisphere is its sign, a letter at the number, or the
    /// cell of a column of its own.
    pub(super) fn degrees(
        &self,
        role: CsvRole,
        hemisphere: CsvRole,
        letters: (char, char),
    ) -> Result<Option<f64>, ExchangeError> {
        let Some((column, cell)) = self.cell(role) else {
            return Ok(None);
        };
        let mut plain = self.with_point(cell);
        if role == CsvRole::Longitude {
            plain = without_o(&plain, self.table.o_is)
                .map_err(|cause| self.error(&column.name, &cause))?;
        }
        let mut degrees = angle::degrees(&plain, letters)
            .ok_or_else(|| self.error(&column.name, &format!("`{cell}` is no number")))?;
        if column.unit == Some(Unit::TenMillionth) {
            degrees /= 1e7;
        }
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
        if let Some(letter) = column.hemisphere {
            let other = if letter == letters.0 {
                letters.1
            } else {
                letters.0
            };
            let of_cell = plain.chars().map(|c| c.to_ascii_uppercase());
            if of_cell.clone().any(|c| c == other) && !of_cell.clone().any(|c| c == letter) {
                let cause = format!("`{cell}` says {other}, and the column's name {letter}");
                return Err(self.error(&column.name, &cause));
            }
            if letter == letters.1 {
                degrees = -degrees.abs();
            }
        }
        let Some((column, word)) = self.cell(hemisphere) else {
            return Ok(Some(degrees));
        };
        let word = if role == CsvRole::Longitude {
            without_o(word, self.table.o_is).map_err(|cause| self.error(&column.name, &cause))?
        } else {
            word.to_owned()
        };
        let first = word.chars().next().map(|c| c.to_ascii_uppercase());
        let letter = hemisphere_of(&word.to_lowercase()).or(first);
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

    pub(super) fn place(&self) -> Result<LonLat, ExchangeError> {
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
    pub(super) fn height_of_place(&self) -> Option<f64> {
        let cell = self.record.get(self.table.places?.column)?;
        geometry(cell)?.ok()?["coordinates"].get(2)?.as_f64()
    }

    /// Cells that we do not know, by the names of their columns, as JSON text.
    pub(super) fn properties(&self) -> BTreeMap<String, String> {
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
