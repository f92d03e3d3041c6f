//! Numbers of a normal distribution, the same each time.

use super::normal_draws::NormalDraws;

/// Numbers of a normal distribution of mean 0 and deviation 1, drawn from a seed without end.
///
/// ```
/// use pilotage_lessons::models::normal_numbers;
/// let first: Vec<f64> = normal_numbers(7).take(3).collect();
/// assert_eq!(first, normal_numbers(7).take(3).collect::<Vec<f64>>());
/// ```
pub fn normal_numbers(seed: u64) -> impl Iterator<Item = f64> {
    let mut draws = NormalDraws::seeded(seed);
    std::iter::repeat_with(move || draws.number())
}
