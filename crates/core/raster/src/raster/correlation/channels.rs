//! Correlation over several channels at once, of which parts may be unknown on both sides.
//!
//! ```text
//!                  Σ_c Σ T_c(i,j) I_c(x+i, y+j)
//! R(x,y) = -----------------------------------------------
//!           sqrt( Σ_c Σ m T_c²  Σ_c Σ w I_c² )
//! ```
//!
//! with the channels `T_c` of the template free of their means under the weight w, the channels `I_c` of the picture
//! free of theirs over what is known of it, and m = 1 where it is known: what is unknown counts neither for nor
//! against a place.

use super::fourier::{Spectrum, good_length};
use crate::raster::Gray;

/// Channels of a picture, prepared for several templates.
#[derive(Debug)]
pub struct ChannelSearch {
    width: usize,
    height: usize,
    length: usize,
    channels: Vec<Spectrum>,
    /// Of the sum of the squares over all channels.
    energy: Spectrum,
    /// Of what is known, `None` if everything is.
    covered: Option<Spectrum>,
}

/// Channels that are looked for.
#[derive(Clone, Debug)]
pub struct ChannelTemplate {
    width: usize,
    height: usize,
    /// Free of their means, zero where nothing is known.
    channels: Vec<Vec<f32>>,
    weight: Vec<f32>,
    /// Sum of squares over all channels, pixel by pixel.
    energy: Vec<f32>,
}

/// Correlation of a template at every place: value (c, r) belongs to the template with its top-left corner
/// there.
#[derive(Clone, Debug)]
pub struct ChannelSurface {
    /// Correlation, -1 to 1; zero where too little is known.
    pub score: Gray,
    /// Share of the template's energy that lies over known pixels.
    pub share: Option<Gray>,
}

impl ChannelSurface {
    /// Share of the template's energy that lies over known pixels at a sample of the surface.
    pub fn share_at(&self, index: usize) -> f32 {
        self.share
            .as_ref()
            .map_or(1.0, |share| share.pixels()[index])
    }
}

/// A picture's channels without their means over what is known.
fn centred(channels: &[Gray], known: &Gray) -> Vec<Vec<f32>> {
    let count: f64 = known.pixels().iter().map(|&w| f64::from(w)).sum();
    let of_channel = |channel: &Gray| {
        let weighted = channel.pixels().iter().zip(known.pixels());
        let sum: f64 = weighted.map(|(v, w)| f64::from(v * w)).sum();
        let mean = (sum / count.max(1.0)) as f32;
        let weighted = channel.pixels().iter().zip(known.pixels());
        weighted.map(|(v, w)| (v - mean) * w).collect()
    };
    channels.iter().map(of_channel).collect()
}

/// The sum of the squares over all channels, pixel by pixel.
fn energy(channels: &[Vec<f32>], pixels: usize) -> Vec<f32> {
    let mut sum = vec![0.0; pixels];
    for channel in channels {
        for (sum, v) in sum.iter_mut().zip(channel) {
            *sum += v * v;
        }
    }
    sum
}

impl ChannelSearch {
    /// Prepares the channels of a picture of which `known` says what counts (one, else zero).
    pub fn new(channels: &[Gray], known: &Gray) -> Self {
        let (width, height) = (known.width(), known.height());
        let length = good_length(width * height);
        let spectrum = |pixels: &[f32]| Spectrum::of_picture(pixels, width, length);
        let centred = centred(channels, known);
        let is_whole = known.pixels().iter().all(|&w| w == 1.0);
        Self {
            width,
            height,
            length,
            energy: spectrum(&energy(&centred, width * height)),
            channels: centred.iter().map(|c| spectrum(c)).collect(),
            covered: (!is_whole).then(|| spectrum(known.pixels())),
        }
    }

    /// The correlation over all places at which the template lies inside the picture; `None` if it does not
    /// fit in.
    pub fn correlate(&self, template: &ChannelTemplate) -> Option<ChannelSurface> {
        let ChannelTemplate { width, height, .. } = *template;
        if width > self.width || height > self.height || width * height == 0 {
            return None;
        }
        let kernel = |pixels: &[f32]| Spectrum::of_kernel(pixels, width, self.width, self.length);
        let kernels = template.channels.iter().map(|c| kernel(c));
        let products = Spectrum::correlate_sum(&self.channels, kernels)?;
        let energies = self.energy.correlate(&kernel(&template.weight));
        let whole: f32 = template.energy.iter().sum();
        let owned = self
            .covered
            .as_ref()
            .map(|covered| covered.correlate(&kernel(&template.energy)));
        let columns = self.width - width + 1;
        let rows = self.height - height + 1;
        let mut score = Gray::filled(columns, rows, 0.0);
        let mut share = owned.as_ref().map(|_| Gray::filled(columns, rows, 1.0));
        // Below this, rounding is all that is left.
        let least = 1e-4 * whole.max(1e-12);
        for row in 0..rows {
            for column in 0..columns {
                let at = row * self.width + column;
                let own = owned.as_ref().map_or(whole, |owned| owned[at]);
                if let Some(share) = &mut share {
                    share.set(column, row, (own / whole).clamp(0.0, 1.0));
                }
                if own > least && energies[at] > least {
                    let value = products[at] / (own * energies[at]).sqrt();
                    score.set(column, row, value.clamp(-1.0, 1.0));
                }
            }
        }
        Some(ChannelSurface { score, share })
    }
}

