//! Units of coordinates.

/// International foot, metres.
pub(super) const FOOT: f64 = 0.3048;
/// Foot of the surveys of the United States, metres.
pub(super) const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

/// EPSG codes of units of length, and metres in each.
const LENGTHS: [(u32, f64); 14] = [
    (9001, 1.0),
    (9002, FOOT),
    (9003, SURVEY_FOOT),
    (9005, 0.304_797_265_4),
    (9036, 1000.0),
    (9031, 1.000_013_596_5),
    (9037, 0.914_391_795_1),
    (9040, 0.914_398_414_616_028_7),
    (9041, 0.304_799_471_538_676_2),
    (9042, 20.116_756),
    (9051, 0.304_799_735),
    (9095, 0.304_800_749_1),
    (9096, 0.9144),
    (9094, 0.304_799_710_181_508_8),
];

/// EPSG codes of units of angles, and radians in each.
const ANGLES: [(u32, f64); 7] = [
    (9101, 1.0),
    (9102, std::f64::consts::PI / 180.0),
    (9122, std::f64::consts::PI / 180.0),
    (9103, std::f64::consts::PI / 10_800.0),
    (9104, std::f64::consts::PI / 648_000.0),
    (9105, std::f64::consts::PI / 200.0),
    (9106, std::f64::consts::PI / 200.0),
];

/// Metres in the unit with that EPSG code.
pub(crate) fn length(code: u64) -> Option<f64> {
    of(&LENGTHS, code)
}

/// Radians in the unit with that EPSG code.
pub(super) fn angle(code: u64) -> Option<f64> {
    of(&ANGLES, code)
}

fn of(units: &[(u32, f64)], code: u64) -> Option<f64> {
    let known = units.iter().find(|(known, _)| u64::from(*known) == code);
    known.map(|(_, size)| *size)
}
