//! A cascade shown every window of a picture at every scale.

use super::integral::Integral;
use super::model::{Area, Cascade, Feature};
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
        Level::new(cascade, picture, scale).scan(&mut found);
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

/// A corner-wise sum: four places of a table relative to the window's first.
type Corners = [usize; 4];

fn sum(table: &[i32], at: usize, corners: &Corners) -> i32 {
    let [a, b, c, d] = corners.map(|offset| table[at + offset]);
    a.wrapping_sub(b).wrapping_sub(c).wrapping_add(d)
}

fn upright([x, y, w, h]: Area, stride: usize) -> Corners {
    let at = |x: i32, y: i32| y as usize * stride + x as usize;
    [at(x, y), at(x + w, y), at(x, y + h), at(x + w, y + h)]
}

fn turned([x, y, w, h]: Area, stride: usize) -> Corners {
    let at = |x: i32, y: i32| y as usize * stride + x as usize;
    [
        at(x, y),
        at(x - h, y + h),
        at(x + w, y + w),
        at(x + w - h, y + w + h),
    ]
}

/// A feature laid out for one level's tables.
enum Laid {
    Haar {
        areas: [(Corners, f32); 3],
        tilted: bool,
    },
    /// Corners of the four by four lattice of the nine blocks.
    Lbp([usize; 16]),
}

/// A smaller copy of the picture, its tables, and the cascade laid out for them.
struct Level<'a> {
    cascade: &'a Cascade,
    scale: f32,
    columns: usize,
    rows: usize,
    step: usize,
    integral: Integral,
    laid: Vec<Laid>,
    norm: Corners,
    norm_area: f64,
}

impl<'a> Level<'a> {
    fn new(cascade: &'a Cascade, picture: &Raster<u8>, scale: f32) -> Self {
        let side = |s: usize| f64::from(s as f32 / scale).round_ties_even() as usize;
        let (width, height) = (side(picture.width()), side(picture.height()));
        let copy = resized(picture, width, height);
        let integral = Integral::of(&copy, !cascade.is_lbp(), cascade.is_tilted());
        let stride = integral.stride;
        let (w, h) = (cascade.width as i32, cascade.height as i32);
        let laid = cascade.features.iter().map(|feature| match feature {
            Feature::Haar(haar) => Laid::Haar {
                areas: haar.areas.map(|(area, weight)| {
                    let lay = if haar.tilted { turned } else { upright };
                    (lay(area, stride), weight)
                }),
                tilted: haar.tilted,
            },
            Feature::Lbp([x, y, w, h]) => Laid::Lbp(std::array::from_fn(|i| {
                let (column, row) = ((i % 4) as i32, (i / 4) as i32);
                (y + row * h) as usize * stride + (x + column * w) as usize
            })),
        });
        Self {
            cascade,
            scale,
            columns: (width + 1).saturating_sub(cascade.width),
            rows: (height + 1).saturating_sub(cascade.height),
            // Large windows are shown at every pixel of their small copy.
            step: if scale >= 2.0 { 1 } else { 2 },
            laid: laid.collect(),
            norm: upright([1, 1, w - 2, h - 2], stride),
            norm_area: f64::from((w - 2) * (h - 2)),
            integral,
        }
    }

    fn scan(&self, found: &mut Vec<Scanned>) {
        let round = |v: f32| v.round_ties_even() as i32;
        let width = round(self.cascade.width as f32 * self.scale);
        let height = round(self.cascade.height as f32 * self.scale);
        for y in (0..self.rows).step_by(self.step) {
            let mut x = 0;
            while x < self.columns {
                match self.verdict(x, y) {
                    Verdict::Passed(score) => found.push(Scanned {
                        rectangle: Rectangle {
                            x: round(x as f32 * self.scale),
                            y: round(y as f32 * self.scale),
                            width,
                            height,
                        },
                        score,
                    }),
                    // What the very first stage refuses has no better neighbour.
                    Verdict::Refused(0) => x += self.step,
                    Verdict::Refused(_) | Verdict::Flat => {}
                }
                x += self.step;
            }
        }
    }

    fn verdict(&self, x: usize, y: usize) -> Verdict {
        let at = y * self.integral.stride + x;
        let factor = if self.cascade.is_lbp() {
            1.0
        } else {
            match self.one_over_deviation(at) {
                Some(factor) => factor,
                None => return Verdict::Flat,
            }
        };
        let mut votes = 0.0;
        for (number, stage) in self.cascade.stages.iter().enumerate() {
            votes = 0.0;
            for tree in &self.cascade.trees[stage.trees.clone()] {
                let mut next = 0;
                loop {
                    let index = tree.nodes.start + next as usize;
                    let node = &self.cascade.nodes[index];
                    let left = match &self.laid[node.feature as usize] {
                        Laid::Haar { areas, tilted } => {
                            self.haar(at, areas, *tilted) * factor < node.threshold
                        }
                        Laid::Lbp(lattice) => {
                            let code = self.code(at, lattice);
                            let subset = &self.cascade.subsets[index];
                            subset[code >> 5] >> (code & 31) & 1 == 1
                        }
                    };
                    next = if left { node.left } else { node.right };
                    if next <= 0 {
                        break;
                    }
                }
                let leaf = tree.first_leaf + next.unsigned_abs() as usize;
                votes += f64::from(self.cascade.leaves[leaf]);
            }
            if votes < f64::from(stage.threshold) {
                return Verdict::Refused(number);
            }
        }
        Verdict::Passed(votes)
    }

    /// One over the standard deviation of the window times its area, `None` if it is flat.
    fn one_over_deviation(&self, at: usize) -> Option<f32> {
        let sum_of = f64::from(sum(&self.integral.sum, at, &self.norm));
        let squares = f64::from(sum(&self.integral.squares, at, &self.norm) as u32);
        let spread = self.norm_area * squares - sum_of * sum_of;
        if spread <= 0.0 {
            return None;
        }
        let factor = (1.0 / spread.sqrt()) as f32;
        (self.norm_area * f64::from(factor) < 0.1).then_some(factor)
    }

    fn haar(&self, at: usize, areas: &[(Corners, f32); 3], tilted: bool) -> f32 {
        let table = if tilted {
            &self.integral.tilted
        } else {
            &self.integral.sum
        };
        let part = |i: usize| areas[i].1 * sum(table, at, &areas[i].0) as f32;
        let value = part(0) + part(1);
        if areas[2].1 == 0.0 {
            value
        } else {
            value + part(2)
        }
    }

    fn code(&self, at: usize, lattice: &[usize; 16]) -> usize {
        let table = &self.integral.sum;
        let block = |i: usize| {
            let corners = [lattice[i], lattice[i + 1], lattice[i + 4], lattice[i + 5]];
            sum(table, at, &corners)
        };
        let middle = block(5);
        // Clockwise from the upper left one, the first in the highest bit.
        [0, 1, 2, 6, 10, 9, 8, 4]
            .into_iter()
            .fold(0, |code, i| code << 1 | usize::from(block(i) >= middle))
    }
}

/// What a cascade says of a window.
enum Verdict {
    Passed(f64),
    Refused(usize),
    Flat,
}
