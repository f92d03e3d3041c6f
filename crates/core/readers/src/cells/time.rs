//! Unit of a column that may be the time.

use super::date::{date_and_time, is_of_ticks, of_clock_number};
use super::moment::Moment;
use super::sample::{ColumnSample, median};
use super::since_1970::is_since_1970;

/// Units that a time may be in: seconds, parts of them (the last two where a name says so), date and time, hours with minutes and seconds in one number, days,
/// minutes, hours.
pub(crate) const UNITS: [&str; 11] = [
    "s", "ms", "us", "ns", "cs", "100us", DATE, CLOCK, DAYS, MINUTES, HOURS,
];

/// Date and time as a cell.
pub(crate) const DATE: &str = "date and time";

/// Hours, minutes and seconds in one number, as satellite receivers write them: 100059.5 is 10:00:59.5.
pub(crate) const CLOCK: &str = "hhmmss";

/// Days, as spreadsheets and MATLAB count dates.
pub(crate) const DAYS: &str = "d";

/// Minutes and hours, with decimals, where a table says so or nothing else makes a flight of it.
pub(crate) const MINUTES: &str = "min";
pub(crate) const HOURS: &str = "h";

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// Days from where spreadsheets count (30 December 1899), and MATLAB (year 0), to 1990 and 2040.
const SERIALS: [std::ops::Range<f64>; 2] = [32_874.0..51_136.0, 726_834.0..745_096.0];

/// Date and time in the fourteen digits of one number: 20240513100059.5.
const DIGITS: std::ops::Range<f64> = 1.99e13..2.041e13;

/// Shortest and longest time that a table is thought to span, seconds, and the time between rows.
const SPAN: (f64, f64) = (2.0, 50_000.0);
const STEP: (f64, f64) = (2e-4, 30.0);

/// Time between rows of a usual log, seconds.
const USUAL_STEP: f64 = 0.05;

/// Seconds in units of numbers that no name has to say.
const SECONDS: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];

/// Those in units that a name may say: hundredths of seconds and hundreds of microseconds.
const SAID: [(&str, f64); 2] = [("cs", 1e-2), ("100us", 1e-4)];

/// Seconds in a unit of times; 1 for dates.
pub(crate) fn seconds(unit: &str) -> f64 {
    match unit {
        DAYS => DAY,
        HOURS => 3600.0,
        MINUTES => 60.0,
        unit => seconds_counted(unit).unwrap_or(1.0),
    }
}

/// Seconds in a unit in which they or parts of them are counted; `None` of any other.
pub(crate) fn seconds_counted(unit: &str) -> Option<f64> {
    let known = SECONDS.iter().chain(&SAID).find(|(name, _)| *name == unit);
    known.map(|(_, seconds)| *seconds)
}

/// Seconds of a number that is a time in that unit; NaN where it is none.
pub(crate) fn seconds_of(unit: &str, number: f64) -> f64 {
    match unit {
        CLOCK => of_clock_number(number).unwrap_or(f64::NAN),
        DATE if DIGITS.contains(&number) || is_of_ticks(number) => {
            match date_and_time(&format!("{number:.6}")) {
                Some(Moment::Absolute(whole, fraction)) => whole as f64 + fraction,
                _ => f64::NAN,
            }
        }
        unit => number * seconds(unit),
    }
}

