//! What the columns of a table mean, guessed.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::header::{Parts, parts};
use super::names::{NameGuess, meanings};
use super::time::unit_of_time;
use super::values::{UnitGuess, are_degrees, unit};
use super::{Alternative, ColumnMap, ColumnRole, MappedColumn, Sample, TableShape};
use crate::folder::{Dimension, decoded};

/// Bytes of the beginning that are looked at for the shape, and of each of the places that are looked at for values.
const HEAD: usize = 1 << 16;
const PIECE: usize = 1 << 12;
/// How many such places there are.
const PLACES: usize = 64;
/// Below this a name says nothing.
const LEAST: f64 = 0.3;
/// Words of columns that number their rows.
const NUMBERS: [&str; 10] = [
    "id", "index", "idx", "no", "number", "seq", "sequence", "row", "sample", "frame",
];

/// What the columns of a table mean; `None` if it is no table with numbers.
///
/// Looks at its beginning and at some places all over it, so that it takes no longer for a long one.
pub fn guess_table(file: &str, bytes: &[u8]) -> Option<ColumnMap> {
    guess_with_samples(file, bytes).map(|(map, ..)| map)
}

/// What the columns of a table mean, with samples of them all and which share of its rows they are, about.
pub(super) fn guess_with_samples(
    file: &str,
    bytes: &[u8],
) -> Option<(ColumnMap, Vec<Sample>, f64)> {
    let head = text(&bytes[..bytes.len().min(HEAD)]);
    let shape = TableShape::of(&head)?;
    let (mut samples, share) = samples(&head, bytes, &shape);
    tell_apart(&mut samples);
    let map = ColumnMap {
        file: file.to_owned(),
        shape,
        columns: guess_columns(&samples, share),
        rows_per_second: None,
    };
    Some((map, samples, share))
}

/// Gives every column a name of its own: `Alt`, `Alt (2)`; `#3` where the third has none.
fn tell_apart(samples: &mut [Sample]) {
    let mut taken = BTreeSet::new();
    for (index, sample) in samples.iter_mut().enumerate() {
        if sample.name.is_empty() {
            sample.name = format!("#{}", index + 1);
        }
        let plain = sample.name.clone();
        let mut number = 1;
        while !taken.insert(sample.name.clone()) {
            number += 1;
            sample.name = format!("{plain} ({number})");
        }
    }
}

/// Text of bytes that may end within a letter.
fn text(bytes: &[u8]) -> Cow<'_, str> {
    match decoded(bytes) {
        Cow::Borrowed(bytes) => String::from_utf8_lossy(bytes),
        Cow::Owned(bytes) => Cow::Owned(String::from_utf8_lossy(&bytes).into_owned()),
    }
}

/// Samples of all columns, and which share of all rows they are, about.
fn samples(head: &str, bytes: &[u8], shape: &TableShape) -> (Vec<Sample>, f64) {
    let mut lines = head.lines().skip(shape.skipped_lines);
    let mut line = || {
        lines
            .next()
            .map(|line| line.trim_start_matches(['#', '%', '!']).trim())
    };
    let names = if shape.has_header { line() } else { None };
    let units = if shape.has_units { line() } else { None };
    let cells = |line: Option<&str>| -> Vec<String> {
        let cells = line
            .map(|line| shape.separator.cells(line))
            .unwrap_or_default();
        cells.into_iter().map(Cow::into_owned).collect()
    };
    let (names, units) = (cells(names), cells(units));
    let mut samples: Vec<Sample> = Vec::new();
    let (mut rows, mut looked_at) = (0_usize, 0_usize);
    let mut add = |line: &str| {
        if line.trim().is_empty() || line.starts_with('#') {
            return;
        }
        rows += 1;
        looked_at += line.len() + 1;
        for (index, cell) in shape.separator.cells(line).iter().enumerate() {
            if samples.len() <= index {
                samples.push(Sample {
                    name: names
                        .get(index)
                        .cloned()
                        .unwrap_or_else(|| format!("#{}", index + 1)),
                    unit: units.get(index).cloned().unwrap_or_default(),
                    ..Sample::default()
                });
            }
            let sample = &mut samples[index];
            match shape.number(cell) {
                Some(number) => sample.numbers.push(number),
                None if cell.is_empty() => sample.empty += 1,
                None => sample.texts.push(cell.clone().into_owned()),
            }
        }
    };
    let skipped = shape.skipped_lines + shape.head_lines();
    // The last line of a piece may be cut off.
    let whole = |text: &str| text.rfind('\n').map_or(0, |end| end + 1);
    if bytes.len() <= HEAD {
        head.lines().skip(skipped).for_each(&mut add);
    } else {
        head[..whole(head)]
            .lines()
            .skip(skipped)
            .take(PIECE / 8)
            .for_each(&mut add);
        for place in 1..PLACES {
            let start = (bytes.len() - PIECE).max(1) / PLACES * place;
            if start < HEAD {
                continue;
            }
            let piece = text(&bytes[start..(start + PIECE).min(bytes.len())]);
            piece[..whole(&piece)].lines().skip(1).for_each(&mut add);
        }
    }
    let share = looked_at as f64 / bytes.len().max(1) as f64;
    (samples, share.clamp(1e-9, 1.0))
}

