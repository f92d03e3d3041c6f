//! A perceptual colour map and pictures of grey rasters.

use egui::{Color32, ColorImage};
use pilotage_core::raster::Gray;
use pilotage_core::viridis::VIRIDIS;

/// Colour of `fraction` in [0, 1]; equal steps look equally large.
pub(crate) fn viridis(fraction: f32) -> Color32 {
    let place = fraction.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f32;
    let below = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - below as f32;
    let mix = |channel: usize| {
        let (a, b) = (VIRIDIS[below][channel], VIRIDIS[below + 1][channel]);
        (f32::from(a) + part * (f32::from(b) - f32::from(a))).round() as u8
    };
    Color32::from_rgb(mix(0), mix(1), mix(2))
}

/// Least and greatest finite value, if there is any.
pub(crate) fn range(raster: &Gray) -> Option<(f32, f32)> {
    let finite = raster.pixels().iter().copied().filter(|v| v.is_finite());
    finite.fold(None, |range, v| {
        let (low, high) = range.unwrap_or((v, v));
        Some((low.min(v), high.max(v)))
    })
}

/// A picture of `raster` between `low` and `high`; what is not a number stays transparent.
pub(crate) fn picture(
    raster: &Gray,
    (low, high): (f32, f32),
    color: impl Fn(f32) -> Color32,
) -> ColorImage {
    let span = (high - low).max(1e-6);
    let pixels = raster
        .pixels()
        .iter()
        .map(|v| {
            if v.is_finite() {
                color((v - low) / span)
            } else {
                Color32::TRANSPARENT
            }
        })
        .collect();
    ColorImage::new([raster.width(), raster.height()], pixels)
}

/// Grey of `fraction` in [0, 1].
pub(crate) fn gray(fraction: f32) -> Color32 {
    Color32::from_gray((fraction.clamp(0.0, 1.0) * 255.0) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brightness_grows_along_the_colour_map() {
        let luminance = |c: Color32| {
            0.2126 * f32::from(c.r()) + 0.7152 * f32::from(c.g()) + 0.0722 * f32::from(c.b())
        };
        let values: Vec<f32> = (0..=64)
            .map(|i| luminance(viridis(i as f32 / 64.0)))
            .collect();
        let steps: Vec<f32> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(
            steps.iter().all(|step| *step > 0.0 && *step < 5.0),
            "{steps:?}"
        );
    }

    #[test]
    fn the_range_ignores_what_is_not_a_number() {
        let raster = Gray::from_pixels(3, 1, vec![f32::NAN, -2.0, 5.0]).unwrap();
        assert_eq!(range(&raster), Some((-2.0, 5.0)));
    }
}
