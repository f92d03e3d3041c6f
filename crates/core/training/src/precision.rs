//! Precision of a detector's right marks in place, turn and size, learned on photos it was not trained on.

use nalgebra::{Matrix2, Vector2};

use super::evaluation::{EvaluatedLook, EvaluatedMark, MarkCovariance};
use pilotage_vision::landmark::trained::{ByScore, MarkPrecision, ReadingEstimate};

/// Draws the starts of the robust fit.
const SEED: u64 = 5;

/// Learned from the best right marks with at least `least_score`; a pixel covers `gsd` metres.
pub fn learned(looks: &[EvaluatedLook], least_score: f64, gsd: f64) -> MarkPrecision {
    let best: Vec<(&EvaluatedLook, &EvaluatedMark)> = looks
        .iter()
        .filter_map(|look| Some((look, look.best_right()?)))
        .filter(|(_, mark)| mark.score >= least_score)
        .collect();
    let turns: Vec<_> = (best.iter())
        .map(|(look, mark)| (look.rotation(), mark.rotation))
        .collect();
    let log_scales: Vec<_> = (best.iter())
        .map(|(look, mark)| (look.log_scale, mark.log_scale))
        .collect();
    // Half a pixel's worth of knowledge from before, so that few marks do not pretend to know.
    let before = Matrix2::identity() * (0.5 * gsd).powi(2);
    let count = best.len() as f64;
    let (bias, covariance, by_score) =
        if let Some(fit) = MarkCovariance::of(looks, least_score, SEED) {
            let covariance = (fit.covariance * count + before) / (count + 1.0);
            (fit.bias.into(), covariance, fit.by_score)
        } else {
            let squares = best.iter().map(|(_, mark)| {
                let offset = Vector2::from(mark.offset);
                offset * offset.transpose()
            });
            let sum = squares.fold(before, |sum, square| sum + square);
            (Vector2::zeros(), sum / (count + 1.0), ByScore::default())
        };
    MarkPrecision {
        bias,
        covariance,
        by_score,
        turn: ReadingEstimate::learned(&turns),
        log_scale: ReadingEstimate::learned(&log_scales),
    }
}
