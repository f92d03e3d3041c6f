//! Picture that templates are looked for in.

use std::sync::OnceLock;

use super::cost;
use super::flatness::flat_level;
use super::fourier::{Spectrum, good_length};
use super::normalize::{WindowSums, normalize};
use super::surface::CorrelationSurface;
use super::template::{Kernel, Template};
use crate::raster::pool::Buffer;
use crate::raster::simd::{self, Instructions, PaddedRows};
use crate::raster::{Gray, IntegralImage};

/// A picture prepared for several templates: its transform and window sums are computed once.
///
/// Nothing is transformed before a template needs it, so preparing a picture for one small template
/// costs only the window sums.
#[derive(Debug)]
pub struct SearchSpectrum {
    width: usize,
    height: usize,
    /// Pixels minus the mean of the picture, which keeps single precision precise.
    centred: Buffer<f32>,
    /// Samples of the flattened transform.
    length: usize,
    /// Energy per pixel below which a window counts as flat.
    flat: f64,
    sums: IntegralImage,
    squares: IntegralImage,
    own: Prepared,
    squared: OnceLock<(Vec<f32>, Prepared)>,
}

/// Forms of a picture that the engines want, made when they do.
#[derive(Debug, Default)]
struct Prepared {
    padded: OnceLock<PaddedRows>,
    spectrum: OnceLock<Spectrum>,
}

/// An engine of the numerator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumeratorEngine {
    Direct(Instructions),
    Fourier,
}

impl SearchSpectrum {
    /// Prepares a picture.
    pub fn new(search: &Gray) -> Self {
        Self::with_flat_level(search, flat_level(search.pixels()))
    }

    pub(super) fn with_flat_level(search: &Gray, flat: f64) -> Self {
        let (width, height) = (search.width(), search.height());
        let pixels = search.pixels();
        let mean = row_sums(pixels) / (pixels.len().max(1)) as f64;
        let mean = if mean.is_finite() { mean as f32 } else { 0.0 };
        let mut centred = Buffer::<f32>::dirty(pixels.len());
        simd::subtract(pixels, mean, &mut centred);
        Self {
            width,
            height,
            length: good_length(width * height),
            flat,
            sums: IntegralImage::of(&centred, width, false),
            squares: IntegralImage::of(&centred, width, true),
            centred,
            own: Prepared::default(),
            squared: OnceLock::new(),
        }
    }

    /// Pixels in a row of the picture.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows of the picture.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The correlation surface of `template` over the whole picture, as [`Template::correlate`].
    pub fn correlate(&self, template: &Template) -> Gray {
        self.correlate_by(template, None)
    }

    pub(super) fn correlate_by(
        &self,
        template: &Template,
        engine: Option<NumeratorEngine>,
    ) -> Gray {
        if template.width > self.width || template.height > self.height {
            return Gray::filled(0, 0, 0.0);
        }
        let numerator = self.raw(&template.zero_mean, &self.centred, &self.own, engine);
        let area = template.count;
        let limit = self.flat * area;
        let size = (
            self.width - template.width + 1,
            self.height - template.height + 1,
        );
        let Some(mask) = &template.mask else {
            let windows = WindowSums {
                sums: &self.sums,
                squares: &self.squares,
                size: (template.width, template.height),
            };
            return normalize(&numerator, &windows, size, template.norm, limit);
        };
        // Under a mask the window sums are correlations with the mask.
        let (squared, prepared) = self.squared.get_or_init(|| {
            let pixels = self.centred.iter().map(|v| v * v).collect();
            (pixels, Prepared::default())
        });
        let sums = self.raw(mask, &self.centred, &self.own, engine);
        let squares = self.raw(mask, squared, prepared, engine);
        // Single precision sums: what lies below their rounding is flat too.
        let rounding = 1e-6 * self.squares.sum(0, 0, self.width, self.height);
        let limit = limit.max(rounding * area / (self.width * self.height) as f64);
        Gray::from_fn(size.0, size.1, |x, y| {
            let (sum, square) = (f64::from(sums.at(x, y)), f64::from(squares.at(x, y)));
            let energy = square - sum * sum / area;
            if energy <= limit {
                return 0.0;
            }
            let value = f64::from(numerator.at(x, y)) / (template.norm * energy.sqrt());
            value.clamp(-1.0, 1.0) as f32
        })
    }

    /// The plain correlation of `pixels` with a kernel.
    fn raw(
        &self,
        kernel: &Kernel,
        pixels: &[f32],
        prepared: &Prepared,
        engine: Option<NumeratorEngine>,
    ) -> CorrelationSurface {
        let (columns, rows) = (
            self.width - kernel.width + 1,
            self.height - kernel.height + 1,
        );
        let engine = engine.unwrap_or_else(|| {
            let missing = [
                prepared.spectrum.get().is_none(),
                !kernel.has_spectrum(self.width, self.length),
            ];
            let transforms = 1.0 + missing.into_iter().filter(|&m| m).count() as f64;
            let direct = cost::direct(columns, rows, kernel.width, kernel.height);
            if direct <= cost::fourier(self.length, transforms) {
                NumeratorEngine::Direct(Instructions::Best)
            } else {
                NumeratorEngine::Fourier
            }
        });
        match engine {
            NumeratorEngine::Direct(instructions) => {
                let padded = prepared
                    .padded
                    .get_or_init(|| PaddedRows::new(pixels, self.width));
                let (stride, values) =
                    simd::correlate(padded, kernel.blocks(), columns, rows, instructions);
                CorrelationSurface { stride, values }
            }
            NumeratorEngine::Fourier => {
                let own = prepared
                    .spectrum
                    .get_or_init(|| Spectrum::of_picture(pixels, self.width, self.length));
                let values = own.correlate(&kernel.spectrum(self.width, self.length));
                CorrelationSurface {
                    stride: self.width,
                    values,
                }
            }
        }
    }
}

/// Sum of all pixels, in pieces short enough for single precision.
fn row_sums(pixels: &[f32]) -> f64 {
    pixels
        .chunks(64)
        .map(|chunk| {
            let mut lanes = [0.0f32; 8];
            for part in chunk.chunks(8) {
                for (lane, &v) in lanes.iter_mut().zip(part) {
                    *lane += v;
                }
            }
            f64::from(lanes.iter().sum::<f32>())
        })
        .sum()
}
