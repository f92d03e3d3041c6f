//! Hue, saturation and value.

use pilotage_raster::raster::Rgb;

/// Hue (share of the circle from red by yellow), saturation and value, each from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HueSaturationValue {
    /// Share of the circle, from red by yellow and green.
    pub hue: f32,
    /// Saturation; 0 for grey.
    pub saturation: f32,
    /// Greatest of red, green and blue.
    pub value: f32,
}

/// The colour as hue, saturation and value; grey has hue 0.
///
/// ```
/// use pilotage_vision::road::yellow::hue_saturation_value;
///
/// // International Traffic Yellow, AMS-STD-595 colour 33538, is sRGB (255, 170, 6).
/// let paint = hue_saturation_value([255, 170, 6]);
/// assert!((paint.hue - 0.1098).abs() < 1e-4);
/// assert!((paint.saturation - 0.9765).abs() < 1e-4);
/// assert_eq!(paint.value, 1.0);
/// ```
pub fn hue_saturation_value(colour: Rgb) -> HueSaturationValue {
    let [red, green, blue] = colour.map(|value| f32::from(value) / 255.0);
    let value = red.max(green).max(blue);
    let range = value - red.min(green).min(blue);
    if range <= 0.0 {
        return HueSaturationValue {
            hue: 0.0,
            saturation: 0.0,
            value,
        };
    }
    let sixths = if value == red {
        (green - blue) / range
    } else if value == green {
        2.0 + (blue - red) / range
    } else {
        4.0 + (red - green) / range
    };
    HueSaturationValue {
        hue: (sixths / 6.0).rem_euclid(1.0),
        saturation: range / value,
        value,
    }
}
