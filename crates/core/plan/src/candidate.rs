//! A box of a map that may become a landmark, and how likely a rehearsal makes it that it is found.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_vision::landmark::RehearsalFit;

/// Greatest ratio of a rival's score to the landmark's, as the detector has it.
const AMBIGUITY: f64 = 0.85;
/// Margin at which a landmark is as likely refused as ambiguous as not, and the width of that change.
/// A rehearsal takes more from the landmark's score than from its rival's, so that it is below zero:
/// from all boxes of one recorded flight.
const EVEN_MARGIN: f64 = -0.1;
/// See [`EVEN_MARGIN`].
const MARGIN_WIDTH: f64 = 0.05;
/// Score in a rehearsal at which a landmark is as likely found as not, from the same boxes.
const EVEN_SCORE: f64 = 0.25;
/// See [`EVEN_SCORE`].
const SCORE_WIDTH: f64 = 0.12;
/// Greatest promise of a rehearsal: relief, another camera and a real day are not in it. So many looks
/// at boxes that pass one succeeded on a recorded flight.
const REHEARSAL: f64 = 0.73;

/// A box of the map, how likely it is found, and how it did on its worst rehearsal day.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LandmarkCandidate {
    /// The box.
    pub bounds: GroundRect,
    /// Score at its own place, 0 to 1.
    pub score: f64,
    /// Score of its strongest rival.
    pub rival: f64,
    /// The place of the rival.
    pub rival_place: GroundPoint,
    /// Margin before the place is refused as ambiguous.
    pub margin: f64,
    /// Distance by which the place seemed to move on another day, metres.
    pub drift: f64,
    /// Probability of being found in a picture, the mean over the rehearsal days; on a map of another date, as far
    /// as real ones tell.
    pub probability: f64,
    /// Range of the probability for nine in ten maps of another date; the probability twice where the map is
    /// of the flight's own.
    pub range: [f64; 2],
}

impl LandmarkCandidate {
    /// As it did on one day.
    pub(super) fn of(bounds: GroundRect, r: &RehearsalFit) -> Self {
        let margin = r.margin(AMBIGUITY);
        let rise = |x: f64| 1.0 / (1.0 + (-x).exp());
        let probability = REHEARSAL
            * rise((margin - EVEN_MARGIN) / MARGIN_WIDTH)
            * rise((r.score - EVEN_SCORE) / SCORE_WIDTH);
        Self {
            bounds,
            score: r.score,
            rival: r.rival,
            rival_place: r.rival_place,
            margin,
            drift: r.drift,
            probability,
            range: [probability; 2],
        }
    }

    /// Probability of being found in a picture, as far as rehearsals can tell.
    pub fn probability(&self) -> f64 {
        self.probability
    }
}
