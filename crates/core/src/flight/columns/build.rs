//! A flight of tables, by their maps.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::Point3;

use super::{ColumnMap, ColumnRole, MappedColumn, time};
use crate::flight::files::FileSet;
use crate::flight::folder::{
    ChannelFile, FlightFile, FlightFolder, FolderError, OriginFile, StartFile, Table, TimeColumn,
    TimeFormat, VERSION, ValueColumn, read_tables,
};
use crate::flight::{ChannelName, Truth, TruthState};

/// Standard deviation per axis of the first position, metres.
const GPS_DEVIATION: f64 = 5.0;
/// Times beyond this are counted from elsewhere than the flight, seconds: they are counted from the first.
const LONGEST: f64 = 1e6;
/// Name of the column of times that rows are given where none is measured.
const ROW_TIME: &str = "#time";

/// The flight that tables among the files tell of, each read as its map says. Cells that make no sense are left out and
/// counted in the notes.
///
/// World is the tangent plane at the first latitude and longitude. The track of the satellite receiver counts as
/// the truth.
pub fn flight_of_tables(
    files: &Arc<dyn FileSet>,
    maps: &[ColumnMap],
) -> Result<FlightFolder, FolderError> {
    let mut tables = BTreeMap::new();
    let mut notes = Vec::new();
    let mut channels = Vec::new();
    let mut start_of_time = f64::INFINITY;
    for map in maps {
        if let Some(cause) = map.lacks() {
            return Err(FolderError::File {
                file: map.file.clone(),
                cause,
            });
        }
        let bytes = files.read(&map.file).ok_or_else(|| FolderError::Missing {
            file: map.file.clone(),
            wanted_by: "its column map".to_owned(),
        })?;
        let names = map
            .columns
            .iter()
            .map(|column| column.name.clone())
            .collect();
        let mut table = Table::shaped(&map.file, &bytes, &map.shape, names)?;
        let time = time_column(map);
        if let Some(rate) = map
            .rows_per_second
            .filter(|_| map.column(ColumnRole::Time).is_none())
        {
            table.number_rows(ROW_TIME, 1.0 / rate);
        }
        let dropped = table.keep_rows_in_time(&time);
        if dropped > 0 {
            notes.push(format!(
                "{}: {dropped} rows were left out, as their time is missing or goes back",
                map.file
            ));
        }
        let first = table
            .times(&time, None)
            .ok()
            .and_then(|times| times.first().copied());
        start_of_time = start_of_time.min(first.unwrap_or(f64::INFINITY));
        channels.extend(of_map(map, &time));
        tables.insert(map.file.clone(), Arc::new(table));
    }
    let is_relative = channels
        .iter()
        .all(|channel| !channel.time.format.is_absolute());
    if is_relative && start_of_time.is_finite() && start_of_time.abs() > LONGEST {
        for channel in &mut channels {
            channel.time.offset_s = -start_of_time;
        }
    }
    let origin = origin(maps, &tables);
    let is_placed = channels
        .iter()
        .any(|c| matches!(c.name.as_str(), "gps" | "gps_north"));
    if !is_placed {
        notes.push(
            "no column says where the flight was: it begins at the world's origin".to_owned(),
        );
    }
    let at_origin = (!is_placed).then_some(0.0);
    let layout = FlightFile {
        pilotage_flight: VERSION,
        name: maps
            .first()
            .map_or("Flight", |map| map.file.as_str())
            .to_owned(),
        description: None,
        data: None,
        origin,
        ground_down_m: 0.0,
        camera: None,
        time_origin: None,
        start: StartFile {
            time_s: None,
            north_m: at_origin,
            east_m: at_origin,
            latitude_deg: None,
            longitude_deg: None,
            standard_deviation_m: GPS_DEVIATION,
        },
        channels,
        frames: None,
        truth: None,
    };
    let mut folder = read_tables(Arc::clone(files), &layout, tables)?;
    folder.notes.splice(0..0, notes);
    folder.flight.truth = track(&folder);
    Ok(folder)
}

fn value(column: &MappedColumn) -> ValueColumn {
    ValueColumn {
        column: column.name.clone(),
        unit: (!column.unit.is_empty()).then(|| column.unit.clone()),
        scale: column.scale,
        offset: column.offset,
    }
}

