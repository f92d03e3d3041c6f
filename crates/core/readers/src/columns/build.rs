//! A flight of tables, by their maps.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use super::attitude::attitude;
use super::body_velocity::{has_body_velocity, turn};
use super::groups::quaternion_roles;
use super::newest_first::begins_with_newest;
use super::rows::pair;
use super::strays::{FARTHEST, leave_out_strays};
use super::together::common_name;
use super::{ColumnMap, ColumnRole, MappedColumn, gimbal, parts, pictures, time};
use crate::cells::{Moment, date_and_time};
use crate::folder::{
    ChannelFile, CsvTable, FlightFile, FlightFolder, FolderError, StartFile, TimeColumn,
    TimeFormat, VERSION, ValueColumn, read_tables,
};
use pilotage_base::files::FileSet;
use pilotage_base::frames::units::EARTH_RADIUS;
use pilotage_base::text::{LastRow, by_count};
use pilotage_flight::{Channel, ChannelName, OriginFile, Truth, TruthState};

/// Standard deviation per axis of the first position, metres.
const GPS_DEVIATION: f64 = 5.0;
/// First places of which all but the last may be damaged.
const MOST_DAMAGED: usize = 20;
/// Times beyond this are counted from elsewhere than the flight, seconds: they are counted from the first.
const LONGEST: f64 = 1e6;
/// Name of the column of times that rows are given where none is measured.
const ROW_TIME: &str = "#time";

/// Names of the columns that the places of two numbers a cell are put into.
const PLACE: [&str; 2] = ["#latitude", "#longitude"];
/// Names of the columns that the angles of a quaternion are put into.
const ANGLES: [(ChannelName, &str); 3] = [
    (ChannelName::Roll, "#roll"),
    (ChannelName::Pitch, "#pitch"),
    (ChannelName::Heading, "#heading"),
];
/// Names of the columns that the wind's velocity is put into.
const WIND: [(ChannelName, &str); 2] = [
    (ChannelName::WindNorth, "#wind_north"),
    (ChannelName::WindEast, "#wind_east"),
];

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
    let mut notes = files.left_out();
    let mut channels = Vec::new();
    let mut start_of_time = f64::INFINITY;
    let mut refused = None;
    for map in maps {
        let (mut table, time) = table_of(files.as_ref(), map)?;
        notes.extend(cut_off(&table, &map.file));
        let told = table.told.iter();
        notes.extend(told.map(|note| format!("{}: {note}", map.file)));
        let dropped = table.keep_rows_in_time(&time);
        if dropped > 0 {
            notes.push(untimed(&map.file, dropped));
        }
        match table.spread_rows(&time) {
            Ok(told) => notes.extend(told.iter().map(|note| format!("{}: {note}", map.file))),
            Err(cause) => {
                // Other tables may be of the flight.
                notes.push(format!("{cause}; the table was left out"));
                refused = Some(cause);
                continue;
            }
        }
        let first = table
            .times(&time, None)
            .ok()
            .and_then(|times| times.first().copied());
        start_of_time = start_of_time.min(first.unwrap_or(f64::INFINITY));
        channels.extend(of_map(map, &time));
        tables.insert(map.file.clone(), Arc::new(table));
    }
    if let Some(cause) = refused.filter(|_| tables.is_empty()) {
        return Err(cause);
    }
    let is_relative = channels
        .iter()
        .all(|channel| !channel.time.format.is_absolute());
    if is_relative && start_of_time.is_finite() && start_of_time.abs() > LONGEST {
        for channel in &mut channels {
            channel.time.offset_s = -start_of_time;
        }
    }
    let dated = date_at_zero(maps, &tables, &channels);
    let first = first_place(maps, &tables, &channels);
    let is_placed = channels
        .iter()
        .any(|c| matches!(c.name.as_str(), "gps" | "gps_north"));
    if !is_placed {
        notes.push(
            "no column says where the flight was: it begins at the world's origin".to_owned(),
        );
    }
    let at_origin = (first.is_some() || !is_placed).then_some(0.0);
    let (pictures, note) = pictures::named(files, maps, &tables, &channels).unzip();
    let (frames, camera) = pictures.unzip();
    notes.extend(note);
    if frames.is_some() {
        notes.extend(pictures::without_those_of_flight(&mut channels));
    }
    let layout = FlightFile {
        pilotage_flight: VERSION,
        name: common_name(maps),
        description: None,
        data: None,
        origin: first.map(|(origin, _)| origin),
        ground_down_m: 0.0,
        camera,
        time_origin: None,
        start: StartFile {
            time_s: first.and_then(|(_, time)| time),
            north_m: at_origin,
            east_m: at_origin,
            latitude_deg: None,
            longitude_deg: None,
            standard_deviation_m: GPS_DEVIATION,
        },
        channels,
        frames,
        truth: None,
    };
    let mut folder = read_tables(Arc::clone(files), &layout, tables)?;
    folder.date(dated);
    if maps.iter().any(has_body_velocity) {
        notes.extend(turn(&mut folder.flight));
    }
    gimbal::turn(&mut folder.flight, maps);
    leave_out_strays(&mut folder, &mut notes);
    notes.extend(height_above_start(&mut folder));
    notes.extend(apart(&folder, maps, &layout));
    for map in maps {
        notes.extend(map.findings.iter().chain(&map.questions).cloned());
    }
    folder.notes.splice(0..0, notes);
    folder.flight.truth = track(&folder);
    Ok(folder)
}

