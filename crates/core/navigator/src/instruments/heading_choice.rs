//! Choice between the gyros' heading and the logged one, by which of them explains a flight better.

use super::calibration::HeadingSource;
use super::track_noise::{Left, TrackNoise};

/// Standard errors by which one has to win.
const ERRORS: f64 = 1.0;
/// Fewest stretches whose scatter tells anything, and how long they are, seconds: one knows little of the next.
const FEWEST: usize = 6;
const STRETCH: f64 = 4.0;
/// Longest time between two means of which one counts as the other's, seconds.
const SAME: f64 = 0.5;

/// Logarithms of the likelihoods of what a heading leaves of the velocities, in the noise that makes it likeliest.
fn scores(left: &[Left<0>], wind_deviation: f64) -> Vec<(f64, f64)> {
    let noise = TrackNoise::default().likeliest(left, &[], wind_deviation);
    noise.each(left, wind_deviation).collect()
}

/// The heading by which the velocities are likelier, by more than the scatter of that from stretch to stretch (Vuong
/// 1989); both where neither is.
pub(super) fn likelier(
    logged: &[Left<0>],
    gyros: &[Left<0>],
    wind_deviation: f64,
) -> HeadingSource {
    let by_logged = scores(logged, wind_deviation);
    let by_gyros = scores(gyros, wind_deviation);
    let mut sums: Vec<(f64, f64)> = Vec::new();
    let mut others = by_logged.iter().peekable();
    for (time, score) in &by_gyros {
        while others.next_if(|(other, _)| *other < time - SAME).is_some() {}
        let Some((_, other)) = others.next_if(|(other, _)| *other <= time + SAME) else {
            continue;
        };
        match sums.last_mut() {
            Some((begin, sum)) if time - *begin < STRETCH => *sum += score - other,
            _ => sums.push((*time, score - other)),
        }
    }
    if sums.len() < FEWEST {
        return HeadingSource::Logged;
    }
    let count = sums.len() as f64;
    let mean = sums.iter().map(|(_, sum)| sum).sum::<f64>() / count;
    let squares: f64 = sums.iter().map(|(_, sum)| (sum - mean).powi(2)).sum();
    let error = ERRORS * (squares / (count - 1.0) / count).sqrt();
    if mean > error {
        HeadingSource::Gyros
    } else if mean < -error {
        HeadingSource::Logged
    } else {
        HeadingSource::Both
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Velocities that are left at random with a standard deviation.
    fn left(deviation: f64, seed: u64) -> Vec<Left<0>> {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let one = |second| Left {
            time: f64::from(second),
            velocity: Vector2::new(normal(), normal()) * deviation,
            design: [],
        };
        (0..120).map(one).collect()
    }

    #[test]
    fn gyros_that_are_as_good_do_not_win_and_better_ones_do() {
        let lucky = (0..50)
            .map(|seed| likelier(&left(1.0, seed), &left(1.0, seed + 100), 5.0))
            .filter(|heading| *heading == HeadingSource::Gyros)
            .count();
        // Beyond one standard error there is a sixth.
        assert!(lucky <= 16, "{lucky} of 50 by luck");
        let (good, bad) = (left(1.0, 2), left(1.5, 1));
        assert_eq!(likelier(&bad, &good, 5.0), HeadingSource::Gyros);
        assert_eq!(likelier(&good, &bad, 5.0), HeadingSource::Logged);
        let few = likelier(&bad[..10], &good[..10], 5.0);
        assert_eq!(few, HeadingSource::Logged);
    }
}
