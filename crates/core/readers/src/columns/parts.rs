//! Times and angles whose parts stand in columns of their own: year to second, degrees to seconds; and the date beside a
//! clock.

use super::ColumnRole::{AngleRest, Date, Latitude, Longitude, Time, TimeRest};
use super::header::parts;
use super::part_units::{ANGLE_UNITS, CALENDAR, MILLISECONDS, SECONDS_REACH};
use super::settle::{give_up, unused};
use super::{ColumnRole, ColumnSample, MappedColumn, time};
use crate::cells::{Moment, date_and_time, days_since_1970, is_since_1970};

/// Words that columns of the seconds themselves end in.
const SECONDS: [&str; 6] = ["second", "seconds", "sec", "secs", "ss", "s"];

/// Units of the parts of latitudes and longitudes beside their degrees, with those that one of them is of a degree.
pub(super) const ANGLES: [(&str, ColumnRole, f64); 4] = [
    (ANGLE_UNITS[0], Latitude, 60.0),
    (ANGLE_UNITS[1], Latitude, 3600.0),
    (ANGLE_UNITS[2], Longitude, 60.0),
    (ANGLE_UNITS[3], Longitude, 3600.0),
];

/// The words of a column's name and of what stands in brackets behind it.
fn words(sample: &ColumnSample) -> Vec<String> {
    let mut name = parts(&sample.name, &sample.unit);
    if !name.unit.is_empty() {
        name.words.push(name.unit);
    }
    name.words
}

/// Whether all cells of a column are numbers within `range`, and whole ones if that is asked.
fn is_within(sample: &ColumnSample, range: [f64; 2], is_whole: bool) -> bool {
    let is_whole = !is_whole || sample.numbers.iter().all(|n| n.fract() == 0.0);
    let fits = sample.range();
    let fits = fits.is_some_and(|(low, high)| low >= range[0] && high <= range[1]);
    sample.is_numeric() && fits && is_whole
}

/// A column of a part of something.
fn part(column: &MappedColumn, role: ColumnRole, unit: &str, reason: &str) -> MappedColumn {
    MappedColumn {
        role,
        unit: unit.to_owned(),
        confidence: 0.9,
        reason: reason.to_owned(),
        ..unused(&column.name, "")
    }
}

/// Puts together hours, minutes and seconds, and the date where it has columns as well: the seconds become the time.
/// Returns whether it did.
pub(super) fn calendar(samples: &[ColumnSample], columns: &mut [MappedColumn]) -> bool {
    let split: Vec<(String, Vec<String>)> = samples
        .iter()
        .map(|sample| {
            let mut words = words(sample);
            // The second of two of one name: `MM (2)`.
            let is_count = |word: &String| word.bytes().all(|b| b.is_ascii_digit());
            if words.len() > 1 && words.last().is_some_and(is_count) {
                words.pop();
            }
            (words.pop().unwrap_or_default(), words)
        })
        .collect();
    // Of several called so that next to `near`: `MM` behind `HH` is minutes, behind `YYYY` months.
    let find = |endings: &[&str], range: [f64; 2], stem: &[String], near: usize| {
        let fits = |(index, (last, of)): &(usize, &(String, Vec<String>))| {
            endings.contains(&last.as_str())
                && of == stem
                && is_within(
                    &samples[*index],
                    range,
                    range != MILLISECONDS && range != SECONDS_REACH,
                )
        };
        let found = split
            .iter()
            .enumerate()
            .filter(fits)
            .map(|(index, _)| index);
        found.min_by_key(|index| index.abs_diff(near))
    };
    let hours = &CALENDAR[0];
    for (hour, (last, stem)) in split.iter().enumerate() {
        // Before the others are sought: a table may have thousands of columns.
        if !hours.1.contains(&last.as_str()) || !is_within(&samples[hour], hours.2, true) {
            continue;
        }
        let Some(seconds) = find(&SECONDS, SECONDS_REACH, stem, hour) else {
            continue;
        };
        let of = |number: usize, near: usize| {
            let (unit, endings, range) = CALENDAR[number];
            find(endings, range, stem, near).map(|index| (index, unit))
        };
        let Some(minute) = of(1, hour) else {
            continue;
        };
        let hour = (hour, hours.0);
        let year = of(2, hour.0);
        let month = year.and_then(|(year, _)| of(3, year));
        let day = month.and_then(|(month, _)| of(4, month));
        let [ms, ns] = [5, 6].map(|number| of(number, seconds));
        let date = [year, month, day];
        let date = date.iter().all(Option::is_some).then_some(date);
        let own: Vec<(usize, &str)> = [Some(hour), Some(minute), ms, ns]
            .into_iter()
            .chain(date.into_iter().flatten())
            .flatten()
            .collect();
        // A clock in one column says the same, and may say it finer.
        let is_own = |index: usize| index == seconds || own.iter().any(|(own, _)| *own == index);
        let mut others = columns.iter().zip(samples).enumerate();
        let is_told = others.any(|(index, (column, sample))| {
            let is_better = date.is_none() || is_finer(sample, &samples[seconds]);
            column.role == Time && !is_own(index) && is_better
        });
        if is_told {
            continue;
        }
        let reason = "the parts of the time stand in several columns";
        for (index, column) in columns.iter_mut().enumerate() {
            if column.role == Time && !is_own(index) {
                give_up(column, reason.to_owned());
            }
        }
        columns[seconds] = part(&columns[seconds], Time, "s", reason);
        for (index, unit) in own {
            columns[index] = part(&columns[index], TimeRest, unit, reason);
        }
        return true;
    }
    false
}

