//! Times of a clock that is coarser than the rows of its table.
//!
//! A table of five rows a second by a clock of whole seconds has five rows of one time each: they are spread over the time
//! until the clock goes on, as evenly as they were written.

/// Fewest rows that tell how coarse a clock is.
const ENOUGH: usize = 10;
/// Share of steps at which the clock stands, from which on it is coarse, and of those whose rows are measured one after the
/// other.
const STANDING: f64 = 0.3;
const MEASURED: f64 = 0.8;
/// Longer than so many of its usual steps the clock waits for nothing but a pause.
const PAUSE: f64 = 1.5;

/// Spreads rows of one time, where they are many; `is_measured` says whether a row and the next one are two measurements of the
/// same columns. Whether they were.
pub(super) fn spread(times: &mut [f64], is_measured: impl Fn(usize) -> bool) -> bool {
    let steps = times.len().saturating_sub(1);
    let standing: Vec<usize> = (0..steps).filter(|i| times[*i] == times[i + 1]).collect();
    let is_coarse = times.len() >= ENOUGH && standing.len() as f64 >= STANDING * steps as f64;
    let measured = standing.iter().filter(|row| is_measured(**row)).count();
    if !is_coarse || (measured as f64) < MEASURED * standing.len() as f64 {
        return false;
    }
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (row, time) in times.iter().enumerate() {
        match runs.last_mut() {
            Some((begin, count)) if times[*begin] == *time => *count += 1,
            _ => runs.push((row, 1)),
        }
    }
    let ticks = runs
        .windows(2)
        .map(|pair| times[pair[1].0] - times[pair[0].0]);
    let (Some(tick), Some(usual)) = (
        median(ticks.collect()),
        median(runs.iter().map(|(_, count)| *count as f64).collect()),
    ) else {
        return false;
    };
    let last = runs.len() - 1;
    for (number, (begin, count)) in runs.iter().copied().enumerate() {
        let time = times[begin];
        let next = runs.get(number + 1).map(|(next, _)| times[*next] - time);
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
    true
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_one_time_are_spread_until_the_clock_goes_on() {
        // Five rows a second; the recording begins with the fourth of a second and ends with the second of another.
        let expected: Vec<f64> = (3..52).map(|row| 0.2 * f64::from(row)).collect();
        let mut times: Vec<f64> = expected.iter().map(|time| (time + 1e-9).floor()).collect();
        assert!(spread(&mut times, |_| true));
        for (time, expected) in times.iter().zip(&expected) {
            assert!((time - expected).abs() < 1e-9, "{time} {expected}");
        }
        // A pause stays one.
        let mut paused: Vec<f64> = (0..40).map(|row| f64::from(row / 4)).collect();
        paused[20..].iter_mut().for_each(|time| *time += 60.0);
        assert!(spread(&mut paused, |_| true));
        assert!((paused[19] - 4.75).abs() < 1e-9 && paused[20] == 65.0);
    }

    #[test]
    fn rows_that_belong_to_one_moment_and_single_ones_that_stand_stay() {
        let doubled: Vec<f64> = (0..40).map(|row| f64::from(row / 2)).collect();
        let mut times = doubled.clone();
        assert!(!spread(&mut times, |_| false));
        assert_eq!(times, doubled);
        let mut regular: Vec<f64> = (0..40).map(f64::from).collect();
        regular[7] = 6.0;
        let before = regular.clone();
        assert!(!spread(&mut regular, |_| true));
        assert_eq!(regular, before);
    }
}
