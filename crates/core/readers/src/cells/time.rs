//! Unit of a column that may be the time.

use super::date::date_and_time;
use super::sample::ColumnSample;

/// Units that a time may be in: seconds, parts of them, date and time.
pub(crate) const UNITS: [&str; 5] = ["s", "ms", "us", "ns", "date and time"];

/// Date and time as a cell.
pub(crate) const DATE: &str = "date and time";

/// Shortest and longest time that a table is thought to span, seconds, and the time between rows.
const SPAN: (f64, f64) = (2.0, 50_000.0);
const STEP: (f64, f64) = (2e-4, 30.0);

/// Seconds since 1970 of flights: from 1990 to 2040.
const EPOCH: std::ops::Range<f64> = 6.3e8..2.3e9;

/// Whether a flight may have been so many seconds after the beginning of 1970.
pub(crate) fn is_since_1970(seconds: f64) -> bool {
    EPOCH.contains(&seconds)
}

/// Time between rows of a usual log, seconds.
const USUAL_STEP: f64 = 0.05;

/// Seconds in units of numbers.
const SECONDS: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];

/// Seconds in a unit of times; 1 for dates.
pub(crate) fn seconds(unit: &str) -> f64 {
    let known = SECONDS.iter().find(|(name, _)| *name == unit);
    known.map_or(1.0, |(_, seconds)| *seconds)
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
    if !sample.is_numeric() || !sample.grows() {
        return None;
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