/// Whether numbers are hours, minutes and seconds without a seam: none has sixty of either, and rows of every few seconds
/// leap from fifty-nine to the next hundred, which is a step as any other once they are read so. Where many leap, as between
/// the places at which a long table is looked at, not each has to.
fn are_of_clock(numbers: &[f64]) -> bool {
    let clocks: Option<Vec<f64>> = numbers.iter().map(|n| of_clock_number(*n)).collect();
    let Some(clocks) = clocks else { return false };
    let pairs = numbers.windows(2).zip(clocks.windows(2));
    let is_midnight = |raw: &[f64]| raw[0] >= 235_900.0 && (0.0..100.0).contains(&raw[1]);
    let is_leap = |raw: &[f64], clock: &[f64]| {
        is_midnight(raw) || (raw[1] - raw[0]) - (clock[1] - clock[0]) > 39.0
    };
    let leaps = pairs
        .clone()
        .filter(|(raw, clock)| is_leap(raw, clock))
        .count();
    let usual = median(clocks.windows(2).map(|w| w[1] - w[0]).collect()).unwrap_or(0.0);
    let is_closed = |raw: &[f64], clock: &[f64]| {
        is_midnight(raw) || is_leap(raw, clock) && clock[1] - clock[0] < 10.0 * usual.max(1.0)
    };
    if leaps < 3 && !pairs.clone().any(|(raw, clock)| is_closed(raw, clock)) {
        return false;
    }
    // Rows of many seconds leap often, and evenly once they are read so.
    let is_even = || {
        let mut steps = clocks
            .windows(2)
            .map(|w| w[1] - w[0])
            .filter(|step| *step > -80_000.0);
        let first = steps.next().unwrap_or(0.0);
        numbers.len() > 5 && first > 1.0 && steps.all(|step| (step - first).abs() < 1.5)
    };
    leaps > 0 && (10 * leaps <= numbers.len() || 2 * leaps <= numbers.len() && is_even())
}

