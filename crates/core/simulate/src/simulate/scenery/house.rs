//! House with its garden, drive and shed.

use std::f32::consts::FRAC_PI_2;

use super::noise::Dice;
use super::plan::SceneryPlan;
use super::scene_kind::SceneKind;
use super::shape::Slab;
use super::things::{Habit, Roof, RoofCover, SurfaceMaterial};

/// Linear reflectances of house roofs.
pub(super) const ROOFS: [[f32; 3]; 9] = [
    [0.135, 0.068, 0.048],
    [0.165, 0.085, 0.06],
    [0.11, 0.06, 0.045],
    [0.078, 0.078, 0.08],
    [0.11, 0.107, 0.104],
    [0.13, 0.105, 0.088],
    [0.165, 0.15, 0.135],
    [0.092, 0.074, 0.062],
    [0.175, 0.1, 0.072],
];

/// A lot being built on: its axis points away from the street.
struct Lot<'a> {
    slab: &'a Slab,
    heading: f32,
    /// Coordinate of the street side along the axis.
    front: f32,
    /// Half the width.
    half: f32,
    /// Side on which the drive lies: 1 or -1.
    mirror: f32,
    setback: f32,
}

/// Builds on a lot whose axis, with that heading, points away from the street.
pub(super) fn lot(plan: &mut SceneryPlan, slab: &Slab, heading: f32, dice: &mut Dice) {
    plan.lay_slab(*slab, SurfaceMaterial::Lawn, 0.35);
    let lot = Lot {
        slab,
        heading,
        front: -slab.half_along,
        half: slab.half_across,
        mirror: if dice.chance(0.5) { 1.0 } else { -1.0 },
        setback: dice.range(5.0, 8.0),
    };
    let (color, depth) = house(plan, &lot, dice);
    drive(plan, &lot, color, dice);
    if lot.front + lot.setback + depth + 6.0 < slab.half_along {
        garden(plan, &lot, depth, dice);
    }
    fences(plan, &lot, dice);
}

/// The house; gives its roof's colour and its greatest extent.
fn house(plan: &mut SceneryPlan, lot: &Lot, dice: &mut Dice) -> ([f32; 3], f32) {
    let (length, width) = (dice.range(9.5, 13.5), dice.range(7.2, 9.0));
    let wobble = dice.range(-0.05, 0.05);
    let across_street = dice.chance(0.7);
    let center = lot.slab.at(
        lot.front + lot.setback + 0.5 * if across_street { width } else { length },
        lot.mirror * -1.6,
    );
    let angle = lot.heading + wobble + if across_street { FRAC_PI_2 } else { 0.0 };
    let slab = Slab::new(center, angle, length, width);
    let mut color = dice.pick(&ROOFS);
    let shade = dice.range(0.8, 1.2);
    color = color.map(|c| c * shade);
    let roof = if dice.chance(0.68) {
        Roof::Gable
    } else {
        Roof::Hip
    };
    let eaves = dice.range(3.0, 5.6);
    let rise = width * dice.range(0.26, 0.42);
    plan.raise(
        slab,
        roof,
        RoofCover::Tiles,
        color,
        eaves,
        rise,
        SceneKind::House,
    );
    if dice.chance(0.4) {
        let wing = Slab::new(
            slab.at(0.25 * length * lot.mirror, 0.5 * width),
            angle + FRAC_PI_2,
            width * 0.9,
            5.0,
        );
        plan.raise(
            wing,
            roof,
            RoofCover::Tiles,
            color,
            eaves - 0.3,
            rise * 0.7,
            SceneKind::House,
        );
    }
    if dice.chance(0.6) {
        let at = slab.at(
            dice.range(-0.3, 0.3) * length,
            dice.range(-0.06, 0.06) * width,
        );
        plan.raise(
            Slab::new(at, angle, 0.75, 0.6),
            Roof::Flat,
            RoofCover::Plain,
            [0.16, 0.1, 0.08],
            eaves + rise + 0.4,
            0.0,
            SceneKind::House,
        );
    }
    (color, length.max(width))
}