/// Sentence about rows of a table that were left out for their times.
fn untimed(file: &str, dropped: usize) -> String {
    format!(
        "{file}: {dropped} {} time is missing, goes back or lies far from those around",
        by_count(
            dropped,
            "row was left out, as its",
            "rows were left out, as their"
        )
    )
}

/// Sentence about the last line of a table, where the file may be cut off in it.
fn cut_off(table: &CsvTable, file: &str) -> Option<String> {
    let (line, end) = table.end;
    let (said, is_left_out) = match end {
        LastRow::Whole => return None,
        LastRow::MayBeCut => (
            "fewer cells or digits than those before it",
            "was read as it is",
        ),
        LastRow::Cut => ("not all that is read of a row", "was left out"),
    };
    Some(format!(
        "{file}, line {line}: the last line has no end, and {said}: the file may be cut off there; the line {is_left_out}"
    ))
}

/// The table of a map with what only several columns say, and its column of times.
fn table_of(files: &dyn FileSet, map: &ColumnMap) -> Result<(CsvTable, TimeColumn), FolderError> {
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
    let is_read = |column: &MappedColumn| column.role != ColumnRole::Nothing;
    let is_read: Vec<bool> = map.columns.iter().map(is_read).collect();
    let mut table = CsvTable::shaped(&map.file, &bytes, &map.shape, names, &is_read)?;
    if begins_with_newest(&bytes) {
        table.turn();
        let told = "its newest row is the first: it is read from its end to its beginning";
        table.told.push(told.to_owned());
    }
    let time = time_column(map);
    if let Some(rate) = map
        .rows_per_second
        .filter(|_| map.column(ColumnRole::Time).is_none())
    {
        table.number_rows(ROW_TIME, 1.0 / rate);
    }
    derive(map, &mut table)?;
    Ok((table, time))
}

/// Universal time at second zero of the tables' clocks, seconds since 1970, where one has dates beside its clock.
fn date_at_zero(
    maps: &[ColumnMap],
    tables: &BTreeMap<String, Arc<CsvTable>>,
    channels: &[ChannelFile],
) -> Option<f64> {
    let shift = channels.first()?.time.offset_s;
    let is_dated = |channel: &ChannelFile| channel.time.format.is_absolute();
    if channels.iter().any(is_dated) {
        return None;
    }
    maps.iter().find_map(|map| {
        let dates = map.column(ColumnRole::Date)?;
        let table = tables.get(&map.file)?;
        let times = table.times(&time_column(map), None).ok()?;
        let times: Vec<Option<f64>> = times.into_iter().map(Some).collect();
        let date = |text: &str| match date_and_time(text)? {
            Moment::Absolute(whole, fraction) => Some(whole as f64 + fraction),
            Moment::Relative(_) => None,
        };
        let dates: Vec<Option<f64>> = table
            .texts(&dates.name)
            .ok()?
            .into_iter()
            .map(date)
            .collect();
        Some(parts::date_at_zero(&times, &dates)? - shift)
    })
}

