//! Channels out of tables.

use super::error::FolderError;
use super::files::{FolderFiles, contents};
use super::layout::{ChannelFile, ValueColumn};
use super::position::Positions;
use super::table::CsvTable;
use crate::cells::Dimension;
use pilotage_base::frames::wrap_pi;
use pilotage_base::text::by_count;
use pilotage_flight::{Channel, ChannelName};

/// Values of a column, `None` where a cell is empty.
type ColumnValues = Vec<Option<f64>>;

/// Adds the channel that `map`, number `number` of flight.json, describes; two where it gives two.
pub(super) fn read_channel(
    folder: &mut FolderFiles,
    map: &ChannelFile,
    number: usize,
    origin: Option<(i64, f64)>,
    positions: &Positions,
    channels: &mut Vec<Channel>,
) -> Result<(), FolderError> {
    let place = format!("channels[{number}]");
    let table = folder.table(&map.file, &place)?;
    let times = table.times(&map.time, origin)?;
    let read = match map.name.as_str() {
        "gps" => gps(&table, map, &place, positions)?.to_vec(),
        "gps_velocity" => gps_velocity(&table, map, &place)?.to_vec(),
        _ => vec![single(&table, map, &place)?],
    };
    for (name, values) in read {
        add_channel(folder, channels, &place, name, &times, values)?;
    }
    Ok(())
}

/// The columns of a channel that is made of two, and of no other.
fn pair<'a>(
    map: &'a ChannelFile,
    place: &str,
    wanted: [(&str, &'a Option<ValueColumn>); 2],
) -> Result<[&'a ValueColumn; 2], FolderError> {
    let stated = map.value_columns().count();
    match (wanted[0].1, wanted[1].1) {
        (Some(first), Some(second)) if stated == 2 => Ok([first, second]),
        _ => Err(contents(
            place,
            format!(
                "{} needs \"{}\" and \"{}\" and nothing beside them",
                map.name, wanted[0].0, wanted[1].0
            ),
        )),
    }
}

/// Latitude and longitude as metres north and east.
fn gps(
    table: &CsvTable,
    map: &ChannelFile,
    place: &str,
    positions: &Positions,
) -> Result<[(ChannelName, ColumnValues); 2], FolderError> {
    let columns = [("latitude", &map.latitude), ("longitude", &map.longitude)];
    let [latitude, longitude] = pair(map, place, columns)?;
    let points = positions.on_globe(table, latitude, longitude, place)?;
    let north = points.iter().map(|p| p.map(|p| p.north)).collect();
    let east = points.iter().map(|p| p.map(|p| p.east)).collect();
    Ok([(ChannelName::GpsNorth, north), (ChannelName::GpsEast, east)])
}

/// Speed over ground and course (clockwise from north) as velocities north and east.
fn gps_velocity(
    table: &CsvTable,
    map: &ChannelFile,
    place: &str,
) -> Result<[(ChannelName, ColumnValues); 2], FolderError> {
    let columns = [("speed", &map.speed), ("course", &map.course)];
    let [speed, course] = pair(map, place, columns)?;
    let speed = table.values(speed, Dimension::Speed)?;
    let course = table.values(course, Dimension::Angle)?;
    let along = |direction: fn(f64) -> f64| -> ColumnValues {
        let pairs = speed.iter().zip(&course);
        pairs
            .map(|(speed, course)| Some((*speed)? * direction((*course)?)))
            .collect()
    };
    Ok([
        (ChannelName::GpsVelocityNorth, along(f64::cos)),
        (ChannelName::GpsVelocityEast, along(f64::sin)),
    ])
}

/// A channel with a column of its own.
fn single(
    table: &CsvTable,
    map: &ChannelFile,
    place: &str,
) -> Result<(ChannelName, ColumnValues), FolderError> {
    let name = ChannelName::ALL
        .into_iter()
        .find(|name| name.key() == map.name)
        .ok_or_else(|| {
            let known: Vec<&str> = ChannelName::ALL.iter().map(|n| n.key()).collect();
            let known = known.join(", ");
            let cause = format!(
                "\"{}\" is no channel; there are {known}, gps and gps_velocity",
                map.name
            );
            contents(place, cause)
        })?;
    let others = [&map.latitude, &map.longitude, &map.speed, &map.course];
    match &map.value {
        Some(value) if others.iter().all(|column| column.is_none()) => {
            Ok((name, table.values(value, name.quantity().into())?))
        }
        _ => Err(contents(place, "state \"value\" and nothing beside it")),
    }
}

fn add_channel(
    folder: &mut FolderFiles,
    channels: &mut Vec<Channel>,
    place: &str,
    name: ChannelName,
    times: &[f64],
    values: ColumnValues,
) -> Result<(), FolderError> {
    if channels.iter().any(|c| c.name == name) {
        let cause = format!("there is a second channel \"{}\"", name.key());
        return Err(contents(place, cause));
    }
    let total = values.len();
    let (times, values): (Vec<f64>, Vec<f64>) = times
        .iter()
        .zip(values)
        .filter_map(|(time, value)| {
            let value = value?;
            // Wrapping only where needed keeps the bits of values that are in range.
            let wraps = name.is_angle() && value.abs() > std::f64::consts::PI;
            Some((*time, if wraps { wrap_pi(value) } else { value }))
        })
        .unzip();
    if values.len() < total {
        folder.notes.push(format!(
            "{}: {} of {total} samples {} skipped",
            name.key(),
            total - values.len(),
            by_count(
                total - values.len(),
                "is empty and was",
                "are empty and were"
            )
        ));
    }
    channels.push(Channel {
        name,
        times,
        values,
    });
    Ok(())
}
