//! The density of a normal distribution, to be drawn.

use std::f64::consts::TAU;

/// Points of the density of a normal distribution over `[from, to]`: number, density.
///
/// ```
/// use pilotage_lessons::models::bell;
/// let points = bell(0.0, 2.0, [-1.0, 1.0]);
/// // Highest in the middle: 1 / (2 √(2π)).
/// let most = points.iter().map(|[_, y]| *y).fold(0.0, f64::max);
/// assert!((most - 0.199_471_14).abs() < 1e-6);
/// ```
pub fn bell(mean: f64, deviation: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    const POINTS: usize = 160;
    let peak = 1.0 / (deviation * TAU.sqrt());
    (0..=POINTS)
        .map(|index| {
            let x = from + (to - from) * index as f64 / POINTS as f64;
            let z = (x - mean) / deviation;
            [x, peak * (-0.5 * z * z).exp()]
        })
        .collect()
}
