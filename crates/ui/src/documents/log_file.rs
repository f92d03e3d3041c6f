//! The log that the flight is read from, as far as the flight is known by it.

use pilotage_core::flight::log::{LogFormat, LogOutline};

/// Log that the flight is read from, as far as the flight is known by it.
#[derive(Clone, Debug, Default)]
pub struct LogFile {
    /// Its name among the files of the flight.
    pub file: String,
    /// Format, once some of it was read.
    pub format: Option<LogFormat>,
    /// First and last time, seconds in the flight's time base, once some of it was read.
    pub span: Option<(f64, f64)>,
    /// Seconds since 1970 at time zero of the flight, where the log says so.
    pub utc_at_zero: Option<f64>,
    /// Time at which it first leaves the ground, seconds, once all of it was read.
    pub take_off: Option<f64>,
    /// Why it cannot be navigated, if it cannot.
    pub unnavigable: Option<String>,
}

impl LogFile {
    /// A log of which nothing was read yet.
    pub fn named(file: String) -> Self {
        Self {
            file,
            ..Self::default()
        }
    }

    /// Takes note of what was read of it.
    pub fn grow(&mut self, outline: &LogOutline) {
        self.format = Some(outline.format);
        self.span = outline.span;
        self.utc_at_zero = outline.utc_at_zero;
    }
}