impl ChannelTemplate {
    /// Prepares the channels of what is looked for, weighted by `weight` (one where it is known, else zero);
    /// `None` if nothing stands out.
    pub fn new(channels: &[Gray], weight: &Gray) -> Option<Self> {
        let centred = centred(channels, weight);
        let energy = energy(&centred, weight.pixels().len());
        let whole: f32 = energy.iter().sum();
        (whole > 0.0 && whole.is_finite()).then(|| Self {
            width: weight.width(),
            height: weight.height(),
            channels: centred,
            weight: weight.pixels().to_vec(),
            energy,
        })
    }

    /// The same turned by half a turn. Undirected edges keep their directions in it, so that it looks like
    /// the same kind of ground without being it: what it scores is chance.
    #[must_use]
    pub fn turned_half(&self) -> Self {
        let turned = |pixels: &[f32]| pixels.iter().rev().copied().collect::<Vec<f32>>();
        Self {
            channels: self.channels.iter().map(|c| turned(c)).collect(),
            weight: turned(&self.weight),
            energy: turned(&self.energy),
            ..*self
        }
    }

    /// Pixels in a row of the template.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows of the template.
    pub fn height(&self) -> usize {
        self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(seed: u32) -> impl FnMut() -> f32 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        }
    }

    /// The quotient of the head of this file, sum by sum.
    fn plain(
        search: &[Gray],
        known: &Gray,
        wanted: &[Gray],
        weight: &Gray,
        at: (usize, usize),
    ) -> f64 {
        let (pictures, templates) = (centred(search, known), centred(wanted, weight));
        let (mut product, mut own, mut theirs) = (0.0, 0.0, 0.0);
        for (picture, template) in pictures.iter().zip(&templates) {
            for y in 0..weight.height() {
                for x in 0..weight.width() {
                    let t = f64::from(template[y * weight.width() + x]);
                    let index = (at.1 + y) * known.width() + at.0 + x;
                    let i = f64::from(picture[index]);
                    product += t * i;
                    own += t * t * f64::from(known.pixels()[index]);
                    theirs += i * i * f64::from(weight.get(x, y));
                }
            }
        }
        product / (own * theirs).sqrt()
    }

    #[test]
    fn the_surface_is_the_quotient_at_every_place() {
        let mut value = noise(7);
        let search: Vec<Gray> = (0..3)
            .map(|_| Gray::from_fn(31, 27, |_, _| value()))
            .collect();
        let wanted: Vec<Gray> = (0..3)
            .map(|_| Gray::from_fn(12, 9, |_, _| value()))
            .collect();
        let known = Gray::from_fn(31, 27, |x, y| f32::from(u8::from(x + y > 9)));
        let weight = Gray::from_fn(12, 9, |x, y| f32::from(u8::from(x > 1 || y > 3)));
        let template = ChannelTemplate::new(&wanted, &weight).expect("it has texture");
        let surface = ChannelSearch::new(&search, &known)
            .correlate(&template)
            .expect("it fits");
        assert_eq!((surface.score.width(), surface.score.height()), (20, 19));
        for (x, y) in [(0, 0), (19, 18), (5, 2), (11, 16)] {
            let expected = plain(&search, &known, &wanted, &weight, (x, y));
            let off = f64::from(surface.score.get(x, y)) - expected;
            assert!(off.abs() < 1e-4, "{x} {y}: {off}");
        }
    }

    #[test]
    fn a_piece_is_found_where_it_was_cut_even_over_the_edge_of_the_known() {
        let mut value = noise(3);
        let search: Vec<Gray> = (0..4)
            .map(|_| Gray::from_fn(40, 40, |_, _| value()))
            .collect();
        let wanted: Vec<Gray> = search
            .iter()
            .filter_map(|c| c.crop(11, 6, 15, 15))
            .collect();
        let known = Gray::from_fn(40, 40, |x, _| f32::from(u8::from(x >= 16)));
        let template = ChannelTemplate::new(&wanted, &Gray::filled(15, 15, 1.0)).expect("texture");
        let surface = ChannelSearch::new(&search, &known)
            .correlate(&template)
            .expect("it fits");
        let peak = crate::raster::highest_peak(&surface.score).expect("there is a summit");
        assert_eq!(peak.sample, (11, 6));
        let share = f64::from(surface.share.expect("a part is unknown").get(11, 6));
        assert!((share - 10.0 / 15.0).abs() < 0.05, "{share}");
    }
}