/// The unit of a column that may be the time, how surely it is one, and why; `None` if it is none. `stated` is the unit
/// that its name says; `share` of the table's rows are in the sample.
pub(crate) fn unit_of_time(
    sample: &ColumnSample,
    stated: Option<&'static str>,
    share: f64,
) -> Option<(&'static str, f64, String)> {
    let dates = sample
        .texts
        .iter()
        .filter(|text| date_and_time(text).is_some())
        .count();
    if dates > 0 && 10 * dates >= 9 * (sample.texts.len() + sample.numbers.len()) {
        return Some((DATE, 1.0, "cells are dates and times".to_owned()));
    }
    let may_stand = !sample.name.starts_with('#') && sample.goes_on();
    if !sample.is_numeric() || !(sample.grows() || may_stand) {
        return None;
    }
    if sample.numbers.iter().all(|n| is_of_ticks(*n)) {
        let reason = "cells count tenths of microseconds, as Windows does".to_owned();
        return Some((DATE, 0.95, reason));
    }
    let are_digits = |n: &f64| seconds_of(DATE, *n).is_finite() && DIGITS.contains(n);
    if sample.numbers.iter().all(are_digits) {
        let reason = "cells are dates and times of fourteen digits".to_owned();
        return Some((DATE, 0.95, reason));
    }
    if stated.is_none() && are_of_clock(&sample.numbers) {
        let reason = "hours, minutes and seconds stand in one number".to_owned();
        return Some((CLOCK, 0.95, reason));
    }
    if let Some(unit) = stated {
        return Some((unit, 1.0, format!("its name says {unit}, and values grow")));
    }
    let (first, last) = sample.inner_range()?;
    let rows = sample.numbers.len() as f64 / share;
    let step = (last - first) / rows.max(2.0);
    // Seconds since 1970 have ten digits today; rows of a flight are as far apart as in any other count.
    let epoch = SECONDS.iter().find(|(_, seconds)| {
        is_since_1970(first * seconds) && (1e-6..STEP.1).contains(&(step * seconds))
    });
    if let Some((unit, _)) = epoch {
        return Some((
            unit,
            0.9,
            format!("values begin at {first:.0}, counted in {unit} since 1970"),
        ));
    }
    let is_plausible = |(_, seconds): &&(&str, f64)| {
        let span = (last - first) * seconds;
        let step = step * seconds;
        (SPAN.0..SPAN.1).contains(&span) && (STEP.0..STEP.1).contains(&step)
    };
    let is_serial = SERIALS.iter().any(|days| days.contains(&first)) && is_plausible(&&(DAYS, DAY));
    if is_serial {
        let reason = format!("values begin at {first:.0}: days, as spreadsheets count dates");
        return Some((DAYS, 0.9, reason));
    }
    let plausible = SECONDS.iter().filter(is_plausible);
    // The reading whose rate is nearest, by its ratio, to what flights are logged with.
    let strangeness = |seconds: f64| (step * seconds / USUAL_STEP).ln().abs();
    let (unit, seconds) = plausible.min_by(|a, b| strangeness(a.1).total_cmp(&strangeness(b.1)))?;
    let span = (last - first) * seconds;
    let rate = 1.0 / (step * seconds);
    Some((
        unit,
        0.8,
        format!("in {unit} the table spans {span:.0} s at {rate:.3} rows a second"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(step: f64, count: usize, start: f64) -> ColumnSample {
        ColumnSample {
            numbers: (0..count).map(|i| start + step * i as f64).collect(),
            ..ColumnSample::default()
        }
    }

    fn unit(step: f64, count: usize, start: f64) -> Option<&'static str> {
        unit_of_time(&sample(step, count, start), None, 1.0).map(|(unit, ..)| unit)
    }

    #[test]
    fn the_unit_is_the_one_in_which_a_flight_has_a_likely_length() {
        assert_eq!(unit(0.02, 1000, 0.0), Some("s"));
        assert_eq!(unit(20.0, 1000, 0.0), Some("ms"));
        assert_eq!(unit(20_000.0, 1000, 5e6), Some("us"));
        assert_eq!(unit(2e7, 1000, 0.0), Some("ns"));
        assert_eq!(unit(1.0, 600, 0.0), Some("s"));
        assert_eq!(unit(0.1, 1000, 1.7e9), Some("s"));
        assert_eq!(unit(100.0, 1000, 1.7e12), Some("ms"));
        assert_eq!(unit(1e8, 1000, 1.7e18), Some("ns"));
        // 13 May 2024 in a spreadsheet, ten rows a second.
        assert_eq!(unit(0.1 / 86_400.0, 1000, 45_425.4), Some("d"));
        assert_eq!(unit(0.1 / 86_400.0, 1000, 739_385.4), Some("d"));
    }

    #[test]
    fn hours_minutes_and_seconds_of_one_number_leap_over_forty() {
        let clock = |second: usize| {
            let (hours, minutes) = (second / 3600, second / 60 % 60);
            (hours * 10_000 + minutes * 100 + second % 60) as f64
        };
        let of = |numbers: Vec<f64>| {
            let sample = ColumnSample {
                numbers,
                ..ColumnSample::default()
            };
            unit_of_time(&sample, None, 1.0).map(|(unit, ..)| unit)
        };
        assert_eq!(of((36_000..36_300).map(clock).collect()), Some(CLOCK));
        let over_midnight = (86_370..86_430).map(|second| clock(second % 86_400));
        assert_eq!(of(over_midnight.collect()), Some(CLOCK));
        assert_eq!(
            of((0..300).map(|i| f64::from(i) * 100.0).collect()),
            Some("ms")
        );
        // A pause of seconds that begins and ends at whole hundreds is no minute.
        let paused = (0..60).chain(1000..1060).map(f64::from);
        assert_eq!(of(paused.collect()), Some("s"));
        let rare = (0..20).map(|i| clock(36_000 + 10 * i));
        assert_eq!(of(rare.collect()), Some(CLOCK));
        let dates = (36_000..36_300).map(|second| 20_240_513_000_000.0 + clock(second));
        assert_eq!(of(dates.collect()), Some(DATE));
        assert!((seconds_of(CLOCK, 100_059.5) - 36_059.5).abs() < 1e-9);
        // date -u -d '2024-05-13 10:00:59' +%s
        assert!((seconds_of(DATE, 20_240_513_100_059.0) - 1_715_594_459.0).abs() < 1e-3);
    }

    #[test]
    fn what_goes_to_and_fro_is_no_time_and_dates_are_one() {
        let mut back = sample(1.0, 100, 0.0);
        back.numbers.iter_mut().for_each(|v| *v = (*v * 0.5).sin());
        assert_eq!(unit_of_time(&back, Some("s"), 1.0), None);
        let dates = ColumnSample {
            texts: vec![
                "2024-05-01 10:00:00".to_owned(),
                "2024-05-01 10:00:01".to_owned(),
            ],
            ..ColumnSample::default()
        };
        assert_eq!(unit_of_time(&dates, None, 1.0).map(|t| t.0), Some(DATE));
    }
}
