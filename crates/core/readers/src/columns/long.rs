//! Tables with a row for each value: time, name, value.

use std::collections::BTreeSet;

use super::{ColumnRole, ColumnSample, MappedColumn};
use crate::cells::date_and_time;

/// Most names of values, and how often each stands there at least, in the mean.
const MOST_NAMES: usize = 300;
const REPEATED: usize = 2;

/// Advice about a table whose rows hold one value each, with its name beside it; `None` of any other.
pub(super) fn told(samples: &[ColumnSample], columns: &[MappedColumn]) -> Option<String> {
    let is_name = |sample: &&ColumnSample| {
        let distinct: BTreeSet<&String> = sample.texts.iter().collect();
        let are_dates = sample
            .texts
            .iter()
            .any(|text| date_and_time(text).is_some());
        sample.numbers.is_empty()
            && (2..=MOST_NAMES).contains(&distinct.len())
            && sample.texts.len() >= REPEATED * distinct.len()
            && !are_dates
    };
    // Every time stands in several rows, so that it hardly grows from row to row.
    let falls = |sample: &ColumnSample| sample.numbers.windows(2).any(|pair| pair[1] < pair[0]);
    let is_time = |(sample, column): &(&ColumnSample, &MappedColumn)| {
        let is_number = sample.is_numeric() && !sample.is_constant() && !falls(sample);
        column.role == ColumnRole::Time || is_number
    };
    let pairs = || samples.iter().zip(columns);
    let time = pairs().find(is_time)?.0;
    let mut names = samples.iter().filter(is_name);
    let mut values = pairs().filter(|(sample, _)| {
        sample.is_numeric() && sample.name != time.name && !sample.is_constant()
    });
    let (name, (value, meaning)) = (names.next()?, values.next()?);
    let is_only = values.next().is_none() && meaning.role == ColumnRole::Nothing;
    let [time, name, value] = [time, name, value].map(|sample| sample.name.as_str());
    is_only.then(|| {
        format!(
            "each of its rows holds one value with its name; make a table of it that has a column for each name, in Python \
             with pandas.read_csv(…).pivot_table(index=\"{time}\", columns=\"{name}\", values=\"{value}\").to_csv(…)"
        )
    })
}
