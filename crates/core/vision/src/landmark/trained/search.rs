//! Search for the places at which a cascade finds its landmark in a picture.

use std::cmp::Ordering;

use nalgebra::Point3;

use super::{DetectorWindow, Mark, Variant};
use crate::landmark::cascade::{Cascade, Responses, responses};
use crate::landmark::match_evidence::in_picture;
use crate::landmark::window::window_around;
use crate::landmark::{FrameView, GroundView, Refusal, rectify};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{IntegralImage, Raster};

/// Share of the window that the camera must have seen.
const LEAST_COVERAGE: f64 = 0.995;
/// Marks of one search that are kept.
const MOST_MARKS: usize = 8;
/// Pixels around a mark whose responses say where its middle is.
const AROUND: i64 = 3;
/// Share of the best score below which a neighbour says nothing of the place.
const SHARE: f64 = 0.3;

/// A score that orders windows by the stages passed and then by what they passed them by.
fn score_of(stages: usize, margin: f64, all: usize) -> f64 {
    if stages >= all {
        margin
    } else {
        // Between -k - 1 and -k for a window that lacks k stages.
        let bounded = 0.5 * (margin / (1.0 + margin.abs()) - 1.0);
        -((all - stages) as f64) + bounded
    }
}

/// The best windows, apart from each other, the best first: shows `cascade` every window within `reach` metres (north, east) of where `expected` is the middle, in every variant of the window.
///
/// # Errors
/// [`Refusal::OutOfPicture`] if no window lies whole in the picture.
pub fn search(
    cascade: &Cascade,
    shown: &DetectorWindow,
    view: &FrameView<'_>,
    expected: GroundPoint,
    reach: (f64, f64),
) -> Result<Vec<Mark>, Refusal> {
    let mut all: Vec<Mark> = Vec::new();
    for variant in shown.variants.all() {
        let ground = SearchedGround::new(cascade, shown, view, expected, reach, &variant);
        let size = (shown.width, shown.height);
        all.extend(ground.map_or_else(Vec::new, |ground| ground.marks(size, &variant)));
    }
    if all.is_empty() {
        return Err(Refusal::OutOfPicture);
    }
    all.sort_by(|a, b| b.score.total_cmp(&a.score));
    Ok(merged(&all, shown))
}

/// The ground that is searched in one variant, and what the cascade says of it.
pub struct SearchedGround<'a> {
    /// The picture from the variant's pose.
    view: FrameView<'a>,
    /// The pose that is assumed.
    assumed: Pose,
    /// Expected place of the landmark's middle under the variant's pose.
    pub expected: GroundPoint,
    /// Ground that is searched, under the variant's pose.
    pub window: Window,
    /// Grey levels.
    pub pixels: Raster<u8>,
    /// Stages passed and what they were passed by, for every window by its upper left corner.
    pub said: Responses,
    /// Scores of all windows, minus infinity where the camera did not see all of one.
    pub scores: Raster<f64>,
}

impl<'a> SearchedGround<'a> {
    /// Shows `cascade` the windows within `reach` metres (north, east) of where `expected` is the middle in
    /// a variant; `None` where no window lies whole in the picture.
    pub fn new(
        cascade: &Cascade,
        shown: &DetectorWindow,
        view: &FrameView<'a>,
        expected: GroundPoint,
        reach: (f64, f64),
        variant: &Variant,
    ) -> Option<Self> {
        let assumed = view.pose;
        let view = FrameView {
            pose: variant.pose(&assumed, view.ground_down),
            ..*view
        };
        let expected = carried(&view, &assumed, &view.pose, expected)?;
        let pixels = |metres: f64| (metres / shown.gsd).ceil().max(0.0) as usize + 1;
        let size = (shown.width, shown.height);
        let around = (pixels(reach.1), pixels(reach.0));
        let window = in_picture(&window_around(expected, shown.gsd, size, around), &view)?;
        if window.width < size.0 || window.height < size.1 {
            return None;
        }
        let ground = rectify(&view, &window);
        let pixels = to_bytes(&ground);
        let said = responses(cascade, &pixels);
        Some(Self {
            scores: scores(cascade, &said, &ground, size),
            view,
            assumed,
            expected,
            window,
            pixels,
            said,
        })
    }

