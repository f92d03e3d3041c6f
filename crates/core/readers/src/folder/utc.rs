//! The date of a flight, where its tables tell it.

use super::layout::TimeColumn;
use super::log::FlightTables;
use crate::cells::{has_zone, is_since_1970};

impl FlightTables {
    /// Coordinated universal time at second 0, seconds since 1970: of times that have a date with a zone, or are counted
    /// since 1970. A date without a zone may be that of any.
    pub(super) fn utc_at_zero(&self) -> Option<f64> {
        let channels = self.layout.times_of_channels();
        channels
            .chain(self.layout.times_of_frames())
            .find_map(|(file, time)| self.utc_by(file, time))
            .or(self.dated)
    }

    /// The time at second 0 as one column of times tells it.
    fn utc_by(&self, file: &str, time: &TimeColumn) -> Option<f64> {
        let table = self.by_file.get(file)?;
        let says = |words: &[&str]| {
            let name = time.column.to_lowercase();
            words.iter().any(|word| name.contains(word))
        };
        if time.format.is_absolute() {
            let (whole, fraction) = self.time_origin?;
            let utc = whole as f64 + fraction;
            let texts = table.texts(&time.column).ok()?;
            let is_told = says(&["utc", "gmt"]) || texts.first().is_some_and(|text| has_zone(text));
            return (is_told && is_since_1970(utc)).then_some(utc - time.offset_s);
        }
        let first = *table.times(time, None).ok()?.first()?;
        // Receivers count their own seconds since 1980.
        (is_since_1970(first - time.offset_s) && !says(&["gps"])).then_some(-time.offset_s)
    }
}