/// Whether a clock goes on between rows in which seconds stand still.
fn is_finer(clock: &ColumnSample, seconds: &ColumnSample) -> bool {
    let still = |of: &ColumnSample| of.numbers.windows(2).filter(|w| w[0] == w[1]).count();
    still(clock) < still(seconds)
}

/// Whether the number of a part of the time is one that calendars have.
fn is_of_calendar(unit: &str, value: f64) -> bool {
    let known = CALENDAR.iter().find(|(own, ..)| *own == unit);
    known.is_none_or(|(_, _, [least, most])| (*least..=*most).contains(&value))
}

/// Seconds of rows out of the parts of their time: those of seconds, and of each other unit. With a date they count from
/// 1970, without one from the first day; `None` where a part is missing.
pub(super) fn seconds(parts: &[(&str, Vec<Option<f64>>)], rows: usize) -> Vec<Option<f64>> {
    let of = |unit: &str, row: usize| {
        let column = parts.iter().find(|(own, _)| *own == unit);
        column.map(|(_, values)| values.get(row).copied().flatten())
    };
    let mut turned = 0.0;
    let mut last = f64::NEG_INFINITY;
    let mut seconds = Vec::with_capacity(rows);
    for row in 0..rows {
        let clock = || -> Option<f64> {
            let mut total = 0.0;
            for (unit, values) in parts {
                let value = values.get(row).copied().flatten()?;
                if !is_of_calendar(unit, value) {
                    return None;
                }
                total += match *unit {
                    "hours" => 3600.0 * value,
                    "minutes" => 60.0 * value,
                    "years" | "months" | "days" => 0.0,
                    unit => time::seconds(unit) * value,
                };
            }
            Some(total)
        };
        let date = of("years", row).zip(of("months", row)).zip(of("days", row));
        let days = match date {
            Some(((year, month), day)) => (|| {
                let is_sound = |unit: &str, value: Option<f64>| {
                    value.is_some_and(|value| is_of_calendar(unit, value))
                };
                let are_sound =
                    is_sound("years", year) && is_sound("months", month) && is_sound("days", day);
                are_sound.then_some(())?;
                let (year, month, day) = (year? as i64, month? as i64, day? as i64);
                let year = if year < 100 { year + 2000 } else { year };
                Some(86_400.0 * days_since_1970(year, month, day) as f64)
            })(),
            None => Some(0.0),
        };
        let Some((clock, days)) = clock().zip(days) else {
            seconds.push(None);
            continue;
        };
        if date.is_none() && parts.iter().any(|(unit, _)| *unit == "hours") {
            // Over midnight.
            if clock < last - 43_200.0 {
                turned += 86_400.0;
            }
            last = clock;
        }
        seconds.push(Some(days + clock + turned));
    }
    seconds
}

