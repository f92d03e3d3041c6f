//! Quantiles.

/// The value that the share `share` of the values stays below, between the nearest two; 0 of none.
///
/// ```
/// use pilotage_navigator::instruments::quantile;
///
/// assert_eq!(quantile(vec![4.0, 1.0, 2.0, 3.0, 5.0], 0.5), 3.0);
/// assert!((quantile(vec![0.0, 10.0], 0.95) - 9.5).abs() < 1e-12);
/// ```
pub fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = share * values.len().saturating_sub(1) as f64;
    let below = values.get(place.floor() as usize);
    let above = values.get(place.ceil() as usize);
    below.zip(above).map_or(0.0, |(below, above)| {
        below + place.fract() * (above - below)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_the_values() {
        let values = vec![4.0, 1.0, 2.0, 3.0, 5.0];
        assert_eq!(quantile(values.clone(), 0.5), 3.0);
        assert!((quantile(values, 0.95) - 4.8).abs() < 1e-12);
        assert_eq!(quantile(Vec::new(), 0.5), 0.0);
    }
}
