//! The features of a cascade over the tables of a picture.

use super::grid::RowGrid;
use super::histograms::{DIRECTIONS, Histograms, unit};
use super::integral::Integral;
use super::model::{Area, CascadeFeature, CascadeKind, any_tilted, kind};
use pilotage_raster::raster::Raster;

/// A corner-wise sum: four places of a table relative to the window's first.
pub(super) type CornerSum = [usize; 4];

/// Least sum over a cell of which OpenCV's HOG says more than zero, and what it adds to that of the
/// block against division by zero, grey levels.
pub(super) const LEAST_EDGE: f32 = 0.001;

fn sum(table: &[i32], at: usize, corners: &CornerSum) -> i32 {
    let [a, b, c, d] = corners.map(|offset| table[at + offset]);
    a.wrapping_sub(b).wrapping_sub(c).wrapping_add(d)
}

fn upright([x, y, w, h]: Area, grid: RowGrid) -> CornerSum {
    let at = |x: i32, y: i32| grid.place(x as usize, y as usize);
    [at(x, y), at(x + w, y), at(x, y + h), at(x + w, y + h)]
}

fn turned([x, y, w, h]: Area, grid: RowGrid) -> CornerSum {
    let at = |x: i32, y: i32| grid.place(x as usize, y as usize);
    [
        at(x, y),
        at(x - h, y + h),
        at(x + w, y + w),
        at(x + w - h, y + w + h),
    ]
}

/// A feature laid out for tables laid out in one way.
#[derive(Clone, Debug)]
pub(super) enum LaidOutFeature {
    Haar {
        areas: [(CornerSum, f32); 3],
        tilted: bool,
    },
    /// Corners of the four by four lattice of the nine blocks.
    Lbp([usize; 16]),
    Hog {
        cell: CornerSum,
        block: CornerSum,
        direction: usize,
    },
}

impl LaidOutFeature {
    /// Furthest place from the window's own that it asks for.
    pub fn reach(&self) -> usize {
        let furthest = |corners: &[usize]| corners.iter().copied().fold(0, usize::max);
        match self {
            LaidOutFeature::Haar { areas, .. } => {
                areas.iter().fold(0, |far, a| far.max(furthest(&a.0)))
            }
            LaidOutFeature::Lbp(lattice) => furthest(lattice),
            LaidOutFeature::Hog { cell, block, .. } => furthest(cell).max(furthest(block)),
        }
    }

    pub fn new(feature: &CascadeFeature, grid: RowGrid) -> Self {
        match feature {
            CascadeFeature::Haar(haar) => LaidOutFeature::Haar {
                areas: haar.areas.map(|(area, weight)| {
                    let lay = if haar.tilted { turned } else { upright };
                    (lay(area, grid), weight)
                }),
                tilted: haar.tilted,
            },
            CascadeFeature::Lbp([x, y, w, h]) => LaidOutFeature::Lbp(std::array::from_fn(|i| {
                let (column, row) = ((i % 4) as i32, (i / 4) as i32);
                grid.place((x + column * w) as usize, (y + row * h) as usize)
            })),
            CascadeFeature::Hog {
                cell: [x, y, w, h],
                component,
            } => {
                let number = usize::from(*component) / DIRECTIONS;
                let (column, row) = ((number % 2) as i32, (number / 2) as i32);
                LaidOutFeature::Hog {
                    cell: upright([x + column * w, y + row * h, *w, *h], grid),
                    block: upright([*x, *y, 2 * w, 2 * h], grid),
                    direction: usize::from(*component) % DIRECTIONS,
                }
            }
        }
    }
}

/// Tables from which features of one kind are computed.
#[derive(Clone, Debug, Default)]
pub(super) struct FeatureTables {
    pub integral: Integral,
    pub histograms: Histograms,
}

/// Features laid out for tables laid out in one way.
#[derive(Clone, Debug)]
pub(super) struct FeatureLayout {
    pub grid: RowGrid,
    pub kind: CascadeKind,
    with_tilted: bool,
    pub laid: Vec<LaidOutFeature>,
    /// Corners of what a window's deviation is taken of.
    pub norm: CornerSum,
    /// Its area, pixels.
    pub norm_area: f64,
    /// Grey levels of a one in the histograms.
    pub unit: f32,
}

