//! Agreement of signed orders of three columns with a reference along three axes, and the factor of each.

use super::grid::quantile;
use pilotage_base::sorting::sort;

/// An order of columns and their signs: along axis i lies `sign[i]` times column `order[i]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AxisOrder {
    /// Name for people.
    pub name: &'static str,
    pub order: [usize; 3],
    pub sign: [f64; 3],
}

const fn axes(name: &'static str, order: [usize; 3], sign: [f64; 3]) -> AxisOrder {
    AxisOrder { name, order, sign }
}

/// Axes over ground, the likeliest first; the last two are those of simulators and games, whose second is up.
pub(super) const EARTH: [AxisOrder; 5] = [
    axes("north, east, down", [0, 1, 2], [1.0, 1.0, 1.0]),
    axes("east, north, up", [1, 0, 2], [1.0, 1.0, -1.0]),
    axes("north, west, up", [0, 1, 2], [1.0, -1.0, -1.0]),
    axes("east, up, south", [2, 0, 1], [-1.0, 1.0, -1.0]),
    axes("east, up, north", [2, 0, 1], [1.0, 1.0, -1.0]),
];

/// Axes of the body, the likeliest first.
pub(super) const BODY: [AxisOrder; 3] = [
    axes("forward, right, down", [0, 1, 2], [1.0, 1.0, 1.0]),
    axes("forward, left, up", [0, 1, 2], [1.0, -1.0, -1.0]),
    axes("right, forward, up", [1, 0, 2], [1.0, 1.0, -1.0]),
];

/// Agreement of axes with a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AxesFit {
    pub axes: AxisOrder,
    /// Mean of the correlations along the axes that tell something, -1 to 1.
    pub score: f64,
    /// Factor from values to the reference.
    pub factor: f64,
}

/// Correlation through the origin of two series and what the second is multiplied by to be the first, by their sizes;
/// with the number of pairs. The outermost hundredth is left out.
pub(super) fn compare(reference: &[f64], values: &[f64]) -> Option<(f64, f64, usize)> {
    let pairs = reference.iter().zip(values);
    let pairs: Vec<(f64, f64)> = pairs
        .map(|(a, b)| (*a, *b))
        .filter(|(a, b)| a.is_finite() && b.is_finite())
        .collect();
    if pairs.len() < 8 {
        return None;
    }
    let sizes = |part: fn(&(f64, f64)) -> f64| {
        let sizes: Vec<f64> = pairs.iter().map(|pair| part(pair).abs()).collect();
        3.0 * quantile(&sizes, 0.99)
    };
    let (most_a, most_b) = (sizes(|pair| pair.0), sizes(|pair| pair.1));
    let inner = pairs
        .iter()
        .filter(|(a, b)| a.abs() <= most_a && b.abs() <= most_b);
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in inner {
        aa += a * a;
        bb += b * b;
        ab += a * b;
    }
    (aa > 0.0 && bb > 0.0).then(|| (ab / (aa * bb).sqrt(), (aa / bb).sqrt(), pairs.len()))
}

/// The same numbers less their mean.
pub(super) fn centred(values: &[f64]) -> Vec<f64> {
    let finite = values.iter().filter(|v| v.is_finite());
    let (sum, count) = finite.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    let mean = if count > 0.0 { sum / count } else { 0.0 };
    values.iter().map(|v| v - mean).collect()
}

fn energy(values: &[f64]) -> f64 {
    let squares: Vec<f64> = values
        .iter()
        .map(|v| v * v)
        .filter(|v| v.is_finite())
        .collect();
    squares.iter().sum::<f64>() / squares.len().max(1) as f64
}

/// Agreement of all `candidates` with the reference, the best first; of equals the likelier. Axes along which the
/// reference is NaN or hardly anything tell nothing; candidates that need a column which is not there are left out.
pub(super) fn fits(
    candidates: &[AxisOrder],
    reference: &[Vec<f64>; 3],
    values: &[Vec<f64>; 3],
) -> Vec<AxesFit> {
    let energies = reference.each_ref().map(|part| energy(part));
    let all: f64 = energies.iter().sum();
    let fit = |axes: &AxisOrder| {
        let (mut scores, mut factors, mut weight, mut count) = (0.0, 0.0, 0.0, 0.0);
        for axis in 0..3 {
            if energies[axis] < 0.02 * all || all == 0.0 {
                continue;
            }
            let values = &values[axes.order[axis]];
            if values.iter().all(|value| value.is_nan()) {
                return None;
            }
            let Some((correlation, factor, _)) = compare(&reference[axis], values) else {
                continue;
            };
            scores += correlation * axes.sign[axis];
            factors += energies[axis] * factor.ln();
            weight += energies[axis];
            count += 1.0;
        }
        (count > 0.0).then(|| AxesFit {
            axes: *axes,
            score: scores / count,
            factor: (factors / weight).exp(),
        })
    };
    let mut fits: Vec<AxesFit> = candidates.iter().filter_map(fit).collect();
    sort(&mut fits, &|a, b| b.score.total_cmp(&a.score));
    fits
}
