//! Units of columns that are parts of a time or an angle.

/// Units of the parts of a time beside its seconds, with the words that their columns end in and the least and greatest
/// number of each.
pub(super) const CALENDAR: [(&str, &[&str], [f64; 2]); 7] = [
    (
        "hours",
        &["hour", "hours", "hh", "hr", "h", "std"],
        [0.0, 24.0],
    ),
    (
        "minutes",
        &["minute", "minutes", "min", "mins", "mm", "mi"],
        [0.0, 59.0],
    ),
    (
        "years",
        &["year", "yyyy", "yy", "yr", "jahr"],
        [0.0, 2100.0],
    ),
    (
        "months",
        &["month", "mon", "mo", "mm", "monat"],
        [1.0, 12.0],
    ),
    ("days", &["day", "dd", "dy", "tag"], [1.0, 31.0]),
    (
        "ms",
        &["millisecond", "milliseconds", "millis", "msec", "ms"],
        MILLISECONDS,
    ),
    // Receivers of u-blox round seconds, and correct them by what may be negative.
    (
        "ns",
        &["nano", "nanos", "nanosecond", "nanoseconds"],
        [-1e9, 1e9],
    ),
];
/// Reach of milliseconds and of seconds, which alone may have a fraction.
pub(super) const MILLISECONDS: [f64; 2] = [0.0, 999.999];
pub(super) const SECONDS_REACH: [f64; 2] = [0.0, 60.999];

/// Units of the parts of latitudes and longitudes beside their degrees.
pub(super) const ANGLE_UNITS: [&str; 4] = [
    "minutes of latitude",
    "seconds of latitude",
    "minutes of longitude",
    "seconds of longitude",
];
