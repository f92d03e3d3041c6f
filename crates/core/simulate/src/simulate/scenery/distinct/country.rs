//! Farm and church at the north-western end of the plan's first leg, the pool of the second.

use std::f32::consts::FRAC_PI_2;

use super::super::plan::{LEG_ONE_HEADING, SceneryPlan, leg_one};
use super::super::scene_kind::SceneKind::{Building, Pool, Tank};
use super::super::shape::{GroundOutline, spot};
use super::super::things::Roof::{Cone, Dome, Gable, Hip, Vault};
use super::super::things::RoofCover::{Glass, Metal, Plain, Tiles};
use super::super::things::{PropForm, SurfaceMaterial};
use super::board::{
    DrawingBoard, GLASS, GREEN_METAL, RED_TILE, RUST_METAL, SLATE, WHITE_STEEL, finish, hedge,
    trees,
};

pub(super) fn dairy_barn(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(62.0, -16.0), LEG_ONE_HEADING + 0.35);
    plan.lay_slab(b.slab(0.0, 2.0, 62.0, 44.0), SurfaceMaterial::Dirt, 2.5);
    plan.lay_slab(
        b.slab(-2.0, -15.0, 50.0, 9.0),
        SurfaceMaterial::Concrete,
        0.4,
    );
    plan.raise(
        b.slab(-2.0, 0.0, 46.0, 17.0),
        Gable,
        Metal,
        GREEN_METAL,
        5.0,
        3.6,
        Building,
    );
    plan.raise(
        b.slab(-4.0, 14.5, 24.0, 8.0),
        Gable,
        Metal,
        RUST_METAL,
        3.4,
        1.5,
        Building,
    );
    for (i, radius) in [3.9, 3.4, 3.4].into_iter().enumerate() {
        let s = b.slab(27.0, -8.5 + 8.6 * i as f32, 2.0 * radius, 2.0 * radius);
        plan.raise(s, Dome, Plain, WHITE_STEEL, 11.0 + radius, 2.0, Tank);
    }
    for i in 0..7 {
        let s = b.slab(
            -26.0 + 1.7 * (i % 4) as f32,
            13.0 + 1.8 * (i / 4) as f32,
            1.4,
            1.5,
        );
        plan.put(s, 1.3, PropForm::Bale, [0.42, 0.35, 0.2]);
    }
    plan.put(
        b.slab(12.0, 13.0, 4.8, 2.2),
        2.6,
        PropForm::Truck,
        [0.06, 0.13, 0.04],
    );
    plan.put(
        b.slab(17.0, 15.0, 6.0, 2.3),
        1.6,
        PropForm::Crate,
        [0.21, 0.055, 0.035],
    );
    let corners = [(-25.0, -8.5), (21.0, -8.5), (21.0, 8.5), (-25.0, 8.5)];
    finish(plan, "dairy barn", &b, &corners, (64.0, 44.0));
}

pub(super) fn greenhouses(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(140.0, 20.0), LEG_ONE_HEADING - 0.5);
    plan.lay_slab(b.slab(0.0, 0.0, 46.0, 48.0), SurfaceMaterial::Gravel, 1.0);
    for i in 0..5 {
        let across = -18.0 + 9.0 * i as f32;
        let cut = if i == 3 { 8.0 } else { 0.0 };
        plan.raise(
            b.slab(-0.5 * cut, across, 40.0 - cut, 7.4),
            Vault,
            Glass,
            GLASS,
            2.4,
            1.8,
            Building,
        );
    }
    plan.raise(
        b.slab(17.5, 9.0, 5.0, 6.0),
        Gable,
        Tiles,
        RED_TILE,
        2.8,
        1.4,
        Building,
    );
    plan.lay_slab(b.slab(0.0, 26.0, 38.0, 5.0), SurfaceMaterial::Beds, 0.3);
    let corners = [(-20.0, -21.7), (20.0, -21.7), (20.0, 21.7), (-20.0, 21.7)];
    finish(plan, "greenhouse rows", &b, &corners, (48.0, 52.0));
}

