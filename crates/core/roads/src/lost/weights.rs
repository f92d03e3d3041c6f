//! Odds of a place by how well a view fits there, as views of known places taught them.
//!
//! Learned by `tests/oracles/lost_weights.py` from 888 views of Aleppo, Bucaramanga, Douala and Salt Lake City, a quarter
//! of them of another map than the one searched (docs/notes/roads-lost.md).

use super::evidence::{CLASSES, RoadEvidence};
use super::settings::LostSettings;

/// Area of the maps that taught the odds, square kilometres: twice the ground has twice the chance fits.
const TAUGHT_AREA: f64 = 100.0;
/// Logarithm of the odds where nothing was seen and nothing is known.
const BASE: f64 = -2.79;
/// Logarithms of odds that a point that was seen adds, by its class of distance.
const SEEN: [f64; CLASSES] = [1.41, 1.34, 0.84, 0.12, -0.33, -0.28, -0.25, -0.55];
/// The same of points of the map.
const KNOWN: [f64; CLASSES] = [0.30, -0.21, -0.20, -0.87, -1.02, -0.20, -0.44, -0.80];

/// Logarithm of the odds of a place against everywhere else.
pub(super) fn log_odds(evidence: &RoadEvidence, area: f64, settings: &LostSettings) -> f64 {
    told(evidence) + prior(area, settings)
}

/// Addition of the evidence to the logarithm of the odds.
///
/// Neighbouring points err alike, so n of them are worth √n: of three laws (n, n^¾, √n) that one gave views of maps
/// that taught nothing the truest probabilities.
pub(super) fn told(evidence: &RoadEvidence) -> f64 {
    let sum = |counts: &[u16; CLASSES], weights: &[f64; CLASSES]| -> f64 {
        let products = counts.iter().zip(weights).map(|(n, w)| f64::from(*n) * w);
        let all: u32 = counts.iter().map(|n| u32::from(*n)).sum();
        products.sum::<f64>() / f64::from(all.max(1)).sqrt()
    };
    sum(&evidence.seen, &SEEN) + sum(&evidence.known, &KNOWN)
}

/// Logarithm of the odds before anything is seen.
pub(super) fn prior(area: f64, settings: &LostSettings) -> f64 {
    let on_map = settings.on_map.clamp(1e-6, 1.0 - 1e-6);
    BASE + (on_map / (1.0 - on_map)).ln() - (area.max(1.0) / TAUGHT_AREA).ln()
}
