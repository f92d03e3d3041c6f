//! The region that holds a stated share of a mixture of Gaussians.
//!
//! Whether a landmark will be recognised is not known before the flight. Each way in which that may
//! turn out is a world with a covariance of its own; the error of the flight is drawn from one of them.
//! Their mean covariance is that of the mixture, but a mixture has heavier tails than a Gaussian.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use pilotage_base::statistics::normal_probability;

/// Errors drawn from all worlds together at least, and from each of them.
const DRAWN: (usize, usize) = (4096, 96);
/// The golden angle, radians: points that far apart on a spiral cover every direction evenly.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Error of the position in one world: truth minus estimate (north, east).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldError {
    /// Weight of this world beside the others.
    pub weight: f64,
    /// Its mean, metres.
    pub mean: Vector2<f64>,
    /// Its covariance, m².
    pub covariance: Matrix2<f64>,
}

/// `count` points that lie like a standard Gaussian of two axes: equally likely rings, on a spiral.
fn gaussian_points(count: usize) -> impl Iterator<Item = Vector2<f64>> {
    (0..count).map(move |i| {
        let within = (i as f64 + 0.5) / count as f64;
        let radius = (-2.0 * (1.0 - within).ln()).sqrt();
        let (sin, cos) = (GOLDEN_ANGLE * i as f64).sin_cos();
        radius * Vector2::new(cos, sin)
    })
}

/// The ellipse and the strip that hold the error with a stated probability.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Corridor {
    /// Covariance of the error (north, east) over all worlds, m².
    pub covariance: Matrix2<f64>,
    /// Standard deviation along the longer axis, metres.
    pub sigma_major: f64,
    /// Standard deviation along the shorter axis, metres.
    pub sigma_minor: f64,
    /// Direction of the longer axis, radians clockwise from north, 0 to π.
    pub heading_of_major: f64,
    /// The ellipse of the covariance times this holds the error with the stated probability; 2.45 for
    /// 95 % of a Gaussian.
    pub scale: f64,
    /// Half width across `course` of the strip that holds it, metres.
    pub across: f64,
    /// Half length along `course`, metres.
    pub along: f64,
}

/// The corridor of worlds with these errors, for a flight on `course` (radians clockwise
/// from north). `None` without a world or where a covariance is not positive.
///
/// A strip holds what the Gaussians of the worlds add up to in one direction. For the ellipse that sum
/// has no closed form: errors are drawn from every world, evenly and the same ones every time, and a
/// quantile taken of them all.
///
/// ```
/// use nalgebra::{Matrix2, Vector2};
/// use pilotage_plan::{WorldError, corridor};
///
/// // One world: 3 m to the north, 4 m to the east, flown towards the north.
/// let covariance = Matrix2::new(9.0, 0.0, 0.0, 16.0);
/// let world = WorldError { weight: 1.0, mean: Vector2::zeros(), covariance };
/// let corridor = corridor(&[world], 0.0, 0.95).ok_or("no covariance")?;
/// assert!((corridor.sigma_major - 4.0).abs() < 1e-9);
/// // Across the course 95 % lie within 1.96 standard deviations.
/// assert!((corridor.across - 1.96 * 4.0).abs() < 0.01);
/// assert!((corridor.along - 1.96 * 3.0).abs() < 0.01);
/// # Ok::<(), &str>(())
/// ```
pub fn corridor(worlds: &[WorldError], course: f64, probability: f64) -> Option<Corridor> {
    if worlds.is_empty() {
        return None;
    }
    let second = |w: &WorldError| w.weight * (w.covariance + w.mean * w.mean.transpose());
    let all = worlds.iter().map(|w| w.weight).sum::<f64>();
    let mean = worlds.iter().map(second).sum::<Matrix2<f64>>() / all;
    let eigen = mean.symmetric_eigen();
    let major = eigen.eigenvalues.imax();
    let (sigma_major, sigma_minor) = (
        eigen.eigenvalues[major].max(0.0).sqrt(),
        eigen.eigenvalues[1 - major].max(0.0).sqrt(),
    );
    let axis = eigen.eigenvectors.column(major);
    Some(Corridor {
        covariance: mean,
        sigma_major,
        sigma_minor,
        heading_of_major: axis[1].atan2(axis[0]).rem_euclid(PI),
        scale: ellipse(worlds, &mean, probability)?,
        across: strip(
            worlds,
            &Vector2::new(-course.sin(), course.cos()),
            probability,
        ),
        along: strip(
            worlds,
            &Vector2::new(course.cos(), course.sin()),
            probability,
        ),
    })
}

/// The multiple of the ellipse of `mean` that holds the error with `probability`.
fn ellipse(worlds: &[WorldError], mean: &Matrix2<f64>, probability: f64) -> Option<f64> {
    // In the coordinates where the mean is a unit circle.
    let whiten = mean.cholesky()?.l().try_inverse()?;
    let each = (DRAWN.0 / worlds.len()).clamp(16, DRAWN.1);
    let points: Vec<Vector2<f64>> = gaussian_points(each).collect();
    let mut norms: Vec<(f64, f64)> = Vec::with_capacity(each * worlds.len());
    for world in worlds {
        let root = whiten * world.covariance.cholesky()?.l();
        let middle = whiten * world.mean;
        let norm = |point: &Vector2<f64>| ((middle + root * point).norm(), world.weight);
        norms.extend(points.iter().map(norm));
    }
    norms.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = probability * norms.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut below: Option<(f64, f64)> = None;
    for (norm, weight) in norms {
        // Each stands for the middle of its share.
        let from = below.map_or(0.0, |(_, weight)| 0.5 * weight);
        let step = from + 0.5 * weight;
        if left <= step {
            let (lower, _) = below.unwrap_or((norm, weight));
            return Some(lower + left / step * (norm - lower));
        }
        left -= step;
        below = Some((norm, weight));
    }
    below.map(|(norm, _)| norm)
}

