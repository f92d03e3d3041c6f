//! Slopes of functions by differences.

use nalgebra::{Const, DVector, Dyn, OMatrix, SVector};

/// Step of the differences, relative to a component's size (at least of 1).
///
/// Fourth order: the error of the formula is step⁴/30 times the fifth derivative, 3e-14 here for a
/// function that changes with its argument as a sine does, and rounding adds about ε/step, 3e-13, of
/// the function's value.
const STEP: f64 = 1e-3;

/// Jacobian of `function` at `place`, m × N, with slopes along the components `along` only and zero
/// elsewhere; `None` where it has no answer.
///
/// Central differences of fourth order: (8 (f(x+h) - f(x-h)) - (f(x+2h) - f(x-2h))) / 12h. They are exact
/// but for rounding up to polynomials of the fourth degree; see `STEP`.
pub fn partial_jacobian<const N: usize>(
    function: impl Fn(&SVector<f64, N>) -> Option<DVector<f64>>,
    place: &SVector<f64, N>,
    along: &[usize],
) -> Option<OMatrix<f64, Dyn, Const<N>>> {
    let rows = function(place)?.nrows();
    let mut jacobian = OMatrix::<f64, Dyn, Const<N>>::zeros(rows);
    for j in along.iter().copied() {
        let step = STEP * place[j].abs().max(1.0);
        let at = |steps: f64| {
            let mut moved = *place;
            moved[j] += steps * step;
            function(&moved)
        };
        let near = at(1.0)? - at(-1.0)?;
        let far = at(2.0)? - at(-2.0)?;
        for i in 0..rows {
            jacobian[(i, j)] = (8.0 * near[i] - far[i]) / (12.0 * step);
        }
    }
    Some(jacobian)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Vector3, dvector};

    use super::*;

    #[test]
    fn the_slope_of_range_and_bearing_is_known_to_eleven_digits_and_asked_components_only_move() {
        let place = Vector3::new(300.0, -40.0, 5.0);
        let range_and_bearing =
            |x: &Vector3<f64>| Some(dvector![x.xy().norm(), x.y.atan2(x.x) * x.z]);
        let slope = partial_jacobian(range_and_bearing, &place, &[0, 1]).unwrap();
        let r = place.xy().norm();
        let exact = [
            [place.x / r, place.y / r],
            [-5.0 * place.y / (r * r), 5.0 * place.x / (r * r)],
        ];
        for (i, row) in exact.into_iter().enumerate() {
            for (j, value) in row.into_iter().enumerate() {
                let off = (slope[(i, j)] / value - 1.0).abs();
                assert!(off < 2e-11, "({i}, {j}): {off:e}");
            }
        }
        assert!(slope.column(2).iter().all(|v| *v == 0.0));
        assert!(partial_jacobian(|_: &Vector3<f64>| None, &place, &[0]).is_none());
    }
}
