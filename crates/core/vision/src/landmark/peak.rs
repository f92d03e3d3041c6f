//! Peaks of a score surface.

use nalgebra::{Matrix2, Vector2};

use pilotage_raster::raster::Gray;

/// Score of an offset at which the patch must not be placed.
pub const FORBIDDEN: f32 = -2.0;

/// A local maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScorePeak {
    /// Column of the surface.
    pub column: usize,
    /// Row of the surface.
    pub row: usize,
    /// Score there.
    pub score: f32,
}

/// Places closer than this to a better one belong to it: a quarter of the patch.
pub fn separation(size: (usize, usize)) -> usize {
    (size.0.min(size.1) / 4).max(2)
}

/// The best `most` places, each at least `separation` pixels (Chebyshev) from better ones.
pub fn best_peaks(surface: &Gray, separation: usize, most: usize) -> Vec<ScorePeak> {
    let mut peaks: Vec<ScorePeak> = Vec::new();
    let mut taken = surface.map(|score| score <= FORBIDDEN);
    while peaks.len() < most {
        let best = surface
            .pixels()
            .iter()
            .zip(taken.pixels())
            .enumerate()
            .filter(|(_, (_, taken))| !**taken)
            .max_by(|a, b| a.1.0.total_cmp(b.1.0));
        let Some((index, (score, _))) = best else {
            break;
        };
        let (column, row) = (index % surface.width(), index / surface.width());
        if is_local_maximum(surface, column, row) {
            peaks.push(ScorePeak {
                column,
                row,
                score: *score,
            });
        }
        let columns =
            column.saturating_sub(separation)..(column + separation + 1).min(surface.width());
        let rows = row.saturating_sub(separation)..(row + separation + 1).min(surface.height());
        let local = peaks
            .last()
            .is_some_and(|p| (p.column, p.row) == (column, row));
        if local {
            for r in rows {
                taken.row_mut(r)[columns.clone()].fill(true);
            }
        } else {
            taken.set(column, row, true);
        }
    }
    peaks
}

/// Whether no neighbour scores higher; a place on the border counts if it beats those it has.
fn is_local_maximum(surface: &Gray, column: usize, row: usize) -> bool {
    let here = surface.get(column, row);
    let columns = column.saturating_sub(1)..=(column + 1).min(surface.width() - 1);
    let rows = row.saturating_sub(1)..=(row + 1).min(surface.height() - 1);
    rows.flat_map(|r| columns.clone().map(move |c| (c, r)))
        .all(|(c, r)| surface.get(c, r) <= here)
}

/// Offset (x, y) of the true maximum from the sample at (column, row) and the height there, from the
/// least-squares paraboloid through the 3×3 neighbourhood; the sample itself on a border or where the
/// surface is not concave.
pub fn refine(surface: &Gray, column: usize, row: usize) -> (Vector2<f64>, f64) {
    let here = f64::from(surface.get(column, row));
    let inside = (1..surface.width().saturating_sub(1)).contains(&column)
        && (1..surface.height().saturating_sub(1)).contains(&row);
    if !inside {
        return (Vector2::zeros(), here);
    }
    let at = |dx: isize, dy: isize| {
        f64::from(surface.get(column.wrapping_add_signed(dx), row.wrapping_add_signed(dy)))
    };
    let sum = |f: &dyn Fn(isize, isize) -> f64| {
        (-1..=1)
            .flat_map(|y| (-1..=1).map(move |x| (x, y)))
            .map(|(x, y)| f(x, y) * at(x, y))
            .sum::<f64>()
    };
    let gradient = Vector2::new(sum(&|x, _| x as f64 / 6.0), sum(&|_, y| y as f64 / 6.0));
    let second = |x: isize| if x == 0 { -2.0 / 3.0 } else { 1.0 / 3.0 };
    let hxx = sum(&|x, _| second(x));
    let hyy = sum(&|_, y| second(y));
    let hxy = sum(&|x, y| (x * y) as f64 / 4.0);
    let hessian = Matrix2::new(hxx, hxy, hxy, hyy);
    if !(hxx < 0.0 && hessian.determinant() > 0.0) {
        return (Vector2::zeros(), here);
    }
    let Some(inverse) = hessian.try_inverse() else {
        return (Vector2::zeros(), here);
    };
    let step = -(inverse * gradient);
    let limited = step.map(|v| v.clamp(-1.0, 1.0));
    (limited, here.max(here + 0.5 * gradient.dot(&limited)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paraboloid_gives_its_top() {
        let surface = Gray::from_fn(9, 9, |c, r| {
            let (x, y) = (c as f32 - 4.3, r as f32 - 3.8);
            0.9 - 0.02 * x * x - 0.03 * y * y + 0.01 * x * y
        });
        let peak = best_peaks(&surface, 2, 1)[0];
        let (offset, height) = refine(&surface, peak.column, peak.row);
        assert!(
            (peak.column as f64 + offset.x - 4.3).abs() < 1e-4,
            "{offset}"
        );
        assert!((peak.row as f64 + offset.y - 3.8).abs() < 1e-4, "{offset}");
        assert!((height - 0.9).abs() < 1e-2);
    }

    #[test]
    fn the_second_peak_lies_outside_the_separation_of_the_first() {
        let mut surface = Gray::filled(20, 20, 0.0);
        surface.set(5, 5, 0.9);
        surface.set(6, 5, 0.85);
        surface.set(15, 12, 0.6);
        let peaks = best_peaks(&surface, 3, 2);
        assert_eq!((peaks[0].column, peaks[0].row), (5, 5));
        assert_eq!((peaks[1].column, peaks[1].row), (15, 12));
    }
}