/// Half width of the strip across `direction` that holds the error with `probability`, metres: where
/// the distribution of all worlds together comes to it, by Newton's method kept within a bracket.
fn strip(worlds: &[WorldError], direction: &Vector2<f64>, probability: f64) -> f64 {
    let one = |w: &WorldError| {
        let variance = direction.dot(&(w.covariance * direction));
        let deviation = variance.max(f64::MIN_POSITIVE).sqrt();
        (w.weight, w.mean.dot(direction), deviation)
    };
    let all: Vec<(f64, f64, f64)> = worlds.iter().map(one).collect();
    let whole = all.iter().map(|(weight, ..)| weight).sum::<f64>();
    let square = all.iter().map(|(w, m, s)| w * (m * m + s * s)).sum::<f64>() / whole;
    let mut q = 2.0 * square.sqrt();
    let furthest = all.iter().map(|(_, m, s)| m.abs() + 9.0 * s);
    let (mut low, mut high) = (0.0, furthest.fold(0.0, f64::max));
    for _ in 0..60 {
        let (mut held, mut slope) = (-probability, 0.0);
        for (weight, m, s) in &all {
            for z in [(q - m) / s, (q + m) / s] {
                held += weight * (normal_probability(z) - 0.5) / whole;
                slope += (-0.5 * z * z).exp() / (s * TAU.sqrt()) * weight / whole;
            }
        }
        if held > 0.0 {
            high = q;
        } else {
            low = q;
        }
        let next = q - held / slope;
        let within = next > low && next < high;
        let next = if within { next } else { 0.5 * (low + high) };
        let moved = (next - q).abs();
        q = next;
        if moved <= 1e-9 * q {
            break;
        }
    }
    q
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::winds;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn centred(covariance: Matrix2<f64>) -> WorldError {
        WorldError {
            weight: 1.0,
            mean: Vector2::zeros(),
            covariance,
        }
    }

    #[test]
    fn one_world_has_the_corridor_of_its_gaussian() {
        let world = Matrix2::new(25.0, 0.0, 0.0, 4.0);
        let found = corridor(&[centred(world)], 0.0, 0.95).unwrap();
        assert!((found.scale - 5.991_f64.sqrt()).abs() < 5e-3, "{found:?}");
        assert!((found.along - 1.96 * 5.0).abs() < 5e-2, "{found:?}");
        assert!((found.across - 1.96 * 2.0).abs() < 2e-2, "{found:?}");
        assert_eq!((found.sigma_major, found.sigma_minor), (5.0, 2.0));
        assert!(found.heading_of_major.abs() < 1e-9);
    }

    #[test]
    fn a_few_parts_of_a_gaussian_have_its_corridor_in_every_direction() {
        for (count, most) in [(1, 0.02), (5, 0.06), (20, 0.03), (70, 0.02)] {
            let worlds: Vec<WorldError> = winds::parts(count)
                .iter()
                .map(|part| WorldError {
                    weight: part.weight,
                    mean: part.mean,
                    covariance: part.covariance,
                })
                .collect();
            for course in 0..18 {
                let course = f64::to_radians(10.0 * f64::from(course));
                let found = corridor(&worlds, course, 0.95).unwrap();
                let off = found.across / 1.96 - 1.0;
                assert!(off.abs() < most, "{count}: {off}");
                let variance = 0.5 * found.covariance.trace();
                assert!((variance - 1.0).abs() < 2e-3, "{count}: {variance}");
            }
        }
    }

    #[test]
    fn the_corridor_of_three_worlds_holds_its_share_of_errors_drawn_from_them() {
        let worlds = [
            centred(Matrix2::new(1.0, 0.3, 0.3, 2.0)),
            centred(Matrix2::new(90.0, -20.0, -20.0, 40.0)),
            WorldError {
                weight: 2.0,
                mean: Vector2::new(-9.0, 6.0),
                covariance: Matrix2::new(4.0, 1.0, 1.0, 2.0),
            },
        ];
        let course = 0.7;
        let found = corridor(&worlds, course, 0.95).unwrap();
        let inverse = found.covariance.try_inverse().unwrap();
        let across = Vector2::new(-f64::sin(course), f64::cos(course));
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let (mut ellipse, mut strip) = (0, 0);
        let n = 60_000;
        for i in 0..n {
            let world = &worlds[(i % 4).min(2)];
            let root = world.covariance.cholesky().unwrap().l();
            let z = Vector2::from_fn(|_, _| {
                let value: f64 = StandardNormal.sample(&mut random);
                value
            });
            let error = world.mean + root * z;
            ellipse += usize::from((inverse * error).dot(&error) <= found.scale * found.scale);
            strip += usize::from(error.dot(&across).abs() <= found.across);
        }
        for share in [ellipse, strip].map(|c| c as f64 / n as f64) {
            assert!((share - 0.95).abs() < 0.006, "{share}");
        }
        assert!(
            found.scale > 2.45,
            "heavier tails than a Gaussian: {found:?}"
        );
    }
}
