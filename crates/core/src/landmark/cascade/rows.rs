//! Every window of a picture shown to a cascade, many at once.

use super::grid::Grid;
use super::layout::{Layout, Tables};
use super::model::{Cascade, Kind};
use super::simd::{self, Program, Windows};
use crate::raster::Raster;

/// Rows whose windows are shown the later stages together.
pub(super) const BATCH: usize = 16;

/// A picture that a cascade is shown many windows at once.
pub(super) struct Rows<'a> {
    cascade: &'a Cascade,
    layout: Layout,
    tables: Tables,
    program: Program,
    /// Windows in a row.
    columns: usize,
    /// Rows of windows.
    pub height: usize,
}

/// Memory that is used again from level to level.
#[derive(Default)]
pub(super) struct Scratch {
    tables: Tables,
    factors: Vec<f32>,
    row: Windows,
    batch: Windows,
}

impl<'a> Rows<'a> {
    /// Every `step`th window of every row, which is 1 or 2.
    pub fn new(
        cascade: &'a Cascade,
        picture: &Raster<u8>,
        step: usize,
        scratch: &mut Scratch,
    ) -> Self {
        let grid = Grid::new(picture.width(), step);
        let layout = Layout::of_windows(&cascade.features, cascade.width, cascade.height, grid);
        let columns = (picture.width() + 1).saturating_sub(cascade.width);
        let mut tables = std::mem::take(&mut scratch.tables);
        layout.fill(&mut tables, picture);
        Self {
            cascade,
            tables,
            program: Program::new(cascade, &layout),
            layout,
            columns: columns.div_ceil(step),
            height: (picture.height() + 1).saturating_sub(cascade.height),
        }
    }

    /// Gives the memory of the tables back.
    pub fn end(self, scratch: &mut Scratch) {
        scratch.tables = self.tables;
    }

    /// Window's number in its row, and its pixel row, of its place in the tables.
    pub fn position(&self, place: usize) -> (usize, usize) {
        let stride = self.layout.grid.stride;
        (place % stride, place / stride)
    }

    /// Shows the windows of the rows that begin at pixel rows `ys`, at most [`BATCH`] of them, stage
    /// after stage: to each stage those that passed the one before. If `skips`, a window is left out
    /// whose left neighbour was refused by the first stage. After each stage `judged` gets the
    /// stage's number, each window's place and its votes; of flat windows nothing.
    pub fn show(
        &self,
        ys: impl Iterator<Item = usize>,
        skips: bool,
        scratch: &mut Scratch,
        mut judged: impl FnMut(usize, usize, f64),
    ) {
        let Scratch {
            factors,
            row,
            batch,
            ..
        } = scratch;
        factors.clear();
        factors.resize(self.columns, 1.0);
        batch.clear();
        let stages = &self.cascade.stages;
        if stages.is_empty() || self.columns == 0 {
            return;
        }
        for y in ys {
            let first = self.layout.grid.place(0, y);
            if self.layout.kind == Kind::Haar {
                simd::factors(&self.layout, &self.tables, first, factors);
            }
            row.clear();
            for (number, &factor) in factors.iter().enumerate() {
                if !factor.is_nan() {
                    row.push(first + number, factor);
                }
            }
            simd::vote(&self.program, 0, &self.tables, row);
            let least = f64::from(stages[0].threshold);
            let mut skipped = usize::MAX;
            for (i, &place) in row.at.iter().enumerate() {
                if place == skipped {
                    continue;
                }
                judged(0, place, row.votes[i]);
                if row.votes[i] >= least {
                    batch.push(place, row.factor[i]);
                } else if skips {
                    // What the very first stage refuses has no better neighbour.
                    skipped = place + 1;
                }
            }
        }
        for (number, stage) in stages.iter().enumerate().skip(1) {
            simd::vote(&self.program, number, &self.tables, batch);
            let least = f64::from(stage.threshold);
            batch.retain(|place, votes| {
                judged(number, place, votes);
                votes >= least
            });
        }
    }
}
