//! Units of `MAVLink`'s definitions.

use super::super::ValueScale;

/// Scaled units, what they are parts of, and how many of them make one.
const PARTS: [(&str, &str, f64); 21] = [
    ("degE7", "deg", 1e7),
    ("degE5", "deg", 1e5),
    ("cdeg", "deg", 1e2),
    ("ddeg/s", "deg/s", 1e1),
    ("mrad/s", "rad/s", 1e3),
    ("cdegC", "degC", 1e2),
    ("mm", "m", 1e3),
    ("cm", "m", 1e2),
    ("dm", "m", 1e1),
    ("mm/s", "m/s", 1e3),
    ("cm/s", "m/s", 1e2),
    ("dm/s", "m/s", 1e1),
    ("m/s*5", "m/s", 5.0),
    ("mG", "G", 1e3),
    ("mgauss", "gauss", 1e3),
    ("mV", "V", 1e3),
    ("cV", "V", 1e2),
    ("mA", "A", 1e3),
    ("cA", "A", 1e2),
    ("c%", "%", 1e2),
    ("d%", "%", 1e1),
];

/// Units that are several of another.
const MULTIPLES: [(&str, &str, f64); 4] = [
    ("deg/2", "deg", 2.0),
    ("dam", "m", 10.0),
    ("hJ", "J", 100.0),
    ("hPa", "Pa", 100.0),
];

/// Unit of the values, and what makes a value of a number in `unit` of the definitions. Times stay as they
/// are: their fields are named after their unit.
pub(super) fn unit_and_scale(unit: &'static str) -> (&'static str, ValueScale) {
    if let Some((_, whole, parts)) = PARTS.iter().find(|(part, _, _)| *part == unit) {
        return (whole, ValueScale::Over(*parts));
    }
    if let Some((_, one, count)) = MULTIPLES.iter().find(|(several, _, _)| *several == unit) {
        return (one, ValueScale::Times(*count));
    }
    (unit, ValueScale::One)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_become_wholes_and_times_stay() {
        let value = |unit, number| {
            let (unit, scale) = unit_and_scale(unit);
            (unit, scale.apply(number))
        };
        assert_eq!(value("degE7", 468_412_345.0), ("deg", 46.841_234_5));
        assert_eq!(value("cm/s", 1234.0), ("m/s", 12.34));
        assert_eq!(value("deg/2", 90.0), ("deg", 180.0));
        assert_eq!(value("ms", 5.0), ("ms", 5.0));
        assert_eq!(value("", 5.0), ("", 5.0));
    }
}
