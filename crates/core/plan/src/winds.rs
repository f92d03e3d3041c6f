//! A wind that nobody knows, cut into parts that are flown one by one.
//!
//! Errors before the first fix grow with the wind, and in a strong one more than in proportion: the
//! flight takes longer against it, and landmarks are passed at other angles. So the tail decides what
//! holds 95 % of them. A disk and rings around it, cut into sectors, part the plane; the outer ones are
//! flown as often as the inner ones and count for less (stratified sampling, Cochran 1977, 5). In each
//! part the wind has the mean and the covariance of a Gaussian that is kept to it, so that all parts
//! together have those of the whole.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Vector2};

use pilotage_base::statistics::normal_probability;

/// The golden angle, radians: rings turned by it against each other have no common edges.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// Radius of the innermost edge of the outermost ring, standard deviations.
const OUTERMOST: f64 = 2.3;

/// A part of the standard Gaussian of two axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct WindPart {
    /// Its probability.
    pub weight: f64,
    /// Mean in it, standard deviations.
    pub mean: Vector2<f64>,
    /// Covariance in it.
    pub covariance: Matrix2<f64>,
}

/// Parts the standard Gaussian of two axes into `count` (at least one).
pub(super) fn parts(count: usize) -> Vec<WindPart> {
    let rings = ((0.9 * (count as f64).sqrt()).round() as usize).min(count);
    if rings < 2 {
        return vec![sector(0.0, f64::INFINITY, PI, 0.0)];
    }
    let edge = |ring: usize| match ring {
        0 => 0.0,
        ring if ring == rings => f64::INFINITY,
        ring => OUTERMOST * ring as f64 / (rings as f64 - 0.5),
    };
    let mut parts = vec![sector(0.0, edge(1), PI, 0.0)];
    // As many sectors as a ring is long.
    let length = |ring: usize| 2.0 * ring as f64 + 1.0;
    for ring in 1..rings {
        let left = count - parts.len();
        let outwards: f64 = (ring..rings).map(length).sum();
        let sectors = (left as f64 * length(ring) / outwards).round().max(1.0) as usize;
        for i in 0..sectors {
            let heading = GOLDEN_ANGLE * ring as f64 + TAU * i as f64 / sectors as f64;
            parts.push(sector(
                edge(ring),
                edge(ring + 1),
                PI / sectors as f64,
                heading,
            ));
        }
    }
    parts
}

/// Part that lies from `inner` to `outer` standard deviations from the middle and within `half` (radians) of
/// `heading`.
fn sector(inner: f64, outer: f64, half: f64, heading: f64) -> WindPart {
    let density = |r: f64| (-0.5 * r * r).exp();
    // Of r dφ dr: density, and what r and r² come to with it.
    let at = |edge: f64, times: f64| {
        if edge.is_finite() {
            times * density(edge)
        } else {
            0.0
        }
    };
    let mass = density(inner) - density(outer);
    let first = at(inner, inner) - at(outer, outer)
        + TAU.sqrt() * (normal_probability(outer) - normal_probability(inner));
    let second = at(inner, inner * inner + 2.0) - at(outer, outer * outer + 2.0);
    let (distance, square) = (first / mass * half.sin() / half, second / mass);
    let apart = (2.0 * half).sin() / (4.0 * half);
    let outwards = square * (0.5 + apart) - distance * distance;
    let sideways = square * (0.5 - apart);
    let (sin, cos) = heading.sin_cos();
    let (radial, tangential) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
    WindPart {
        weight: mass * half / PI,
        mean: distance * radial,
        covariance: outwards * radial * radial.transpose()
            + sideways * tangential * tangential.transpose(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn all_parts_together_have_the_moments_of_the_whole() {
        for count in [1, 2, 3, 5, 9, 20, 70, 204] {
            let parts = parts(count);
            assert!(parts.len().abs_diff(count) <= 1, "{count}: {}", parts.len());
            let weight: f64 = parts.iter().map(|p| p.weight).sum();
            let mean: Vector2<f64> = parts.iter().map(|p| p.weight * p.mean).sum();
            let of = |p: &WindPart| p.weight * (p.covariance + p.mean * p.mean.transpose());
            let second: Matrix2<f64> = parts.iter().map(of).sum();
            assert!((weight - 1.0).abs() < 1e-12, "{count}: {weight}");
            assert!(mean.norm() < 0.05, "{count}: {mean}");
            assert!((second.trace() - 2.0).abs() < 1e-9, "{count}: {second}");
            if count >= 5 {
                assert!((second - Matrix2::identity()).norm() < 0.1, "{second}");
            }
        }
    }

    #[test]
    fn a_part_has_the_moments_of_what_is_drawn_in_it() {
        let part = sector(0.8, 1.9, 0.7, 0.4);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let drawn: Vec<Vector2<f64>> = (0..400_000)
            .map(|_| Vector2::from_fn(|_, _| StandardNormal.sample(&mut random)))
            .collect();
        let inside: Vec<&Vector2<f64>> = drawn
            .iter()
            .filter(|v| {
                let off = (v.y.atan2(v.x) - 0.4 + PI).rem_euclid(TAU) - PI;
                (0.8..1.9).contains(&v.norm()) && off.abs() < 0.7
            })
            .collect();
        let n = inside.len() as f64;
        let mean: Vector2<f64> = inside.iter().copied().sum::<Vector2<f64>>() / n;
        let spread = |v: &&Vector2<f64>| (**v - mean) * (**v - mean).transpose();
        let covariance: Matrix2<f64> = inside.iter().map(spread).sum::<Matrix2<f64>>() / n;
        assert!((n / drawn.len() as f64 - part.weight).abs() < 2e-3);
        assert!((mean - part.mean).norm() < 5e-3, "{mean} {}", part.mean);
        assert!((covariance - part.covariance).norm() < 5e-3, "{covariance}");
    }
}