fn time_column(map: &ColumnMap) -> TimeColumn {
    let column = map.column(ColumnRole::Time);
    let format = match column.map_or("s", |column| column.unit.as_str()) {
        "ms" => TimeFormat::Milliseconds,
        "us" => TimeFormat::Microseconds,
        "ns" => TimeFormat::Nanoseconds,
        time::DATE => TimeFormat::Iso,
        _ => TimeFormat::Seconds,
    };
    TimeColumn {
        column: column
            .map_or(ROW_TIME, |column| column.name.as_str())
            .to_owned(),
        format,
        offset_s: 0.0,
    }
}

/// The channels of a table.
fn of_map(map: &ColumnMap, time: &TimeColumn) -> Vec<ChannelFile> {
    let channel = |name: &str| ChannelFile {
        name: name.to_owned(),
        file: map.file.clone(),
        time: time.clone(),
        ..ChannelFile::default()
    };
    let role = |role: ColumnRole| map.column(role).map(value);
    let mut channels = Vec::new();
    if let (Some(latitude), Some(longitude)) =
        (role(ColumnRole::Latitude), role(ColumnRole::Longitude))
    {
        channels.push(ChannelFile {
            latitude: Some(latitude),
            longitude: Some(longitude),
            ..channel("gps")
        });
    }
    let has_velocity = map
        .column(ColumnRole::Channel(ChannelName::GpsVelocityNorth))
        .is_some();
    let course = (role(ColumnRole::SpeedOverGround), role(ColumnRole::Course));
    if let ((Some(speed), Some(course)), false) = (course, has_velocity) {
        channels.push(ChannelFile {
            speed: Some(speed),
            course: Some(course),
            ..channel("gps_velocity")
        });
    }
    channels.extend(map.columns.iter().filter_map(|column| match column.role {
        ColumnRole::Channel(name) => Some(ChannelFile {
            value: Some(value(column)),
            ..channel(name.key())
        }),
        _ => None,
    }));
    channels
}

/// The first place on the globe that a table has.
fn origin(maps: &[ColumnMap], tables: &BTreeMap<String, Arc<Table>>) -> Option<OriginFile> {
    maps.iter().find_map(|map| {
        let table = tables.get(&map.file)?;
        let angles = |role| {
            let dimension = crate::flight::folder::Dimension::Angle;
            table.values(&value(map.column(role)?), dimension).ok()
        };
        let pairs = angles(ColumnRole::Latitude)?
            .into_iter()
            .zip(angles(ColumnRole::Longitude)?);
        // A receiver without a fix says that it is in the Gulf of Guinea.
        let mut places = pairs
            .filter_map(|(a, b)| Some((a?, b?)))
            .filter(|p| *p != (0.0, 0.0));
        let (latitude, longitude) = places.next()?;
        Some(OriginFile {
            latitude_deg: latitude.to_degrees(),
            longitude_deg: longitude.to_degrees(),
            height_m: 0.0,
        })
    })
}

/// The track of the satellite receiver as the truth.
fn track(folder: &FlightFolder) -> Option<Truth> {
    let channel = |name| folder.flight.channel(name);
    let (north, east) = (
        channel(ChannelName::GpsNorth)?,
        channel(ChannelName::GpsEast)?,
    );
    let height = channel(ChannelName::GpsHeight);
    let first_height = height
        .and_then(|height| height.values.first())
        .copied()
        .unwrap_or(0.0);
    let mut states: Vec<TruthState> = Vec::with_capacity(north.times.len());
    for (index, time) in north.times.iter().enumerate() {
        let east = east.values.get(index).copied().or(east.latest(*time))?;
        let height = height
            .and_then(|height| height.interpolated(*time))
            .unwrap_or(first_height);
        if states.last().is_none_or(|last| *time > last.time) {
            states.push(TruthState {
                time: *time,
                position: Point3::new(north.values[index], east, first_height - height),
                attitude: None,
                wind: None,
            });
        }
    }
    Some(Truth {
        states,
        frames: Vec::new(),
    })
}
