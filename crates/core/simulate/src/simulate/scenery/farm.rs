//! A farm: yard, barns, house, silos, bales and machinery.

use std::f32::consts::{FRAC_PI_2, PI};

use super::house::ROOFS;
use super::noise::Dice;
use super::plan::SceneryPlan;
use super::scene_kind::SceneKind;
use super::shape::{GroundOutline, Slab, Spot, smooth_curve};
use super::things::{Habit, PropForm, Road, Roof, RoofCover, SceneryRoadClass, SurfaceMaterial};

/// Builds a farm around its yard, and a track to the nearest road.
pub(super) fn build(plan: &mut SceneryPlan, center: Spot, angle: f32, dice: &mut Dice) {
    let yard = Slab::new(
        center,
        angle,
        dice.range(52.0, 66.0),
        dice.range(40.0, 52.0),
    );
    plan.lay(
        GroundOutline::Slab(yard),
        SurfaceMaterial::Dirt,
        yard.axis,
        3.5,
        Some(SceneKind::Yard),
    );
    plan.reserved.push(yard.grown(4.0));
    let (a, b) = (yard.half_along, yard.half_across);
    let colors = [
        [0.3, 0.31, 0.31],
        [0.17, 0.1, 0.08],
        [0.12, 0.17, 0.13],
        [0.32, 0.32, 0.31],
        [0.16, 0.14, 0.13],
    ];
    let barn = Slab::new(
        yard.at(-0.3 * a, -b + 9.0),
        angle,
        dice.range(26.0, 34.0),
        13.0,
    );
    plan.raise(
        barn,
        Roof::Gable,
        RoofCover::Metal,
        dice.pick(&colors),
        5.0,
        3.2,
        SceneKind::Building,
    );
    let second = Slab::new(
        yard.at(a - 9.0, -2.0),
        angle + FRAC_PI_2,
        dice.range(16.0, 24.0),
        11.0,
    );
    plan.raise(
        second,
        Roof::Gable,
        RoofCover::Metal,
        dice.pick(&colors),
        4.2,
        2.4,
        SceneKind::Building,
    );
    if dice.chance(0.7) {
        let open = Slab::new(
            yard.at(-0.2 * a, b - 6.0),
            angle,
            dice.range(18.0, 26.0),
            8.0,
        );
        plan.raise(
            open,
            Roof::Gable,
            RoofCover::Metal,
            dice.pick(&colors),
            3.6,
            1.0,
            SceneKind::Building,
        );
    }
    let house = Slab::new(
        yard.at(-a - 9.0, 0.3 * b),
        angle + dice.range(-0.1, 0.1),
        13.0,
        9.0,
    );
    plan.lay_slab(house.grown(6.0), SurfaceMaterial::Lawn, 0.8);
    plan.reserved.push(house.grown(6.0));
    plan.raise(
        house,
        Roof::Gable,
        RoofCover::Tiles,
        dice.pick(&ROOFS),
        5.2,
        3.4,
        SceneKind::House,
    );
    clutter(plan, &yard, angle, dice);
    track(plan, center, dice);
}

/// Silos, bales, machinery and trees about a yard.
fn clutter(plan: &mut SceneryPlan, yard: &Slab, angle: f32, dice: &mut Dice) {
    let (a, b) = (yard.half_along, yard.half_across);
    for i in 0..dice.bits() % 3 {
        let r = dice.range(2.2, 3.2);
        let silo = Slab::new(
            yard.at(a - 5.0, b - 5.0 - 7.5 * i as f32),
            0.0,
            2.0 * r,
            2.0 * r,
        );
        plan.raise(
            silo,
            Roof::Cone,
            RoofCover::Plain,
            [0.34, 0.345, 0.345],
            dice.range(8.0, 13.0),
            1.5,
            SceneKind::Tank,
        );
    }
    for i in 0..(6 + dice.bits() % 14) {
        let p = yard.at(
            -a + 4.0 + 1.7 * (i % 7) as f32,
            b - 3.0 - 1.8 * (i / 7) as f32,
        );
        plan.put(
            Slab::new(p, angle + 0.04 * (i % 3) as f32, 1.4, 1.5),
            1.4,
            PropForm::Bale,
            [0.24, 0.205, 0.125],
        );
    }
    for _ in 0..4 {
        let p = yard.at(dice.range(-0.4, 0.6) * a, dice.range(-0.2, 0.5) * b);
        let slab = Slab::new(p, dice.range(0.0, PI), dice.range(3.5, 7.0), 2.2);
        if plan.is_clear_of_solids(&slab) {
            let color = dice.pick(&[
                [0.05, 0.11, 0.04],
                [0.17, 0.05, 0.035],
                [0.22, 0.16, 0.05],
                [0.2, 0.2, 0.2],
            ]);
            plan.put(
                slab,
                2.4,
                dice.pick(&[PropForm::Truck, PropForm::Crate]),
                color,
            );
        }
    }
    for _ in 0..9 {
        let p = yard.at(
            dice.range(-1.5, 1.2) * a,
            dice.pick(&[-1.0, 1.0]) * (b + dice.range(1.0, 7.0)),
        );
        let r = dice.range(2.0, 5.0);
        plan.plant(p, r, Habit::Broadleaf, dice);
    }
}

/// A track from the yard to the nearest road.
fn track(plan: &mut SceneryPlan, center: Spot, dice: &mut Dice) {
    let nearest = plan
        .roads
        .iter()
        .filter(|r| r.class > SceneryRoadClass::Track)
        .flat_map(|r| r.curve.iter().copied())
        .min_by(|x, y| (*x - center).length().total_cmp(&(*y - center).length()));
    if let Some(end) = nearest {
        let middle = (end + center) * 0.5 + (end - center).unit().right() * dice.range(-12.0, 12.0);
        plan.roads.push(Road {
            class: SceneryRoadClass::Track,
            curve: smooth_curve(&[end, middle, center], 5.0),
            half_width: 1.6,
            name: None,
            village: false,
        });
    }
}
