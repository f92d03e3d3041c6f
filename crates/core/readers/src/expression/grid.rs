//! Values of one row of times at another.

/// Values at the times `wanted`, which grow, between those at `times`: linear, or where `period` is given, the
/// shorter way round; NaN outside. Each value between two lies on the turn of the nearer one.
pub(super) fn at_times(
    times: &[f64],
    values: &[f64],
    period: Option<f64>,
    wanted: &[f64],
) -> Vec<f64> {
    let mut after = 0;
    let value = |time: &f64| {
        while after < times.len() && times[after] <= *time {
            after += 1;
        }
        let Some(before) = after.checked_sub(1) else {
            return f64::NAN;
        };
        if times[before] == *time {
            return values[before];
        }
        let Some(next) = times.get(after) else {
            return f64::NAN;
        };
        let weight = (time - times[before]) / (next - times[before]);
        let change = shorter_way(values[after] - values[before], period);
        if weight < 0.5 {
            values[before] + weight * change
        } else {
            values[after] - (1.0 - weight) * change
        }
    };
    wanted.iter().map(value).collect()
}

/// The change that leads to the same place by at most half a turn.
pub(super) fn shorter_way(change: f64, period: Option<f64>) -> f64 {
    match period {
        Some(turn) if change.abs() > 0.5 * turn => change - turn * (change / turn).round(),
        _ => change,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_samples_values_lie_on_the_line_and_outside_there_are_none() {
        let wanted = [0.0, 1.0, 1.25, 2.0, 3.5, 4.0, 4.5];
        let found = at_times(&[1.0, 2.0, 4.0], &[10.0, 20.0, 0.0], None, &wanted);
        assert!(found[0].is_nan() && found[6].is_nan());
        assert_eq!(found[1..6], [10.0, 12.5, 20.0, 5.0, 0.0]);
    }

    #[test]
    fn a_missing_value_leaves_its_neighbours_as_they_are() {
        let wanted = [0.0, 0.5, 1.0, 2.0];
        let found = at_times(&[0.0, 1.0, 2.0], &[3.0, f64::NAN, 5.0], None, &wanted);
        assert_eq!((found[0], found[3]), (3.0, 5.0));
        assert!(found[1].is_nan() && found[2].is_nan());
    }

    #[test]
    fn angles_go_the_shorter_way_round() {
        let found = at_times(&[0.0, 1.0], &[350.0, 10.0], Some(360.0), &[0.25, 0.75]);
        assert_eq!(found, [355.0, 5.0]);
    }
}
