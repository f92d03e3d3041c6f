//! The same ground as another camera, another day or another heading shows it.

use pilotage_raster::raster::{Raster, Rgba, gaussian_blur_colour};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

use super::example::{RoadExample, RoadTruth};

/// A square of `side` pixels around (x, y) of an example, turned by `angle` (radians) and `scale` times as large;
/// unknown beyond its border.
pub fn turned(
    example: &RoadExample,
    [x, y]: [f64; 2],
    angle: f64,
    scale: f64,
    side: usize,
) -> RoadExample {
    let (sin, cos) = angle.sin_cos();
    let half = 0.5 * side as f64;
    let place = |column: usize, row: usize| {
        let dx = (column as f64 + 0.5 - half) / scale;
        let dy = (row as f64 + 0.5 - half) / scale;
        [x + cos * dx - sin * dy, y + sin * dx + cos * dy]
    };
    let (width, height) = (example.truth.width() as f64, example.truth.height() as f64);
    let inside = move |[x, y]: [f64; 2]| x >= 0.0 && y >= 0.0 && x < width && y < height;
    RoadExample {
        picture: Raster::from_fn(side, side, |c, r| {
            let at = place(c, r);
            if inside(at) {
                sampled(&example.picture, at)
            } else {
                [0; 4]
            }
        }),
        truth: Raster::from_fn(side, side, |c, r| {
            let at = place(c, r);
            if inside(at) {
                example.truth.get(at[0] as usize, at[1] as usize)
            } else {
                RoadTruth::Unknown
            }
        }),
    }
}

fn sampled(picture: &Raster<Rgba>, [x, y]: [f64; 2]) -> Rgba {
    let limit = |value: f64, size: usize| (value - 0.5).clamp(0.0, (size - 1) as f64);
    let (cx, cy) = (limit(x, picture.width()), limit(y, picture.height()));
    let (left, top) = (cx as usize, cy as usize);
    let right = (left + 1).min(picture.width() - 1);
    let bottom = (top + 1).min(picture.height() - 1);
    let (fx, fy) = (cx - left as f64, cy - top as f64);
    let corners = [(left, top), (right, top), (left, bottom), (right, bottom)];
    let corners = corners.map(|(c, r)| picture.get(c, r).map(f64::from));
    std::array::from_fn(|i| {
        let upper = corners[0][i] + fx * (corners[1][i] - corners[0][i]);
        let lower = corners[2][i] + fx * (corners[3][i] - corners[2][i]);
        (upper + fy * (lower - upper)).round() as u8
    })
}

/// The example in other colours, softer or noisier, or grey.
pub fn changed(example: &RoadExample, random: &mut impl Rng) -> RoadExample {
    let mut between = |low: f32, high: f32| low + (high - low) * random.random::<f32>();
    let saturation = if between(0.0, 1.0) < 0.45 {
        0.0
    } else {
        between(0.3, 1.6)
    };
    let gains = [(); 3].map(|()| between(-0.28, 0.28).exp());
    let share = between(0.0, 1.0).powi(3);
    let exponent = between(-0.5, 0.5).exp();
    let (contrast, level) = (between(0.6, 1.3), between(-25.0, 25.0));
    let blur = if between(0.0, 1.0) < 0.5 {
        between(0.4, 1.6)
    } else {
        0.0
    };
    let noise = between(0.0, 1.0).powi(2) * 14.0;
    let mut picture = example.picture.clone();
    if blur > 0.0 {
        let colours = gaussian_blur_colour(&picture.map(|[r, g, b, _]| [r, g, b]), f64::from(blur));
        let pairs = picture.pixels_mut().iter_mut().zip(colours.pixels());
        for (pixel, [r, g, b]) in pairs {
            *pixel = [*r, *g, *b, pixel[3]];
        }
    }
    for pixel in picture.pixels_mut() {
        let [r, g, b, coverage] = pixel.map(f32::from);
        if coverage == 0.0 {
            continue;
        }
        // Colours run into each other as other films and filters have them.
        let [r, g, b] = [
            r + share * (g - r),
            g + share * (b - g),
            b + share * (r - b),
        ];
        let luminance = 0.299 * r + 0.587 * g + 0.114 * b;
        let grain: f32 = StandardNormal.sample(random);
        let values = [r, g, b].map(|value| luminance + saturation * (value - luminance));
        let out: [u8; 3] = std::array::from_fn(|i| {
            let gain = if saturation > 0.0 { gains[i] } else { 1.0 };
            let share = (values[i] * gain / 255.0).clamp(0.0, 1.0).powf(exponent);
            (128.0 + contrast * (255.0 * share - 128.0) + level + noise * grain) as u8
        });
        *pixel = [out[0], out[1], out[2], 255];
    }
    RoadExample {
        picture,
        truth: example.truth.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_brings_the_right_to_the_top() {
        let mut example = RoadExample {
            picture: Raster::filled(8, 8, [10, 20, 30, 255]),
            truth: Raster::filled(8, 8, RoadTruth::Open),
        };
        example.picture.set(6, 3, [200, 200, 200, 255]);
        example.truth.set(6, 3, RoadTruth::Road);
        let angle = std::f64::consts::FRAC_PI_2;
        let out = turned(&example, [4.0, 4.0], angle, 1.0, 8);
        let at = out
            .truth
            .pixels()
            .iter()
            .position(|t| *t == RoadTruth::Road);
        assert_eq!(at.map(|i| (i % 8, i / 8)), Some((3, 1)));
        assert_eq!(out.picture.get(3, 1), [200, 200, 200, 255]);
        let far = turned(&example, [8.0, 8.0], 0.0, 1.0, 8);
        assert_eq!(far.truth.get(7, 7), RoadTruth::Unknown);
        assert_eq!(far.picture.get(7, 7), [0; 4]);
    }
}
