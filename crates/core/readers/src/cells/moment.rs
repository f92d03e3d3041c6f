//! A time as a table states it.

/// A moment: whole seconds and a fraction, so that differences lose nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// Seconds in the flight's time base.
    Relative(f64),
    /// Seconds since 1970-01-01 and a fraction of a second.
    Absolute(i64, f64),
}

impl Moment {
    /// Seconds since `origin`; relative times are counted from it already.
    pub fn since(self, origin: Option<(i64, f64)>) -> f64 {
        match (self, origin) {
            (Self::Relative(seconds), _) => seconds,
            (Self::Absolute(whole, fraction), Some((whole0, fraction0))) => {
                (whole.saturating_sub(whole0)) as f64 + (fraction - fraction0)
            }
            (Self::Absolute(whole, fraction), None) => whole as f64 + fraction,
        }
    }
}
