//! Quantiles of samples.

/// Value that the share `share` (0 to 1) of `ascending` samples stays below, linear between the nearest two; `None` of
/// none.
///
/// ```
/// use pilotage_base::statistics::quantile;
///
/// assert_eq!(quantile(&[0.0, 3.0, 4.0], 0.5), Some(3.0));
/// assert_eq!(quantile(&[0.0, 10.0], 0.75), Some(7.5));
/// ```
pub fn quantile(ascending: &[f64], share: f64) -> Option<f64> {
    let place = share * ascending.len().checked_sub(1)? as f64;
    let low = ascending.get(place.floor() as usize)?;
    let high = ascending.get(place.ceil() as usize)?;
    Some(low + place.fract() * (high - low))
}

/// Sample of `ascending` ones that stands nearest to the share `share` (0 to 1) of their order, of two as near the
/// greater; `None` of none.
///
/// ```
/// use pilotage_base::statistics::nearest_sample;
///
/// assert_eq!(nearest_sample(&[1.0, 2.0, 30.0, 40.0], 0.5), Some(30.0));
/// ```
pub fn nearest_sample(ascending: &[f64], share: f64) -> Option<f64> {
    let place = share * ascending.len().checked_sub(1)? as f64;
    ascending.get(place.round() as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_the_samples_and_end_with_them() {
        let samples = [1.0, 2.0, 3.0, 4.0, 5.0];
        assert_eq!(quantile(&samples, 0.0), Some(1.0));
        assert_eq!(quantile(&samples, 1.0), Some(5.0));
        assert!((quantile(&samples, 0.95).unwrap() - 4.8).abs() < 1e-12);
        assert_eq!(nearest_sample(&samples, 0.95), Some(5.0));
        assert_eq!(nearest_sample(&samples, 0.0), Some(1.0));
    }

    #[test]
    fn no_samples_have_none() {
        assert_eq!((quantile(&[], 0.5), nearest_sample(&[], 0.5)), (None, None));
    }
}
