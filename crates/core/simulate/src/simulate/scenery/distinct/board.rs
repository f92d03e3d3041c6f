//! Drawing in a building's own coordinates, and the colours of roofs.

use std::f32::consts::FRAC_PI_2;

use super::super::noise::Dice;
use super::super::plan::SceneryPlan;
use super::super::scene_kind::SceneKind;
use super::super::shape::{Slab, Spot};
use super::super::things::Habit;

pub(super) const SLATE: [f32; 3] = [0.085, 0.088, 0.1];
pub(super) const RED_TILE: [f32; 3] = [0.16, 0.08, 0.056];
pub(super) const WHITE_STEEL: [f32; 3] = [0.4, 0.405, 0.405];
pub(super) const GRAY_FELT: [f32; 3] = [0.2, 0.2, 0.195];
pub(super) const GREEN_METAL: [f32; 3] = [0.088, 0.118, 0.098];
pub(super) const RUST_METAL: [f32; 3] = [0.185, 0.125, 0.095];
pub(super) const GLASS: [f32; 3] = [0.34, 0.4, 0.39];
pub(super) const CONCRETE: [f32; 3] = [0.26, 0.25, 0.235];

/// A drawing board at a place: coordinates along and across a heading.
pub(super) struct DrawingBoard {
    pub(super) frame: Slab,
    /// Heading of the `along` axis, radians.
    pub(super) angle: f32,
}

impl DrawingBoard {
    pub(super) fn new(center: Spot, angle: f32) -> Self {
        Self {
            frame: Slab::new(center, angle, 1.0, 1.0),
            angle,
        }
    }
    pub(super) fn at(&self, along: f32, across: f32) -> Spot {
        self.frame.at(along, across)
    }
    /// A rectangle of `length` along by `width` across.
    pub(super) fn slab(&self, along: f32, across: f32, length: f32, width: f32) -> Slab {
        Slab::new(self.at(along, across), self.angle, length, width)
    }
    /// The same turned by a quarter: the ridge runs across.
    pub(super) fn turned(&self, along: f32, across: f32, length: f32, width: f32) -> Slab {
        Slab::new(
            self.at(along, across),
            self.angle + FRAC_PI_2,
            width,
            length,
        )
    }
    pub(super) fn outline(&self, corners: &[(f32, f32)]) -> Vec<Spot> {
        corners.iter().map(|&(u, v)| self.at(u, v)).collect()
    }
}

/// Trees at fixed places: along, across, crown radius.
pub(super) fn trees(plan: &mut SceneryPlan, board: &DrawingBoard, places: &[(f32, f32, f32)]) {
    let mut dice = Dice::new(41, plan.crowns.len() as u64);
    for &(u, v, radius) in places {
        plan.plant(board.at(u, v), radius, Habit::Broadleaf, &mut dice);
    }
}

/// A clipped hedge from one place to another.
pub(super) fn hedge(
    plan: &mut SceneryPlan,
    board: &DrawingBoard,
    from: (f32, f32),
    to: (f32, f32),
) {
    let mut dice = Dice::new(43, plan.crowns.len() as u64);
    let (a, b) = (board.at(from.0, from.1), board.at(to.0, to.1));
    let steps = ((b - a).length() / 0.8) as usize;
    for i in 0..=steps {
        let p = a + (b - a) * (i as f32 / steps.max(1) as f32);
        let radius = dice.range(0.75, 0.95);
        plan.plant(p, radius, Habit::Shrub, &mut dice);
    }
}

/// Reserves the site and announces the building as a distinct feature.
pub(super) fn finish(
    plan: &mut SceneryPlan,
    name: &str,
    board: &DrawingBoard,
    corners: &[(f32, f32)],
    size: (f32, f32),
) {
    let site = board.slab(0.0, 0.0, size.0, size.1);
    plan.reserved.push(site);
    plan.announce(name, SceneKind::Building, board.outline(corners), &site);
}
