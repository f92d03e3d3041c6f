//! Ways in which units are written.

use super::units::Dimension;

/// Ways of writing the units that are known, besides their own names.
pub(crate) const SPELLINGS: [(&str, &[&str]); 37] = [
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
    (
        "kt",
        &[
            "kts", "knot", "knots", "kn", "knoten", "nœuds", "noeuds", "nudos",
        ],
    ),
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
    ("semicircles", &["semicircle", "semi circles"]),
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
pub(crate) const TIMES: [(&str, &[&str]); 6] = [
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
    ("cs", &["csec", "centisecond", "centiseconds", "hundredths"]),
    (
        "100us",
        &["100µs", "100μs", "100 us", "100 µs", "0.1ms", "0.1 ms"],
    ),
];

/// The name of a unit per time whose parts are written in words or powers: `degrees/sec`, `m/sec^2`, `deg.s-1`.
pub(crate) fn per_time(text: &str) -> Option<&'static str> {
    let parted = text.split_once('/').map(|(base, time)| (base, time, false));
    let (base, time, is_power) = parted.or_else(|| {
        let at = text.find(['.', '·', ' '])?;
        let behind = at + text[at..].chars().next()?.len_utf8();
        Some((&text[..at], &text[behind..], true))
    })?;
    let base = find_in(&SPELLINGS, base.trim()).filter(|name| !name.contains('/'))?;
    let time = time.trim();
    let end = time
        .find(|c: char| !c.is_alphabetic())
        .unwrap_or(time.len());
    let (time, power) = time.split_at(end);
    let time = find_in(&TIMES, time).or_else(|| find_in(&LONG_TIMES, time))?;
    let square = match (power, is_power) {
        ("", false) | ("-1" | "^-1" | "⁻¹", true) => "",
        ("2" | "^2" | "²" | "**2", false) | ("-2" | "^-2" | "⁻²", true) => "2",
        _ => return None,
    };
    let name = format!("{base}/{time}{square}");
    find_in(&SPELLINGS, &name)
}

/// Whether a text is a unit of anything, in any spelling.
pub(crate) fn is_unit(text: &str) -> bool {
    let text = text.trim().to_lowercase();
    find_in(&SPELLINGS, &text)
        .or_else(|| find_in(&TIMES, &text))
        .or_else(|| per_time(&text))
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
    let found = found.next().filter(|_| !text.is_empty());
    found.or_else(|| per_time(&text).filter(|name| of_dimension(name)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_per_time_are_known_in_words_and_powers() {
        for text in [
            "degrees/s",
            "degrees/sec",
            "°/sec",
            "degree/second",
            "deg.s-1",
            "Degrees / Second",
            "deg s-1",
        ] {
            assert_eq!(
                unit_in(text, Dimension::AngularRate),
                Some("deg/s"),
                "{text}"
            );
        }
        for text in ["meters/s", "m.s-1", "metres/sec", "meters/Sec", "m·s⁻¹"] {
            assert_eq!(unit_in(text, Dimension::Speed), Some("m/s"), "{text}");
        }
        for text in ["meters/sec2", "m/sec2", "m/sec^2", "m.s-2", "m/second²"] {
            assert_eq!(
                unit_in(text, Dimension::Acceleration),
                Some("m/s2"),
                "{text}"
            );
        }
        assert_eq!(unit_in("kilometers/hour", Dimension::Speed), Some("km/h"));
        for text in ["deg", "m/m", "/s", "m/", "m.5", "degrees/s3", ""] {
            assert_eq!(unit_in(text, Dimension::AngularRate), None, "{text}");
        }
    }
}