/// Drive, garage and the walk to the door.
fn drive(plan: &mut SceneryPlan, lot: &Lot, color: [f32; 3], dice: &mut Dice) {
    let drive_v = lot.mirror * (lot.half - 2.3);
    let drive_length = lot.setback + dice.range(3.0, 9.0);
    let surface = dice.pick(&[
        SurfaceMaterial::Asphalt,
        SurfaceMaterial::Gravel,
        SurfaceMaterial::Paving,
        SurfaceMaterial::Concrete,
    ]);
    let drive = Slab::new(
        lot.slab.at(lot.front + 0.5 * drive_length - 1.2, drive_v),
        lot.heading,
        drive_length + 2.4,
        3.2,
    );
    plan.lay_slab(drive, surface, 0.1);
    plan.stalls.push((
        Slab::new(drive.at(dice.range(-2.0, 0.2), 0.0), lot.heading, 4.4, 1.8),
        0.6,
    ));
    if dice.chance(0.45) {
        let garage = Slab::new(
            lot.slab.at(lot.front + drive_length + 3.0, drive_v),
            lot.heading,
            6.0,
            3.6,
        );
        plan.raise(
            garage,
            Roof::Gable,
            RoofCover::Tiles,
            color,
            2.5,
            1.1,
            SceneKind::House,
        );
    }
    let walk = Slab::new(
        lot.slab
            .at(lot.front + 0.5 * lot.setback, lot.mirror * -1.6),
        lot.heading,
        lot.setback,
        1.2,
    );
    plan.lay_slab(walk, SurfaceMaterial::Paving, 0.05);
}

/// Patio, vegetable beds, shed and trees behind the house.
fn garden(plan: &mut SceneryPlan, lot: &Lot, depth: f32, dice: &mut Dice) {
    let back = lot.front + lot.setback + depth + 2.0;
    let patio = Slab::new(
        lot.slab.at(
            lot.front + lot.setback + 0.5 * depth + 5.4,
            lot.mirror * -2.0,
        ),
        lot.heading,
        3.5,
        5.0,
    );
    plan.lay_slab(patio, SurfaceMaterial::Paving, 0.05);
    if dice.chance(0.35) {
        let beds = Slab::new(
            lot.slab.at(lot.slab.half_along - 4.0, lot.mirror * 3.0),
            lot.heading,
            5.0,
            6.0,
        );
        plan.lay_slab(beds, SurfaceMaterial::Beds, 0.2);
    }
    if dice.chance(0.55) {
        let shed = Slab::new(
            lot.slab
                .at(lot.slab.half_along - 2.2, lot.mirror * -(lot.half - 2.2)),
            lot.heading,
            2.6,
            3.2,
        );
        let tone = dice.range(0.1, 0.3);
        plan.raise(
            shed,
            Roof::Gable,
            RoofCover::Felt,
            [tone, tone * 0.95, tone * 0.9],
            2.0,
            0.6,
            SceneKind::House,
        );
    }
    for _ in 0..dice.bits() % 5 {
        let u = dice.range(back, lot.slab.half_along);
        let v = dice.range(-lot.half, lot.half);
        let r = dice.range(1.3, 4.0);
        let p = lot.slab.at(u, v);
        if plan
            .solids
            .iter()
            .rev()
            .take(8)
            .all(|s| s.distance(p) > r * 0.5)
        {
            plan.plant(
                p,
                r,
                if dice.chance(0.85) {
                    Habit::Broadleaf
                } else {
                    Habit::Conifer
                },
                dice,
            );
        }
    }
}

/// Hedges and shrubs between neighbours.
fn fences(plan: &mut SceneryPlan, lot: &Lot, dice: &mut Dice) {
    for side in [-1.0, 1.0] {
        if dice.chance(0.5) {
            let mut u = lot.front + 3.0;
            while u < lot.slab.half_along {
                let r = dice.range(0.6, 1.0);
                plan.plant(
                    lot.slab.at(u, side * (lot.half - 0.3)),
                    r,
                    Habit::Shrub,
                    dice,
                );
                u += r * 1.05;
            }
        } else {
            for _ in 0..3 {
                let r = dice.range(0.4, 1.3);
                let p = lot.slab.at(
                    dice.range(lot.front + 1.0, lot.slab.half_along),
                    side * (lot.half - 1.0),
                );
                plan.plant(p, r, Habit::Shrub, dice);
            }
        }
    }
}
