//! Place of a landmark within a pixel, from the answers of a cascade around it.

use super::model::{Cascade, Stage};
use super::responses::responses;
use super::scale::resized;
use super::scan::Scanned;
use pilotage_raster::raster::Raster;

/// Distance around a window within which others are asked, pixels of its scale's copy.
const REACH: f64 = 4.0;
/// Ratio of a neighbouring scale to the window's own.
const SCALE_STEP: f64 = 1.04;
/// Scales on each side of the window's own.
const SCALES: i32 = 2;
/// Share of the best margin that a window needs to count.
const LEAST: f64 = 0.7;
/// A window's centre and size between pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refined {
    /// Centre, pixels of the picture, origin at its outer corner.
    pub centre: [f64; 2],
    /// Ratio of the window to that of the cascade.
    pub scale: f64,
    /// Covariance of the centre, pixels² of the picture, as the scatter of the windows says that it is the
    /// mean of: how well the middle of the answers is known, not how well it marks the landmark.
    pub covariance: [[f64; 2]; 2],
}

/// An answer: offset of the centre (pixels of the window's scale) and of the logarithm of the scale
/// (steps), and the margin.
type RefinedWindow = ([f64; 3], f64);

/// Asks all trees of the cascade about every window around one that was found, on its scale and those
/// next to it, no stage refusing any. The place is the mean of the centres of the windows that come near
/// the best, weighted by their margins; a quadratic fitted to the margins is no better, for they fall
/// in steps.
///
/// `None` if no window around has more votes than the thresholds ask for.
pub fn refined(cascade: &Cascade, picture: &Raster<u8>, found: &Scanned) -> Option<Refined> {
    let r = found.rectangle;
    let scale = f64::from(r.width) / cascade.width as f64;
    let centre = [
        f64::from(r.x) + f64::from(r.width) / 2.0,
        f64::from(r.y) + f64::from(r.height) / 2.0,
    ];
    let all = in_one_stage(cascade);
    let mut answers = Vec::new();
    for level in (-SCALES..=SCALES).map(f64::from) {
        ask(&all, picture, centre, scale, level, &mut answers);
    }
    let best = answers.iter().fold(f64::NEG_INFINITY, |m, a| m.max(a.1));
    answers.retain(|a| best > 0.0 && a.1 >= LEAST * best);
    if answers.is_empty() {
        return None;
    }
    let (offset, covariance) = mean(&answers);
    let by_scale = scale * scale;
    Some(Refined {
        centre: [centre[0] + offset[0] * scale, centre[1] + offset[1] * scale],
        scale: scale * SCALE_STEP.powf(offset[2]),
        covariance: covariance.map(|row| row.map(|v| v * by_scale)),
    })
}

/// The cascade with all trees in one stage: no window is refused before all have voted.
fn in_one_stage(cascade: &Cascade) -> Cascade {
    let mut all = cascade.clone();
    all.stages = vec![Stage {
        trees: 0..cascade.trees.len(),
        threshold: cascade.stages.iter().map(|stage| stage.threshold).sum(),
    }];
    all
}

/// Adds the answers on one scale.
fn ask(
    cascade: &Cascade,
    picture: &Raster<u8>,
    centre: [f64; 2],
    scale: f64,
    level: f64,
    answers: &mut Vec<RefinedWindow>,
) {
    let own = scale * SCALE_STEP.powf(level);
    let half = |side: usize| (side as f64 / 2.0 + REACH + 2.0) * own;
    let cut = |centre: f64, half: f64, limit: usize| {
        let from = (centre - half).floor().max(0.0) as usize;
        let to = ((centre + half).ceil().max(0.0) as usize).min(limit);
        (from, to.saturating_sub(from))
    };
    let (left, width) = cut(centre[0], half(cascade.width), picture.width());
    let (top, height) = cut(centre[1], half(cascade.height), picture.height());
    let Some(part) = picture.crop(left, top, width, height) else {
        return;
    };
    let side = |side: usize| (side as f64 / own).round() as usize;
    let (columns, rows) = (side(width), side(height));
    if columns < cascade.width || rows < cascade.height {
        return;
    }
    let copy = resized(&part, columns, rows);
    let pixel = [width as f64 / columns as f64, height as f64 / rows as f64];
    let found = responses(cascade, &copy);
    for y in 0..found.score.height() {
        for x in 0..found.score.width() {
            let place = |from: usize, i: usize, side: usize, pixel: f64| {
                from as f64 + (i as f64 + side as f64 / 2.0) * pixel
            };
            let dx = (place(left, x, cascade.width, pixel[0]) - centre[0]) / scale;
            let dy = (place(top, y, cascade.height, pixel[1]) - centre[1]) / scale;
            let margin = f64::from(found.score.get(x, y));
            if dx.hypot(dy) <= REACH && margin.is_finite() {
                answers.push(([dx, dy, level], margin));
            }
        }
    }
}

