//! A cascade shown every window of a picture at every scale.

use super::layout::{Layout, Tables};
use super::model::{Cascade, Tree};
use super::scale::resized;
use crate::raster::Raster;

/// Which windows are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanSettings {
    /// Ratio of one scale to the one before it, over 1.
    pub scale_step: f64,
    /// Smallest window, width and height, pixels; zero is no limit.
    pub least: (usize, usize),
    /// Largest window, width and height, pixels; zero is no limit.
    pub greatest: (usize, usize),
}

impl Default for ScanSettings {
    fn default() -> Self {
        Self {
            scale_step: 1.1,
            least: (0, 0),
            greatest: (0, 0),
        }
    }
}

/// A rectangle of a picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rectangle {
    /// Left edge.
    pub x: i32,
    /// Upper edge.
    pub y: i32,
    /// Width.
    pub width: i32,
    /// Height.
    pub height: i32,
}

impl Rectangle {
    /// What of it lies in a picture of that size; by rounding, a window can leave it by some pixels.
    #[must_use]
    pub fn within(&self, width: usize, height: usize) -> Self {
        let (x, y) = (self.x.max(0), self.y.max(0));
        Self {
            x,
            y,
            width: (self.x + self.width).min(width as i32) - x,
            height: (self.y + self.height).min(height as i32) - y,
        }
    }
}

/// A window that passed every stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scanned {
    /// The window in the picture.
    pub rectangle: Rectangle,
    /// Sum of the votes of the last stage.
    pub score: f64,
}

/// Every window of `picture` that passes, scale by scale, row by row: those that OpenCV's
/// `detectMultiScale` finds before it groups them.
pub fn scan(cascade: &Cascade, picture: &Raster<u8>, settings: &ScanSettings) -> Vec<Scanned> {
    let mut found = Vec::new();
    for scale in scales(cascade, picture, settings) {
        scan_level(cascade, picture, scale, &mut found);
    }
    found
}

/// Scales at which the window fits into the picture and the settings.
fn scales(cascade: &Cascade, picture: &Raster<u8>, settings: &ScanSettings) -> Vec<f32> {
    let limit = |(w, h): (usize, usize)| match (w, h) {
        (0, _) | (_, 0) => (picture.width(), picture.height()),
        limit => limit,
    };
    let greatest = limit(settings.greatest);
    let window = |factor: f64| {
        let side = |s: usize| (s as f64 * factor).round_ties_even() as usize;
        (side(cascade.width), side(cascade.height))
    };
    let mut scales = Vec::new();
    // A step that goes nowhere is taken for one scale alone.
    let step = if settings.scale_step > 1.0 {
        settings.scale_step
    } else {
        f64::INFINITY
    };
    let mut factor = 1.0;
    loop {
        let (w, h) = window(factor);
        if w > picture.width() || h > picture.height() {
            break;
        }
        let scale = factor as f32;
        let (w, h) = window(f64::from(scale));
        if w > greatest.0 || h > greatest.1 {
            break;
        }
        if w >= settings.least.0 && h >= settings.least.1 {
            scales.push(scale);
        }
        factor *= step;
    }
    scales
}

/// A picture seen through a cascade.
pub(super) struct Sight<'a> {
    cascade: &'a Cascade,
    layout: Layout,
    tables: Tables,
}

/// What a cascade says of a window.
pub(super) struct Seen {
    /// Stages passed.
    pub passed: usize,
    /// Whether the window was so flat that no stage was asked.
    pub flat: bool,
    /// Votes of the last stage met.
    pub votes: f64,
    /// Sum over the stages met of votes less threshold; minus infinity where none was.
    pub margin: f64,
}

impl<'a> Sight<'a> {
    pub fn new(cascade: &'a Cascade, layout: Layout, picture: &Raster<u8>) -> Self {
        Self {
            cascade,
            tables: layout.tables(picture),
            layout,
        }
    }

    /// Shows the window whose upper left pixel is (x, y).
    pub fn look(&self, x: usize, y: usize) -> Seen {
        let at = y * self.layout.stride + x;
        let mut seen = Seen {
            passed: 0,
            flat: false,
            votes: 0.0,
            margin: 0.0,
        };
        let Some(factor) = self.layout.factor(&self.tables, at) else {
            seen.flat = true;
            seen.margin = f64::NEG_INFINITY;
            return seen;
        };
        for stage in &self.cascade.stages {
            let trees = self.cascade.trees[stage.trees.clone()].iter();
            seen.votes = trees.fold(0.0, |sum, tree| sum + self.vote(tree, at, factor));
            let margin = seen.votes - f64::from(stage.threshold);
            seen.margin += margin;
            if margin < 0.0 {
                break;
            }
            seen.passed += 1;
        }
        seen
    }

    fn vote(&self, tree: &Tree, at: usize, factor: f32) -> f64 {
        let mut next = 0;
        loop {
            let index = tree.nodes.start + next as usize;
            let node = &self.cascade.nodes[index];
            let feature = node.feature as usize;
            let left = if let Some(subset) = self.cascade.subsets.get(index) {
                let code = self.layout.code(&self.tables, feature, at);
                subset[code >> 5] >> (code & 31) & 1 == 1
            } else {
                self.layout.value(&self.tables, feature, at, factor) < node.threshold
            };
            next = if left { node.left } else { node.right };
            if next <= 0 {
                let leaf = tree.first_leaf + next.unsigned_abs() as usize;
                return f64::from(self.cascade.leaves[leaf]);
            }
        }
    }
}

/// Shows every window of a smaller copy of `picture`.
fn scan_level(cascade: &Cascade, picture: &Raster<u8>, scale: f32, found: &mut Vec<Scanned>) {
    let side = |s: usize| f64::from(s as f32 / scale).round_ties_even() as usize;
    let (width, height) = (side(picture.width()), side(picture.height()));
    let copy = resized(picture, width, height);
    let layout = Layout::new(&cascade.features, cascade.width, cascade.height, width + 1);
    let sight = Sight::new(cascade, layout, &copy);
    let columns = (width + 1).saturating_sub(cascade.width);
    let rows = (height + 1).saturating_sub(cascade.height);
    // Large windows are shown at every pixel of their small copy.
    let step = if scale >= 2.0 { 1 } else { 2 };
    let round = |v: f32| v.round_ties_even() as i32;
    for y in (0..rows).step_by(step) {
        let mut x = 0;
        while x < columns {
            let seen = sight.look(x, y);
            if seen.passed == cascade.stages.len() {
                found.push(Scanned {
                    rectangle: Rectangle {
                        x: round(x as f32 * scale),
                        y: round(y as f32 * scale),
                        width: round(cascade.width as f32 * scale),
                        height: round(cascade.height as f32 * scale),
                    },
                    score: seen.votes,
                });
            } else if seen.passed == 0 && !seen.flat {
                // What the very first stage refuses has no better neighbour.
                x += step;
            }
            x += step;
        }
    }
}
