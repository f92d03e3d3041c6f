//! Times of flight.json that are counted in parts of seconds, though nothing says so.

use std::collections::BTreeSet;

use super::clock::TimeFormat;
use super::files::FolderFiles;
use super::layout::{FlightFile, TimeColumn};
use crate::cells::ColumnSample;
use crate::cells::time::unit_of_time;

/// Seconds between rows, in the middle, that no series of a flight has.
const LONGEST_STEP: f64 = 100.0;
/// No seconds since 1970 are so many.
const LATEST: f64 = 1e11;

/// Reads times that cannot be seconds, and whose format is that, in the part of a second that they must be; says so in
/// the folder's notes.
pub(super) fn settle(folder: &mut FolderFiles, layout: &mut FlightFile) {
    let mut told = BTreeSet::new();
    let frames = layout
        .frames
        .iter_mut()
        .map(|map| (&map.file, &mut map.time));
    let channels = layout
        .channels
        .iter_mut()
        .map(|map| (&map.file, &mut map.time));
    let states = layout.truth.iter_mut().flat_map(|truth| &mut truth.states);
    let states = states.map(|map| (&map.file, &mut map.time));
    for (file, time) in frames.chain(channels).chain(states) {
        let Some((format, unit)) = found(folder, file, time) else {
            continue;
        };
        time.format = format;
        if told.insert((file.clone(), time.column.clone())) {
            folder.notes.push(format!(
                "{file}: the times in column \"{}\" are taken for {unit}, as they cannot be seconds; state \"format\" in \
                 flight.json to have them otherwise",
                time.column
            ));
        }
    }
}

/// The format that times must have which are said to be seconds and cannot be.
fn found(
    folder: &mut FolderFiles,
    file: &str,
    time: &TimeColumn,
) -> Option<(TimeFormat, &'static str)> {
    if time.format != TimeFormat::Seconds {
        return None;
    }
    // What is wrong with the table is told where it is read.
    let table = folder.table(file, "time").ok()?;
    let numbers = table.numbers(&time.column).ok()??;
    let sample = ColumnSample {
        numbers: numbers
            .into_iter()
            .filter(|number| number.is_finite())
            .collect(),
        ..ColumnSample::default()
    };
    let mut steps: Vec<f64> = sample.numbers.windows(2).map(|w| w[1] - w[0]).collect();
    steps.sort_by(f64::total_cmp);
    let step = *steps.get(steps.len() / 2)?;
    if step <= LONGEST_STEP && sample.reach() < LATEST {
        return None;
    }
    let (unit, ..) = unit_of_time(&sample, None, 1.0)?;
    match unit {
        "ms" => Some((TimeFormat::Milliseconds, "milliseconds")),
        "us" => Some((TimeFormat::Microseconds, "microseconds")),
        "ns" => Some((TimeFormat::Nanoseconds, "nanoseconds")),
        _ => None,
    }
}
