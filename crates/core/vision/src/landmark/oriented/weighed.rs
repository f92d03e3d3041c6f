//! Places of a landmark in a picture, weighed by likelihood and prior.

use nalgebra::{Matrix2, Vector2};

use super::variants::{PatchVariant, PatchVariants};
use crate::evidence::Evidence;
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{ChannelSurface, Gray, Peak, refine_peak};

/// Probability, before it is looked for, that the landmark does not look like its patch of the map any more, or
/// is hidden.
const GONE: f64 = 0.1;
/// Share of the patch that must be seen at a place.
const LEAST_SHARE: f32 = 0.6;
/// Score of an offset at which too little of the patch is seen.
const UNSEEN: f32 = -1.0;
/// Logarithm of a weight that is not exceeded.
const MOST: f64 = 600.0;

/// Prior of a landmark before it is looked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prior {
    /// Middle of the landmark under the assumed pose.
    pub center: GroundPoint,
    /// Inverse of the covariance of that (north, east), per m².
    pub information: Matrix2<f64>,
    /// Standard deviations of the turn (radians) and of the logarithm of the size.
    pub turn: f64,
    pub log_scale: f64,
}

/// A place, turn and size.
#[derive(Clone, Copy, Debug)]
pub(super) struct VariantPlace {
    pub variant: PatchVariant,
    /// Between the samples of the surface.
    pub peak: Peak,
    /// Share of the patch that is seen there.
    pub share: f64,
    /// Logarithm of likelihood times prior.
    pub log_weight: f64,
}

/// Weights of all places.
pub(super) struct WeighedPlaces<'a> {
    prior: &'a Prior,
    window: &'a Window,
    size: (usize, usize),
    evidence: Evidence,
    /// At each offset of the patch, all turns and sizes together.
    weights: Vec<f64>,
    /// The best score over all turns and sizes.
    pub best_scores: Gray,
    /// Sum of the prior over places that are seen, and over all.
    prior_seen: f64,
    prior_all: f64,
    pub best: Option<VariantPlace>,
}

impl Prior {
    fn log_of_variant(&self, variants: &PatchVariants, variant: PatchVariant) -> f64 {
        let square = |off: f64, deviation: f64| (off / deviation.max(0.5 * variants.step)).powi(2);
        -0.5 * (square(variants.turn(variant), self.turn)
            + square(variants.log_scale(variant), self.log_scale))
    }

    /// Natural logarithm of the density of a place, against that of the likeliest.
    pub fn log_of_place(&self, place: &GroundPoint) -> f64 {
        let off: Vector2<f64> = place.to_vector() - self.center.to_vector();
        -0.5 * (off.transpose() * self.information * off)[0]
    }
}

impl<'a> WeighedPlaces<'a> {
    /// Before anything was weighed; surfaces have `width` × `height` offsets of a patch of `size` pixels in
    /// `window`.
    pub fn new(
        prior: &'a Prior,
        window: &'a Window,
        size: (usize, usize),
        evidence: Evidence,
    ) -> Self {
        let (width, height) = (window.width + 1 - size.0, window.height + 1 - size.1);
        Self {
            prior,
            window,
            size,
            evidence,
            weights: vec![0.0; width * height],
            best_scores: Gray::filled(width, height, UNSEEN),
            prior_seen: 0.0,
            prior_all: 0.0,
            best: None,
        }
    }

    /// Ground at the middle of the patch at an offset, pixels.
    pub fn ground_at(&self, x: f64, y: f64) -> GroundPoint {
        let (w, h) = (self.size.0 as f64, self.size.1 as f64);
        self.window.ground_at(x + 0.5 * w, y + 0.5 * h)
    }

    /// Weighs all places of a turn and size.
    pub fn add(
        &mut self,
        variants: &PatchVariants,
        variant: PatchVariant,
        surface: &ChannelSurface,
    ) {
        let of_variant = self.prior.log_of_variant(variants, variant);
        let cell = self.window.gsd.powi(2);
        let root = self.prior.information.determinant().sqrt();
        self.prior_all += of_variant.exp() * std::f64::consts::TAU / root / cell;
        let width = surface.score.width();
        for (index, value) in surface.score.pixels().iter().enumerate() {
            let share = surface.share_at(index);
            if share < LEAST_SHARE {
                continue;
            }
            let (column, row) = (index % width, index / width);
            let place = self.ground_at(column as f64, row as f64);
            let log_prior = of_variant + self.prior.log_of_place(&place);
            let likelihood = self
                .evidence
                .log_likelihood(f64::from(*value), f64::from(share));
            let log_weight = (likelihood + log_prior).min(MOST);
            self.prior_seen += log_prior.exp();
            self.weights[index] += log_weight.exp();
            let best = self.best_scores.get(column, row);
            self.best_scores.set(column, row, best.max(*value));
            if self.best.is_none_or(|b| log_weight > b.log_weight) {
                self.best = Some(VariantPlace {
                    variant,
                    peak: refine_peak(&surface.score, column, row),
                    share: f64::from(share),
                    log_weight,
                });
            }
        }
    }

    /// The best score over all turns and sizes of a patch with its middle at `place`; `None` where that is not seen.
    pub fn score_at(&self, place: &GroundPoint) -> Option<f64> {
        let (x, y) = self.window.pixel_at(place);
        let column = (x - 0.5 * self.size.0 as f64).round();
        let row = (y - 0.5 * self.size.1 as f64).round();
        let within = |at: f64, count: usize| (0.0..count as f64).contains(&at);
        let inside =
            within(column, self.best_scores.width()) && within(row, self.best_scores.height());
        let score = inside.then(|| self.best_scores.get(column as usize, row as usize));
        score.filter(|score| *score > UNSEEN).map(f64::from)
    }

    /// Weight of places that are not seen, and of the landmark's being gone.
    fn without_it(&self) -> (f64, f64) {
        let unseen = (self.prior_all - self.prior_seen).max(0.0);
        (unseen, GONE / (1.0 - GONE) * self.prior_all)
    }

    /// Probabilities of the best place with all within `separation` pixels of it, of the likeliest place
    /// elsewhere with what is as near to that, and of its being where the picture does not show it.
    pub fn probabilities(&self, separation: usize) -> Option<[f64; 3]> {
        let best = self.best?;
        let (unseen, gone) = self.without_it();
        let width = self.best_scores.width();
        let beside = |index: usize, of: (usize, usize)| {
            (index % width)
                .abs_diff(of.0)
                .max((index / width).abs_diff(of.1))
                <= separation
        };
        let all: f64 = self.weights.iter().sum::<f64>() + unseen + gone;
        let around = |of: (usize, usize), without: Option<(usize, usize)>| {
            let weights = self.weights.iter().enumerate();
            let near = weights.filter(|(index, _)| {
                beside(*index, of) && without.is_none_or(|other| !beside(*index, other))
            });
            near.map(|(_, weight)| weight).sum::<f64>() / all
        };
        let here = best.peak.sample;
        let elsewhere = self.weights.iter().enumerate();
        let other = elsewhere
            .filter(|(index, _)| !beside(*index, here))
            .max_by(|a, b| a.1.total_cmp(b.1))
            .map_or(0.0, |(index, _)| {
                around((index % width, index / width), Some(here))
            });
        Some([around(here, None), other, unseen / all])
    }
}
