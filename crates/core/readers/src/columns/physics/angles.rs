//! Directions against the direction of the track: unit, sense and zero together.

use pilotage_base::sorting::sort;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::board::{FlightColumns, Id, UnitBasis};
use super::grid::{TimeCells, quantile};
use crate::cells::Dimension;

/// From where and in which sense a direction is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Convention {
    /// Clockwise from north.
    Compass,
    /// Against the clock from east, as ROS has it.
    FromEast,
    /// Against the clock from north.
    FromNorthLeft,
    /// Clockwise from south: where something comes from.
    Reverse,
}

impl Convention {
    /// Sign and offset, radians, that make a compass direction of it.
    pub fn terms(self) -> (f64, f64) {
        match self {
            Self::Compass => (1.0, 0.0),
            Self::FromEast => (-1.0, FRAC_PI_2),
            Self::FromNorthLeft => (-1.0, 0.0),
            Self::Reverse => (1.0, PI),
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::Compass => "counted clockwise from north",
            Self::FromEast => {
                "counted against the clock from east, as ROS has it; turned to clockwise from north"
            }
            Self::FromNorthLeft => "counted against the clock from north; turned to clockwise",
            Self::Reverse => "it says where things come from; turned around",
        }
    }
}

/// A way to read a column as a direction.
#[derive(Clone, Debug)]
pub(super) struct DirectionReading {
    pub unit: &'static str,
    pub convention: Convention,
    /// Mean cosine of its difference from the reference, with a little more for what was expected.
    pub score: f64,
    /// Mean difference, radians.
    pub off: f64,
    /// The direction in the middle of each cell, radians, unwrapped.
    pub cells: Vec<f64>,
}

impl DirectionReading {
    /// Says what is unusual about how the column `id` was read: `stated`, if its table says otherwise.
    pub fn tell(&self, board: &mut FlightColumns, id: Id, stated: Option<String>) {
        let name = board.name(id);
        if let Some(stated) = stated {
            board.tell(id.0, format!("{name}: {stated}"));
        } else if self.unit != "deg" && self.unit != "rad" {
            board.tell(
                id.0,
                format!(
                    "{name}: read in {}, as the track's direction says",
                    self.unit
                ),
            );
        }
        if self.convention != Convention::Compass {
            board.tell(id.0, format!("{name}: {}", self.convention.words()));
        }
    }

    /// Reads the column so.
    pub fn apply(&self, board: &mut FlightColumns, id: Id, what: &str) {
        let (sign, offset) = self.convention.terms();
        let factor = Dimension::Angle.factor(Some(self.unit)).unwrap_or(1.0);
        let role = board.column(id).role;
        board.assign(id, role, sign, tidy(offset / factor));
        board.found(
            id,
            self.unit,
            &format!(
                "in {}, {}, it agrees with {what}",
                self.unit,
                self.convention.words()
            ),
        );
    }
}

/// An offset of whole units where it is one but for rounding.
pub(super) fn tidy(value: f64) -> f64 {
    let whole = value.round();
    if (value - whole).abs() < 1e-6 * value.abs().max(1.0) && whole.abs() >= 90.0 {
        whole
    } else {
        value
    }
}

/// Every way to read a column as a direction, against a reference per cell, the best first.
pub(super) fn readings(
    board: &FlightColumns,
    grid: &TimeCells,
    id: Id,
    reference: &[f64],
    conventions: &[Convention],
) -> Vec<DirectionReading> {
    let raw = board.raw(id);
    // A few damaged cells say nothing of the unit, nor does what it shows as long as nothing tells a direction.
    let told = grid.where_known(&raw.map(f64::abs), reference);
    let reach = quantile(&told, 0.95);
    let is_stated = board.basis(id) == UnitBasis::Stated;
    let expected = board.column(id).unit.clone();
    let mut found = Vec::new();
    for unit in Dimension::Angle.names() {
        let factor = Dimension::Angle.factor(Some(unit)).unwrap_or(1.0);
        // A direction goes at least some way, and hardly ever more than two turns.
        if !(0.02..2.05 * TAU).contains(&(reach * factor)) {
            continue;
        }
        let middle = grid.middle(&raw.map(|value| value * factor).unwrapped());
        for convention in conventions {
            let (sign, offset) = convention.terms();
            let cells: Vec<f64> = middle.iter().map(|value| sign * value + offset).collect();
            let Some((cosine, off)) = agreement(reference, &cells) else {
                continue;
            };
            // One that hardly turns in a unit agrees with anything: it has to turn as the track does.
            if unit != expected && spread(&cells) < 0.5 * spread(reference) {
                continue;
            }
            let bonus = match (unit == expected, is_stated) {
                (true, true) => 0.2,
                (true, false) => 0.08,
                _ => 0.0,
            } + if *convention == Convention::Compass {
                0.05
            } else {
                0.0
            };
            found.push(DirectionReading {
                unit,
                convention: *convention,
                score: cosine + bonus,
                off,
                cells,
            });
        }
    }
    sort(&mut found, &|a, b| b.score.total_cmp(&a.score));
    found
}

/// Mean cosine of the difference of two directions, and the mean difference; `None` with too little of both.
pub(super) fn agreement(reference: &[f64], cells: &[f64]) -> Option<(f64, f64)> {
    let pairs = reference.iter().zip(cells);
    let differences: Vec<f64> = pairs
        .map(|(a, b)| b - a)
        .filter(|d| d.is_finite())
        .collect();
    if differences.len() < 8 {
        return None;
    }
    let count = differences.len() as f64;
    let cosine: f64 = differences.iter().map(|d| d.cos()).sum::<f64>() / count;
    let sine: f64 = differences.iter().map(|d| d.sin()).sum::<f64>() / count;
    Some((cosine, sine.atan2(cosine)))
}

/// Spread of directions around their mean, 0 to 1: 0 of a straight way, 1 of one in all directions.
pub(super) fn spread(directions: &[f64]) -> f64 {
    let finite: Vec<f64> = directions
        .iter()
        .copied()
        .filter(|d| d.is_finite())
        .collect();
    let count = finite.len().max(1) as f64;
    let cosine: f64 = finite.iter().map(|d| d.cos()).sum::<f64>() / count;
    let sine: f64 = finite.iter().map(|d| d.sin()).sum::<f64>() / count;
    1.0 - cosine.hypot(sine)
}
