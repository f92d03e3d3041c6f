//! Meanings that only several columns together have, or several numbers in one: places in a cell, parts of a time,
//! hemispheres.

use super::ColumnRole::{Latitude, Longitude};
use super::header::{NameParts, parts};
use super::rows::pair;
use super::settle::{give_up, unused};
use super::{ColumnRole, ColumnSample, MappedColumn};
use crate::cells::DEGREES_AND_MINUTES;
use crate::folder::hemispheres::{letter, tells_of_letters};
use pilotage_base::hemisphere_in_name::hemispheres_in_names;

/// Finds the column that has latitude and longitude in each cell.
pub(super) fn places(samples: &[ColumnSample], columns: &mut [MappedColumn]) {
    if columns.iter().any(|column| column.role == Latitude) {
        return;
    }
    let is_place =
        |text: &String| pair(text).is_some_and(|(a, b)| a.abs() <= 90.0 && b.abs() <= 360.0);
    let found = samples.iter().position(|sample| {
        let count = sample.texts.iter().filter(|text| is_place(text)).count();
        sample.numbers.is_empty() && count > 2 && 10 * count >= 9 * sample.texts.len()
    });
    if let Some(index) = found {
        columns[index] = MappedColumn {
            role: ColumnRole::Place,
            unit: "deg".to_owned(),
            confidence: 0.9,
            reason: "each cell has two numbers that are a place on the globe".to_owned(),
            ..unused(&columns[index].name, "")
        };
    }
}

/// Puts seconds and the parts of them in a second column together, as ROS writes stamps: `stamp.sec`, `stamp.nanosec`.
pub(super) fn parts_of_time(samples: &[ColumnSample], columns: &mut [MappedColumn]) {
    let split = |name: &str| {
        let words = parts(name, "").words;
        let (last, stem) = words.split_last()?;
        Some((last.clone(), stem.to_vec()))
    };
    let find = |endings: &[&str], stem: Option<&[String]>| {
        samples.iter().position(|sample| {
            let found = split(&sample.name);
            found.is_some_and(|(last, of)| {
                endings.contains(&last.as_str()) && stem.is_none_or(|stem| *stem == of)
            })
        })
    };
    let parts = [
        ("ns", ["nanosec", "nsec", "nsecs", "nanosecs"]),
        ("us", ["microsec", "usec", "usecs", "microsecs"]),
    ];
    for (unit, endings) in parts {
        let Some(rest) = find(&endings, None) else {
            continue;
        };
        let stem = split(&samples[rest].name).map(|(_, stem)| stem);
        let Some(whole) = find(&["sec", "secs", "seconds"], stem.as_deref()) else {
            continue;
        };
        let has_other = columns
            .iter()
            .any(|c| c.role == ColumnRole::Time && c.unit != "s");
        if has_other || !samples[whole].is_numeric() || !samples[rest].is_numeric() {
            continue;
        }
        for column in columns
            .iter_mut()
            .filter(|column| column.role == ColumnRole::Time)
        {
            give_up(
                column,
                "seconds and parts of them stand in two other columns".to_owned(),
            );
        }
        for (index, role, unit) in [
            (whole, ColumnRole::Time, "s"),
            (rest, ColumnRole::TimeRest, unit),
        ] {
            columns[index] = MappedColumn {
                role,
                unit: unit.to_owned(),
                confidence: 0.9,
                reason: "seconds and parts of them stand in two columns".to_owned(),
                ..unused(&columns[index].name, "")
            };
        }
        return;
    }
}

/// Puts whole seconds and their fraction in a column of its own together, as receivers of Advanced Navigation write them:
/// `Unix Time`, `Microseconds`. Returns whether it did.
pub(super) fn fraction_of_time(samples: &[ColumnSample], columns: &mut [MappedColumn]) -> bool {
    let is_whole = |sample: &ColumnSample| sample.numbers.iter().all(|n| n.fract() == 0.0);
    let grows = |sample: &ColumnSample| sample.numbers.windows(2).all(|pair| pair[0] <= pair[1]);
    let is_called = |sample: &ColumnSample| {
        parts(&sample.name, "")
            .words
            .iter()
            .any(|word| word == "time")
    };
    let other = columns
        .iter()
        .any(|c| c.role == ColumnRole::Time && c.unit != "s");
    let whole = columns.iter().zip(samples).position(|(column, sample)| {
        (column.role == ColumnRole::Time || is_called(sample) && grows(sample))
            && sample.is_numeric()
            && is_whole(sample)
    });
    let whole = whole.filter(|_| !other);
    let fraction = samples.iter().enumerate().find_map(|(index, sample)| {
        let words = parts(&sample.name, "").words;
        let (unit, count) = match words.as_slice() {
            [word] if word == "microseconds" => ("us", 1e6),
            [word] if word == "nanoseconds" => ("ns", 1e9),
            [word] if word == "milliseconds" => ("ms", 1e3),
            _ => return None,
        };
        let (low, high) = sample.range()?;
        let falls = sample.numbers.windows(2).any(|pair| pair[1] < pair[0]);
        (falls && low >= 0.0 && high < count).then_some((index, unit))
    });
    let Some((whole, (index, unit))) = whole.zip(fraction) else {
        return false;
    };
    for (index, role, unit) in [
        (whole, ColumnRole::Time, "s"),
        (index, ColumnRole::TimeRest, unit),
    ] {
        columns[index] = MappedColumn {
            role,
            unit: unit.to_owned(),
            confidence: 0.9,
            reason: "whole seconds and their fraction stand in two columns".to_owned(),
            ..unused(&columns[index].name, "")
        };
    }
    true
}

