//! Places where trees grow: woods, hedges, road sides, water sides and single trees.

use super::bend::{bent, unbent};
use super::grid::{CellLists, REACH};
use super::noise::{Dice, hash2, unit, value_noise};
use super::parcels::{Parcels, Use};
use super::plan::{RoadPiece, SceneryPlan};
use super::shape::{Spot, spot};
use super::texture::PeriodicTexture;
use super::things::{Habit, SceneryRoadClass};

/// Obstacles that keep trees away, looked up by cells.
pub(super) struct TreeObstacles<'a> {
    pub(super) land: &'a PeriodicTexture,
    pub(super) segments: &'a [RoadPiece],
    pub(super) segment_grid: &'a CellLists,
    pub(super) surface_grid: &'a CellLists,
    pub(super) solid_grid: &'a CellLists,
}

impl TreeObstacles<'_> {
    /// Whether a crown of that radius may stand there.
    fn is_open(&self, plan: &SceneryPlan, p: Spot, radius: f32) -> bool {
        let clear_of_roads = self.segment_grid.at(p).iter().all(|&i| {
            let s = &self.segments[i as usize];
            s.measure(p).0 > s.half_width + (0.75 * radius).min(4.0) + 0.6
        });
        clear_of_roads
            && self.surface_grid.at(p).iter().all(|&i| {
                let s = &plan.surfaces[i as usize];
                s.ground == super::things::SurfaceMaterial::Grass
                    || s.outline.distance(p) > 0.4 * radius
            })
            && self
                .solid_grid
                .at(p)
                .iter()
                .all(|&i| plan.solids[i as usize].distance(p) > radius)
    }
}

/// Plants woods and hedges on the parcels, with a few single trees.
pub(super) fn plant(plan: &mut SceneryPlan, parcels: &Parcels, ground: &TreeObstacles, seed: u64) {
    let mut dice = Dice::new(seed, 31);
    let pitch = 5.0;
    let count = (2.0 * REACH / pitch) as i32;
    for row in 0..count {
        for column in 0..count {
            let h = hash2(row, column, seed as u32);
            let p = spot(
                (row as f32 + 0.9 * unit(h)) * pitch - REACH,
                (column as f32 + 0.9 * unit(h.wrapping_mul(0x9e37_79b1))) * pitch - REACH,
            );
            let located = parcels.locate(unbent(ground.land, p));
            let parcel = &parcels.parcels[located.parcel as usize];
            let wobble = 5.0 * value_noise(p.n * 0.05, p.e * 0.05, 77);
            let habit = match parcel.use_ {
                Use::Wood if located.edge > 3.0 + wobble => {
                    if dice.chance(0.12) {
                        Habit::Conifer
                    } else {
                        Habit::Broadleaf
                    }
                }
                Use::ConiferWood if located.edge > 3.0 + wobble => {
                    if dice.chance(0.9) {
                        Habit::Conifer
                    } else {
                        Habit::Broadleaf
                    }
                }
                Use::Orchard if located.edge > 6.0 => continue,
                _ => {
                    let lone = unit(h.rotate_left(9)) < 0.0035;
                    if lone && parcel.use_ == Use::Grassland {
                        Habit::Broadleaf
                    } else {
                        continue;
                    }
                }
            };
            // Glades, and groups of bigger and smaller trees.
            let stand = value_noise(p.n * 0.023, p.e * 0.023, 78);
            if stand < -0.72 || dice.chance(0.04) {
                continue;
            }
            let radius = match habit {
                Habit::Conifer => dice.range(1.6, 3.2) + 0.4 * stand,
                _ => 1.9 + 3.6 * dice.unit().powi(2) + 0.9 * dice.unit() + 0.8 * stand,
            };
            let habit = if dice.chance(0.006) {
                Habit::Dead
            } else {
                habit
            };
            if ground.is_open(plan, p, radius) {
                plan.plant(p, radius.max(1.1), habit, &mut dice);
            }
        }
    }
    undergrowth(plan, parcels, ground, &mut dice);
    banks(plan, ground, &mut dice);
    hedges(plan, parcels, ground, &mut dice);
    orchards(plan, parcels, ground, &mut dice);
}

/// Shrubs between the trees and along the edges of woods.
fn undergrowth(plan: &mut SceneryPlan, parcels: &Parcels, ground: &TreeObstacles, dice: &mut Dice) {
    for parcel in parcels
        .parcels
        .iter()
        .filter(|p| p.use_ == Use::Wood || p.use_ == Use::ConiferWood)
    {
        let Some(bounds) = bounds(&parcel.corners) else {
            continue;
        };
        let area = (bounds.1.n - bounds.0.n) * (bounds.1.e - bounds.0.e);
        for _ in 0..(area / 45.0) as usize {
            let p = spot(
                dice.range(bounds.0.n, bounds.1.n),
                dice.range(bounds.0.e, bounds.1.e),
            );
            let depth = -super::shape::polygon_distance(&parcel.corners, unbent(ground.land, p));
            if depth < 0.5 || depth > 14.0 && dice.chance(0.5) {
                continue;
            }
            let radius = dice.range(0.7, 1.9);
            if ground.is_open(plan, p, radius) {
                plan.plant(p, radius, Habit::Shrub, dice);
            }
        }
    }
}

