//! Units of columns that are parts of a time or an angle.

/// Units of the parts of a time that calendars and clocks have, beside its seconds.
pub(super) const CALENDAR_UNITS: [&str; 6] = ["hours", "minutes", "years", "months", "days", "ms"];

/// Units of the parts of latitudes and longitudes beside their degrees.
pub(super) const ANGLE_UNITS: [&str; 4] = [
    "minutes of latitude",
    "seconds of latitude",
    "minutes of longitude",
    "seconds of longitude",
];