/// The letters of hemispheres that the names of columns state.
fn named(samples: &[ColumnSample]) -> Vec<Option<char>> {
    let names: Vec<&str> = samples.iter().map(|sample| sample.name.as_str()).collect();
    hemispheres_in_names(&names)
}

/// The names of columns taken apart, without the letters of hemispheres.
pub(super) fn parts_without_hemispheres(samples: &[ColumnSample]) -> Vec<NameParts> {
    let name = |(sample, letter): (&ColumnSample, Option<char>)| match letter {
        None => parts(&sample.name, &sample.unit),
        Some('N' | 'S') => parts("latitude", ""),
        Some(_) => parts("longitude", ""),
    };
    samples.iter().zip(named(samples)).map(name).collect()
}

/// Turns latitudes and longitudes whose hemisphere stands in a column of its own or in their name, where that is south or
/// west, and those with a small s behind them, which is no second there.
pub(super) fn hemispheres(samples: &[ColumnSample], columns: &mut [MappedColumn]) {
    for (sample, column) in samples.iter().zip(columns.iter_mut()) {
        let is_south = column.role == Latitude && sample.unit.trim() == "s";
        if is_south && sample.range().is_some_and(|(low, _)| low >= 0.0) {
            column.scale = -1.0;
            column.reason = format!("{}; its cells end in s for south", column.reason);
        }
    }
    for ((sample, column), letter) in samples.iter().zip(columns.iter_mut()).zip(named(samples)) {
        let is_place = [Latitude, Longitude].contains(&column.role);
        let is_positive = sample.range().is_some_and(|(low, _)| low >= 0.0);
        if let Some(letter @ ('S' | 'W')) = letter.filter(|_| is_place && is_positive) {
            column.scale = -1.0;
            column.reason = format!("{}; its name says {letter}", column.reason);
        }
    }
    let both = [(Latitude, ['N', 'S']), (Longitude, ['E', 'W'])];
    let found = both.map(|(role, letters)| {
        let letter = |text: &String| letter(text).map(char::from);
        let is_of = |sample: &ColumnSample| {
            let mut texts = sample.texts.iter().map(letter);
            sample.numbers.is_empty()
                && !sample.texts.is_empty()
                && texts.all(|text| text.is_some_and(|text| letters.contains(&text)))
        };
        let place = columns.iter().position(|column| column.role == role)?;
        let is_named = |at: &usize| tells_of_letters(&samples[*at].name, role == Latitude);
        let mut of = (0..samples.len()).filter(|at| is_of(&samples[*at]));
        let own = of.clone().find(is_named);
        let at = own.or_else(|| of.find(|at| at.abs_diff(place) == 1))?;
        let turned = samples[at].texts.iter();
        let turned = turned.filter(|text| letter(text) == Some(letters[1]));
        Some((place, at, turned.count(), own.is_some()))
    });
    let are_both = found.iter().all(Option::is_some);
    for (found, (_, letters)) in found.into_iter().zip(both) {
        // A letter may be a mode or a level: its column's name says what it is, or both stand beside their angles.
        let Some((place, at, turned, _)) = found.filter(|found| found.3 || are_both) else {
            continue;
        };
        let sample = &samples[at];
        let is_positive = |at: usize| samples[at].range().is_some_and(|(low, _)| low >= 0.0);
        if turned == 0 || !is_positive(place) {
            continue;
        }
        let column = &mut columns[place];
        if turned == sample.texts.len() {
            column.scale = -1.0;
            column.reason = format!("{}; {} says {}", column.reason, sample.name, letters[1]);
        } else {
            let reason = format!(
                "{} changes between {} and {}",
                sample.name, letters[0], letters[1]
            );
            give_up(column, reason);
        }
    }
}

/// Reads latitudes and longitudes whose degrees and minutes stand in one number, as satellite receivers write them: one of
/// both has numbers mostly that no degrees reach, some with a fraction, and no number of either has sixty minutes or more.
pub(super) fn degrees_and_minutes(samples: &[ColumnSample], columns: &mut [MappedColumn]) {
    let of = |role| columns.iter().position(|column| column.role == role);
    let Some(places) = of(Latitude).zip(of(Longitude)) else {
        return;
    };
    let places = [(places.0, 90.0), (places.1, 180.0)];
    let are_beyond = |(at, most): &(usize, f64)| {
        // Zeros stand for no fix.
        let numbers = samples[*at].numbers.iter().filter(|n| **n != 0.0);
        let beyond: Vec<&f64> = numbers.clone().filter(|n| n.abs() > *most).collect();
        2 * beyond.len() > numbers.count() && beyond.iter().any(|n| n.fract() != 0.0)
    };
    let fit = |(at, most): &(usize, f64)| {
        let mut numbers = samples[*at].numbers.iter();
        numbers.all(|n| n.abs() <= 100.0 * most && n.abs() % 100.0 < 60.0)
    };
    if !places.iter().any(are_beyond) || !places.iter().all(fit) {
        return;
    }
    for (at, _) in places {
        DEGREES_AND_MINUTES.clone_into(&mut columns[at].unit);
        let reason = &mut columns[at].reason;
        *reason = format!(
            "{reason}; degrees and minutes stand in one number, as receivers write them (NMEA)"
        );
    }
}
