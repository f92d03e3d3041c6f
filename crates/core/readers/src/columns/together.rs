//! Tables that were written together: one clock for all, and each channel from one of them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::flights::beginnings_of_flights;
use super::groups::context;
use super::guess::{ColumnGuesses, TimeGuess, guess_with_samples, time_column, times, wanted};
use super::physics::{self, TableEvidence};
use super::rows::EvenRows;
use super::settle::give_up;
use super::{ColumnMap, ColumnRole, ColumnSample, TablePreview, preview};
use crate::cells::time::seconds_counted;
use pilotage_base::files::{FileSet, file_of};
use pilotage_flight::ChannelName;

/// Rows that are shown of a table.
const SHOWN: usize = 4;
/// Confidence from which on a column is the time in a table that is one of a flight.
const SURE_TIME: f64 = 0.4;
/// Preference of the receiver's own table over others for channels of satellite navigation.
const RECEIVER: f64 = 0.3;
/// Confidences nearer to each other than this are equal.
const EQUAL: f64 = 0.05;

/// A table whose columns were guessed, with what is shown beside the guess.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GuessedTable {
    /// Meanings of its columns.
    pub map: ColumnMap,
    /// Its first rows.
    pub preview: TablePreview,
    /// Smallest and largest number of each column as it stands in the cells, at places all over the table.
    pub ranges: Vec<Option<(f64, f64)>>,
    /// Rows that it has, about.
    pub rows: f64,
    /// Whether a flight is likely to be made of it, together with the others that are proposed.
    pub is_proposed: bool,
}

impl GuessedTable {
    /// Whether it is surely one of a flight: it has a time and something that was measured.
    pub fn is_of_a_flight(&self) -> bool {
        let time = self.map.column(ColumnRole::Time);
        time.is_some_and(|time| time.confidence >= SURE_TIME) && self.map.lacks().is_none()
    }

    /// Rows a second, by its times; 0 without any.
    fn rate(&self) -> f64 {
        let time = |column: &super::MappedColumn| column.role == ColumnRole::Time;
        let index = self.map.columns.iter().position(time);
        let span = index.and_then(|index| {
            let (first, last) = (*self.ranges.get(index)?)?;
            Some((last - first) * seconds_counted(&self.map.columns[index].unit)?)
        });
        span.filter(|span| *span > 0.0)
            .map_or(0.0, |span| self.rows / span)
    }
}