/// A column that may be the time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimeGuess {
    /// Which column.
    pub column: usize,
    /// Its unit.
    pub unit: &'static str,
    /// How surely, 0 to 1.
    pub confidence: f64,
    /// Why, in words.
    pub reason: String,
}

/// The column that is the time.
pub(crate) fn guess_time(samples: &[Sample], share: f64) -> Option<TimeGuess> {
    let candidates = times(samples, share).into_iter();
    // Of equals the first.
    candidates.fold(None, |best: Option<TimeGuess>, found| match best {
        Some(best) if best.confidence >= found.confidence => Some(best),
        _ => Some(found),
    })
}

/// Every column that may be the time, in the order of the columns.
pub(super) fn times(samples: &[Sample], share: f64) -> Vec<TimeGuess> {
    let has_names = samples.iter().any(|sample| !sample.name.starts_with('#'));
    let candidate = |(column, sample): (usize, &Sample)| {
        let parts = parts(&sample.name, &sample.unit);
        let named = meanings(&parts.words)
            .into_iter()
            .chain(meanings(parts.plain_words()));
        let named = named
            .filter(|guess| guess.role == ColumnRole::Time)
            .map(|g| g.confidence);
        let named = named.fold(0.0, f64::max);
        let is_number = parts
            .words
            .iter()
            .any(|word| NUMBERS.contains(&word.as_str()));
        let (unit, confidence, reason) = unit_of_time(sample, parts.time_unit(), share)?;
        let is_date = unit == super::time::DATE;
        let by_name = match named {
            0.0 if is_date => 0.9,
            // Among columns with names the time has one.
            0.0 if has_names || is_number => return None,
            0.0 => 0.6,
            named => named,
        };
        Some(TimeGuess {
            column,
            unit,
            confidence: by_name * confidence,
            reason,
        })
    };
    samples.iter().enumerate().filter_map(candidate).collect()
}

/// What columns mean of which these are samples, `share` of all rows.
pub(crate) fn guess_columns(samples: &[Sample], share: f64) -> Vec<MappedColumn> {
    let time = guess_time(samples, share);
    let taken: Vec<(Parts, Vec<NameGuess>)> = samples
        .iter()
        .map(|sample| {
            let parts = parts(&sample.name, &sample.unit);
            let guesses = meanings(parts.plain_words());
            (parts, guesses)
        })
        .collect();
    let has_degrees = has_degrees(samples, &taken);
    let mut columns: Vec<MappedColumn> = samples
        .iter()
        .zip(&taken)
        .enumerate()
        .map(|(index, (sample, (parts, guesses)))| match &time {
            Some(time) if time.column == index => time_column(&sample.name, time),
            _ => column(sample, parts, guesses, has_degrees),
        })
        .collect();
    settle(&mut columns);
    columns
}

/// Whether some angle of the table is surely in degrees, or in radians.
fn has_degrees(samples: &[Sample], taken: &[(Parts, Vec<NameGuess>)]) -> Option<bool> {
    let angles = samples.iter().zip(taken).filter(|(_, (_, guesses))| {
        let angle = |role: ColumnRole| {
            matches!(Dimension::of(role.quantity()?), Dimension::Angle).then_some(())
        };
        let is_place = |role| matches!(role, ColumnRole::Latitude | ColumnRole::Longitude);
        guesses
            .first()
            .is_some_and(|g| !is_place(g.role) && angle(g.role).is_some())
    });
    let said: Vec<bool> = angles
        .filter_map(|(sample, (parts, _))| match parts.unit(Dimension::Angle) {
            Some(unit) => Some(unit != "rad"),
            None => are_degrees(sample),
        })
        .collect();
    said.iter().find(|said| **said).or(said.first()).copied()
}

/// The column called so as the time.
pub(super) fn time_column(name: &str, time: &TimeGuess) -> MappedColumn {
    MappedColumn {
        role: ColumnRole::Time,
        unit: time.unit.to_owned(),
        confidence: time.confidence,
        reason: time.reason.clone(),
        ..unused(name, "")
    }
}

