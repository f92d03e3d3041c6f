//! Units of heights in `GeoTIFF` files.

use crate::GeoKeys;

/// International foot, metres.
const FOOT: f64 = 0.3048;
/// Foot of the surveys of the United States, metres.
const SURVEY_FOOT: f64 = 1200.0 / 3937.0;
/// British foot of 1936, metres.
const BRITISH_FOOT: f64 = 0.304_800_749_1;

/// EPSG codes of units, and metres in each.
const UNITS: [(u32, f64); 9] = [
    (9001, 1.0),
    (9002, FOOT),
    (9003, SURVEY_FOOT),
    (1025, 1e-3),
    (1033, 1e-2),
    (9036, 1e3),
    (9005, 0.304_797_265_4),
    (9014, 1.8288),
    (9095, BRITISH_FOOT),
];

/// Names of units as GDAL writes them, in small letters, and metres in each.
const NAMES: [(&str, f64); 26] = [
    ("m", 1.0),
    ("metre", 1.0),
    ("metres", 1.0),
    ("meter", 1.0),
    ("meters", 1.0),
    ("dm", 0.1),
    ("decimetre", 0.1),
    ("decimeter", 0.1),
    ("cm", 1e-2),
    ("centimetre", 1e-2),
    ("centimeter", 1e-2),
    ("mm", 1e-3),
    ("millimetre", 1e-3),
    ("millimeter", 1e-3),
    ("km", 1e3),
    ("kilometre", 1e3),
    ("kilometer", 1e3),
    ("ft", FOOT),
    ("foot", FOOT),
    ("feet", FOOT),
    ("international foot", FOOT),
    ("us-ft", SURVEY_FOOT),
    ("ftus", SURVEY_FOOT),
    ("us survey foot", SURVEY_FOOT),
    ("us survey feet", SURVEY_FOOT),
    ("foot_us", SURVEY_FOOT),
];

/// Systems of heights that count in other units than metres, with which GDAL writes no unit: EPSG codes
/// and metres in the unit.
const NOT_IN_METRES: [(u32, f64); 9] = [
    (5702, SURVEY_FOOT),
    (6360, SURVEY_FOOT),
    (8052, SURVEY_FOOT),
    (6130, FOOT),
    (6131, FOOT),
    (6132, FOOT),
    (8050, FOOT),
    (8228, FOOT),
    (5754, BRITISH_FOOT),
];

/// EPSG codes of systems that count downward: depths.
const DEPTHS: [u32; 44] = [
    5336, 5612, 5614, 5706, 5715, 5734, 5739, 5789, 5831, 5861, 5862, 5863, 5864, 5865, 5866, 5867,
    5873, 6357, 6358, 6359, 7976, 8051, 8053, 8358, 9287, 9288, 9672, 10_150, 10_151, 10_349,
    10_364, 10_370, 10_371, 10_372, 10_373, 10_374, 10_547, 10_548, 10_549, 10_550, 10_551, 10_552,
    10_649, 10_678,
];

/// Metres in the unit of an elevation model: that which its band names, else that of its keys, else that
/// of its system of heights, else metres. The error says in words why it has no unit of height.
pub(super) fn metres_per_unit(keys: &GeoKeys, named: Option<&str>) -> Result<f64, String> {
    if let Some(code) = keys.vertical_system.filter(|code| DEPTHS.contains(code)) {
        return Err(format!(
            "EPSG:{code} counts depths downward; turn them into heights"
        ));
    }
    if let Some(name) = named {
        let small = name.to_lowercase();
        let known = NAMES.iter().find(|(known, _)| *known == small);
        return known.map(|(_, metres)| *metres).ok_or_else(|| {
            let name: String = name.chars().take(40).collect();
            format!("its values are in \"{name}\", which is no unit of height that is known; metres and feet are")
        });
    }
    let Some(code) = keys.vertical_unit else {
        let system = keys.vertical_system;
        let known = (NOT_IN_METRES.iter()).find(|(code, _)| Some(*code) == system);
        return Ok(known.map_or(1.0, |(_, metres)| *metres));
    };
    let known = UNITS.iter().find(|(known, _)| *known == code);
    known.map(|(_, metres)| *metres).ok_or_else(|| {
        format!("EPSG:{code} is no unit of height that is known; metres (EPSG:9001) and feet (EPSG:9002, 9003) are")
    })
}