/// Guesses the meanings of the columns of the tables `names`, which were written together; files that are no
/// table are left out.
///
/// Tables of several flights, as the beginnings of their names tell, are told apart; those of the flight with most of
/// them are proposed.
///
/// Where one table counts its time from elsewhere than the others, and has a second column of times that agrees with
/// theirs, that one is taken. Where several have the same channel, it is left to the likeliest, or else to the one with
/// most rows a second.
pub fn guess_tables(files: &dyn FileSet, names: &[String]) -> Vec<GuessedTable> {
    let read = |name: &String| {
        let bytes = files.read(name)?;
        let ColumnGuesses {
            map,
            samples,
            share,
            hints,
            groups,
        } = guess_with_samples(name, &bytes, names.len() == 1)?;
        let clocks = CountedTimes::all(&samples, share);
        let rows = if map.column(ColumnRole::Time).is_some() {
            let times: Vec<usize> = clocks.iter().map(|clock| clock.guess.column).collect();
            EvenRows::of(&bytes, &map.shape, &wanted(&map, &groups, &times)).with_parts(&map)
        } else {
            EvenRows::default()
        };
        let evidence = TableEvidence {
            rows,
            hints,
            groups,
        };
        let cells =
            |sample: &ColumnSample| sample.numbers.len() + sample.texts.len() + sample.empty;
        let table = GuessedTable {
            preview: preview(&bytes, &map, SHOWN),
            ranges: samples.iter().map(ColumnSample::range).collect(),
            rows: (samples.iter().map(cells).max().unwrap_or(0) as f64 / share).round(),
            map,
            is_proposed: false,
        };
        Some((table, (clocks, evidence)))
    };
    let found: Vec<_> = names.iter().filter_map(read).collect();
    let mut flights: BTreeMap<String, Vec<(GuessedTable, _)>> = BTreeMap::new();
    let sure = found.iter().filter(|(table, _)| table.is_of_a_flight());
    let sure: Vec<&str> = sure.map(|(table, _)| table.map.file.as_str()).collect();
    let beginnings = beginnings_of_flights(&sure);
    for (table, clocks) in found {
        let begins = |start: &&String| table.map.file.starts_with(start.as_str());
        let flight = beginnings.iter().find(begins).cloned().unwrap_or_default();
        let of_flight = flights.entry(flight).or_default();
        of_flight.push((table, clocks));
    }
    let together = |of_flight: Vec<(GuessedTable, (Vec<CountedTimes>, TableEvidence))>| {
        let (mut tables, known): (Vec<_>, Vec<_>) = of_flight.into_iter().unzip();
        let (clocks, evidence): (Vec<_>, Vec<_>) = known.into_iter().unzip();
        agree_on_time(&mut tables, &clocks);
        settle(&mut tables);
        let mut maps: Vec<_> = tables.iter_mut().map(|table| &mut table.map).collect();
        physics::judge(&mut maps, &evidence);
        settle(&mut tables);
        tables
    };
    let mut flights: Vec<Vec<GuessedTable>> = flights.into_values().map(together).collect();
    let worth = |tables: &Vec<GuessedTable>| {
        let of_flight = tables.iter().filter(|table| table.is_of_a_flight());
        let of_flight = of_flight.map(|table| table.rows);
        of_flight.fold((0, 0), |(count, rows), more| {
            (count + 1, rows + more as u64)
        })
    };
    if let Some(best) = flights.iter_mut().max_by_key(|tables| worth(tables)) {
        for table in best.iter_mut() {
            table.is_proposed = table.is_of_a_flight();
        }
    }
    flights.into_iter().flatten().collect()
}

/// A column of times that are counted: when it begins and ends, seconds.
struct CountedTimes {
    guess: TimeGuess,
    span: (f64, f64),
}

impl CountedTimes {
    /// Those of a table.
    fn all(samples: &[ColumnSample], share: f64) -> Vec<Self> {
        let clock = |guess: TimeGuess| {
            let (first, last) = samples.get(guess.column)?.range()?;
            let seconds = seconds_counted(guess.unit)?;
            let span = (first * seconds, last * seconds);
            Some(Self { guess, span })
        };
        times(samples, share)
            .into_iter()
            .filter_map(clock)
            .collect()
    }

    /// Whether two run together for at least half of the shorter.
    fn agrees(&self, other: &Self) -> bool {
        let ((a, b), (c, d)) = (self.span, other.span);
        let shorter = (b - a).min(d - c);
        b.min(d) - a.max(c) >= 0.5 * shorter
    }
}

/// Has every table count its time as most of them do, where it can.
fn agree_on_time(tables: &mut [GuessedTable], clocks: &[Vec<CountedTimes>]) {
    let agreeing = |clock: &CountedTimes| {
        let agrees = |others: &&Vec<CountedTimes>| others.iter().any(|other| clock.agrees(other));
        clocks.iter().filter(agrees).count()
    };
    let all = clocks.iter().flatten();
    let best = all.fold(None, |best: Option<(usize, &CountedTimes)>, clock| {
        let count = agreeing(clock);
        match best {
            Some((most, _)) if most >= count => best,
            _ => Some((count, clock)),
        }
    });
    let Some((_, reference)) = best.filter(|(count, _)| *count > 1) else {
        return;
    };
    for (table, clocks) in tables.iter_mut().zip(clocks) {
        let columns = &mut table.map.columns;
        let taken = columns.iter().position(|c| c.role == ColumnRole::Time);
        let is_taken = |clock: &&CountedTimes| Some(clock.guess.column) == taken;
        let Some(present) = clocks.iter().find(is_taken) else {
            continue;
        };
        let other = clocks.iter().find(|clock| clock.agrees(reference));
        let Some(other) = other.filter(|_| !present.agrees(reference)) else {
            continue;
        };
        let before = &mut columns[present.guess.column];
        give_up(
            before,
            "its times are not those of the other tables".to_owned(),
        );
        let column = &mut columns[other.guess.column];
        *column = time_column(&column.name, &other.guess);
        column.reason += "; it runs with the times of the other tables";
    }
}

