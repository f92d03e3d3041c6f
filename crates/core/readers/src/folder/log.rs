//! The log that the tables of a flight are: every column as it was written, and what is known of it.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::layout::{ChannelFile, FlightFile, TimeColumn, ValueColumn};
use super::table::CsvTable;
use crate::cells::Dimension;
use crate::interpret::{Role, RoleSeries};
use crate::log::{Cells, Column, Log, LogFormat};
use pilotage_flight::{Channel, ChannelName, Flight};

/// Word in the name of a column of a gimbal's angle.
const GIMBAL: &str = "gimbal";

/// The tables of a flight, and what is said of their columns.
#[derive(Clone)]
pub(crate) struct FlightTables {
    /// Statements about the columns.
    pub layout: FlightFile,
    /// By the names that the layout has for them.
    pub by_file: BTreeMap<String, Arc<CsvTable>>,
    /// Second 0 of times with a date.
    pub time_origin: Option<(i64, f64)>,
    /// Universal time at second 0, seconds since 1970, where dates stand beside the clock.
    pub dated: Option<f64>,
}

impl FlightTables {
    /// A topic for each table that has times, called as its file, and the series of the flight that they became.
    pub fn log(&self, flight: &Flight) -> Log {
        let mut log = Log::new(&flight.name, LogFormat::Tables);
        log.utc_at_zero = self.utc_at_zero();
        let names = self.topic_names();
        for (file, table) in &self.by_file {
            let Some(times) = self.times(file, table, flight) else {
                continue;
            };
            log.add_columns(&names[file], &times, &self.columns(file, table));
            log.report.bytes += table.bytes();
            log.report.used_bytes += table.bytes();
        }
        // Equivalent airspeed stands for the true one only where there is no other.
        let is_equivalent = |map: &&ChannelFile| map.name == ChannelName::EquivalentAirspeed.key();
        let channels = self.layout.channels.iter();
        let (equivalent, others): (Vec<_>, Vec<_>) = channels.partition(is_equivalent);
        for map in others.into_iter().chain(equivalent) {
            for series in self.given(map, &names[&map.file], flight) {
                let is_there = log.given.iter().any(|given| given.role == series.role);
                if !is_there && !series.times.is_empty() {
                    log.given.push(series);
                }
            }
        }
        log
    }

    /// Name of the topic of each file: the file without folder and ending, where no other is called so.
    fn topic_names(&self) -> BTreeMap<String, String> {
        let stem = |file: &str| -> String {
            let name = file.rsplit('/').next().unwrap_or(file);
            name.rsplit_once('.').map_or(name, |(stem, _)| stem).into()
        };
        let files = self.by_file.keys();
        let is_alone = |file: &&String| files.clone().filter(|f| stem(f) == stem(file)).count() < 2;
        let name = |file: &String| match Some(file).filter(is_alone) {
            Some(file) => stem(file),
            None => file.clone(),
        };
        files
            .clone()
            .map(|file| (file.clone(), name(file)))
            .collect()
    }

    /// When the rows of a table were measured: by its own times, or by those of the frames that it names.
    fn times(&self, file: &str, table: &CsvTable, flight: &Flight) -> Option<Vec<Option<f64>>> {
        let layout = &self.layout;
        let states = layout.truth.iter().flat_map(|truth| &truth.states);
        let states = states.map(|map| (&map.file, &map.time));
        let frames = layout.times_of_frames();
        let mut all = frames.chain(layout.times_of_channels()).chain(states);
        if let Some((_, map)) = all.find(|(of, _)| *of == file) {
            let times = table.times(map, self.time_origin).ok()?;
            return Some(times.into_iter().map(Some).collect());
        }
        let named = layout.truth.iter().flat_map(|truth| &truth.frames);
        let map = named.into_iter().find(|map| map.file == file)?;
        let time = |name: &str| {
            let mut frames = flight.frames.iter();
            frames
                .find(|frame| frame.name == name)
                .map(|frame| frame.time)
        };
        let names = table.texts(&map.name).ok()?;
        Some(names.into_iter().map(time).collect())
    }

    /// Every column of a table.
    fn columns(&self, file: &str, table: &CsvTable) -> Vec<Column> {
        let column = |name: &String| {
            let cells = if let Some(numbers) = table.numbers(name).ok()? {
                Cells::Numbers(numbers)
            } else {
                let texts = table.texts(name).ok()?.into_iter();
                Cells::Texts(texts.map(str::to_owned).collect())
            };
            Some(Column {
                name: name.clone(),
                unit: self.unit(file, name),
                cells,
            })
        };
        table.columns().iter().filter_map(column).collect()
    }

