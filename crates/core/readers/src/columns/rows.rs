//! Rows of a table from its beginning to its end, so that its columns can be held against each other.

use std::collections::BTreeMap;

use super::newest_first::oldest_first;
use super::{ColumnMap, ColumnRole, MappedColumn, TableShape, parts, time};
use crate::cells::{Moment, date_and_time};
use crate::folder::decoded_table;
use pilotage_base::place_text::two_numbers;

/// Rows that are looked at, about.
const MOST: usize = 20_000;

/// Rows of a table at even distances.
#[derive(Clone, Debug, Default)]
pub(super) struct EvenRows {
    /// Cells of each column, NaN where there is no number; dates are seconds since 1970.
    pub columns: Vec<Vec<f64>>,
    /// Cells that hold a place, latitude and longitude, of columns in which some do; NaN elsewhere.
    pub places: BTreeMap<usize, [Vec<f64>; 2]>,
}

/// The two numbers in a cell, as radios write places: `47.000000 8.000000`, `(47.0, 8.0)`, `47.0N 8.0W`.
pub(super) fn pair(cell: &str) -> Option<(f64, f64)> {
    let cell = cell.trim_matches(['(', ')', '[', ']', ' ']);
    let mut parts = cell.split([' ', ';', ',']).filter(|part| !part.is_empty());
    let mut number = || parts.next()?.parse::<f64>().ok();
    if let (Some(a), Some(b)) = (number(), number()) {
        return (parts.next().is_none() && cell.contains('.')).then_some((a, b));
    }
    // Minutes and seconds end in small letters.
    let is_marked = cell.contains(['N', 'S', '°']);
    let [a, b] = two_numbers(cell).filter(|_| is_marked)?;
    Some((a, b))
}

impl EvenRows {
    /// Rows of a table of that shape; of columns that are not wanted nothing is kept.
    pub fn of(bytes: &[u8], shape: &TableShape, wanted: &[bool]) -> Self {
        let bytes = oldest_first(bytes);
        let bytes = decoded_table(&bytes);
        let skipped = shape.skipped_lines + shape.head_lines();
        let lines = || bytes.split(|byte| *byte == b'\n').skip(skipped);
        let stride = lines().count().div_ceil(MOST).max(1);
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); wanted.len()];
        let mut places: BTreeMap<usize, [Vec<f64>; 2]> = BTreeMap::new();
        for line in lines().step_by(stride) {
            if line.first().is_none_or(|byte| *byte == b'#') {
                continue;
            }
            let line = String::from_utf8_lossy(line);
            if line.trim().is_empty() {
                continue;
            }
            let cells = shape.separator.cells(line.trim_end_matches('\r'));
            let kept = columns.iter_mut().enumerate();
            for (index, column) in kept.filter(|(index, _)| wanted[*index]) {
                let cell = cells.get(index).map_or("", |cell| cell.as_ref());
                let number = value(cell, shape);
                if number.is_nan()
                    && let Some((first, second)) = pair(cell)
                {
                    let both = places.entry(index).or_default();
                    for (part, value) in both.iter_mut().zip([first, second]) {
                        part.resize(column.len(), f64::NAN);
                        part.push(value);
                    }
                }
                column.push(number);
            }
        }
        for (index, both) in &mut places {
            for part in both {
                part.resize(columns[*index].len(), f64::NAN);
            }
        }
        Self { columns, places }
    }

    /// The same with the degrees of latitudes and longitudes put together of their parts.
    pub fn with_parts(mut self, map: &ColumnMap) -> Self {
        for (unit, role, per_degree) in parts::ANGLES {
            let find = |is_it: &dyn Fn(&MappedColumn) -> bool| map.columns.iter().position(is_it);
            let rest = find(&|c| c.role == ColumnRole::AngleRest && c.unit == unit);
            let whole = find(&|c| c.role == role);
            let Some((whole, rest)) = whole.zip(rest) else {
                continue;
            };
            let rest = self.columns.get(rest).cloned().unwrap_or_default();
            let wholes = self.columns.get_mut(whole).into_iter().flatten();
            for (whole, rest) in wholes.zip(rest) {
                *whole = parts::angle(*whole, rest / per_degree);
            }
        }
        self
    }

    /// Times of the rows by the table's map, seconds; empty where it has none.
    pub fn times(&self, map: &ColumnMap) -> Vec<f64> {
        let is_time = |column: &super::MappedColumn| column.role == ColumnRole::Time;
        let Some(index) = map.columns.iter().position(is_time) else {
            return Vec::new();
        };
        let scaled = |index: usize| -> Vec<f64> {
            let unit = &map.columns[index].unit;
            let times = self.columns.get(index).into_iter().flatten();
            times.map(|time| time::seconds_of(unit, *time)).collect()
        };
        let times = scaled(index);
        let rests = map.columns.iter().enumerate();
        let rests = rests.filter(|(_, column)| column.role == ColumnRole::TimeRest);
        let known = |values: &[f64]| -> Vec<Option<f64>> {
            let known = values.iter().map(|value| Some(*value));
            known.map(|value| value.filter(|v| v.is_finite())).collect()
        };
        let mut all = vec![("s", known(&times))];
        for (index, column) in rests {
            let values = self.columns.get(index).map_or(&[][..], Vec::as_slice);
            all.push((column.unit.as_str(), known(values)));
        }
        if all.len() == 1 {
            return times;
        }
        let seconds = parts::seconds(&all, times.len());
        seconds.into_iter().map(|s| s.unwrap_or(f64::NAN)).collect()
    }
}

fn value(cell: &str, shape: &TableShape) -> f64 {
    if let Some(number) = shape.number(cell) {
        return number;
    }
    match date_and_time(cell) {
        Some(Moment::Absolute(whole, fraction)) => whole as f64 + fraction,
        _ => f64::NAN,
    }
}