impl FeatureLayout {
    /// For windows of `width` × `height` pixels in pictures whose tables lie so.
    pub fn new(features: &[CascadeFeature], width: usize, height: usize, grid: RowGrid) -> Self {
        Self {
            laid: features
                .iter()
                .map(|f| LaidOutFeature::new(f, grid))
                .collect(),
            ..Self::of_windows(features, width, height, grid)
        }
    }

    /// Layout without the features: the tables that such features need and the normalization of windows.
    pub fn of_windows(
        features: &[CascadeFeature],
        width: usize,
        height: usize,
        grid: RowGrid,
    ) -> Self {
        let (w, h) = (width as i32, height as i32);
        Self {
            grid,
            kind: kind(features),
            with_tilted: any_tilted(features),
            laid: Vec::new(),
            norm: upright([1, 1, w - 2, h - 2], grid),
            norm_area: f64::from((w - 2) * (h - 2)),
            unit: unit(width * height),
        }
    }

    /// Number of features.
    pub fn len(&self) -> usize {
        self.laid.len()
    }

    /// The tables of a picture.
    pub fn tables(&self, picture: &Raster<u8>) -> FeatureTables {
        let mut tables = FeatureTables::default();
        self.fill(&mut tables, picture);
        tables
    }

    /// The tables of a picture, in the memory of others.
    pub fn fill(&self, tables: &mut FeatureTables, picture: &Raster<u8>) {
        if self.kind == CascadeKind::Hog {
            tables.histograms.fill(picture, self.grid, self.unit);
        } else {
            let with_squares = self.kind == CascadeKind::Haar;
            let integral = &mut tables.integral;
            integral.fill(picture, self.grid, with_squares, self.with_tilted);
        }
    }

    /// Factor on the values of Haar features in a window: one over its standard deviation times its area.
    /// `None` if the window is flat; one for other features.
    pub fn factor(&self, tables: &FeatureTables, at: usize) -> Option<f32> {
        if self.kind != CascadeKind::Haar {
            return Some(1.0);
        }
        let integral = &tables.integral;
        let sum_of = f64::from(sum(&integral.sum, at, &self.norm));
        let squares = f64::from(sum(&integral.squares, at, &self.norm) as u32);
        let spread = self.norm_area * squares - sum_of * sum_of;
        if spread <= 0.0 {
            return None;
        }
        let factor = (1.0 / spread.sqrt()) as f32;
        (self.norm_area * f64::from(factor) < 0.1).then_some(factor)
    }

    /// Value of a Haar feature times `factor`, or of a HOG feature; an LBP code as a number.
    #[inline]
    pub fn value(&self, tables: &FeatureTables, feature: usize, at: usize, factor: f32) -> f32 {
        match &self.laid[feature] {
            LaidOutFeature::Haar { areas, tilted } => {
                let integral = &tables.integral;
                let table = if *tilted {
                    &integral.tilted
                } else {
                    &integral.sum
                };
                let part = |i: usize| areas[i].1 * sum(table, at, &areas[i].0) as f32;
                let value = part(0) + part(1);
                let value = if areas[2].1 == 0.0 {
                    value
                } else {
                    value + part(2)
                };
                value * factor
            }
            LaidOutFeature::Lbp(_) => self.code(tables, feature, at) as f32,
            LaidOutFeature::Hog {
                cell,
                block,
                direction,
            } => {
                let histograms = &tables.histograms;
                let edges = |table, corners| sum(table, at, corners) as f32 * self.unit;
                let own = edges(&histograms.directions[*direction], cell);
                if own > LEAST_EDGE {
                    own / (edges(&histograms.all, block) + LEAST_EDGE)
                } else {
                    0.0
                }
            }
        }
    }

    /// Code of an LBP feature, 0 to 255; zero for others.
    #[inline]
    pub fn code(&self, tables: &FeatureTables, feature: usize, at: usize) -> usize {
        let LaidOutFeature::Lbp(lattice) = &self.laid[feature] else {
            return 0;
        };
        let table = &tables.integral.sum;
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
