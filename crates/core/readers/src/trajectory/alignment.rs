//! Alignment of one trajectory with another.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use serde::{Deserialize, Serialize};

/// Kind of alignment of a trajectory with the reference before it is compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrajectoryAlignment {
    /// Not at all: both are in one world.
    #[default]
    None,
    /// First place on first place.
    Origin,
    /// Turned and moved to fit best (Umeyama 1991 without scale).
    Rigid,
    /// Turned, moved and scaled to fit best (Umeyama 1991).
    Similarity,
}

/// A place p goes to scale · rotation · p + shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectorySimilarity {
    /// Scale.
    pub scale: f64,
    /// Rotation.
    pub rotation: Rotation3<f64>,
    /// Shift, metres.
    pub shift: Vector3<f64>,
}

impl TrajectorySimilarity {
    /// Leaves everything where it is.
    pub fn identity() -> Self {
        Self {
            scale: 1.0,
            rotation: Rotation3::identity(),
            shift: Vector3::zeros(),
        }
    }

    /// Applies the similarity to a place.
    pub fn apply(&self, place: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.scale * (self.rotation * place.coords) + self.shift)
    }
}

/// Similarity that lays the first of each pair over the second; `None` where the places do not tell: without
/// a pair, or for a rotation with all of them in one place.
///
/// ```
/// use nalgebra::Point3;
/// use pilotage_readers::trajectory::{TrajectoryAlignment, align};
///
/// // East in place of north, twice as large and 5 m down.
/// let pairs = [(0.0, 0.0), (10.0, 0.0), (10.0, 20.0)]
///     .map(|(n, e)| (Point3::new(n, e, 0.0), Point3::new(-2.0 * e, 2.0 * n, 5.0)));
/// let over = align(&pairs, TrajectoryAlignment::Similarity).ok_or("one place")?;
/// assert!((over.scale - 2.0).abs() < 1e-9);
/// assert!((over.apply(&pairs[2].0) - pairs[2].1).norm() < 1e-9);
/// # Ok::<(), &str>(())
/// ```
pub fn align(
    pairs: &[(Point3<f64>, Point3<f64>)],
    how: TrajectoryAlignment,
) -> Option<TrajectorySimilarity> {
    let (first, second) = pairs.first()?;
    match how {
        TrajectoryAlignment::None => Some(TrajectorySimilarity::identity()),
        TrajectoryAlignment::Origin => Some(TrajectorySimilarity {
            shift: second - first,
            ..TrajectorySimilarity::identity()
        }),
        TrajectoryAlignment::Rigid => umeyama(pairs, false),
        TrajectoryAlignment::Similarity => umeyama(pairs, true),
    }
}

/// Umeyama 1991, eqs 34-42.
fn umeyama(pairs: &[(Point3<f64>, Point3<f64>)], with_scale: bool) -> Option<TrajectorySimilarity> {
    let count = pairs.len() as f64;
    let mean_from = pairs.iter().map(|p| p.0.coords).sum::<Vector3<f64>>() / count;
    let mean_to = pairs.iter().map(|p| p.1.coords).sum::<Vector3<f64>>() / count;
    let mut covariance = Matrix3::zeros();
    let mut variance = 0.0;
    for (from, to) in pairs {
        let (from, to) = (from.coords - mean_from, to.coords - mean_to);
        covariance += to * from.transpose() / count;
        variance += from.norm_squared() / count;
    }
    let svd = covariance.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let sizes = svd.singular_values;
    // A line still has a turn about itself that is free; a place has none at all.
    if variance <= f64::EPSILON || sizes[0] <= f64::EPSILON * variance {
        return None;
    }
    let mut signs = Vector3::repeat(1.0);
    if u.determinant() * v_t.determinant() < 0.0 {
        signs[2] = -1.0;
    }
    let rotation = u * Matrix3::from_diagonal(&signs) * v_t;
    let scale = if with_scale {
        sizes.dot(&signs) / variance
    } else {
        1.0
    };
    Some(TrajectorySimilarity {
        scale,
        rotation: Rotation3::from_matrix_unchecked(rotation),
        shift: mean_to - scale * (rotation * mean_from),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_was_turned_moved_and_scaled_is_laid_back(
            roll in -3.0..3.0, pitch in -1.5..1.5, yaw in -3.0..3.0, scale in 0.2..5.0,
            north in -500.0..500.0, east in -500.0..500.0,
        ) {
            let moved = TrajectorySimilarity {
                scale,
                rotation: Rotation3::from_euler_angles(roll, pitch, yaw),
                shift: Vector3::new(north, east, 30.0),
            };
            let places = (0..20).map(|i| {
                let t = f64::from(i);
                Point3::new(10.0 * t.sin(), 7.0 * t, (0.7 * t).cos())
            });
            let pairs: Vec<_> = places.map(|p| (p, moved.apply(&p))).collect();
            let found = align(&pairs, TrajectoryAlignment::Similarity).unwrap();
            prop_assert!((found.scale - scale).abs() < 1e-9 * scale);
            for (from, to) in &pairs {
                prop_assert!((found.apply(from) - to).norm() < 1e-7);
            }
        }
    }

    #[test]
    fn a_mirror_image_is_not_turned_inside_out() {
        let corners = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 2.0, 0.0],
            [0.0, 0.0, 3.0],
        ];
        let pairs = corners.map(|[x, y, z]| (Point3::new(x, y, z), Point3::new(-x, y, z)));
        let found = align(&pairs, TrajectoryAlignment::Rigid).unwrap();
        assert!((found.rotation.matrix().determinant() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn places_that_are_one_have_no_turn() {
        let p = Point3::new(1.0, 2.0, 3.0);
        assert_eq!(align(&[(p, p), (p, p)], TrajectoryAlignment::Rigid), None);
        assert_eq!(align(&[], TrajectoryAlignment::None), None);
        let shifted = align(&[(p, Point3::origin())], TrajectoryAlignment::Origin).unwrap();
        assert_eq!(shifted.apply(&p), Point3::origin());
    }
}
