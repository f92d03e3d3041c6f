//! Functions of a whole series: its change, its sum, its mean around each time.

use super::grid::shorter_way;

/// Change per second at each time: exact for parabolas, whatever the distances of the samples; one-sided at the
/// ends and beside missing values. Angles (`period`) change the shorter way round.
///
/// The slopes to both neighbours, each weighted by the distance of the other: with h₀, h₁ the distances and
/// s₀, s₁ the slopes, (h₁ s₀ + h₀ s₁) / (h₀ + h₁) is the derivative of the parabola through the three samples.
pub(super) fn derivative(times: &[f64], values: &[f64], period: Option<f64>) -> Vec<f64> {
    let slope = |i: usize| {
        let distance = times.get(i + 1)? - times[i];
        let change = shorter_way(values[i + 1] - values[i], period);
        let slope = change / distance;
        slope.is_finite().then_some((distance, slope))
    };
    let mut before: Option<(f64, f64)> = None;
    let of = |i: usize| {
        let after = slope(i);
        let slope = match (before, after) {
            (Some((h0, s0)), Some((h1, s1))) => (h1 * s0 + h0 * s1) / (h0 + h1),
            (Some((_, slope)), None) | (None, Some((_, slope))) => slope,
            (None, None) => f64::NAN,
        };
        before = after;
        if values[i].is_nan() { f64::NAN } else { slope }
    };
    (0..times.len()).map(of).collect()
}

/// Sum over time by trapezoids, zero at the first value; over missing values it stands still.
pub(super) fn integral(times: &[f64], values: &[f64]) -> Vec<f64> {
    let mut sum = CompensatedSum::default();
    let mut last: Option<(f64, f64)> = None;
    let of = |(time, value): (&f64, &f64)| {
        if value.is_nan() {
            last = None;
            return f64::NAN;
        }
        if let Some((before, other)) = last {
            sum.add(0.5 * (time - before) * (value + other));
        }
        last = Some((*time, *value));
        sum.total()
    };
    times.iter().zip(values).map(of).collect()
}

/// Mean of the values within `seconds` / 2 of each time; angles (`period`) are averaged the shorter way round.
/// What is missing stays missing.
pub(super) fn smooth(times: &[f64], values: &[f64], seconds: f64, period: Option<f64>) -> Vec<f64> {
    let turns = turns(values, period);
    let unwound = |i: usize| values[i] + turns.get(i).copied().unwrap_or(0.0);
    let mut sum = CompensatedSum::default();
    let (mut from, mut to, mut count) = (0, 0, 0_usize);
    let of = |(i, time): (usize, &f64)| {
        while to < times.len() && times[to] <= time + 0.5 * seconds {
            if !values[to].is_nan() {
                sum.add(unwound(to));
                count += 1;
            }
            to += 1;
        }
        while times[from] < time - 0.5 * seconds {
            if !values[from].is_nan() {
                sum.add(-unwound(from));
                count -= 1;
            }
            from += 1;
        }
        if values[i].is_nan() {
            return f64::NAN;
        }
        sum.total() / count as f64 - turns.get(i).copied().unwrap_or(0.0)
    };
    times.iter().enumerate().map(of).collect()
}

/// Offsets to add to each value so that none is more than half a turn from the one before; empty without a
/// period.
fn turns(values: &[f64], period: Option<f64>) -> Vec<f64> {
    let Some(period) = period else {
        return Vec::new();
    };
    let mut last: Option<f64> = None;
    let mut offset = 0.0;
    let of = |value: &f64| {
        if !value.is_nan() {
            let change = value - last.unwrap_or(*value);
            offset += shorter_way(change, Some(period)) - change;
            last = Some(*value);
        }
        offset
    };
    values.iter().map(of).collect()
}

/// A sum that keeps what single additions round away (Neumaier 1974).
#[derive(Clone, Copy, Debug, Default)]
struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        self.lost += if self.sum.abs() >= value.abs() {
            (self.sum - sum) + value
        } else {
            (value - sum) + self.sum
        };
        self.sum = sum;
    }

    fn total(&self) -> f64 {
        self.sum + self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivative_of_a_parabola_is_exact_at_uneven_times() {
        let times = [0.0, 0.5, 2.0, 2.25, 5.0];
        let values = times.map(|t| 3.0 * t * t - t + 7.0);
        let found = derivative(&times, &values, None);
        for i in 1..4 {
            assert!(
                (found[i] - (6.0 * times[i] - 1.0)).abs() < 1e-12,
                "{found:?}"
            );
        }
    }

    #[test]
    fn a_heading_that_passes_north_turns_evenly() {
        let times = [0.0, 1.0, 2.0, 3.0];
        let found = derivative(&times, &[340.0, 350.0, 0.0, 10.0], Some(360.0));
        assert_eq!(found, [10.0; 4]);
    }

    #[test]
    fn a_missing_value_has_no_derivative_and_does_not_spoil_its_neighbours() {
        let times = [0.0, 1.0, 2.0, 3.0, 4.0];
        let found = derivative(&times, &[0.0, 2.0, f64::NAN, 6.0, 8.0], None);
        assert!(found[2].is_nan());
        assert_eq!([found[0], found[1], found[3], found[4]], [2.0; 4]);
    }

    #[test]
    fn the_integral_of_a_line_is_a_parabola() {
        let times: Vec<f64> = (0..=10).map(f64::from).collect();
        let found = integral(&times, &times);
        for (time, value) in times.iter().zip(found) {
            assert_eq!(value, 0.5 * time * time);
        }
    }

    #[test]
    fn a_line_stays_a_line_when_smoothed_but_for_its_ends() {
        let times: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|t| 1e9 + 2.0 * t).collect();
        let found = smooth(&times, &values, 1.05, None);
        for i in 6..94 {
            assert!(
                (found[i] - values[i]).abs() < 1e-6,
                "{i}: {}",
                found[i] - values[i]
            );
        }
    }

    #[test]
    fn a_heading_around_north_is_smoothed_around_north() {
        let times: Vec<f64> = (0..50).map(f64::from).collect();
        let values: Vec<f64> = (0..50)
            .map(|i| if i % 2 == 0 { 358.0 } else { 2.0 })
            .collect();
        let found = smooth(&times, &values, 4.5, Some(360.0));
        for value in &found[3..47] {
            let from_north = (value + 180.0).rem_euclid(360.0) - 180.0;
            assert!(from_north.abs() < 0.5, "{value}");
        }
    }
}
