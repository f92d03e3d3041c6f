//! Colours from the samples of a TIFF file.

use super::super::tiff::{
    Chunk, Photometric, SampleKind, TiffError, TiffFile, TiffLayout, TileSamples,
};
use super::mask::for_hidden;
use pilotage_raster::raster::{Raster, Rgba};

/// Tiles from which the brightest value of 16-bit pictures is taken.
const TILES_TO_LOOK_AT: usize = 24;

/// Mapping from samples to colours.
#[derive(Clone, Debug)]
pub struct Colours {
    /// Samples for red, green and blue.
    bands: [usize; 3],
    /// The sample that is transparency, and whether colours are multiplied by it.
    alpha: Option<(usize, bool)>,
    /// Sample that is shown as full brightness.
    white: u32,
    /// Sample of transparency that is full coverage.
    opaque: u32,
    inverted: bool,
    palette: Vec<u16>,
    no_data: Option<f64>,
}

impl Colours {
    /// Mapping to show the picture of `file`; an error if it is none.
    pub fn of(file: &TiffFile) -> Result<Self, TiffError> {
        let layout = &file.levels()[0];
        let kind = layout.kind;
        if !matches!(kind, SampleKind::Bits(_) | SampleKind::U8 | SampleKind::U16) {
            return Err(file.directory.blame("samples").unsupported(format!(
                "{:?} samples are heights or measurements, not a picture; it may serve as terrain",
                layout.kind
            )));
        }
        let colours = layout.samples - usize::from(layout.alpha.is_some());
        let is_palette = layout.photometric == Photometric::Palette;
        let mut found = Self {
            bands: if colours >= 3 && !is_palette {
                [0, 1, 2]
            } else {
                [0; 3]
            },
            alpha: layout.alpha,
            white: match kind {
                SampleKind::Bits(bits) => (1 << bits) - 1,
                _ => 255,
            },
            opaque: match kind {
                SampleKind::Bits(bits) => (1 << bits) - 1,
                SampleKind::U16 => 65_535,
                _ => 255,
            },
            inverted: layout.photometric == Photometric::WhiteIsZero,
            palette: if is_palette {
                layout.palette.clone()
            } else {
                Vec::new()
            },
            no_data: layout.no_data,
        };
        if layout.kind == SampleKind::U16 && !is_palette {
            found.white = found.depth(file);
        }
        Ok(found)
    }

    /// Full brightness of a 16-bit picture: many sensors fill only 10 to 14 of the bits. The largest
    /// number of so many bits as the brightest pixel of the coarsest overview needs, of those that are shown.
    fn depth(&self, file: &TiffFile) -> u32 {
        let level = file.levels().len() - 1;
        let layout = &file.levels()[level];
        let count = layout.across() * layout.down();
        let step = count.div_ceil(TILES_TO_LOOK_AT);
        let mut brightest = 255;
        for index in (0..count).step_by(step) {
            let place = (level, index % layout.across(), index / layout.across());
            let tile = file.chunk(level, place.1, place.2);
            // A tile that cannot be read is told when it is shown.
            let Ok(Some(chunk)) = tile else { continue };
            let TileSamples::U16(samples) = &chunk.samples else {
                continue;
            };
            let mut hidden = vec![false; chunk.width * chunk.height];
            let size = (chunk.width, chunk.height);
            let masked = for_hidden(file, place, size, &mut |x, y| {
                hidden[y * chunk.width + x] = true;
            });
            if masked.is_err() {
                continue;
            }
            let pixels = samples.chunks_exact(chunk.samples_per_pixel);
            for (pixel, is_hidden) in pixels.zip(hidden) {
                let colour = self.bands.map(|band| u32::from(pixel[band]));
                let is_clear = self.alpha.is_some_and(|(band, _)| pixel[band] == 0);
                let is_empty = is_hidden || is_clear;
                if !is_empty && !colour.iter().all(|v| self.is_no_data(*v)) {
                    brightest = brightest.max(colour[0]).max(colour[1]).max(colour[2]);
                }
            }
        }
        (brightest + 1).next_power_of_two() - 1
    }

    /// Sample that is shown as full brightness.
    pub fn white(&self) -> u32 {
        self.white
    }

    fn is_no_data(&self, sample: u32) -> bool {
        self.no_data == Some(f64::from(sample))
    }

    /// The colours of a tile; missing tiles are transparent.
    pub fn paint(&self, layout: &TiffLayout, chunk: Option<&Chunk>) -> Raster<Rgba> {
        let empty = || Raster::filled(layout.chunk_width, layout.chunk_height, [0; 4]);
        let Some(chunk) = chunk else { return empty() };
        let n = chunk.samples_per_pixel;
        let pixels: Vec<Rgba> = match &chunk.samples {
            TileSamples::U8(samples) => (samples.chunks_exact(n))
                .map(|pixel| self.colour(|band| u32::from(pixel[band])))
                .collect(),
            TileSamples::U16(samples) => (samples.chunks_exact(n))
                .map(|pixel| self.colour(|band| u32::from(pixel[band])))
                .collect(),
            _ => return empty(),
        };
        Raster::from_pixels(chunk.width, chunk.height, pixels).unwrap_or_else(empty)
    }

    #[inline]
    fn colour(&self, sample: impl Fn(usize) -> u32) -> Rgba {
        let colour = self.bands.map(&sample);
        if self.no_data.is_some() && colour.iter().all(|v| self.is_no_data(*v)) {
            return [0; 4];
        }
        let coverage = match self.alpha {
            Some((band, _)) => to_byte(sample(band), self.opaque),
            None => 255,
        };
        if coverage == 0 {
            return [0; 4];
        }
        if !self.palette.is_empty() {
            let count = self.palette.len() / 3;
            let part = |i: usize| {
                let place = i * count + colour[0] as usize;
                (self.palette.get(place).copied().unwrap_or(0) >> 8) as u8
            };
            return [part(0), part(1), part(2), coverage];
        }
        let mut shown = colour.map(|v| to_byte(v, self.white));
        if self.alpha.is_some_and(|(_, is_multiplied)| is_multiplied) {
            shown = shown.map(|v| to_byte(u32::from(v), u32::from(coverage)));
        }
        if self.inverted {
            shown = shown.map(|v| 255 - v);
        }
        let [r, g, b] = shown;
        [r, g, b, coverage]
    }
}

/// `value` of `most` as a byte, rounded.
fn to_byte(value: u32, most: u32) -> u8 {
    if most == 255 {
        return value.min(255) as u8;
    }
    ((value * 255 + most / 2) / most.max(1)).min(255) as u8
}