/// The channels that a table gives, and the columns that each is made of.
fn channels(map: &ColumnMap) -> Vec<(ChannelName, Vec<usize>)> {
    let place = |role: ColumnRole| map.columns.iter().position(|column| column.role == role);
    let numbered = map.columns.iter().enumerate();
    let single = numbered.filter_map(|(index, column)| match column.role {
        ColumnRole::Channel(name) => Some((name, vec![index])),
        ColumnRole::BodyVelocity(axis) => Some((axis.channel(), vec![index])),
        _ => None,
    });
    let mut channels: Vec<_> = single.collect();
    let pairs = [
        (
            [ColumnRole::Latitude, ColumnRole::Longitude],
            [ChannelName::GpsNorth, ChannelName::GpsEast],
        ),
        (
            [ColumnRole::SpeedOverGround, ColumnRole::Course],
            [ChannelName::GpsVelocityNorth, ChannelName::GpsVelocityEast],
        ),
        (
            [ColumnRole::WindSpeed, ColumnRole::WindFrom],
            [ChannelName::WindNorth, ChannelName::WindEast],
        ),
    ];
    for ([first, second], names) in pairs {
        let Some((first, second)) = place(first).zip(place(second)) else {
            continue;
        };
        // Velocities north and east say more than speed and course.
        let is_told = channels.iter().any(|(name, _)| *name == names[0]);
        if !is_told || names[0] == ChannelName::GpsNorth {
            channels.extend(names.map(|name| (name, vec![first, second])));
        }
    }
    if let Some(index) = place(ColumnRole::Place) {
        channels
            .extend([ChannelName::GpsNorth, ChannelName::GpsEast].map(|name| (name, vec![index])));
    }
    for is_ros in [false, true] {
        let parts = super::groups::quaternion_roles(is_ros).map(place);
        if let [Some(w), Some(x), Some(y), Some(z)] = parts {
            let angles = [ChannelName::Roll, ChannelName::Pitch, ChannelName::Heading];
            channels.extend(angles.map(|name| (name, vec![w, x, y, z])));
        }
    }
    channels
}

/// Preference of a table for a channel; greater is better.
fn preference(table: &GuessedTable, name: ChannelName, columns: &[usize]) -> f64 {
    let columns = columns.iter().map(|index| &table.map.columns[*index]);
    let confidence = columns.map(|column| column.confidence).fold(1.0, f64::min);
    let words = context(&table.map.file);
    let is_called = words
        .iter()
        .any(|word| word.starts_with("gps") || ["gnss", "fix"].contains(&word.as_str()));
    let has = |role| table.map.column(role).is_some();
    let is_receiver = has(ColumnRole::Latitude) || has(ColumnRole::Place);
    let of_satellites = matches!(
        name,
        ChannelName::GpsHeight
            | ChannelName::GpsVelocityNorth
            | ChannelName::GpsVelocityEast
            | ChannelName::GpsVelocityDown
            | ChannelName::GpsNorth
            | ChannelName::GpsEast
    );
    // Roll, pitch and heading of one table belong together.
    let angles = [ChannelName::Roll, ChannelName::Pitch, ChannelName::Heading];
    let given: Vec<ChannelName> = channels(&table.map)
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    let is_whole = angles.contains(&name) && angles.iter().all(|angle| given.contains(angle));
    let by_group = if is_whole { 2.0 * EQUAL } else { 0.0 };
    let by_name = if is_called && of_satellites {
        EQUAL
    } else {
        0.0
    };
    confidence
        + by_name
        + by_group
        + if is_receiver && of_satellites {
            RECEIVER
        } else {
            0.0
        }
}