    /// Carries a place on the ground under the assumed pose to the variant's pose.
    pub fn there(&self, place: GroundPoint) -> Option<GroundPoint> {
        carried(&self.view, &self.assumed, &self.view.pose, place)
    }

    /// Carries a place on the ground under the variant's pose to the assumed pose.
    fn back(&self, place: GroundPoint) -> Option<GroundPoint> {
        carried(&self.view, &self.view.pose, &self.assumed, place)
    }

    /// The best windows, apart from each other, the best first.
    fn marks(&self, size: (usize, usize), variant: &Variant) -> Vec<Mark> {
        let scores = &self.scores;
        let mark = |(column, row): (usize, usize)| {
            let (x, y) = middle(scores, column, row);
            let (x, y) = (x + 0.5 * size.0 as f64, y + 0.5 * size.1 as f64);
            Some(Mark {
                ground: self.back(self.window.ground_at(x, y))?,
                score: scores.get(column, row),
                stages: usize::from(self.said.stages.get(column, row)),
                at_edge: at_edge(scores, column, row),
                rotation: variant.rotation,
                log_scale: variant.log_scale,
            })
        };
        peaks(scores, size).into_iter().filter_map(mark).collect()
    }
}

/// Carries the ground at `place` under the pose `from` to its place under the pose `to`: at the same pixel.
fn carried(
    view: &FrameView<'_>,
    from: &Pose,
    to: &Pose,
    place: GroundPoint,
) -> Option<GroundPoint> {
    if from == to {
        return Some(place);
    }
    let in_world = Point3::new(place.north, place.east, view.ground_down);
    let pixel = view.camera.project(from, &in_world)?;
    view.camera.ground_at(to, &pixel, view.ground_down)
}

/// The best marks, apart from each other, of the marks of all variants from the best to the worst. Where
/// several variants mark one place, it, its turn and its size lie between theirs.
fn merged(all: &[Mark], shown: &DetectorWindow) -> Vec<Mark> {
    let (north, east) = shown.beside();
    let mut groups: Vec<Vec<&Mark>> = Vec::new();
    for mark in all {
        let same = |group: &&mut Vec<&Mark>| {
            group.first().is_some_and(|best| {
                (best.ground.north - mark.ground.north).abs() <= north
                    && (best.ground.east - mark.ground.east).abs() <= east
            })
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.push(mark),
            None => groups.push(vec![mark]),
        }
    }
    groups.truncate(MOST_MARKS);
    groups.iter().filter_map(|group| between(group)).collect()
}

/// Merges the marks that variants made of one place, the best first, into one.
fn between(group: &[&Mark]) -> Option<Mark> {
    let best = **group.first()?;
    // The place lies amid all of them; turn and size are those of the few that fit nearly as well as the
    // best, for far ones are on both sides as often as not.
    let (mut place, mut variant) = ([0.0; 3], [0.0; 3]);
    for mark in group {
        let weight = weight(mark.score, best.score);
        let sharp = (weight / best.score).powi(4);
        let of = [1.0, mark.ground.north, mark.ground.east];
        for (sum, value) in place.iter_mut().zip(of) {
            *sum += weight * value;
        }
        let of = [1.0, mark.rotation, mark.log_scale];
        for (sum, value) in variant.iter_mut().zip(of) {
            *sum += sharp * value;
        }
    }
    if group.len() < 2 || place[0] <= 0.0 {
        return Some(best);
    }
    let mean = |sum: [f64; 3]| [sum[1] / sum[0], sum[2] / sum[0]];
    let ([north, east], [rotation, log_scale]) = (mean(place), mean(variant));
    Some(Mark {
        ground: GroundPoint::new(north, east),
        rotation,
        log_scale,
        ..best
    })
}

/// Weight of a mark beside the best of its place.
fn weight(score: f64, top: f64) -> f64 {
    if top > 0.0 {
        (score - SHARE * top).max(0.0)
    } else {
        0.0
    }
}

/// Grey levels as whole numbers, which cascades are made for.
pub fn to_bytes(ground: &GroundView) -> Raster<u8> {
    ground.luminance.map(|v| v.round().clamp(0.0, 255.0) as u8)
}

