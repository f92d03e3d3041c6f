//! Probabilities as people read them.

/// A probability (0 to 1) in percent, never rounded to certainty, of being right or wrong.
pub fn probability_words(probability: f64) -> String {
    match 100.0 * probability {
        p if p > 99.9 => "> 99.9 %".to_owned(),
        p if p > 99.0 => format!("{p:.1} %"),
        p if p < 1.0 => "< 1 %".to_owned(),
        p => format!("{p:.0} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::probability_words;

    #[test]
    fn a_probability_is_never_rounded_to_certainty() {
        assert_eq!(probability_words(1.0), "> 99.9 %");
        assert_eq!(probability_words(0.9951), "99.5 %");
        assert_eq!(probability_words(0.123), "12 %");
        assert_eq!(probability_words(0.0008), "< 1 %");
    }
}
