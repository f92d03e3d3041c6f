//! Sun, sky, air and the encoding into pixels.

use super::day::Day;
use super::shape::{Spot, spot};
use pilotage_raster::raster::Rgba;

/// A linear colour.
pub(super) type Color = [f32; 3];

/// Mixes `a` towards `b`.
#[inline]
pub(super) fn mix(a: Color, b: Color, t: f32) -> Color {
    [
        a[0] + (b[0] - a[0]) * t,
        a[1] + (b[1] - a[1]) * t,
        a[2] + (b[2] - a[2]) * t,
    ]
}

/// A colour times a number.
#[inline]
pub(super) fn scale(a: Color, k: f32) -> Color {
    [a[0] * k, a[1] * k, a[2] * k]
}

/// The light of one day.
#[derive(Clone, Debug)]
pub(super) struct DayLight {
    /// Horizontal unit vector towards the sun.
    pub(super) toward: Spot,
    /// Metres of shadow per metre of height.
    pub(super) shadow_per_height: f32,
    pub(super) sin_elevation: f32,
    pub(super) cos_elevation: f32,
    sun: Color,
    sky: Color,
    haze: f32,
    haze_color: Color,
    gain: Color,
    encode: Vec<u8>,
}

const STEPS: usize = 4096;

impl DayLight {
    pub(super) fn new(day: &Day) -> Self {
        let elevation = day.sun_elevation.clamp(0.12, 1.5) as f32;
        let azimuth = day.sun_azimuth as f32;
        let low = (1.0 - elevation / 0.9).clamp(0.0, 1.0);
        let sun = [1.0, 0.95 - 0.06 * low, 0.88 - 0.16 * low];
        let sky = [0.125, 0.155, 0.205];
        // A level white surface keeps its brightness whatever the sun's height.
        let level = sun[1] * elevation.sin() + sky[1];
        let exposure = day.exposure as f32 * 2.45 / level;
        let encode = (0..=STEPS)
            .map(|i| {
                let root = i as f32 / STEPS as f32;
                // The square root is the table's argument; a soft shoulder keeps roofs from burning out.
                let linear = root * root * 4.0;
                let rolled = if linear < 0.6 {
                    linear
                } else {
                    0.6 + 0.4 * (1.0 - (-(linear - 0.6) / 0.4).exp())
                };
                let coded = if rolled < 0.003_130_8 {
                    12.92 * rolled
                } else {
                    1.055 * rolled.powf(1.0 / 2.4) - 0.055
                };
                (coded * 255.0 + 0.5).clamp(0.0, 255.0) as u8
            })
            .collect();
        Self {
            toward: spot(azimuth.cos(), azimuth.sin()),
            shadow_per_height: 1.0 / elevation.tan(),
            sin_elevation: elevation.sin(),
            cos_elevation: elevation.cos(),
            sun,
            sky,
            haze: day.haze as f32,
            haze_color: [0.105, 0.115, 0.13],
            gain: [
                exposure * day.tint[0] as f32,
                exposure * day.tint[1] as f32,
                exposure * day.tint[2] as f32,
            ],
            encode,
        }
    }

    /// Cosine between the sun and a surface of slopes (rise per metre north, east).
    #[inline]
    pub(super) fn cosine(&self, slope: Spot) -> f32 {
        let up = self.sin_elevation - self.cos_elevation * slope.dot(self.toward);
        (up / (1.0 + slope.dot(slope)).sqrt()).max(0.0)
    }

    /// Light reflected by a surface: `direct` is the cosine times the share of sun that reaches
    /// it, `open` the share of sky it sees.
    #[inline]
    pub(super) fn reflect(&self, albedo: Color, direct: f32, open: f32) -> Color {
        [
            albedo[0] * (self.sun[0] * direct + self.sky[0] * open),
            albedo[1] * (self.sun[1] * direct + self.sky[1] * open),
            albedo[2] * (self.sun[2] * direct + self.sky[2] * open),
        ]
    }

    /// Light as a pixel, through the air and the exposure.
    #[inline]
    pub(super) fn pixel(&self, light: Color) -> Rgba {
        let veiled = mix(light, self.haze_color, self.haze);
        let code = |i: usize| {
            let linear = (veiled[i] * self.gain[i] * 0.25).clamp(0.0, 1.0);
            self.encode[(linear.sqrt() * STEPS as f32 + 0.5) as usize]
        };
        [code(0), code(1), code(2), 255]
    }
}