/// Mean by margin, and the covariance that it would have if the windows were independent.
fn mean(answers: &[RefinedWindow]) -> ([f64; 3], [[f64; 2]; 2]) {
    let sum: f64 = answers.iter().map(|a| a.1).sum();
    let mean = [0, 1, 2].map(|i| answers.iter().map(|a| a.0[i] * a.1).sum::<f64>() / sum);
    let mut covariance = [[0.0; 2]; 2];
    for (offset, margin) in answers {
        let share = margin / sum;
        for (i, row) in covariance.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value += share * share * (offset[i] - mean[i]) * (offset[j] - mean[j]);
            }
        }
    }
    // A window stands for the pixel around its place.
    covariance[0][0] += 1.0 / 12.0 / answers.len() as f64;
    covariance[1][1] += 1.0 / 12.0 / answers.len() as f64;
    (mean, covariance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmark::cascade::{
        CascadeFeature, NodeSplit, Patch, PatchEvaluator, ScanSettings, TrainedStage, TrainedTree,
        scan, soft_suppressed,
    };

    /// A soft ring with a stroke in it, its middle at (x, y), so many times as large.
    fn ring(width: usize, height: usize, x: f64, y: f64, scale: f64) -> Raster<u8> {
        let soft = |t: f64| (-t * t / 4.5).exp();
        Raster::from_fn(width, height, |column, row| {
            let part = |i: usize| (i as f64 + 0.5) / 3.0;
            let bright = |i: usize| {
                let u = (column as f64 + part(i % 3) - x) / scale;
                let v = (row as f64 + part(i / 3) - y) / scale;
                let stroke = if v.abs() < 5.0 { soft(u - 2.0) } else { 0.0 };
                90.0 + 100.0 * soft(u.hypot(v) - 7.0) + 60.0 * stroke
            };
            let noise = (column * 37 + row * 91 + column * row * 11) % 7;
            ((0..9).map(bright).sum::<f64>() / 9.0 + noise as f64) as u8
        })
    }

    /// A cascade that asks for the strongest edges of the ring.
    fn ring_cascade() -> Cascade {
        let mut all = Vec::new();
        for [w, h] in [[4, 4], [6, 6], [4, 8], [8, 4]] {
            for y in (0..=24 - 2 * h).step_by(2) {
                for x in (0..=24 - 2 * w).step_by(2) {
                    let cell = [x, y, w, h];
                    all.extend((0..36).map(|component| CascadeFeature::Hog { cell, component }));
                }
            }
        }
        let patch = Patch::cut(&ring(60, 60, 30.0, 30.0, 1.0), 18, 18, 24, 24).unwrap();
        let mut values = vec![0.0; all.len()];
        PatchEvaluator::new(&all, 24, 24).values(&patch, &mut values);
        let mut strong: Vec<usize> = (0..all.len()).filter(|&i| values[i] > 0.06).collect();
        strong.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
        let step = strong.len() / 120;
        let chosen: Vec<usize> = strong.into_iter().step_by(step).take(120).collect();
        let tree = |(k, &i): (usize, &usize)| {
            TrainedTree::stump(k, NodeSplit::Threshold(values[i] * 0.8), -1.0, 1.0)
        };
        let trees: Vec<_> = chosen.iter().enumerate().map(tree).collect();
        let stages: Vec<_> = trees
            .chunks(30)
            .map(|trees| TrainedStage {
                trees: trees.to_vec(),
                threshold: 3.0,
            })
            .collect();
        let features = chosen.iter().map(|&i| all[i].clone()).collect();
        Cascade::from_parts(24, 24, features, &stages).unwrap()
    }

    #[test]
    fn the_centre_is_found_within_a_pixel_and_its_covariance_says_how_well() {
        let cascade = ring_cascade();
        let (mut raw, mut refined_squares, mut normalized, mut found) = (0.0, 0.0, 0.0, 0);
        for k in 0..40 {
            let part = |m: usize| (k * m % 97) as f64 / 97.0;
            let (x, y, scale) = (40.0 + part(41), 37.0 + part(59), 1.0 + 0.8 * part(23));
            let picture = ring(90, 80, x, y, scale);
            let windows = scan(&cascade, &picture, &ScanSettings::default());
            let Some(best) = soft_suppressed(&windows, 0.3).into_iter().next() else {
                continue;
            };
            let r = best.window.rectangle;
            let (cx, cy) = (
                f64::from(r.x) + f64::from(r.width) / 2.0 - x,
                f64::from(r.y) + f64::from(r.height) / 2.0 - y,
            );
            let fine = refined(&cascade, &picture, &best.window).unwrap();
            let [ex, ey] = [fine.centre[0] - x, fine.centre[1] - y];
            raw += cx * cx + cy * cy;
            refined_squares += ex * ex + ey * ey;
            normalized += ex * ex / fine.covariance[0][0] + ey * ey / fine.covariance[1][1];
            assert!((fine.scale / scale).ln().abs() < 0.3, "{fine:?} {scale}");
            found += 1;
        }
        let mean = |sum: f64| (sum / f64::from(found)).sqrt();
        let normalized = normalized / f64::from(2 * found);
        println!(
            "{found} of 40: {:.2} px as scanned, {:.2} px refined, {normalized:.2} times the variance",
            mean(raw),
            mean(refined_squares)
        );
        assert!(found >= 36, "{found}");
        assert!(mean(refined_squares) < 0.5, "{}", mean(refined_squares));
        assert!(mean(refined_squares) < 0.4 * mean(raw));
        assert!((0.4..2.5).contains(&normalized), "{normalized}");
    }
}