    /// The unit of the numbers in a column as they stand there, where it is said.
    fn unit(&self, file: &str, name: &str) -> String {
        let of_file = |map: &&ChannelFile| map.file == file;
        let mut maps = self.layout.channels.iter().filter(of_file);
        let is_it = |column: &&ValueColumn| column.column == name && column.scale.abs() == 1.0;
        let mapped = maps
            .clone()
            .flat_map(ChannelFile::value_columns)
            .find(is_it);
        let time = |map: &ChannelFile| (map.time.column == name).then(|| time_unit(&map.time));
        let unit = mapped.and_then(|column| column.unit.clone());
        unit.or_else(|| maps.find_map(time).map(str::to_owned))
            .unwrap_or_default()
    }

    /// Roles of the columns of a channel in navigation, with values as the flight has them.
    fn given(&self, map: &ChannelFile, topic: &str, flight: &Flight) -> Vec<RoleSeries> {
        let named = |columns: &[&ValueColumn]| {
            let names: Vec<&str> = columns.iter().map(|c| c.column.as_str()).collect();
            format!("{topic}.{}", names.join(", "))
        };
        let of_channel = |role, name, columns: &[&ValueColumn]| {
            let channel = flight.channel(name)?;
            let is_held = columns.iter().any(|c| is_of_a_gimbal(&c.column));
            Some(RoleSeries {
                is_held,
                ..of_samples(role, named(columns), channel)
            })
        };
        let of_column = |role, column: &ValueColumn, dimension| {
            let table = self.by_file.get(&map.file)?;
            let times = table.times(&map.time, self.time_origin).ok()?;
            let values = table.values(column, dimension).ok()?;
            let samples = times.into_iter().zip(values);
            let samples = samples.filter(|(_, value)| value.is_some());
            Some(RoleSeries::new(role, named(&[column]), samples))
        };
        match map.name.as_str() {
            "gps" => {
                let (Some(latitude), Some(longitude)) = (&map.latitude, &map.longitude) else {
                    return Vec::new();
                };
                let angle = |role, column| of_column(role, column, Dimension::Angle);
                let both = [
                    angle(Role::Latitude, latitude),
                    angle(Role::Longitude, longitude),
                ];
                both.into_iter().flatten().collect()
            }
            "gps_velocity" => {
                let (Some(speed), Some(course)) = (&map.speed, &map.course) else {
                    return Vec::new();
                };
                let [north, east] = [
                    (Role::GpsVelocityNorth, ChannelName::GpsVelocityNorth),
                    (Role::GpsVelocityEast, ChannelName::GpsVelocityEast),
                ]
                .map(|(role, name)| of_channel(role, name, &[speed, course]));
                let over_ground = of_column(Role::GroundSpeed, speed, Dimension::Speed);
                [north, east, over_ground].into_iter().flatten().collect()
            }
            key => {
                let name = ChannelName::ALL.into_iter().find(|name| name.key() == key);
                let role = name.and_then(Role::of_channel);
                let column = map.value.as_ref();
                let (Some(name), Some(role), Some(column)) = (name, role, column) else {
                    return Vec::new();
                };
                of_channel(role, name, &[column]).into_iter().collect()
            }
        }
    }
}

/// The samples of a channel as those of a role.
pub(crate) fn of_samples(role: Role, source: String, channel: &Channel) -> RoleSeries {
    let samples = channel.times.iter().zip(&channel.values);
    RoleSeries::new(role, source, samples.map(|(t, v)| (*t, Some(*v))))
}

fn time_unit(time: &TimeColumn) -> &'static str {
    use super::TimeFormat;
    match time.format {
        TimeFormat::Seconds => "s",
        TimeFormat::Milliseconds => "ms",
        TimeFormat::Microseconds => "us",
        TimeFormat::Nanoseconds => "ns",
        TimeFormat::Centiseconds => "cs",
        TimeFormat::HundredMicroseconds => "100us",
        TimeFormat::Days => "d",
        TimeFormat::Minutes => "min",
        TimeFormat::Hours => "h",
        TimeFormat::Camera | TimeFormat::Iso | TimeFormat::Clock => "",
    }
}

/// Whether a column tells of a camera's gimbal, by its name.
fn is_of_a_gimbal(column: &str) -> bool {
    column.to_ascii_lowercase().contains(GIMBAL)
}

#[cfg(test)]
#[path = "log_tests.rs"]
mod tests;
