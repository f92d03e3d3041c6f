//! Traces of windows through a cascade and pictures of its features, for those who want to understand it.

use serde::{Deserialize, Serialize};

use super::grid::RowGrid;
use super::histograms::{DIRECTIONS, Histograms, unit};
use super::model::{Area, Cascade, CascadeFeature};
use super::patch::Patch;
use super::responses::responses;
use super::scale::resized;
use pilotage_raster::raster::Raster;

/// Trace of the windows of one scale through the stages.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Size of the scale's copy of the picture, pixels: width, height.
    pub size: (usize, usize),
    /// Windows that are left: at first, and after each stage.
    pub left: Vec<usize>,
    /// Number of the stage at which each window ended, by its upper left pixel in the copy; as many as
    /// there are stages (at most 255) if it passed all.
    pub ended: Raster<u8>,
}

/// Shows `cascade` every window of `picture` made smaller by `scale`, which is at least one.
pub fn trace(cascade: &Cascade, picture: &Raster<u8>, scale: f64) -> Trace {
    let side = |side: usize| (side as f64 / scale.max(1.0)).round() as usize;
    let copy = resized(picture, side(picture.width()), side(picture.height()));
    let ended = responses(cascade, &copy).stages;
    let left = |stage: usize| {
        let passed = |stages: &&u8| usize::from(**stages) >= stage.min(255);
        ended.pixels().iter().filter(passed).count()
    };
    Trace {
        size: (copy.width(), copy.height()),
        left: (0..=cascade.stages.len()).map(left).collect(),
        ended,
    }
}

/// Strength of the edges of each direction in each cell of a patch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HogPicture {
    /// Width and height of a cell, pixels of the patch.
    pub cell: usize,
    /// For each cell and direction, the mean length of the gradients, grey levels: differences of the
    /// pixels on both sides. Direction d holds gradients of 20° d + 10° to 20° d + 30° from x towards
    /// y, or opposite; an edge lies across its gradient.
    pub strengths: Raster<[f32; DIRECTIONS]>,
}

/// Direction of the edges that a HOG direction stands for, radians from x towards y, 0 to π: across the
/// middle of its gradients.
pub fn edge_angle(direction: usize) -> f64 {
    let gradient = (20.0 * direction as f64 + 20.0).to_radians();
    (gradient + std::f64::consts::FRAC_PI_2).rem_euclid(std::f64::consts::PI)
}

/// The edges of a patch in cells of `cell` × `cell` pixels; what does not fill a cell is left out.
pub fn hog_picture(patch: &Patch, cell: usize) -> HogPicture {
    let cell = cell.max(1);
    let pixels = patch.pixels();
    let grid = RowGrid::new(pixels.width(), 1);
    let unit = unit(pixels.width() * pixels.height());
    let mut histograms = Histograms::default();
    histograms.fill(pixels, grid, unit);
    let share = unit / (cell * cell) as f32;
    let (columns, rows) = (patch.width() / cell, patch.height() / cell);
    let strengths = Raster::from_fn(columns, rows, |column, row| {
        let (x, y) = (1 + column * cell, 1 + row * cell);
        std::array::from_fn(|d| {
            let at = |x, y| histograms.directions[d][grid.place(x, y)];
            let sum = at(x, y)
                .wrapping_sub(at(x + cell, y))
                .wrapping_sub(at(x, y + cell))
                .wrapping_add(at(x + cell, y + cell));
            sum as f32 * share
        })
    });
    HogPicture { cell, strengths }
}

/// A feature as it is drawn over the window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShownFeature {
    /// Tree of the stage that asks for the feature.
    pub tree: usize,
    /// Rectangles of the window (left, top, width, height, pixels) with their weights: those of a Haar
    /// feature; the nine blocks of an LBP one, the middle one with minus one; the cell of a HOG one with
    /// one, and its block with zero.
    pub areas: Vec<(Area, f32)>,
    /// Whether the rectangles are turned: from their uppermost corner the width runs down to the
    /// right and the height down to the left, each pixel of them by 45°.
    pub tilted: bool,
    /// Direction of a HOG feature.
    pub direction: Option<usize>,
}

/// The features of a stage in the order in which its trees ask for them; empty if there is no such stage.
pub fn stage_features(cascade: &Cascade, stage: usize) -> Vec<ShownFeature> {
    let Some(stage) = cascade.stages.get(stage) else {
        return Vec::new();
    };
    let trees = cascade.trees[stage.trees.clone()].iter().enumerate();
    let nodes = trees.flat_map(|(tree, t)| {
        let nodes = cascade.nodes[t.nodes.clone()].iter();
        nodes.map(move |node| (tree, node.feature as usize))
    });
    nodes
        .map(|(tree, feature)| shown(tree, &cascade.features[feature]))
        .collect()
}

