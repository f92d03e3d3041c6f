//! Times of a clock that is coarser than the rows of its table.
//!
//! A table of five rows a second by a clock of whole seconds has five rows of one time each: they are spread over the time
//! until the clock goes on, as evenly as they were written. A clock that is as fine as its rows may stop: its rows are
//! spread so where it goes on as far on as they need, and else keep the time at which it stopped.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::cells::{median, number};

/// Fewest rows that tell how coarse a clock is.
const ENOUGH: usize = 10;
/// Share of steps at which the clock stands, from which on it is coarse, and of those whose rows are measured one after the
/// other.
const STANDING: f64 = 0.3;
const MEASURED: f64 = 0.8;
/// Longer than so many of its usual steps the clock waits for nothing but a pause.
const PAUSE: f64 = 1.5;
/// Times that tell whether rows are of several bodies.
const MOST_RUNS: usize = 500;
/// Below this share of the steps within one time, those from time to time are of one body of several.
const TO_AND_FRO: f64 = 0.25;

/// Rows whose clock stands until the next one.
fn standing(times: &[f64]) -> impl Iterator<Item = usize> {
    (1..times.len())
        .filter(|row| times[row - 1] == times[*row])
        .map(|row| row - 1)
}

/// Runs of rows of one time: the first row, and how many.
fn runs(times: &[f64]) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (row, time) in times.iter().enumerate() {
        match runs.last_mut() {
            Some((begin, count)) if times[*begin] == *time => *count += 1,
            _ => runs.push((row, 1)),
        }
    }
    runs
}

/// Rows of a run beyond which its clock has stopped: more than twice those of the usual one, and one.
fn longest(runs: &[(usize, usize)]) -> usize {
    let counts = runs.iter().map(|(_, count)| *count as f64);
    median(counts.collect()).map_or(usize::MAX, |usual| 2 * usual as usize + 1)
}

/// Whether a clock stands so often that it is coarser than its rows. Where it stops for long, that is not counted.
pub(super) fn is_coarse(times: &[f64]) -> bool {
    let runs = runs(times);
    let longest = longest(&runs);
    let usual = runs.iter().filter(|(_, count)| *count <= longest);
    let (rows, ticks) = usual.fold((0, 0), |(rows, ticks), (_, count)| {
        (rows + count, ticks + 1)
    });
    let steps = rows.max(1) - 1;
    times.len() >= ENOUGH && (rows - ticks) as f64 >= STANDING * steps as f64
}

/// Whether that is so of most rows of one time and their next ones.
pub(super) fn are_mostly(times: &[f64], is_so: impl Fn(usize) -> bool) -> bool {
    let count = standing(times).filter(|row| is_so(*row)).count();
    count as f64 >= MEASURED * standing(times).count() as f64
}

/// Rows of one time that were spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SpreadRows {
    /// Whether the clock is coarser than its rows.
    pub is_coarse: bool,
    /// Number of rows within which it stopped, and went on as if it had not.
    pub stopped: usize,
}

/// Spreads rows of one time, where they are many or the clock stopped; `is_measured` says whether a row and the next one are
/// two measurements of the same columns. `None` where nothing is spread.
pub(super) fn spread(times: &mut [f64], is_measured: impl Fn(usize) -> bool) -> Option<SpreadRows> {
    let runs = runs(times);
    let longest = longest(&runs);
    let is_coarse = is_coarse(times) && are_mostly(times, &is_measured);
    let ticks = runs
        .windows(2)
        .filter(|pair| pair[0].1 <= longest)
        .map(|pair| times[pair[1].0] - times[pair[0].0]);
    let (tick, usual) = (
        median(ticks.collect())?,
        median(runs.iter().map(|(_, count)| *count as f64).collect())?,
    );
    let last = runs.len() - 1;
    let mut stopped = 0;
    for (number, (begin, count)) in runs.iter().copied().enumerate() {
        let time = times[begin];
        let next = runs.get(number + 1).map(|(next, _)| times[*next] - time);
        if count > longest {
            let are_measured = (begin..begin + count - 1)
                .filter(|row| is_measured(*row))
                .count();
            let rows = count as f64;
            let needed = rows * tick / usual;
            // Rows are a step apart, the last of them and the next one as well.
            let goes_on = next.filter(|next| (next - needed).abs() <= 0.5 * tick.max(0.1 * needed));
            if let Some(until) = goes_on.filter(|_| are_measured as f64 >= MEASURED * (rows - 1.0))
            {
                stopped += count;
                let step = until / rows;
                for row in 0..count {
                    times[begin + row] = time + step * row as f64;
                }
            }
            continue;
        }
        if !is_coarse {
            continue;
        }
        let until = next.filter(|next| *next < PAUSE * tick).unwrap_or(tick);
        // A recording begins and ends within a step of the clock.
        let is_part = (count as f64) < usual;
        let step = if is_part && (number == 0 || number == last) {
            until / usual
        } else {
            until / count as f64
        };
        let before = if is_part && number == 0 {
            until - step * count as f64
        } else {
            0.0
        };
        for row in 0..count {
            times[begin + row] = time + before + step * row as f64;
        }
    }
    (is_coarse || stopped > 0).then_some(SpreadRows { is_coarse, stopped })
}

