//! Numbers as people read them.

/// Number with three significant digits, with a power of ten only where it has seven figures or more, or is tiny.
///
/// ```
/// use pilotage_lessons::significant;
///
/// assert_eq!(significant(9.996), "10.0");
/// assert_eq!(significant(12_345_678.0), "1.23·10⁷");
/// ```
pub fn significant(number: f64) -> String {
    if !number.is_finite() {
        return "not known".to_owned();
    }
    if number == 0.0 {
        return "0".to_owned();
    }
    let order = number.abs().log10().floor() as i32;
    if !(-5..7).contains(&order) {
        let text = format!("{number:.2e}");
        let (figures, power) = text.split_once('e').unwrap_or((&text, "0"));
        let power: String = power.chars().map(raised).collect();
        return format!("{figures}·10{power}").replace('-', "\u{2212}");
    }
    let decimals = (2 - order).max(0) as usize;
    // 9.996 has another order once it is rounded.
    let rounded: f64 = format!("{number:.decimals$}").parse().unwrap_or(number);
    let grown = rounded.abs().log10().floor() as i32 > order;
    let decimals = decimals.saturating_sub(usize::from(grown));
    format!("{number:.decimals$}").replace('-', "\u{2212}")
}

/// Figure or sign as it stands in an exponent.
fn raised(character: char) -> char {
    const FIGURES: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    character
        .to_digit(10)
        .map_or('⁻', |figure| FIGURES[figure as usize])
}

/// Number as a text has it written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Written {
    /// The number.
    pub number: f64,
    /// Place of its last digit: 0.01 for 3.40.
    pub last_digit: f64,
    /// Significant digits.
    pub digits: usize,
}

impl Written {
    /// Reads a number; `None` where it is none.
    ///
    /// ```
    /// use pilotage_lessons::Written;
    ///
    /// let written = Written::read("3.40").ok_or("a number")?;
    /// assert_eq!((written.last_digit, written.digits), (0.01, 3));
    /// assert!(Written::read("some").is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn read(text: &str) -> Option<Self> {
        let plain = text.replace('\u{2212}', "-").replace(['\u{202f}', ','], "");
        let number: f64 = plain.parse().ok()?;
        let decimals = plain.split_once('.').map_or(0, |(_, tail)| tail.len());
        let figures: String = plain.chars().filter(char::is_ascii_digit).collect();
        Some(Self {
            number,
            last_digit: 10f64.powi(-(decimals as i32)),
            digits: figures.trim_start_matches('0').len(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_significant_digits() {
        for (number, wanted) in [
            (0.0, "0"),
            (1.0, "1.00"),
            (-0.012_345, "\u{2212}0.0123"),
            (9.996, "10.0"),
            (99.96, "100"),
            (12_345.6, "12346"),
            (1.93e-9, "1.93·10⁻⁹"),
            (-2.5e12, "\u{2212}2.50·10¹²"),
            (f64::NAN, "not known"),
        ] {
            assert_eq!(significant(number), wanted);
        }
    }

    #[test]
    fn a_written_number_says_how_exactly_it_is_meant() {
        let read = |text| Written::read(text).map(|it| (it.number, it.last_digit, it.digits));
        assert_eq!(read("3.40"), Some((3.4, 0.01, 3)));
        assert_eq!(read("\u{2212}12"), Some((-12.0, 1.0, 2)));
        assert_eq!(read("0.0250"), Some((0.025, 0.0001, 3)));
        assert_eq!(read("many"), None);
    }
}
