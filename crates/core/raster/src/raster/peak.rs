//! The summit of a correlation surface and its rivals.

use nalgebra::{Matrix2, Matrix3x2, Vector2};

use super::Gray;

/// A local maximum between the samples of a surface.
///
/// Surface coordinates are indices: (x, y) = (c, r) is the sample of column c and row r. On a
/// correlation surface that is the place of the template's top-left corner in the continuous pixel
/// coordinates of the search, so the template's centre lies at (x + width/2, y + height/2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Column, between samples.
    pub x: f64,
    /// Row, between samples.
    pub y: f64,
    /// Height of the fitted summit.
    pub value: f64,
    /// Second derivatives of the surface at the summit, per pixel²; negative definite unless the
    /// summit lies at the edge of the surface or on a ridge.
    pub hessian: Matrix2<f64>,
    /// The highest sample, column and row.
    pub sample: (usize, usize),
}

/// The highest sample, refined between the samples, or `None` for an empty surface.
pub fn highest_peak(surface: &Gray) -> Option<Peak> {
    let (index, value) = highest(surface.pixels().iter().copied().enumerate())?;
    value
        .is_finite()
        .then(|| refine_peak(surface, index % surface.width(), index / surface.width()))
}

/// The highest local maximum at least `exclusion_radius` samples away from `peak`.
///
/// The slopes of the excluded peak do not count: only a sample not lower than its eight neighbours
/// can be a rival. `None` if there is none.
pub fn rival_peak(surface: &Gray, peak: &Peak, exclusion_radius: f64) -> Option<Peak> {
    let (width, height) = (surface.width(), surface.height());
    let limit = exclusion_radius * exclusion_radius;
    let mut best: Option<(usize, usize, f32)> = None;
    for row in 0..height {
        let dy = row as f64 - peak.y;
        for (column, &value) in surface.row(row).iter().enumerate() {
            if best.is_some_and(|(_, _, top)| value <= top) {
                continue;
            }
            let dx = column as f64 - peak.x;
            if dx * dx + dy * dy < limit {
                continue;
            }
            let neighbours = (row.saturating_sub(1)..(row + 2).min(height)).flat_map(|r| {
                (column.saturating_sub(1)..(column + 2).min(width)).map(move |c| (c, r))
            });
            if neighbours
                .map(|(c, r)| surface.get(c, r))
                .all(|other| other <= value)
            {
                best = Some((column, row, value));
            }
        }
    }
    best.map(|(column, row, _)| refine_peak(surface, column, row))
}

/// Fits a quadric to the 3 × 3 samples around (column, row) by least squares and moves to its
/// summit, at most one sample away; at the edge, or where there is no summit, it stays.
///
/// With s ∈ {-1, 0, 1}² the normal equations decouple: the derivatives are the averaged differences
/// and the second derivatives the averaged second differences.
pub fn refine_peak(surface: &Gray, column: usize, row: usize) -> Peak {
    let value = f64::from(surface.get(column, row));
    let mut peak = Peak {
        x: column as f64,
        y: row as f64,
        value,
        hessian: Matrix2::zeros(),
        sample: (column, row),
    };
    let inside =
        column > 0 && row > 0 && column + 1 < surface.width() && row + 1 < surface.height();
    if !inside {
        return peak;
    }
    let f = |dx: usize, dy: usize| f64::from(surface.get(column + dx - 1, row + dy - 1));
    // Sums over each column and row of the neighbourhood.
    let sums = Matrix3x2::from_fn(|i, axis| {
        (0..3)
            .map(|j| if axis == 0 { f(i, j) } else { f(j, i) })
            .sum::<f64>()
    });
    let gradient = Vector2::from_fn(|axis, _| (sums[(2, axis)] - sums[(0, axis)]) / 6.0);
    let second = |axis: usize| (sums[(0, axis)] - 2.0 * sums[(1, axis)] + sums[(2, axis)]) / 3.0;
    let mixed = (f(2, 2) - f(0, 2) - f(2, 0) + f(0, 0)) / 4.0;
    let hessian = Matrix2::new(second(0), mixed, mixed, second(1));
    peak.hessian = hessian;
    let is_summit = hessian[(0, 0)] < 0.0 && hessian.determinant() > 1e-12;
    let step = hessian.try_inverse().map(|inverse| -(inverse * gradient));
    if let Some(step) = step.filter(|step| is_summit && step.amax() <= 1.0) {
        // Height over the least-squares level of the nine samples.
        let level = sums.column(0).sum() / 9.0 - (second(0) + second(1)) / 3.0;
        peak.x += step.x;
        peak.y += step.y;
        peak.value = (level + 0.5 * gradient.dot(&step)).max(value);
    }
    peak
}

fn highest(values: impl Iterator<Item = (usize, f32)>) -> Option<(usize, f32)> {
    values.fold(None, |best, (index, value)| match best {
        Some((_, top)) if top >= value || value.is_nan() => best,
        _ if value.is_nan() => best,
        _ => Some((index, value)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn hill(x: f64, y: f64, height: f64) -> impl Fn(usize, usize) -> f64 {
        move |c, r| {
            let (dx, dy) = (c as f64 - x, r as f64 - y);
            height - 0.02 * dx * dx - 0.03 * dy * dy + 0.01 * dx * dy
        }
    }

    proptest! {
        #[test]
        fn the_summit_of_a_quadric_is_found_where_it_is(x in 3.0..17.0f64, y in 3.0..11.0f64) {
            let exact = hill(x, y, 0.9);
            let surface = Gray::from_fn(21, 15, |c, r| exact(c, r) as f32);
            let peak = highest_peak(&surface).unwrap();
            prop_assert!((peak.x - x).abs() < 1e-3 && (peak.y - y).abs() < 1e-3, "{peak:?}");
            prop_assert!((peak.value - 0.9).abs() < 1e-4, "{peak:?}");
            let expected = Matrix2::new(-0.04, 0.01, 0.01, -0.06);
            prop_assert!((peak.hessian - expected).amax() < 1e-4);
        }
    }

    #[test]
    fn the_rival_is_another_hill_and_not_the_slope_of_the_first() {
        let (a, b) = (hill(6.2, 7.4, 0.9), hill(30.6, 8.1, 0.6));
        let surface = Gray::from_fn(40, 16, |c, r| a(c, r).max(b(c, r)).max(0.0) as f32);
        let peak = highest_peak(&surface).unwrap();
        let rival = rival_peak(&surface, &peak, 3.0).unwrap();
        assert_eq!(peak.sample, (6, 7));
        assert_eq!(rival.sample, (31, 8));
        assert!((rival.x - 30.6).abs() < 0.01, "{rival:?}");
    }

    #[test]
    fn a_summit_at_the_edge_stays_on_its_sample() {
        let surface = Gray::from_fn(5, 5, |c, _| c as f32);
        let peak = highest_peak(&surface).unwrap();
        assert_eq!((peak.x, peak.hessian), (4.0, Matrix2::zeros()));
        assert_eq!(highest_peak(&Gray::filled(0, 0, 0.0)), None);
    }
}
