//! Shops and works of the village, and the warehouse.

use std::f32::consts::FRAC_PI_2;

use super::super::plan::{LEG_ONE_HEADING, SceneryPlan, leg_one};
use super::super::scene_kind::SceneKind::{Building, Tank};
use super::super::shape::{Slab, spot};
use super::super::things::Roof::{Cone, Flat, Gable, Sawtooth};
use super::super::things::RoofCover::{Felt, Glass, Metal, Plain, Tiles};
use super::super::things::{PropForm, SurfaceMaterial};
use super::board::{DrawingBoard, GRAY_FELT, RED_TILE, finish, hedge, trees};

pub(super) fn supermarket(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(526.0, -14.0), LEG_ONE_HEADING - 0.12);
    plan.lay_slab(b.slab(0.0, 0.0, 64.0, 60.0), SurfaceMaterial::Asphalt, 0.4);
    plan.raise(
        b.slab(-4.0, -15.0, 46.0, 26.0),
        Flat,
        Felt,
        [0.36, 0.36, 0.345],
        7.0,
        0.0,
        Building,
    );
    plan.raise(
        b.slab(-4.0, 0.0, 40.0, 4.6),
        Gable,
        Metal,
        [0.19, 0.055, 0.045],
        4.2,
        1.2,
        Building,
    );
    for i in 0..9 {
        let (column, row) = ((i % 5) as f32, (i / 5) as f32);
        plan.raise(
            b.slab(-21.0 + 8.5 * column, -21.0 + 10.0 * row, 2.6, 3.4),
            Flat,
            Plain,
            [0.38, 0.39, 0.4],
            8.4,
            0.0,
            Building,
        );
    }
    for row in 0..2 {
        let across = 11.5 + 11.6 * row as f32;
        plan.lay_slab(b.slab(0.0, across, 58.0, 9.6), SurfaceMaterial::Stalls, 0.0);
        for i in 0..22 {
            for side in [-2.5, 2.5] {
                let s = Slab::new(
                    b.at(-27.3 + 2.6 * i as f32, across + side),
                    b.angle + FRAC_PI_2,
                    4.4,
                    1.8,
                );
                plan.stalls.push((s, 0.55));
            }
        }
    }
    trees(
        plan,
        &b,
        &[
            (-30.5, 6.0, 2.0),
            (-30.5, 17.0, 2.2),
            (-30.5, 28.0, 1.8),
            (30.5, 6.0, 2.3),
            (30.5, 17.5, 1.9),
            (-9.0, 17.3, 1.7),
            (9.0, 17.3, 1.6),
        ],
    );
    let corners = [(-27.0, -28.0), (19.0, -28.0), (19.0, 2.3), (-27.0, 2.3)];
    finish(plan, "supermarket", &b, &corners, (66.0, 62.0));
}

pub(super) fn water_tanks(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(606.0, 16.0), LEG_ONE_HEADING + 0.55);
    plan.lay_slab(b.slab(0.0, 0.0, 60.0, 38.0), SurfaceMaterial::Gravel, 1.2);
    plan.raise(
        b.slab(-14.0, 0.0, 25.0, 25.0),
        Cone,
        Plain,
        [0.33, 0.345, 0.325],
        9.0,
        1.8,
        Tank,
    );
    plan.raise(
        b.slab(14.0, 2.0, 20.0, 20.0),
        Cone,
        Plain,
        [0.2, 0.245, 0.262],
        7.0,
        1.4,
        Tank,
    );
    plan.raise(
        b.slab(2.0, -14.0, 9.0, 5.0),
        Gable,
        Tiles,
        RED_TILE,
        3.0,
        1.5,
        Building,
    );
    hedge(plan, &b, (-29.0, -18.5), (29.0, -18.5));
    trees(
        plan,
        &b,
        &[(-27.0, 16.0, 4.2), (0.5, 16.5, 3.4), (27.0, -15.0, 3.8)],
    );
    let corners = [(-26.5, -12.5), (24.0, -12.5), (24.0, 12.5), (-26.5, 12.5)];
    finish(plan, "water tanks", &b, &corners, (60.0, 40.0));
}

pub(super) fn sawtooth_factory(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(684.0, -10.0), LEG_ONE_HEADING - 0.3);
    plan.lay_slab(b.slab(2.0, 0.0, 66.0, 52.0), SurfaceMaterial::Concrete, 1.2);
    plan.raise(
        b.slab(0.0, -4.0, 48.0, 34.0),
        Sawtooth(8.0),
        Felt,
        [0.16, 0.13, 0.12],
        6.0,
        2.8,
        Building,
    );
    plan.raise(
        b.slab(-12.0, 18.0, 24.0, 9.0),
        Flat,
        Felt,
        GRAY_FELT,
        6.5,
        0.0,
        Building,
    );
    plan.raise(
        b.slab(27.5, 16.0, 2.8, 2.8),
        Cone,
        Plain,
        [0.25, 0.12, 0.09],
        24.0,
        0.3,
        Building,
    );
    for i in 0..5 {
        plan.put(
            b.slab(8.0 + 3.2 * i as f32, 19.0, 2.4, 6.0),
            2.6,
            PropForm::Crate,
            [[0.2, 0.07, 0.05], [0.06, 0.1, 0.17], [0.26, 0.26, 0.25]][i % 3],
        );
    }
    plan.put(
        b.slab(30.0, -12.0, 2.5, 12.0),
        3.6,
        PropForm::Truck,
        [0.5, 0.5, 0.5],
    );
    let corners = [
        (-24.0, -21.0),
        (24.0, -21.0),
        (24.0, 13.0),
        (0.0, 13.0),
        (0.0, 22.5),
        (-24.0, 22.5),
    ];
    finish(plan, "sawtooth factory", &b, &corners, (66.0, 54.0));
}

pub(super) fn warehouse(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(spot(548.0, 572.0), 0.3);
    plan.lay_slab(b.slab(0.0, 4.0, 84.0, 66.0), SurfaceMaterial::Asphalt, 0.8);
    plan.raise(
        b.slab(0.0, -8.0, 68.0, 36.0),
        Flat,
        Metal,
        [0.33, 0.335, 0.335],
        9.0,
        0.0,
        Building,
    );
    for i in 0..12 {
        let (column, row) = ((i % 6) as f32, (i / 6) as f32);
        plan.raise(
            b.slab(-27.0 + 11.0 * column, -16.0 + 15.0 * row, 2.0, 6.0),
            Flat,
            Glass,
            [0.5, 0.54, 0.55],
            9.4,
            0.0,
            Building,
        );
    }
    for i in 0..9 {
        if i % 3 != 1 {
            plan.put(
                Slab::new(
                    b.at(-28.0 + 7.0 * i as f32, 17.5),
                    b.angle + FRAC_PI_2,
                    13.0,
                    2.5,
                ),
                3.8,
                PropForm::Truck,
                [0.5, 0.5, 0.49],
            );
        }
    }
    let corners = [(-34.0, -26.0), (34.0, -26.0), (34.0, 10.0), (-34.0, 10.0)];
    finish(plan, "warehouse", &b, &corners, (86.0, 70.0));
}
