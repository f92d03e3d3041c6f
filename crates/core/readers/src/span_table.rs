//! Series of a span of time as a table of comma-separated values.

use std::borrow::Borrow;
use std::fmt::Write as _;
use std::ops::Range;

use super::expression::TimedSamples;
use pilotage_base::text::csv_cell;

/// A table with the samples of several series within a span of time, written some rows at a time.
///
/// One row for every time at which there is a sample of any column, in order of time; the cell of a column
/// without a sample at that time is empty, so that nothing is made up or lost. Numbers have as many decimals as
/// tell them from every other (double precision); those that are missing (NaN) are empty as well. The heading
/// has names with their units: `time [s],ATT.Roll [deg]`.
pub struct SpanTable<S> {
    columns: Vec<(String, S)>,
    /// Samples that are still to be written.
    left: Vec<Range<usize>>,
    /// Samples of all columns.
    total: usize,
}

impl<S: Borrow<TimedSamples>> SpanTable<S> {
    /// A table of `columns` (name and samples) from `span.0` to `span.1` seconds, both included.
    pub fn new(columns: Vec<(String, S)>, span: (f64, f64)) -> Self {
        let within = |column: &(String, S)| column.1.borrow().within(span);
        let left: Vec<Range<usize>> = columns.iter().map(within).collect();
        Self {
            total: left.iter().map(ExactSizeIterator::len).sum(),
            left,
            columns,
        }
    }

    /// The heading, with the end of its line.
    pub fn heading(&self) -> String {
        let mut row = String::from("time [s]");
        for (name, samples) in &self.columns {
            let heading = match samples.borrow().unit.as_str() {
                "" => name.clone(),
                unit => format!("{name} [{unit}]"),
            };
            row.push(',');
            row.push_str(&csv_cell(&heading));
        }
        row.push('\n');
        row
    }

    /// Share of the samples that were written, 0 to 1.
    pub fn progress(&self) -> f32 {
        let left: usize = self.left.iter().map(ExactSizeIterator::len).sum();
        1.0 - left as f32 / self.total.max(1) as f32
    }

    /// Writes the next `most` rows; whether there are more.
    pub fn write(&mut self, most: usize, table: &mut String) -> bool {
        for _ in 0..most {
            let columns = self.left.iter().zip(&self.columns);
            let next = columns.filter_map(|(left, (_, samples))| {
                let times = &samples.borrow().times;
                (left.start < left.end).then(|| times[left.start])
            });
            let Some(time) = next.min_by(f64::total_cmp) else {
                return false;
            };
            push_number(table, time);
            for (left, (_, samples)) in self.left.iter_mut().zip(&self.columns) {
                let samples = samples.borrow();
                table.push(',');
                if left.start < left.end && samples.times[left.start] == time {
                    push_number(table, samples.values[left.start]);
                    left.start += 1;
                }
            }
            table.push('\n');
        }
        true
    }
}

/// Writes a number with the fewest decimals that tell it from every other; nothing for one that is missing.
fn push_number(table: &mut String, value: f64) {
    let is_plain = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    let _ = match value {
        value if value.is_nan() => Ok(()),
        value if is_plain => write!(table, "{value}"),
        value => write!(table, "{value:e}"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All of a table, written two rows at a time.
    fn whole(columns: &[(&str, &TimedSamples)], span: (f64, f64)) -> String {
        let columns = columns
            .iter()
            .map(|(name, samples)| ((*name).to_owned(), *samples));
        let mut table = SpanTable::new(columns.collect(), span);
        let mut text = table.heading();
        while table.write(2, &mut text) {
            assert!(table.progress() <= 1.0);
        }
        assert_eq!(table.progress(), 1.0);
        text
    }

    #[test]
    fn every_sample_has_its_row_and_nothing_is_made_up() {
        let slow = TimedSamples::new([(0.0, 1.0), (1.0, 0.1), (2.0, 9.0)].into_iter(), "m");
        let fast = [(0.5, 1e-7), (1.0, f64::NAN), (1.5, 2.0), (2.5, 8.0)];
        let fast = TimedSamples::new(fast.into_iter(), "");
        let columns = [("A.x", &slow), ("max(A.x, 2)", &fast)];
        let table = whole(&columns, (0.5, 2.0));
        let expected = "time [s],A.x [m],\"max(A.x, 2)\"\n\
                        0.5,,1e-7\n\
                        1,0.1,\n\
                        1.5,,2\n\
                        2,9,\n";
        assert_eq!(table, expected);
    }

    #[test]
    fn samples_of_one_time_are_all_there() {
        let twice = TimedSamples::in_order([(1.0, 3.0), (1.0, 4.0)].into_iter(), "");
        let table = whole(&[("x", &twice)], (0.0, 2.0));
        assert_eq!(table, "time [s],x\n1,3\n1,4\n");
    }

    #[test]
    fn numbers_keep_every_digit() {
        let value = 0.1 + 0.2;
        let samples = TimedSamples::new([(1.0 / 3.0, value)].into_iter(), "rad");
        let table = whole(&[("x", &samples)], (0.0, 1.0));
        let row = table.lines().nth(1).unwrap();
        let numbers: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(numbers, [1.0 / 3.0, value]);
    }
}
