//! Odds of a place by how well a view fits there, as drawn views of known places taught them.

use super::evidence::{CLASSES, RoadEvidence};
use super::locate::LostSettings;

/// Area of the maps that taught the odds, square kilometres: twice the ground has twice the chance fits.
const TAUGHT_AREA: f64 = 100.0;
/// Logarithm of the odds where nothing was seen and nothing is known.
const BASE: f64 = -0.35;
/// Logarithms of odds that a point that was seen adds, by its class of distance.
const SEEN: [f64; CLASSES] = [0.13, 1.03, 0.84, -0.69, -0.16, -0.25, 0.25, -1.36];
/// The same of points of the map.
const KNOWN: [f64; CLASSES] = [1.94, -0.27, 0.26, -0.55, -0.42, -0.19, -0.13, -2.36];

/// Logarithm of the odds of a place against everywhere else.
pub(super) fn log_odds(evidence: &RoadEvidence, area: f64, settings: &LostSettings) -> f64 {
    told(evidence) + prior(area, settings)
}

/// What the evidence adds to the logarithm of the odds.
///
/// Neighbouring points err alike, so n of them are worth √n: of four laws (n, n^¾, √n, shares) that one gave views of maps
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