/// Leaves each channel to one of the tables that a flight can be made of.
fn settle(tables: &mut [GuessedTable]) {
    for name in ChannelName::ALL {
        let of_table = |(index, table): (usize, &GuessedTable)| {
            let found = channels(&table.map).into_iter().find(|(n, _)| *n == name);
            let (_, columns) = found.filter(|_| table.map.lacks().is_none())?;
            Some((index, preference(table, name, &columns), columns))
        };
        let claims: Vec<_> = tables.iter().enumerate().filter_map(of_table).collect();
        let better = |(a, of_a): (usize, f64), (b, of_b): (usize, f64)| {
            if (of_a - of_b).abs() < EQUAL {
                tables[b].rate() > 1.2 * tables[a].rate()
            } else {
                of_b > of_a
            }
        };
        let best = claims.iter().fold(None, |best, (index, claim, _)| {
            let claim = (*index, *claim);
            match best {
                Some(best) if !better(best, claim) => Some(best),
                _ => Some(claim),
            }
        });
        let Some((best, _)) = best else { continue };
        let reason = format!("{} has it, too", file_of(&tables[best].map.file));
        for (index, _, columns) in claims.iter().filter(|(index, ..)| *index != best) {
            for column in columns {
                give_up(&mut tables[*index].map.columns[*column], reason.clone());
            }
        }
    }
}

/// Name of tables together: the common beginning of their names, else the folder that they lie in, else the name of
/// the first without its ending.
pub(super) fn common_name(maps: &[ColumnMap]) -> String {
    let Some(first) = maps.first() else {
        return "Flight".to_owned();
    };
    let name = file_of(&first.file);
    let is_common = |end: &usize| {
        maps.iter()
            .all(|map| file_of(&map.file).starts_with(&name[..*end]))
    };
    let ends = name.match_indices(['_', '-']).map(|(end, _)| end);
    let end = ends
        .rev()
        .find(is_common)
        .filter(|end| *end > 0 && maps.len() > 1);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let folder = |map: &ColumnMap| {
        map.file
            .rsplit_once('/')
            .map(|(folder, _)| file_of(folder).to_owned())
    };
    let is_one_folder = maps.len() > 1 && maps.iter().all(|map| folder(map) == folder(first));
    match (end, folder(first).filter(|_| is_one_folder)) {
        (Some(end), _) => name[..end].to_owned(),
        (None, Some(folder)) => folder,
        (None, None) => stem.to_owned(),
    }
}

/// Why the flight of these tables cannot be navigated, in words; `None` if it can.
pub fn tables_lack_to_navigate(maps: &[&ColumnMap]) -> Option<&'static str> {
    let has = |name| {
        let role = ColumnRole::Channel(name);
        maps.iter().any(|map| map.column(role).is_some())
    };
    let heights = [
        ChannelName::HeightAboveGround,
        ChannelName::BarometricHeight,
        ChannelName::GpsHeight,
    ];
    if !has(ChannelName::Heading) {
        Some("no column is the heading, without which nothing can be navigated")
    } else if !heights.into_iter().any(has) {
        Some("no column is a height, without which nothing can be navigated")
    } else {
        None
    }
}

/// Why no flight can be made of these tables together, in words; `None` if one can.
pub fn tables_lack(maps: &[&ColumnMap]) -> Option<String> {
    if maps.is_empty() {
        return Some("no table is to be used".to_owned());
    }
    let alone = maps.iter().find_map(|map| Some((map, map.lacks()?)));
    if let Some((map, why)) = alone {
        return Some(format!("{}: {why}", file_of(&map.file)));
    }
    let mut known: Vec<(ChannelName, &str)> = Vec::new();
    for map in maps {
        for (name, _) in channels(map) {
            let other = known.iter().find(|(other, _)| *other == name);
            if let Some((_, other)) = other {
                let what = ColumnRole::Channel(name).label();
                let (other, file) = (file_of(other), file_of(&map.file));
                return Some(if other == file {
                    format!("{file} tells the {what} twice; let one column not be used")
                } else {
                    format!("{other} and {file} both tell the {what}; let one of them not be used")
                });
            }
            known.push((name, &map.file));
        }
    }
    None
}