/// Scores of all windows, minus infinity where the camera did not see all of one.
fn scores(
    cascade: &Cascade,
    said: &Responses,
    ground: &GroundView,
    size: (usize, usize),
) -> Raster<f64> {
    let table = (!ground.complete).then(|| IntegralImage::new(&ground.seen));
    let least = LEAST_COVERAGE * (size.0 * size.1) as f64;
    Raster::from_fn(said.score.width(), said.score.height(), |x, y| {
        let seen = table
            .as_ref()
            .is_none_or(|t| t.sum(x, y, size.0, size.1) >= least);
        if !seen {
            return f64::NEG_INFINITY;
        }
        let margin = f64::from(said.score.get(x, y));
        let margin = if margin.is_finite() { margin } else { -1e6 };
        score_of(
            usize::from(said.stages.get(x, y)),
            margin,
            cascade.stages.len(),
        )
    })
}

/// The best windows of their surroundings, of a third of the window around, the best first.
fn peaks(scores: &Raster<f64>, size: (usize, usize)) -> Vec<(usize, usize)> {
    let apart = ((size.0 / 3) as i64, (size.1 / 3) as i64);
    let mut places: Vec<(usize, usize)> = (0..scores.height())
        .flat_map(|row| (0..scores.width()).map(move |column| (column, row)))
        .filter(|(c, r)| scores.get(*c, *r) > f64::NEG_INFINITY)
        .collect();
    let best_first = |a: &(usize, usize), b: &(usize, usize)| -> Ordering {
        scores
            .get(b.0, b.1)
            .total_cmp(&scores.get(a.0, a.1))
            .then(a.cmp(b))
    };
    let mut list: Vec<(usize, usize)> = Vec::new();
    while list.len() < MOST_MARKS {
        let Some(best) = places.iter().min_by(|a, b| best_first(a, b)).copied() else {
            break;
        };
        list.push(best);
        let far = |(c, r): &(usize, usize)| {
            (*c as i64 - best.0 as i64).abs() > apart.0
                || (*r as i64 - best.1 as i64).abs() > apart.1
        };
        places.retain(far);
    }
    list
}

/// Whether a window beside that one was not seen whole.
fn at_edge(scores: &Raster<f64>, column: usize, row: usize) -> bool {
    let beside = |at: usize| [at.checked_sub(1), Some(at), Some(at + 1)];
    beside(row).into_iter().any(|row| {
        beside(column).into_iter().any(|column| {
            let score = column.zip(row).and_then(|(column, row)| {
                let inside = column < scores.width() && row < scores.height();
                inside.then(|| scores.get(column, row))
            });
            score.is_none_or(|score| score == f64::NEG_INFINITY)
        })
    })
}

/// The mean place of the windows around one, each weighing as much as it passes the stages by: of a
/// cascade's response not the peak, which is rough, but the whole hill lies over the landmark.
fn middle(scores: &Raster<f64>, column: usize, row: usize) -> (f64, f64) {
    let top = scores.get(column, row);
    let (mut sum, mut x, mut y) = (0.0, 0.0, 0.0);
    for dy in -AROUND..=AROUND {
        for dx in -AROUND..=AROUND {
            let (c, r) = (column as i64 + dx, row as i64 + dy);
            let inside =
                c >= 0 && r >= 0 && (c as usize) < scores.width() && (r as usize) < scores.height();
            if !inside {
                continue;
            }
            let score = scores.get(c as usize, r as usize);
            let weight = weight(score, top);
            sum += weight;
            x += weight * dx as f64;
            y += weight * dy as f64;
        }
    }
    if sum > 0.0 {
        (column as f64 + x / sum, row as f64 + y / sum)
    } else {
        (column as f64, row as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_beside_one_that_leaves_the_picture_is_at_the_edge() {
        // The picture ends along a diagonal.
        let scores = Raster::from_fn(
            9,
            7,
            |x, y| if x + y > 10 { f64::NEG_INFINITY } else { 1.0 },
        );
        for (column, row) in [(0, 3), (4, 0), (8, 1), (4, 6), (5, 4), (6, 4)] {
            assert!(at_edge(&scores, column, row), "{column}, {row}");
        }
        for (column, row) in [(1, 1), (4, 4), (5, 3), (7, 1), (3, 5)] {
            assert!(!at_edge(&scores, column, row), "{column}, {row}");
        }
    }
}
