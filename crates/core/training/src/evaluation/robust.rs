//! Mean and covariance that stray points do not move.

use nalgebra::{Matrix2, Vector2};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use pilotage_base::statistics::chi_square_quantile;

/// Random triples from which the search starts.
const STARTS: usize = 300;
/// Starts that are followed to their end.
const FOLLOWED: usize = 8;
/// Points that the search looks at, at most.
const MOST_POINTS: usize = 1500;
/// Fewest points.
const FEWEST_POINTS: usize = 10;
/// Share of normal points that the final estimate keeps.
const KEPT: f64 = 0.975;

/// A normal distribution in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobustFit {
    /// Centre.
    pub mean: Vector2<f64>,
    /// Covariance.
    pub covariance: Matrix2<f64>,
    /// Points that it was taken from in the end.
    pub used: usize,
}

impl RobustFit {
    /// The minimum covariance determinant: mean and covariance of that half of the points whose
    /// covariance has the least determinant (Rousseeuw 1985; the search is that of Rousseeuw and Van
    /// Driessen 1999), made wide by the median distance, then of all points within the 97.5 % ellipse
    /// of that. `None` for under ten points or where over half of them lie on a line.
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use pilotage_training::evaluation::RobustFit;
    ///
    /// // A square of 5 × 5 places around (3, 4), and four strays 1 km off.
    /// let near = (0..25).map(|i| Vector2::new(1.0 + f64::from(i % 5), 2.0 + f64::from(i / 5)));
    /// let strays = (0..4).map(|i| Vector2::new(1000.0, f64::from(i)));
    /// let fit = RobustFit::of(&near.chain(strays).collect::<Vec<_>>(), 1).ok_or("a line")?;
    /// assert_eq!(fit.used, 25);
    /// assert!((fit.mean - Vector2::new(3.0, 4.0)).norm() < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(points: &[Vector2<f64>], seed: u64) -> Option<Self> {
        if points.len() < FEWEST_POINTS {
            return None;
        }
        let stride = points.len().div_ceil(MOST_POINTS);
        let searched: Vec<_> = points.iter().copied().step_by(stride).collect();
        let (mean, covariance) = densest_half(&searched, seed)?;
        let mut distances = squared_distances(points, &mean, &covariance)?;
        let middle = points.len() / 2;
        let (_, median, _) = distances.select_nth_unstable_by(middle, f64::total_cmp);
        let covariance = covariance * (*median / chi_square_quantile(0.5, 2.0));
        let limit = chi_square_quantile(KEPT, 2.0);
        let distances = squared_distances(points, &mean, &covariance)?;
        let near = points.iter().zip(distances).filter(|(_, d)| *d <= limit);
        let near: Vec<_> = near.map(|(p, _)| *p).collect();
        let (mean, covariance) = moments(&near)?;
        // Cut at the limit, a normal distribution has this share of its covariance left: the chance of a
        // chi-square variable of two more degrees of freedom (Croux and Haesbroeck 1999).
        let left = 1.0 - (-0.5 * limit).exp() * (1.0 + 0.5 * limit);
        Some(Self {
            mean,
            covariance: covariance * (KEPT / left),
            used: near.len(),
        })
    }
}

/// Mean and covariance of the half of the points with the least determinant.
fn densest_half(points: &[Vector2<f64>], seed: u64) -> Option<(Vector2<f64>, Matrix2<f64>)> {
    // The subset that resists most strays in two dimensions: (n + p + 1) / 2.
    let half = usize::midpoint(points.len(), 3);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut found: Vec<(f64, Vector2<f64>, Matrix2<f64>)> = Vec::new();
    for _ in 0..STARTS {
        let triple = [(); 3].map(|()| points[random.random_range(0..points.len())]);
        let Some(start) = moments(&triple) else {
            continue;
        };
        let two = concentrated(points, half, start).and_then(|s| concentrated(points, half, s));
        if let Some((mean, covariance)) = two {
            found.push((covariance.determinant(), mean, covariance));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.truncate(FOLLOWED);
    let ends = found
        .into_iter()
        .map(|(mut determinant, mean, covariance)| {
            let mut fit = (mean, covariance);
            while let Some(next) = concentrated(points, half, fit) {
                let smaller = next.1.determinant();
                if smaller >= determinant {
                    break;
                }
                (determinant, fit) = (smaller, next);
            }
            (determinant, fit)
        });
    let best = ends.min_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, fit)| fit)
}

