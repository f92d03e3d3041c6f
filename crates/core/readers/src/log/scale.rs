//! Scale from a stored number to a value.

use serde::{Deserialize, Serialize};

/// Scale from a stored number to a value.
///
/// Hundredths are divided by a hundred instead of multiplied by 0.01, which no computer has exactly: so
/// 1234 becomes the very number that 12.34 is read as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum ValueScale {
    /// The number is the value.
    #[default]
    One,
    /// The number is multiplied by this.
    Times(f64),
    /// The number is divided by this.
    Over(f64),
}

impl ValueScale {
    /// The scale that multiplies by `factor`: by division where `factor` is one over a whole number.
    pub fn by(factor: f64) -> Self {
        let over = (1.0 / factor).round();
        if factor == 1.0 {
            Self::One
        } else if over > 1.0 && over.is_finite() && 1.0 / over == factor {
            Self::Over(over)
        } else {
            Self::Times(factor)
        }
    }

    /// The value of a stored number.
    #[inline]
    pub fn apply(self, number: f64) -> f64 {
        match self {
            Self::One => number,
            Self::Times(factor) => number * factor,
            Self::Over(divisor) => number / divisor,
        }
    }

    /// Factor from a stored number to its value, as nearly as it can be told.
    pub fn factor(self) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Times(factor) => factor,
            Self::Over(divisor) => 1.0 / divisor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_fractions_come_out_as_they_would_be_read() {
        let mut blurred = 0;
        for number in 0..10_000_i32 {
            let read: f64 = format!("{}.{:02}", number / 100, number % 100)
                .parse()
                .unwrap();
            assert_eq!(ValueScale::by(0.01).apply(f64::from(number)), read);
            blurred += u32::from(f64::from(number) * 0.01 != read);
        }
        assert!(blurred > 100);
    }

    #[test]
    fn a_scale_divides_only_where_it_loses_nothing() {
        assert_eq!(ValueScale::by(1.0), ValueScale::One);
        assert_eq!(ValueScale::by(1e-7), ValueScale::Over(1e7));
        assert_eq!(ValueScale::by(1e-9), ValueScale::Over(1e9));
        assert_eq!(ValueScale::by(3.6), ValueScale::Times(3.6));
        assert_eq!(ValueScale::by(0.3), ValueScale::Times(0.3));
        assert_eq!(ValueScale::by(-0.5), ValueScale::Times(-0.5));
        for factor in [0.0, f64::INFINITY, f64::NAN, 1e-310] {
            assert!(
                matches!(ValueScale::by(factor), ValueScale::Times(_)),
                "{factor}"
            );
        }
        assert_eq!(ValueScale::by(1e-6).factor(), 1e-6);
    }
}
