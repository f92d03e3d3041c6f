//! Features that are compared when a map patch is matched: intensity and edges.
//!
//! Edges are gradients in double-angle form, `|g| (cos 2θ, sin 2θ)`: they keep the orientation of an
//! edge and forget which side is brighter, which differs between seasons and times of day.

use pilotage_raster::raster::{Gray, Template};

/// Intensity and the two double-angle gradient components, all of one size.
#[derive(Clone, Debug)]
pub struct Features {
    /// Intensity, then the two edge components.
    pub channels: [Gray; 3],
}

impl Features {
    /// Features of a luminance picture (central differences, one-sided at the border).
    pub fn new(luminance: Gray) -> Self {
        let (width, height) = (luminance.width(), luminance.height());
        let mut cosine = Gray::filled(width, height, 0.0);
        let mut sine = Gray::filled(width, height, 0.0);
        for row in 0..height {
            let above = luminance.row(row.saturating_sub(1));
            let here = luminance.row(row);
            let below = luminance.row((row + 1).min(height - 1));
            let (cosines, sines) = (cosine.row_mut(row), sine.row_mut(row));
            for column in 0..width {
                let (left, right) = (column.saturating_sub(1), (column + 1).min(width - 1));
                let gx = 0.5 * (here[right] - here[left]);
                let gy = 0.5 * (below[column] - above[column]);
                let magnitude = (gx * gx + gy * gy).sqrt() + 1e-6;
                cosines[column] = (gx * gx - gy * gy) / magnitude;
                sines[column] = 2.0 * gx * gy / magnitude;
            }
        }
        Self {
            channels: [luminance, cosine, sine],
        }
    }
}

/// Share of the intensity in the combined score; edges have the rest.
const INTENSITY_SHARE: f32 = 0.5;

/// A patch ready to be correlated with search pictures.
pub struct FeatureTemplate {
    channels: [Option<Template>; 3],
    shares: [f32; 3],
}

impl FeatureTemplate {
    /// Prepares a patch, or `None` if its intensity has no contrast.
    ///
    /// `shares` of the edge components follow their energy in the patch.
    pub fn new(patch: &Features) -> Option<Self> {
        let energy = |p: &Gray| p.pixels().iter().map(|v| v * v).sum::<f32>();
        let (cosine, sine) = (energy(&patch.channels[1]), energy(&patch.channels[2]));
        let edges = (1.0 - INTENSITY_SHARE) / (cosine + sine).max(1e-6);
        let channels = [0, 1, 2].map(|i| Template::new(&patch.channels[i]));
        channels[0].as_ref()?;
        Some(Self {
            channels,
            shares: [INTENSITY_SHARE, edges * cosine, edges * sine],
        })
    }

    /// Combined score at every offset of the patch in `search`.
    pub fn correlate(&self, search: &Features) -> Gray {
        let mut total: Option<Gray> = None;
        for ((template, share), picture) in
            self.channels.iter().zip(self.shares).zip(&search.channels)
        {
            let Some(template) = template else { continue };
            let mut surface = template.correlate(picture);
            for pixel in surface.pixels_mut() {
                *pixel *= share;
            }
            total = Some(match total {
                None => surface,
                Some(mut sum) => {
                    for (a, b) in sum.pixels_mut().iter_mut().zip(surface.pixels()) {
                        *a += b;
                    }
                    sum
                }
            });
        }
        total.unwrap_or_else(|| Gray::filled(0, 0, 0.0))
    }
}