/// Adds columns of what only several columns together say: attitude out of a quaternion, the wind's velocity out of
/// strength and direction. All are in SI and radians.
fn derive(map: &ColumnMap, table: &mut CsvTable) -> Result<(), FolderError> {
    if let Some(column) = map.column(ColumnRole::Place) {
        let texts = table.texts(&column.name)?;
        let places: Vec<Option<(f64, f64)>> = texts.into_iter().map(pair).collect();
        table.add_numbers(PLACE[0], places.iter().map(|place| Some((*place)?.0)));
        table.add_numbers(PLACE[1], places.iter().map(|place| Some((*place)?.1)));
    }
    let numbers = |column: &MappedColumn| {
        let plain = MappedColumn {
            unit: String::new(),
            scale: 1.0,
            ..column.clone()
        };
        table.values(&value(&plain), crate::cells::Dimension::Number)
    };
    let rests = |role| map.columns.iter().filter(move |column| column.role == role);
    let mut added: Vec<(&str, Vec<Option<f64>>)> = Vec::new();
    if let Some(whole) = map.column(ColumnRole::Time)
        && rests(ColumnRole::TimeRest).next().is_some()
    {
        let mut all = vec![(whole.unit.as_str(), numbers(whole)?)];
        for rest in rests(ColumnRole::TimeRest) {
            all.push((rest.unit.as_str(), numbers(rest)?));
        }
        let mut times = parts::seconds(&all, table.len());
        // A date is told for that of universal time only where its columns say so.
        let mut names = map.columns.iter().map(|column| column.name.to_lowercase());
        let is_universal = names.any(|name| name.contains("utc") || name.contains("gmt"));
        if all.iter().any(|(unit, _)| *unit == "years") && !is_universal {
            let first = times.iter().flatten().next().copied().unwrap_or(0.0);
            let day = (first / 86_400.0).floor() * 86_400.0;
            times.iter_mut().flatten().for_each(|time| *time -= day);
        }
        added.push((ROW_TIME, times));
    }
    for (role, name) in [
        (ColumnRole::Latitude, PLACE[0]),
        (ColumnRole::Longitude, PLACE[1]),
    ] {
        let Some(whole) = map.column(role).filter(|_| has_parts(map, role)) else {
            continue;
        };
        let mut degrees = numbers(whole)?;
        for (unit, _, per_degree) in parts::ANGLES.iter().filter(|(_, of, _)| *of == role) {
            let Some(rest) = rests(ColumnRole::AngleRest).find(|column| column.unit == *unit)
            else {
                continue;
            };
            let pairs = degrees.iter().zip(numbers(rest)?);
            degrees = pairs
                .map(|(whole, rest)| Some(parts::angle((*whole)?, rest? / per_degree)))
                .collect();
        }
        let turned = degrees.into_iter().map(|angle| Some(angle? * whole.scale));
        added.push((name, turned.collect()));
    }
    for (name, numbers) in added {
        table.add_numbers(name, numbers);
    }
    for is_ros in [false, true] {
        let parts = quaternion_roles(is_ros).map(|role| map.column(role));
        let [Some(w), Some(x), Some(y), Some(z)] = parts else {
            continue;
        };
        let number = crate::cells::Dimension::Number;
        let mut values = Vec::with_capacity(4);
        for column in [w, x, y, z] {
            values.push(table.values(&value(column), number)?);
        }
        let found = |row: usize| {
            let part = |index: usize| values[index].get(row).copied().flatten();
            attitude([part(0)?, part(1)?, part(2)?, part(3)?], is_ros)
        };
        let found: Vec<_> = (0..table.len()).map(found).collect();
        table.add_numbers(ANGLES[0].1, found.iter().map(|a| Some((*a)?.roll)));
        table.add_numbers(ANGLES[1].1, found.iter().map(|a| Some((*a)?.pitch)));
        table.add_numbers(ANGLES[2].1, found.iter().map(|a| Some((*a)?.yaw)));
    }
    let wind = map
        .column(ColumnRole::WindSpeed)
        .zip(map.column(ColumnRole::WindFrom));
    if let Some((speed, from)) = wind {
        let speed = table.values(&value(speed), crate::cells::Dimension::Speed)?;
        let from = table.values(&value(from), crate::cells::Dimension::Angle)?;
        let along = |part: fn(f64) -> f64| -> Vec<Option<f64>> {
            let pairs = speed.iter().zip(&from);
            pairs
                .map(|(speed, from)| Some(-(*speed)? * part((*from)?)))
                .collect()
        };
        let (north, east) = (along(f64::cos), along(f64::sin));
        table.add_numbers(WIND[0].1, north);
        table.add_numbers(WIND[1].1, east);
    }
    Ok(())
}

/// Whether a latitude or longitude has minutes in a column of their own.
fn has_parts(map: &ColumnMap, role: ColumnRole) -> bool {
    let units = parts::ANGLES.iter().filter(|(_, of, _)| *of == role);
    let is_part = |column: &MappedColumn| {
        let mut units = units.clone();
        column.role == ColumnRole::AngleRest && units.any(|(unit, ..)| column.unit == *unit)
    };
    map.columns.iter().any(is_part)
}