pub(super) fn church(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(217.0, -8.0), FRAC_PI_2 + 0.12);
    plan.lay_slab(b.slab(0.0, 0.0, 52.0, 44.0), SurfaceMaterial::Lawn, 0.3);
    plan.lay_slab(b.slab(3.0, 15.5, 40.0, 11.0), SurfaceMaterial::Graves, 0.2);
    plan.lay_slab(b.slab(8.0, -16.5, 26.0, 9.0), SurfaceMaterial::Graves, 0.2);
    plan.lay_slab(b.slab(-22.5, 0.0, 9.0, 3.0), SurfaceMaterial::Paving, 0.2);
    plan.lay_slab(b.slab(0.0, 0.0, 44.0, 15.0), SurfaceMaterial::Gravel, 0.3);
    plan.raise(
        b.slab(1.0, 0.0, 32.0, 10.5),
        Gable,
        Tiles,
        SLATE,
        8.0,
        5.2,
        Building,
    );
    plan.raise(
        b.turned(6.5, 0.0, 8.5, 22.0),
        Gable,
        Tiles,
        SLATE,
        8.0,
        4.6,
        Building,
    );
    plan.raise(
        b.slab(-17.5, 0.0, 7.0, 7.0),
        Hip,
        Metal,
        [0.17, 0.28, 0.22],
        19.0,
        6.0,
        Building,
    );
    plan.raise(
        b.slab(18.0, 0.0, 8.0, 8.0),
        Cone,
        Tiles,
        SLATE,
        6.5,
        3.0,
        Building,
    );
    plan.raise(
        b.slab(11.5, -8.4, 6.0, 5.0),
        Gable,
        Tiles,
        SLATE,
        3.5,
        2.0,
        Building,
    );
    trees(
        plan,
        &b,
        &[
            (-24.0, -18.0, 4.6),
            (-8.0, 20.5, 3.9),
            (23.0, 19.0, 4.8),
            (24.0, -19.0, 3.4),
            (-16.0, -20.0, 2.8),
            (-23.5, 12.0, 3.2),
        ],
    );
    hedge(plan, &b, (-25.5, 21.5), (25.5, 21.5));
    hedge(plan, &b, (25.5, -21.5), (25.5, 21.5));
    hedge(plan, &b, (-25.5, -21.5), (25.5, -21.5));
    let corners = [
        (-21.0, -3.5),
        (-15.0, -5.2),
        (2.2, -5.2),
        (2.2, -11.0),
        (10.8, -11.0),
        (10.8, -5.2),
        (17.0, -5.2),
        (22.0, 0.0),
        (17.0, 5.2),
        (10.8, 5.2),
        (10.8, 11.0),
        (2.2, 11.0),
        (2.2, 5.2),
        (-15.0, 5.2),
        (-21.0, 3.5),
    ];
    finish(plan, "church", &b, &corners, (54.0, 46.0));
}

pub(super) fn pool(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(spot(-492.5, -257.5), 1.25 * std::f32::consts::PI);
    plan.lay_slab(b.slab(0.0, 8.0, 60.0, 46.0), SurfaceMaterial::Lawn, 0.4);
    plan.lay_slab(b.slab(0.0, 1.0, 36.0, 23.0), SurfaceMaterial::Paving, 0.0);
    plan.lay(
        GroundOutline::Slab(b.slab(0.0, 0.0, 25.0, 12.5)),
        SurfaceMaterial::Pool,
        b.frame.axis,
        0.0,
        Some(Pool),
    );
    plan.lay(
        GroundOutline::Disc(b.at(-16.0, 14.5), 3.6),
        SurfaceMaterial::Paving,
        b.frame.axis,
        0.0,
        None,
    );
    plan.lay(
        GroundOutline::Disc(b.at(-16.0, 14.5), 2.8),
        SurfaceMaterial::Pool,
        b.frame.axis,
        0.0,
        Some(Pool),
    );
    plan.raise(
        b.slab(4.0, 21.0, 26.0, 8.0),
        Hip,
        Tiles,
        RED_TILE,
        3.2,
        2.2,
        Building,
    );
    plan.lay_slab(b.slab(37.0, 6.0, 10.0, 26.0), SurfaceMaterial::Asphalt, 0.3);
    for i in 0..6 {
        let s = b.slab(36.0, -4.0 + 2.7 * i as f32, 4.4, 1.8);
        plan.stalls.push((s, 0.6));
    }
    let site = b.slab(0.0, 8.0, 60.0, 46.0);
    plan.reserved.push(site);
    plan.reserved.push(b.slab(37.0, 6.0, 10.0, 26.0));
    for i in 0..11 {
        let lounger = b.slab(
            -14.5 + 2.7 * i as f32,
            if i % 3 == 0 { -9.3 } else { 8.6 },
            0.75,
            1.9,
        );
        let cloth = [[0.42, 0.42, 0.4], [0.1, 0.16, 0.28], [0.36, 0.3, 0.12]][i % 3];
        plan.put(lounger, 0.4, PropForm::Crate, cloth);
    }
    for (u, v) in [(-10.0, 10.6), (1.5, 10.8), (13.0, 10.4), (15.8, -8.0)] {
        let shade = b.slab(u, v, 2.8, 2.8);
        plan.raise(shade, Cone, Plain, [0.4, 0.38, 0.34], 2.2, 0.6, Building);
    }
    plan.lay_slab(b.slab(25.0, 6.0, 15.0, 2.4), SurfaceMaterial::Paving, 0.1);
    hedge(plan, &b, (-29.0, -13.5), (22.0, -13.5));
    hedge(plan, &b, (-29.0, -13.5), (-29.0, 28.0));
    trees(
        plan,
        &b,
        &[
            (-24.0, 3.0, 3.4),
            (-25.0, 24.0, 4.0),
            (-13.0, 26.0, 3.0),
            (24.0, 25.0, 3.8),
            (25.0, -8.0, 2.4),
            (-22.0, -9.0, 2.1),
        ],
    );
    let corners = [(-12.5, -6.25), (12.5, -6.25), (12.5, 6.25), (-12.5, 6.25)];
    let outline = b.outline(&corners);
    plan.announce(
        "swimming pool",
        Pool,
        outline,
        &b.slab(0.0, 3.0, 44.0, 34.0),
    );
}
