//! Tests of `track_noise`.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::*;

/// Residuals of a flight of so many seconds in which nothing was fitted.
fn left(noise: &TrackNoise, seconds: u32, seed: u64) -> Vec<Left<0>> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> Vector2<f64> {
        let mut one = || StandardNormal.sample(&mut random);
        Vector2::new(one(), one())
    };
    let persistence = (-1.0 / noise.memory).exp();
    let fresh = noise.gust * (1.0 - persistence * persistence).sqrt();
    let (mut wind, mut gust) = (Vector2::zeros(), normal() * noise.gust);
    (0..seconds)
        .map(|second| {
            wind += normal() * noise.walk;
            gust = gust * persistence + normal() * fresh;
            Left {
                time: f64::from(second),
                velocity: wind + gust + normal() * noise.white,
                design: [],
            }
        })
        .collect()
}

#[test]
fn a_long_flight_tells_its_own_gusts_and_how_its_wind_changes() {
    let truth = TrackNoise {
        white: 0.4,
        gust: 1.6,
        memory: 6.0,
        walk: 0.15,
    };
    let left = left(&truth, 2400, 3);
    let found = TrackNoise::default().likeliest(&left, &[], 5.0);
    let about = |own: f64, truth: f64, factor: f64| (own / truth).ln().abs() < factor.ln();
    assert!(about(found.gust, truth.gust, 1.15), "{found:?}");
    assert!(about(found.memory, truth.memory, 1.4), "{found:?}");
    assert!(about(found.walk, truth.walk, 1.5), "{found:?}");
    let (known, expected) = found.known(&left, &[], 5.0);
    assert!(about(known.walk, truth.walk, 1.5), "{known:?}");
    assert!(about(expected.walk, truth.walk, 1.6), "{expected:?}");
}

#[test]
fn a_short_flight_leaves_open_how_the_wind_changes() {
    let truth = TrackNoise {
        walk: 0.01,
        ..TrackNoise::default()
    };
    let short = left(&truth, 40, 5);
    let found = TrackNoise::default().likeliest(&short, &[], 5.0);
    let (known, expected) = found.known(&short, &[], 5.0);
    assert!(expected.walk > 1.5 * known.walk, "{found:?} {expected:?}");
    assert!(expected.gust > found.gust);
}

#[test]
fn the_weights_of_samples_make_the_wind_of_the_filter() {
    let noise = TrackNoise {
        walk: 0.1,
        ..TrackNoise::default()
    };
    let left = left(&noise, 50, 7);
    let mut separation = Separation::new(&noise, 5.0);
    let mut parts = WindAndGust::default();
    let mut last = 0.0;
    for left in &left {
        let step = separation.after(left.time - last);
        last = left.time;
        parts.innovation(&step, left.velocity);
    }
    let weights = noise.weights(left.iter().map(|l| l.time), 5.0);
    let pairs = left.iter().zip(&weights.of_wind);
    let summed: Vector2<f64> = pairs.map(|(l, weight)| l.velocity * *weight).sum();
    assert!(
        (summed - parts.wind).norm() < 1e-9,
        "{summed} {}",
        parts.wind
    );
    let whole: f64 = weights.of_wind.iter().sum();
    assert!((0.98..=1.0).contains(&whole), "{whole}");
}

#[test]
fn a_sum_strays_as_its_covariance_says() {
    let noise = TrackNoise {
        white: 0.5,
        gust: 1.0,
        memory: 5.0,
        walk: 0.2,
    };
    let instruments: Vec<_> = (0..60)
        .map(|i| {
            let time = 0.7 * f64::from(i) + 0.1 * f64::from(i % 3);
            let (sin, cos) = (0.1 * time).sin_cos();
            (time, [Vector2::new(cos, sin), Vector2::new(1.0, 0.0)])
        })
        .collect();
    let end = instruments[59].0;
    let mut expected = SMatrix::<f64, 2, 2>::zeros();
    for (i, (time, a)) in instruments.iter().enumerate() {
        for (j, (other, b)) in instruments.iter().enumerate() {
            let gust = (-(time - other).abs() / noise.memory).exp();
            let walked = noise.walk.powi(2) * (end - time.max(*other));
            let white = if i == j { noise.white.powi(2) } else { 0.0 };
            let error = noise.gust.powi(2) * gust + walked + white;
            expected += SMatrix::<f64, 2, 2>::from_fn(|k, l| a[k].dot(&b[l]) * error);
        }
    }
    let found = noise.covariance(&instruments);
    assert!((found - expected).norm() < 1e-9 * expected.norm());
}
