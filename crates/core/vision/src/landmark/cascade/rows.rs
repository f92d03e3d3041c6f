//! Every window of a picture shown to a cascade, many at once.

use super::grid::RowGrid;
use super::layout::{FeatureLayout, FeatureTables};
use super::model::{Cascade, CascadeKind};
use super::simd::{self, CascadeProgram, RunningWindows};
use pilotage_raster::raster::Raster;

/// Rows whose windows are shown the later stages together.
pub(super) const BATCH: usize = 16;

/// A picture that a cascade is shown many windows at once.
pub(super) struct RowsOfWindows<'a> {
    cascade: &'a Cascade,
    layout: FeatureLayout,
    tables: FeatureTables,
    program: CascadeProgram,
    /// Windows in a row.
    columns: usize,
    /// Rows of windows.
    pub height: usize,
}

/// Verdict of a stage on a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct JudgedWindow {
    /// Number of the stage.
    pub stage: usize,
    /// Place of the window in the tables.
    pub place: usize,
    /// Sum of the votes.
    pub votes: f64,
    /// Sum over the stages met so far of votes less threshold.
    pub margin: f64,
    /// Whether it passes.
    pub passed: bool,
}

/// Memory that is used again from level to level.
#[derive(Default)]
pub(super) struct Scratch {
    tables: FeatureTables,
    factors: Vec<f32>,
    votes: Vec<f64>,
    batch: RunningWindows,
}

impl<'a> RowsOfWindows<'a> {
    /// Every `step`th window of every row, which is 1 or 2.
    pub fn new(
        cascade: &'a Cascade,
        picture: &Raster<u8>,
        step: usize,
        scratch: &mut Scratch,
    ) -> Self {
        let grid = RowGrid::new(picture.width(), step);
        let layout =
            FeatureLayout::of_windows(&cascade.features, cascade.width, cascade.height, grid);
        let columns = (picture.width() + 1).saturating_sub(cascade.width);
        let mut tables = std::mem::take(&mut scratch.tables);
        layout.fill(&mut tables, picture);
        Self {
            cascade,
            tables,
            program: CascadeProgram::new(cascade, &layout),
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
    /// after stage: to each stage those that passed the one before; of each row every `every`th, or
    /// if that is `None` all but those whose left neighbour was refused by the first stage.
    pub fn show(
        &self,
        ys: impl Iterator<Item = usize>,
        every: Option<usize>,
        scratch: &mut Scratch,
        mut judged: impl FnMut(JudgedWindow),
    ) {
        let Scratch {
            factors,
            votes,
            batch,
            ..
        } = scratch;
        factors.clear();
        factors.resize(self.columns, 1.0);
        votes.resize(self.columns, 0.0);
        batch.clear();
        let stages = &self.cascade.stages;
        if stages.is_empty() || self.columns == 0 {
            return;
        }
        for y in ys {
            let first = self.layout.grid.place(0, y);
            if self.layout.kind == CascadeKind::Haar {
                simd::factors(&self.layout, &self.tables, first, factors);
            }
            simd::first_votes(&self.program, &self.tables, first, factors, votes);
            let mut number = 0;
            while number < self.columns {
                let (place, factor) = (first + number, factors[number]);
                number += every.unwrap_or(1);
                if factor.is_nan() {
                    continue;
                }
                let seen = self.judge(0, place, votes[place - first], 0.0);
                judged(seen);
                if seen.passed {
                    batch.push(place, factor, seen.margin);
                } else if every.is_none() {
                    // What the very first stage refuses has no better neighbour.
                    number += 1;
                }
            }
        }
        for stage in 1..stages.len() {
            simd::vote(&self.program, stage, &self.tables, batch);
            batch.retain(|place, votes, margin| {
                let seen = self.judge(stage, place, votes, *margin);
                judged(seen);
                *margin = seen.margin;
                seen.passed
            });
        }
    }

    fn judge(&self, stage: usize, place: usize, votes: f64, margin: f64) -> JudgedWindow {
        let excess = votes - f64::from(self.cascade.stages[stage].threshold);
        JudgedWindow {
            stage,
            place,
            votes,
            margin: margin + excess,
            passed: excess >= 0.0,
        }
    }
}
