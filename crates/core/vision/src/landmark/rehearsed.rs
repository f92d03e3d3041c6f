//! Findings of a rehearsal of a landmark, and rules of every rehearsal.

use pilotage_base::frames::GroundPoint;
use pilotage_raster::raster::{Raster, Rgba};

/// A best place further off than this, in pixels, is not the landmark.
pub(super) const OFF_PIXELS: f64 = 2.0;
/// Pixels of a patch that may be pure white or pure black: more of them are a hole in the map.
pub(super) const MOST_BLANK: f64 = 0.005;

/// Fit of a map patch to the ground on another day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RehearsalFit {
    /// Score at the landmark's own place, -1 to 1; zero if the best place is elsewhere.
    pub score: f64,
    /// Score of the best other place.
    pub rival: f64,
    /// Place with the rival's score.
    pub rival_place: GroundPoint,
    /// Distance of the best place from the landmark, metres.
    pub drift: f64,
}

impl RehearsalFit {
    /// Margin before the detector must refuse the landmark as ambiguous, with `ambiguity` the greatest ratio
    /// of the rival's score to its own; negative if it must.
    pub fn margin(&self, ambiguity: f64) -> f64 {
        ambiguity * self.score - self.rival
    }
}

/// Share of the pixels that are pure white or pure black.
pub(super) fn blank(patch: &Raster<Rgba>) -> f64 {
    let pure = |[r, g, b, _]: &&Rgba| (*r).min(*g).min(*b) >= 253 || (*r).max(*g).max(*b) <= 2;
    let count = patch.pixels().iter().filter(pure).count();
    count as f64 / patch.pixels().len().max(1) as f64
}