/// Channels that are made of what [`derive`] adds, with the names of the columns.
fn derived(map: &ColumnMap) -> Vec<(ChannelName, &'static str)> {
    let has = |role| map.column(role).is_some();
    let mut found = Vec::new();
    let is_quaternion = |is_ros| quaternion_roles(is_ros).into_iter().all(has);
    if is_quaternion(false) || is_quaternion(true) {
        found.extend(ANGLES);
    }
    if has(ColumnRole::WindSpeed) && has(ColumnRole::WindFrom) {
        found.extend(WIND);
    }
    found
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
    let is_split = map.column(ColumnRole::TimeRest).is_some();
    let column = map.column(ColumnRole::Time).filter(|_| !is_split);
    let format = match column.map_or("s", |column| column.unit.as_str()) {
        "ms" => TimeFormat::Milliseconds,
        "us" => TimeFormat::Microseconds,
        "ns" => TimeFormat::Nanoseconds,
        "cs" => TimeFormat::Centiseconds,
        "100us" => TimeFormat::HundredMicroseconds,
        time::DATE => TimeFormat::Iso,
        time::CLOCK => TimeFormat::Clock,
        time::DAYS => TimeFormat::Days,
        time::MINUTES => TimeFormat::Minutes,
        time::HOURS => TimeFormat::Hours,
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
    let place = |of: ColumnRole, column: &str| {
        if !has_parts(map, of) {
            return role(of);
        }
        map.column(of).map(|_| ValueColumn {
            column: column.to_owned(),
            unit: Some("deg".to_owned()),
            scale: 1.0,
            offset: 0.0,
        })
    };
    if let (Some(latitude), Some(longitude)) = (
        place(ColumnRole::Latitude, PLACE[0]),
        place(ColumnRole::Longitude, PLACE[1]),
    ) {
        channels.push(ChannelFile {
            latitude: Some(latitude),
            longitude: Some(longitude),
            ..channel("gps")
        });
    }
    if let Some(place) = map.column(ColumnRole::Place) {
        let part = |column: &str| ValueColumn {
            column: column.to_owned(),
            ..value(place)
        };
        channels.push(ChannelFile {
            latitude: Some(part(PLACE[0])),
            longitude: Some(part(PLACE[1])),
            ..channel("gps")
        });
    }
    let north = ColumnRole::Channel(ChannelName::GpsVelocityNorth);
    let has_velocity = map.column(north).is_some() || has_body_velocity(map);
    let course = (role(ColumnRole::SpeedOverGround), role(ColumnRole::Course));
    if let ((Some(speed), Some(course)), false) = (course, has_velocity) {
        channels.push(ChannelFile {
            speed: Some(speed),
            course: Some(course),
            ..channel("gps_velocity")
        });
    }
    channels.extend(derived(map).into_iter().map(|(name, column)| ChannelFile {
        value: Some(ValueColumn {
            column: column.to_owned(),
            unit: None,
            scale: 1.0,
            offset: 0.0,
        }),
        ..channel(name.key())
    }));
    channels.extend(map.columns.iter().filter_map(|column| match column.role {
        ColumnRole::Channel(name) => Some(ChannelFile {
            value: Some(value(column)),
            ..channel(name.key())
        }),
        ColumnRole::BodyVelocity(axis) => Some(ChannelFile {
            value: Some(value(column)),
            ..channel(axis.channel().key())
        }),
        _ => None,
    }));
    channels
}

/// The first place on the globe that a table has, and when, seconds, where times have no date.
fn first_place(
    maps: &[ColumnMap],
    tables: &BTreeMap<String, Arc<CsvTable>>,
    channels: &[ChannelFile],
) -> Option<(OriginFile, Option<f64>)> {
    maps.iter().find_map(|map| {
        let table = tables.get(&map.file)?;
        let channel = channels
            .iter()
            .find(|c| c.file == map.file && c.name == "gps")?;
        let angles = |column: &Option<ValueColumn>| {
            let dimension = crate::cells::Dimension::Angle;
            table.values(column.as_ref()?, dimension).ok()
        };
        let pairs = angles(&channel.latitude)?
            .into_iter()
            .zip(angles(&channel.longitude)?);
        let is_place = |(latitude, longitude): &(f64, f64)| {
            latitude.abs() <= std::f64::consts::FRAC_PI_2
                && longitude.abs() <= std::f64::consts::TAU
                && (*latitude, *longitude) != (0.0, 0.0)
        };
        let places: Vec<_> = pairs
            .enumerate()
            .filter_map(|(row, (a, b))| Some((row, Some((a?, b?)).filter(is_place)?)))
            .collect();
        let (row, (latitude, longitude)) = first_of_most(&places)?;
        let origin = OriginFile {
            latitude_deg: latitude.to_degrees(),
            longitude_deg: longitude.to_degrees(),
            height_m: 0.0,
        };
        let channel = channels.iter().find(|c| c.file == map.file);
        let time = channel.map(|c| &c.time);
        let time = time.filter(|time| !time.format.is_absolute());
        let time = time.and_then(|time| table.times(time, None).ok()?.get(row).copied());
        Some((origin, time))
    })
}

/// The first of these places, latitude and longitude in radians, that most of the others are near to: the first may be
/// the damaged one.
fn first_of_most(places: &[(usize, (f64, f64))]) -> Option<(usize, (f64, f64))> {
    let on_sphere = |(latitude, longitude): (f64, f64)| {
        let (up, around) = (latitude.sin_cos(), longitude.sin_cos());
        EARTH_RADIUS * Vector3::new(up.1 * around.1, up.1 * around.0, up.0)
    };
    let all: Vec<_> = places.iter().map(|place| on_sphere(place.1)).collect();
    let is_among = |(place, _): &(&Vector3<f64>, _)| {
        let near = all
            .iter()
            .filter(|other| (*other - *place).norm() <= FARTHEST);
        2 * near.count() >= all.len()
    };
    let mut found = all.iter().zip(places).take(MOST_DAMAGED).filter(is_among);
    found
        .next()
        .map(|(_, place)| *place)
        .or(places.first().copied())
}

/// Makes the height above ground, where no table has it, of the height above the start of the flight: by air pressure
/// where it was measured, else by the receiver. Returns a sentence that says so.
fn height_above_start(folder: &mut FlightFolder) -> Option<String> {
    let flight = &mut folder.flight;
    if flight.channel(ChannelName::HeightAboveGround).is_some() {
        return None;
    }
    let measured = [ChannelName::BarometricHeight, ChannelName::GpsHeight];
    let mut known = measured.into_iter().filter_map(|name| flight.channel(name));
    // What shows one number for ever measures nothing, if the other moves.
    let moves = |channel: &&Channel| channel.values.iter().any(|v| *v != channel.values[0]);
    let known = known.clone().find(moves).or_else(|| known.next());
    let known = known.filter(|channel| !channel.times.is_empty())?;
    let start = known.interpolated(flight.start.time)?;
    let channel = Channel {
        name: ChannelName::HeightAboveGround,
        times: known.times.clone(),
        values: known.values.iter().map(|value| value - start).collect(),
    };
    let name = super::ColumnRole::Channel(known.name).label();
    flight.channels.push(channel);
    Some(format!(
        "no column is the height above ground: the {name} above the start stands for it"
    ))
}

/// Tables whose times lie apart from those of all others, in sentences.
fn apart(folder: &FlightFolder, maps: &[ColumnMap], layout: &FlightFile) -> Vec<String> {
    let span_of = |file: &str| {
        let of_file = |map: &&ChannelFile| map.file == file;
        let is_known = |map: &ChannelFile| {
            let name = match map.name.as_str() {
                "gps" => ChannelName::GpsNorth.key(),
                "gps_velocity" => ChannelName::GpsVelocityNorth.key(),
                name => name,
            };
            let channels = &folder.flight.channels;
            let channel = channels.iter().find(|c| c.name.key() == name)?;
            Some((*channel.times.first()?, *channel.times.last()?))
        };
        layout
            .channels
            .iter()
            .filter(of_file)
            .find_map(is_known)
            .map(|span| (file.to_owned(), span))
    };
    let spans: Vec<_> = maps.iter().filter_map(|map| span_of(&map.file)).collect();
    let is_apart = |index: usize| {
        let (_, (first, last)) = &spans[index];
        let mut others = spans
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != index);
        spans.len() > 1 && others.all(|(_, (_, (a, b)))| b < first || a > last)
    };
    let told = (0..spans.len()).filter(|index| is_apart(*index));
    told.map(|index| {
        let (file, (first, last)) = &spans[index];
        format!("{file}: its times, {first:.1} s to {last:.1} s, are those of no other table")
    })
    .collect()
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