/// Mean and covariance of the `half` points nearest to a fit; the determinant never grows.
fn concentrated(
    points: &[Vector2<f64>],
    half: usize,
    (mean, covariance): (Vector2<f64>, Matrix2<f64>),
) -> Option<(Vector2<f64>, Matrix2<f64>)> {
    let distances = squared_distances(points, &mean, &covariance)?;
    let mut order: Vec<usize> = (0..points.len()).collect();
    let near = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
    order.select_nth_unstable_by(half - 1, near);
    let nearest: Vec<_> = order[..half].iter().map(|&i| points[i]).collect();
    moments(&nearest)
}

fn squared_distances(
    points: &[Vector2<f64>],
    mean: &Vector2<f64>,
    covariance: &Matrix2<f64>,
) -> Option<Vec<f64>> {
    let inverse = covariance.try_inverse()?;
    let distance = |p: &Vector2<f64>| (p - mean).dot(&(inverse * (p - mean)));
    Some(points.iter().map(distance).collect())
}

/// Mean and covariance, `None` where the points lie on a line.
pub(super) fn moments(points: &[Vector2<f64>]) -> Option<(Vector2<f64>, Matrix2<f64>)> {
    let n = points.len() as f64;
    let mean = points.iter().sum::<Vector2<f64>>() / n;
    let spread = |p: &Vector2<f64>| (p - mean) * (p - mean).transpose();
    let covariance = points.iter().map(spread).sum::<Matrix2<f64>>() / (n - 1.0);
    let size = covariance.trace();
    (covariance.determinant() > 1e-9 * size * size).then_some((mean, covariance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_distr::StandardNormal;

    fn normal(count: usize, seed: u64) -> Vec<Vector2<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut draw = || random.sample::<f64, _>(StandardNormal);
        let mut point = || {
            let (a, b) = (draw(), draw());
            Vector2::new(0.4 + 1.2 * a, -0.3 + 0.5 * a + 0.6 * b)
        };
        (0..count).map(|_| point()).collect()
    }

    fn truth() -> Matrix2<f64> {
        Matrix2::new(1.44, 0.6, 0.6, 0.25 + 0.36)
    }

    #[test]
    fn of_normal_points_it_is_their_covariance() {
        let fit = RobustFit::of(&normal(4000, 1), 7).unwrap();
        assert!((fit.covariance - truth()).norm() < 0.08, "{fit:?}");
        assert!((fit.mean - Vector2::new(0.4, -0.3)).norm() < 0.06);
        assert!(fit.used > 3800);
    }

    #[test]
    fn a_third_of_stray_points_does_not_inflate_it() {
        let mut points = normal(400, 2);
        for (i, point) in points.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
            *point = Vector2::new(15.0 + 0.01 * i as f64, -12.0 + 0.1 * (i % 17) as f64);
        }
        let fit = RobustFit::of(&points, 7).unwrap();
        let (_, plain) = moments(&points).unwrap();
        assert!(plain.trace() > 60.0);
        assert!((fit.covariance - truth()).norm() < 0.45, "{fit:?}");
    }

    #[test]
    fn it_is_the_same_for_the_same_seed_and_none_for_points_on_a_line() {
        let points = normal(100, 3);
        assert_eq!(RobustFit::of(&points, 1), RobustFit::of(&points, 1));
        let line: Vec<_> = (0..50).map(|i| Vector2::new(f64::from(i), 2.0)).collect();
        assert!(RobustFit::of(&line, 1).is_none());
        assert!(RobustFit::of(&points[..9], 1).is_none());
    }
}
