//! Ways in which units are written.

use super::units::Dimension;

/// Ways of writing the units that are known, besides their own names.
pub(crate) const SPELLINGS: [(&str, &[&str]); 36] = [
    ("m", &["meter", "meters", "metre", "metres", "mtr"]),
    (
        "ft",
        &["feet", "foot", "ft msl", "ftmsl", "ft baro", "ft wgs"],
    ),
    (
        "km",
        &["kilometer", "kilometers", "kilometre", "kilometres"],
    ),
    (
        "cm",
        &["centimeter", "centimeters", "centimetre", "centimetres"],
    ),
    (
        "mm",
        &["millimeter", "millimeters", "millimetre", "millimetres"],
    ),
    (
        "m/s",
        &[
            "mps",
            "ms",
            "m s",
            "m/sec",
            "m s 1",
            "ms 1",
            "meters/second",
            "metres/second",
        ],
    ),
    ("kt", &["kts", "knot", "knots", "kn"]),
    ("km/h", &["kmh", "kph", "kmph", "km h", "km/hr"]),
    ("ft/s", &["fps", "ft s", "ft/sec", "feet/second"]),
    ("ft/min", &["fpm", "ft min", "feet/min", "feet/minute"]),
    ("mph", &["mi/h", "miles/hour"]),
    ("cm/s", &["cm s", "cmps", "cms", "cm/sec"]),
    ("dm/s", &["dm s", "dmps", "dm/sec"]),
    ("mm/s", &["mm s", "mmps", "mm/sec"]),
    (
        "dm",
        &["decimeter", "decimeters", "decimetre", "decimetres"],
    ),
    ("rad", &["radian", "radians"]),
    (
        "deg",
        &[
            "degree",
            "degrees",
            "°",
            "d",
            "degheading",
            "deglatitude",
            "deglongitude",
        ],
    ),
    (
        "ddeg",
        &[
            "decideg",
            "decidegrees",
            "deg*10",
            "deg10",
            "0.1deg",
            "1e 1deg",
        ],
    ),
    (
        "cdeg",
        &[
            "centideg",
            "centidegrees",
            "deg*100",
            "deg100",
            "0.01deg",
            "1e 2deg",
        ],
    ),
    ("mrad", &["millirad", "milliradians"]),
    ("deg1e5", &["dege5", "1e5deg", "deg*1e5", "1e 5deg", "e5"]),
    ("deg1e6", &["dege6", "1e6deg", "deg*1e6", "1e 6deg", "e6"]),
    (
        "deg1e7",
        &["dege7", "1e7deg", "1e7", "deg*1e7", "1e 7deg", "e7"],
    ),
    (
        "deg1e8",
        &["dege8", "1e8deg", "1e8", "deg 1e8", "deg*1e8", "1e 8deg"],
    ),
    (
        "rad/s",
        &["rad s", "radps", "rps", "rad/sec", "radians/second"],
    ),
    (
        "deg/s",
        &["deg s", "dps", "°/s", "degps", "deg/sec", "degrees/second"],
    ),
    (
        "m/s2",
        &[
            "m/s/s", "m/s^2", "m/s²", "m s2", "mps2", "mss", "m/s**2", "m s 2",
        ],
    ),
    ("mrad/s", &["mrad s", "mradps"]),
    ("ddeg/s", &["ddeg s", "decideg/s", "0.1deg/s"]),
    ("cdeg/s", &["cdeg s", "centideg/s", "0.01deg/s"]),
    (
        "cm/s2",
        &["cm/s/s", "cm/s^2", "cm/s²", "cmss", "cm s 2", "cm s2"],
    ),
    (
        "mm/s2",
        &["mm/s/s", "mm/s^2", "mm/s²", "mmss", "mm s 2", "mm s2"],
    ),
    ("g", &["gee", "gs", "g0"]),
    ("mg", &["milli g", "millig"]),
    ("s", &["sec", "secs", "second", "seconds"]),
    (
        "ms",
        &["msec", "millis", "millisecond", "milliseconds", "msecs"],
    ),
];

/// Times are units of nothing that a flight measures.
pub(crate) const TIMES: [(&str, &[&str]); 4] = [
    ("s", &["sec", "secs", "second", "seconds"]),
    (
        "ms",
        &["msec", "millis", "millisecond", "milliseconds", "msecs"],
    ),
    (
        "us",
        &[
            "µs",
            "μs",
            "usec",
            "micros",
            "microsecond",
            "microseconds",
            "usecs",
        ],
    ),
    (
        "ns",
        &["nsec", "nanos", "nanosecond", "nanoseconds", "nsecs"],
    ),
];

/// Whether a text is a unit of anything, in any spelling.
pub(crate) fn is_unit(text: &str) -> bool {
    let text = text.trim().to_lowercase();
    find_in(&SPELLINGS, &text)
        .or_else(|| find_in(&TIMES, &text))
        .is_some()
}

/// Minutes and hours in which whole times are counted: only in brackets, as `lat_min` is something else.
pub(crate) const LONG_TIMES: [(&str, &[&str]); 2] = [
    ("min", &["mins", "minute", "minutes"]),
    ("h", &["hr", "hrs", "hour", "hours"]),
];

/// The unit among `spellings` that `text`, in small letters, writes.
pub(crate) fn find_in(spellings: &[(&'static str, &[&str])], text: &str) -> Option<&'static str> {
    let is_it = |(name, others): &&(&'static str, &[&str])| *name == text || others.contains(&text);
    spellings.iter().find(is_it).map(|(name, _)| *name)
}

/// The unit of that dimension which `text` says, in any spelling.
pub(crate) fn unit_in(text: &str, dimension: Dimension) -> Option<&'static str> {
    let text = text.trim().to_lowercase();
    let of_dimension = |name: &str| dimension.factor(Some(name)).is_ok();
    // The same letters may be units of several dimensions.
    let known = SPELLINGS.iter().filter(|(name, _)| of_dimension(name));
    let is_it = |(name, others): &&(&'static str, &[&str])| {
        *name == text || others.contains(&text.as_str())
    };
    let mut found = known.filter(is_it).map(|(name, _)| *name);
    found.next().filter(|_| !text.is_empty())
}