/// Whether rows of one time are of several bodies by the cells of a column: the same cells come again at the next time, all of
/// them others, or its numbers go to and fro in step with the rows.
pub(super) fn are_of_several<'a>(
    times: &[f64],
    cell: impl Fn(usize) -> &'a str,
    has_decimal_comma: bool,
) -> bool {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (row, time) in times.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if times[run.start] == *time => run.end = row + 1,
            _ => runs.push(row..row + 1),
        }
    }
    runs.truncate(MOST_RUNS);
    let (mut rows, mut again) = (0, 0);
    let (mut across, mut along) = (Vec::new(), Vec::new());
    let value = |row: usize| number(cell(row), has_decimal_comma);
    for pair in runs.windows(2) {
        let (run, next) = (pair[0].clone(), pair[1].clone());
        if run.len() < 2 {
            continue;
        }
        let cells: BTreeSet<&str> = run.clone().map(&cell).collect();
        let is_one_each = cells.len() == run.len() && !cells.contains("");
        let others: BTreeSet<&str> = next.clone().map(&cell).collect();
        rows += run.len();
        again += cells
            .iter()
            .filter(|c| is_one_each && others.contains(*c))
            .count();
        if run.len() == next.len() {
            for (row, later) in run.clone().zip(next) {
                across.extend(value(row).zip(value(later)).map(|(a, b)| (a - b).abs()));
            }
        }
        for row in run.start..run.end - 1 {
            along.extend(value(row).zip(value(row + 1)).map(|(a, b)| (a - b).abs()));
        }
    }
    let comes_again = rows >= ENOUGH && again as f64 >= MEASURED * rows as f64;
    let steps = median(across).zip(median(along));
    comes_again || steps.is_some_and(|(across, along)| across < TO_AND_FRO * along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_one_time_are_spread_until_the_clock_goes_on() {
        // Five rows a second; the recording begins with the fourth of a second and ends with the second of another.
        let expected: Vec<f64> = (3..52).map(|row| 0.2 * f64::from(row)).collect();
        let mut times: Vec<f64> = expected.iter().map(|time| (time + 1e-9).floor()).collect();
        assert!(spread(&mut times, |_| true).is_some());
        for (time, expected) in times.iter().zip(&expected) {
            assert!((time - expected).abs() < 1e-9, "{time} {expected}");
        }
        // A pause stays one.
        let mut paused: Vec<f64> = (0..40).map(|row| f64::from(row / 4)).collect();
        paused[20..].iter_mut().for_each(|time| *time += 60.0);
        assert!(spread(&mut paused, |_| true).is_some());
        assert!((paused[19] - 4.75).abs() < 1e-9 && paused[20] == 65.0);
    }

    #[test]
    fn rows_that_belong_to_one_moment_and_single_ones_that_stand_stay() {
        let doubled: Vec<f64> = (0..40).map(|row| f64::from(row / 2)).collect();
        let mut times = doubled.clone();
        assert_eq!(spread(&mut times, |_| false), None);
        assert_eq!(times, doubled);
        let mut regular: Vec<f64> = (0..40).map(f64::from).collect();
        regular[7] = 6.0;
        let before = regular.clone();
        assert_eq!(spread(&mut regular, |_| true), None);
        assert_eq!(regular, before);
    }

    #[test]
    fn rows_of_a_clock_that_stopped_are_spread_only_where_it_goes_on_as_if_it_had_not() {
        let right: Vec<f64> = (0..60).map(|row| 0.2 * f64::from(row)).collect();
        // It stands for ten rows, then tells the right time again.
        let mut stopped = right.clone();
        stopped[20..30].fill(right[20]);
        let told = spread(&mut stopped, |_| true);
        assert_eq!(
            told,
            Some(SpreadRows {
                is_coarse: false,
                stopped: 10
            })
        );
        for (time, right) in stopped.iter().zip(&right) {
            assert!((time - right).abs() < 1e-9, "{time} {right}");
        }
        // The same rows, written again and again; a clock that goes on from where it stopped; one that stops for good.
        let mut again = right.clone();
        again[20..30].fill(right[20]);
        assert_eq!(spread(&mut again.clone(), |_| false), None);
        again[30..].iter_mut().for_each(|time| *time -= 1.8);
        let mut ended = right.clone();
        ended[30..].fill(right[30]);
        for times in [again, ended] {
            let mut found = times.clone();
            assert_eq!(spread(&mut found, |_| true), None);
            assert_eq!(found, times);
        }
    }

    #[test]
    fn rows_of_several_bodies_are_known_by_cells_that_come_again_or_go_to_and_fro() {
        let times: Vec<f64> = (0..60).map(|row| f64::from(row / 2)).collect();
        let several = |cell: &dyn Fn(usize) -> String| {
            let cells: Vec<String> = (0..60).map(cell).collect();
            are_of_several(&times, |row| cells[row].as_str(), false)
        };
        assert!(several(&|row| ["A", "B"][row % 2].to_owned()));
        // They may come in any order.
        assert!(several(&|row| ["A", "B"][(row + row / 6) % 2].to_owned()));
        let place = |row: usize, apart: f64| 47.1 + 1e-4 * row as f64 + apart * (row % 2) as f64;
        assert!(several(&|row| format!("{:.6}", place(row, 0.1))));
        assert!(!several(&|row| format!("{:.6}", place(row, 0.0))));
        assert!(!several(&|row| (500 + row % 3).to_string()));
        assert!(!several(&|_| "fixed".to_owned()));
        // A sum that checks each row.
        assert!(!several(&|row| format!("*{:02X}", row * row * 7 % 251)));
    }
}