fn bounds(corners: &[Spot]) -> Option<(Spot, Spot)> {
    let fold = |f: fn(f32, f32) -> f32, of: fn(&Spot) -> f32| corners.iter().map(of).reduce(f);
    Some((
        spot(fold(f32::min, |c| c.n)?, fold(f32::min, |c| c.e)?),
        spot(fold(f32::max, |c| c.n)?, fold(f32::max, |c| c.e)?),
    ))
}

/// Bushes and trees along water.
fn banks(plan: &mut SceneryPlan, ground: &TreeObstacles, dice: &mut Dice) {
    let ponds = plan
        .surfaces
        .iter()
        .filter(|s| s.ground == super::things::SurfaceMaterial::Pond)
        .map(|s| {
            let mut corners = s.outline.corners();
            corners.extend(corners.first().copied());
            (corners, 0.0)
        });
    let streams = plan
        .roads
        .iter()
        .filter(|r| r.class == SceneryRoadClass::Stream)
        .map(|r| (r.curve.clone(), r.half_width));
    let lines: Vec<(Vec<Spot>, f32)> = ponds.chain(streams).collect();
    for (line, half_width) in lines {
        for w in line.windows(2) {
            let length = (w[1] - w[0]).length();
            let mut along = dice.range(0.0, 3.0);
            while along < length {
                let p = w[0] + (w[1] - w[0]) * (along / length);
                let outward = (w[1] - w[0]).unit().right() * dice.pick(&[-1.0, 1.0]);
                let tree = dice.chance(0.2);
                let radius = if tree {
                    dice.range(1.8, 4.6)
                } else {
                    dice.range(0.5, 1.6)
                };
                let q = p + outward * (half_width + 0.5 * radius + dice.range(0.3, 2.0));
                let dense = value_noise(p.n * 0.03, p.e * 0.03, 95) > -0.3;
                if dense && ground.is_open(plan, q, 0.4 * radius) {
                    let habit = if tree { Habit::Broadleaf } else { Habit::Shrub };
                    plan.plant(q, radius, habit, dice);
                }
                along += dice.range(0.7, 3.0);
            }
        }
    }
}

fn hedges(plan: &mut SceneryPlan, parcels: &Parcels, ground: &TreeObstacles, dice: &mut Dice) {
    for parcel in &parcels.parcels {
        if !parcel.hedged {
            continue;
        }
        for i in 0..parcel.corners.len() {
            let (a, b) = (
                parcel.corners[i],
                parcel.corners[(i + 1) % parcel.corners.len()],
            );
            if dice.chance(0.35) {
                continue;
            }
            let axis = (b - a).unit();
            let length = (b - a).length();
            let mut along = dice.range(0.0, 6.0);
            let thick = dice.range(0.0, 1.0);
            while along < length {
                let p = bent(
                    ground.land,
                    a + axis * along + axis.right() * dice.range(-0.9, 0.9),
                );
                let gap = value_noise(p.n * 0.03, p.e * 0.03, 91) < -0.35;
                let tree = dice.chance(0.07 + 0.15 * thick);
                let r = if tree {
                    dice.range(2.2, 4.6)
                } else {
                    dice.range(0.8, 1.6)
                };
                let habit = if tree { Habit::Broadleaf } else { Habit::Shrub };
                if !gap && ground.is_open(plan, p, r) {
                    plan.plant(p, r, habit, dice);
                }
                along += if gap { 5.0 } else { dice.range(0.9, 1.9) };
            }
        }
    }
}

fn orchards(plan: &mut SceneryPlan, parcels: &Parcels, ground: &TreeObstacles, dice: &mut Dice) {
    for parcel in parcels.parcels.iter().filter(|p| p.use_ == Use::Orchard) {
        let center = super::parcels::center_of(&parcel.corners);
        for i in -40..40 {
            for j in -40..40 {
                let p = center
                    + parcel.axis * (i as f32 * 5.0 + dice.range(-0.4, 0.4))
                    + parcel.axis.right() * (j as f32 * 6.0 + dice.range(-0.3, 0.3));
                let inside =
                    super::shape::polygon_distance(&parcel.corners, unbent(ground.land, p)) < -6.0;
                let r = dice.range(1.3, 2.2);
                if inside && !dice.chance(0.06) && ground.is_open(plan, p, r) {
                    plan.plant(p, r, Habit::Broadleaf, dice);
                }
            }
        }
    }
}