fn unused(name: &str, reason: &str) -> MappedColumn {
    MappedColumn {
        name: name.to_owned(),
        role: ColumnRole::Nothing,
        unit: String::new(),
        scale: 1.0,
        offset: 0.0,
        confidence: 0.0,
        reason: reason.to_owned(),
        alternatives: Vec::new(),
    }
}

fn column(
    sample: &Sample,
    parts: &Parts,
    guesses: &[NameGuess],
    has_degrees: Option<bool>,
) -> MappedColumn {
    if !sample.is_numeric() {
        return unused(&sample.name, "its cells are no numbers");
    }
    let measured = guesses
        .iter()
        .filter(|guess| guess.role != ColumnRole::Time);
    let units: Vec<(NameGuess, UnitGuess, bool)> = measured
        .filter_map(|guess| {
            let dimension = Dimension::of(guess.role.quantity()?);
            let stated = parts.unit(dimension).map(|unit| UnitGuess {
                unit,
                confidence: 1.0,
                reason: format!("the table says {unit}"),
            });
            let is_stated = stated.is_some();
            Some((
                *guess,
                stated.or_else(|| unit(guess.role, sample, has_degrees))?,
                is_stated,
            ))
        })
        .collect();
    let Some((best, unit, is_stated)) = units.first().filter(|(g, ..)| g.confidence >= LEAST)
    else {
        return unused(
            &sample.name,
            "its name says nothing that a flight has a place for",
        );
    };
    let mut confidence = best.confidence * unit.confidence;
    let mut reason = format!("it is called {}; {}", sample.name, unit.reason);
    if sample.is_constant() {
        confidence *= 0.7;
        reason += "; it never changes";
    }
    let mut alternatives: Vec<Alternative> = units[1..]
        .iter()
        .map(|(guess, unit, _)| Alternative {
            role: guess.role,
            unit: unit.unit.to_owned(),
            confidence: guess.confidence * unit.confidence,
        })
        .collect();
    if !is_stated {
        let others = best
            .role
            .units()
            .into_iter()
            .filter(|other| *other != unit.unit);
        alternatives.extend(others.take(2).map(|other| Alternative {
            role: best.role,
            unit: other.to_owned(),
            confidence: best.confidence * (1.0 - unit.confidence) / 2.0,
        }));
    }
    alternatives.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    MappedColumn {
        role: best.role,
        unit: unit.unit.to_owned(),
        scale: best.sign,
        confidence,
        reason,
        alternatives,
        ..unused(&sample.name, "")
    }
}

/// Leaves each role to the column that most likely is it, and takes away those that are of no use alone.
fn settle(columns: &mut [MappedColumn]) {
    use ColumnRole::{Channel, Course, Latitude, Longitude, SpeedOverGround};
    use pilotage_flight::ChannelName::{GpsEast, GpsNorth};
    for index in 0..columns.len() {
        let (role, confidence) = (columns[index].role, columns[index].confidence);
        let better = columns.iter().enumerate().find(|(other, column)| {
            let wins =
                column.confidence > confidence || column.confidence == confidence && *other < index;
            *other != index && column.role == role && wins
        });
        if let Some((_, better)) = better.filter(|_| role != ColumnRole::Nothing) {
            let reason = format!("{} is more likely the {}", better.name, role.label());
            give_up(&mut columns[index], reason);
        }
    }
    for (one, other) in [
        (Latitude, Longitude),
        (SpeedOverGround, Course),
        (Channel(GpsNorth), Channel(GpsEast)),
    ] {
        for (one, other) in [(one, other), (other, one)] {
            let has_other = columns.iter().any(|column| column.role == other);
            let alone = columns
                .iter_mut()
                .find(|column| column.role == one)
                .filter(|_| !has_other);
            if let Some(column) = alone {
                let reason = format!("{} is of no use without {}", one.label(), other.label());
                give_up(column, reason);
            }
        }
    }
    // Places on the globe say where metres are counted from.
    if columns.iter().any(|column| column.role == Latitude) {
        for column in columns.iter_mut() {
            if matches!(column.role, Channel(GpsNorth | GpsEast)) {
                give_up(column, "latitude and longitude say more".to_owned());
            }
        }
    }
}

/// Takes its role from a column, and keeps it as the first of what else it may be.
pub(super) fn give_up(column: &mut MappedColumn, reason: String) {
    column.alternatives.insert(
        0,
        Alternative {
            role: column.role,
            unit: std::mem::take(&mut column.unit),
            confidence: column.confidence,
        },
    );
    column.role = ColumnRole::Nothing;
    column.scale = 1.0;
    column.confidence = 0.0;
    column.reason = reason;
}