/// Puts together degrees, minutes and seconds of latitudes and longitudes; those whose minutes cannot be added are given
/// up: of the degrees alone a flight would be up to 100 km off.
pub(super) fn angles(samples: &[ColumnSample], columns: &mut [MappedColumn]) {
    for (role, names) in [
        (Latitude, ["lat", "latitude"]),
        (Longitude, ["lon", "longitude"]),
    ] {
        let ends_in = |sample: &ColumnSample, ends: &[&str]| {
            let mut found = words(sample);
            found.retain(|word| !["gps", "dec", "decimal"].contains(&word.as_str()));
            // `lat_std_mm` is something else.
            matches!(&found[..], [of, last] if names.contains(&of.as_str()) && ends.contains(&last.as_str()))
        };
        let is_minutes = |sample: &_| ends_in(sample, &["min", "mins", "minute", "minutes", "mm"]);
        let is_seconds = |sample: &_| ends_in(sample, &["sec", "secs", "second", "seconds", "ss"]);
        let Some(minutes) = samples.iter().position(is_minutes) else {
            continue;
        };
        let seconds = samples.iter().position(is_seconds);
        // Degrees with a fraction are places: beside them `lat_min` is the least, or something else.
        let is_broken = |sample: &ColumnSample| sample.numbers.iter().any(|n| n.fract() != 0.0);
        let degrees = (0..columns.len()).find(|index| {
            let sample = &samples[*index];
            columns[*index].role == role && !is_minutes(sample) && !is_seconds(sample)
        });
        let most = if role == Latitude { 90.0 } else { 360.0 };
        let has_most = samples.iter().any(|sample| ends_in(sample, &["max"]));
        let are_parts = !has_most
            && is_within(&samples[minutes], [0.0, 59.999_999], seconds.is_some())
            && seconds.is_none_or(|at| is_within(&samples[at], [0.0, 60.0], false));
        let degrees = degrees.filter(|index| is_within(&samples[*index], [-most, most], true));
        if let Some(degrees) = degrees.filter(|_| are_parts) {
            let reason = "degrees, minutes and seconds stand in several columns";
            for (index, column) in columns.iter_mut().enumerate() {
                if column.role == role && index != degrees {
                    give_up(column, reason.to_owned());
                }
            }
            columns[degrees] = part(&columns[degrees], role, "deg", reason);
            let units = ANGLES.iter().filter(|(_, of, _)| *of == role);
            for (index, (unit, ..)) in [Some(minutes), seconds].into_iter().zip(units) {
                if let Some(index) = index {
                    columns[index] = part(&columns[index], AngleRest, unit, reason);
                }
            }
            continue;
        }
        let name = &samples[minutes].name;
        for (column, sample) in columns.iter_mut().zip(samples) {
            let is_degree = is_within(sample, [-most, most], true);
            let is_place =
                (is_broken(sample) || !is_degree) && !is_minutes(sample) && !is_seconds(sample);
            if column.role != role || is_place {
                continue;
            }
            give_up(
                column,
                format!(
                    "its minutes stand in {name}: write degrees with their fraction into one column"
                ),
            );
        }
    }
}

/// Degrees with the parts that stand beside them; the sign is that of the degrees, of minus zero as well.
pub(super) fn angle(degrees: f64, rest: f64) -> f64 {
    if degrees.is_sign_negative() {
        degrees - rest
    } else {
        degrees + rest
    }
}

/// Finds the column of dates and times beside a clock that has none, where it says that it is universal time.
pub(super) fn date(samples: &[ColumnSample], columns: &mut [MappedColumn]) {
    let clock = columns.iter().find(|column| column.role == Time);
    if clock.is_none_or(|clock| clock.unit == time::DATE) {
        return;
    }
    let is_date = |text: &String| {
        let moment = date_and_time(text);
        matches!(moment, Some(Moment::Absolute(whole, _)) if is_since_1970(whole as f64))
    };
    let found = (0..columns.len()).find(|index| {
        let sample = &samples[*index];
        let dates = sample.texts.iter().filter(|text| is_date(text)).count();
        let name = sample.name.to_lowercase();
        let says = |word: &str| name.contains(word);
        let has_zone = sample.texts.iter().all(|text| crate::cells::has_zone(text));
        columns[*index].role == ColumnRole::Nothing
            && sample.numbers.is_empty()
            && dates > 0
            && 10 * dates >= 9 * sample.texts.len()
            && (says("utc") || says("gmt") || has_zone)
    });
    if let Some(index) = found {
        let reason =
            "its cells are dates and times in universal time, beside a clock without a date";
        columns[index] = part(&columns[index], Date, time::DATE, reason);
    }
}

/// Universal time at second zero of a clock, seconds since 1970, by the dates beside it, whose seconds may be cut off: the
/// latest that fits most of them.
pub(super) fn date_at_zero(times: &[Option<f64>], dates: &[Option<f64>]) -> Option<f64> {
    let pairs = times.iter().zip(dates);
    let mut offsets: Vec<f64> = pairs
        .filter_map(|(time, date)| Some((*date)? - (*time)?))
        .filter(|offset| offset.is_finite())
        .collect();
    if offsets.is_empty() {
        return None;
    }
    let middle = offsets.len() / 2;
    let usual = *offsets.select_nth_unstable_by(middle, f64::total_cmp).1;
    let near = offsets.into_iter().filter(|o| (o - usual).abs() < 1.5);
    near.max_by(f64::total_cmp)
}