fn shown(tree: usize, feature: &CascadeFeature) -> ShownFeature {
    let (areas, tilted, direction) = match feature {
        CascadeFeature::Haar(haar) => {
            let areas = haar.areas.iter().filter(|(_, weight)| *weight != 0.0);
            (areas.copied().collect(), haar.tilted, None)
        }
        CascadeFeature::Lbp([x, y, w, h]) => {
            let block = |i: i32| {
                let area = [x + i % 3 * w, y + i / 3 * h, *w, *h];
                (area, if i == 4 { -1.0 } else { 1.0 })
            };
            ((0..9).map(block).collect(), false, None)
        }
        CascadeFeature::Hog {
            cell: [x, y, w, h],
            component,
        } => {
            let (number, direction) = (component / 9, component % 9);
            let (column, row) = (i32::from(number % 2), i32::from(number / 2));
            let own = [x + column * w, y + row * h, *w, *h];
            let areas = vec![(own, 1.0), ([*x, *y, 2 * w, 2 * h], 0.0)];
            (areas, false, Some(usize::from(direction)))
        }
    };
    ShownFeature {
        tree,
        areas,
        tilted,
        direction,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmark::cascade::{HaarFeature, NodeSplit, TrainedStage, TrainedTree};

    /// Two stages that look for an edge upright, the second in the lower half, too.
    fn cascade() -> Cascade {
        let feature = |component| CascadeFeature::Hog {
            cell: [0, 0, 8, 8],
            component,
        };
        let stage = |feature| TrainedStage {
            trees: vec![TrainedTree::stump(
                feature,
                NodeSplit::Threshold(0.45),
                -1.0,
                1.0,
            )],
            threshold: 0.5,
        };
        let features = vec![feature(8), feature(26)];
        Cascade::from_parts(16, 16, features, &[stage(0), stage(1)]).unwrap()
    }

    #[test]
    fn the_windows_that_are_left_are_those_that_ended_later() {
        let picture = Raster::from_fn(60, 40, |x, y| match (x < 30, y < 25) {
            (true, _) | (_, false) => 40,
            _ => 200,
        });
        let trace = trace(&cascade(), &picture, 1.0);
        assert_eq!(trace.size, (60, 40));
        assert_eq!(trace.left[0], 45 * 25);
        assert!(
            trace.left[1] < trace.left[0] && trace.left[2] < trace.left[1],
            "{:?}",
            trace.left
        );
        assert!(trace.left[2] > 0);
        let ended = |stage| {
            trace
                .ended
                .pixels()
                .iter()
                .filter(|e| usize::from(**e) == stage)
                .count()
        };
        assert_eq!(ended(2), trace.left[2]);
        assert_eq!(ended(1), trace.left[1] - trace.left[2]);
        let half = super::trace(&cascade(), &picture, 2.0);
        assert_eq!((half.size, half.left[0]), ((30, 20), 15 * 5));
    }

    #[test]
    fn the_hog_picture_of_an_upright_edge_has_upright_strokes_where_the_edge_is() {
        let picture = Raster::from_fn(24, 16, |x, _| if x < 12 { 50 } else { 210 });
        let patch = Patch::cut(&picture, 0, 0, 24, 16).unwrap();
        let hog = hog_picture(&patch, 8);
        assert_eq!((hog.strengths.width(), hog.strengths.height()), (3, 2));
        for column in 0..3 {
            let strengths = hog.strengths.get(column, 1);
            let strongest = (0..DIRECTIONS).max_by(|a, b| strengths[*a].total_cmp(&strengths[*b]));
            // Two of eight columns have a gradient of 160.
            let wanted = if column == 1 { 40.0 } else { 0.0 };
            assert!(
                (strengths.iter().sum::<f32>() - wanted).abs() < 0.01,
                "{strengths:?}"
            );
            if column == 1 {
                assert_eq!(strongest, Some(8));
                assert!((edge_angle(8) - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_features_of_a_stage_are_its_rectangles() {
        let shown = stage_features(&cascade(), 1);
        assert_eq!(shown.len(), 1);
        assert_eq!(shown[0].areas[0], ([0, 8, 8, 8], 1.0));
        assert_eq!(shown[0].areas[1], ([0, 0, 16, 16], 0.0));
        assert_eq!(shown[0].direction, Some(8));
        assert!(stage_features(&cascade(), 2).is_empty());
        let haar = CascadeFeature::Haar(HaarFeature {
            areas: [
                ([0, 0, 9, 9], -1.0),
                ([3, 3, 3, 3], 9.0),
                ([1, 0, 1, 1], 0.0),
            ],
            tilted: false,
        });
        assert_eq!(super::shown(4, &haar).areas.len(), 2);
        let lbp = super::shown(0, &CascadeFeature::Lbp([1, 2, 3, 4]));
        assert_eq!(lbp.areas[8].0, [7, 10, 3, 4]);
    }
}
