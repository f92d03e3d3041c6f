//! School, sports hall and hospital.

use std::f32::consts::FRAC_PI_2;

use super::super::plan::{LEG_ONE_HEADING, SceneryPlan, leg_one};
use super::super::scene_kind::SceneKind::Building;
use super::super::shape::{GroundOutline, Slab};
use super::super::things::Roof::{Flat, Hip, Vault};
use super::super::things::RoofCover::{Ballast, Felt, Glass, Metal, Plain};
use super::super::things::{PropForm, SurfaceMaterial};
use super::board::{CONCRETE, DrawingBoard, GLASS, GRAY_FELT, WHITE_STEEL, finish, trees};

pub(super) fn school(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(296.0, 18.0), LEG_ONE_HEADING + 0.06);
    plan.lay_slab(b.slab(0.0, 0.0, 58.0, 50.0), SurfaceMaterial::Lawn, 0.4);
    plan.lay_slab(b.slab(7.0, 7.0, 40.0, 32.0), SurfaceMaterial::Asphalt, 0.2);
    plan.lay_slab(b.slab(12.0, 10.0, 24.0, 13.0), SurfaceMaterial::Tartan, 0.1);
    for (u, v, l, w) in [
        (12.0, 3.8, 23.6, 0.12),
        (12.0, 16.2, 23.6, 0.12),
        (0.2, 10.0, 0.12, 12.4),
        (23.8, 10.0, 0.12, 12.4),
        (12.0, 10.0, 0.12, 12.4),
    ] {
        plan.lay_slab(b.slab(u, v, l, w), SurfaceMaterial::Paint, 0.0);
    }
    plan.raise(
        b.slab(0.0, -16.0, 54.0, 14.0),
        Flat,
        Ballast,
        GRAY_FELT,
        7.5,
        0.0,
        Building,
    );
    plan.raise(
        b.slab(-20.0, 8.0, 14.0, 34.0),
        Flat,
        Felt,
        [0.3, 0.3, 0.29],
        7.2,
        0.0,
        Building,
    );
    plan.raise(
        b.slab(-20.0, -16.0, 8.0, 6.0),
        Flat,
        Plain,
        WHITE_STEEL,
        9.0,
        0.0,
        Building,
    );
    for i in 0..4 {
        plan.raise(
            b.slab(2.0 + 7.0 * i as f32, -15.0, 2.4, 2.4),
            Hip,
            Glass,
            GLASS,
            7.9,
            0.6,
            Building,
        );
    }
    trees(
        plan,
        &b,
        &[
            (26.0, 22.0, 3.6),
            (17.0, 23.0, 3.0),
            (6.0, 23.4, 4.2),
            (-8.0, 22.0, 2.4),
            (27.0, 4.0, 2.6),
            (27.5, 12.0, 3.1),
        ],
    );
    plan.put(
        b.slab(-8.0, -4.5, 6.0, 2.0),
        0.8,
        PropForm::Crate,
        [0.09, 0.12, 0.05],
    );
    let corners = [
        (-27.0, -23.0),
        (27.0, -23.0),
        (27.0, -9.0),
        (-13.0, -9.0),
        (-13.0, 25.0),
        (-27.0, 25.0),
    ];
    finish(plan, "L-shaped school", &b, &corners, (60.0, 54.0));
}

pub(super) fn sports_hall(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(371.0, -22.0), LEG_ONE_HEADING - 0.85);
    plan.lay_slab(b.slab(0.0, 3.0, 52.0, 40.0), SurfaceMaterial::Asphalt, 0.3);
    plan.lay_slab(b.slab(0.0, 18.5, 48.0, 5.2), SurfaceMaterial::Stalls, 0.0);
    plan.raise(
        b.slab(0.0, -2.0, 42.0, 25.0),
        Vault,
        Metal,
        [0.27, 0.305, 0.33],
        6.0,
        5.5,
        Building,
    );
    plan.raise(
        b.slab(-14.0, 13.0, 12.0, 6.0),
        Flat,
        Felt,
        GRAY_FELT,
        3.6,
        0.0,
        Building,
    );
    for i in 0..18 {
        let s = Slab::new(
            b.at(-22.0 + 2.6 * i as f32, 18.6),
            b.angle + FRAC_PI_2,
            4.4,
            1.8,
        );
        plan.stalls.push((s, 0.45));
    }
    trees(
        plan,
        &b,
        &[
            (-23.5, 14.0, 2.6),
            (24.5, 8.0, 3.4),
            (24.0, -4.0, 2.4),
            (24.4, -13.0, 3.2),
        ],
    );
    let corners = [(-21.0, -14.5), (21.0, -14.5), (21.0, 10.5), (-21.0, 10.5)];
    finish(plan, "vaulted sports hall", &b, &corners, (54.0, 46.0));
}

pub(super) fn hospital(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(leg_one(450.0, 6.0), LEG_ONE_HEADING + 0.2);
    plan.lay_slab(b.slab(0.0, 0.0, 60.0, 56.0), SurfaceMaterial::Lawn, 0.4);
    plan.lay_slab(
        b.slab(0.0, -18.0, 20.0, 20.0),
        SurfaceMaterial::Asphalt,
        0.2,
    );
    plan.lay(
        GroundOutline::Disc(b.at(0.0, -17.0), 5.0),
        SurfaceMaterial::Lawn,
        b.frame.axis,
        0.1,
        None,
    );
    plan.lay(
        GroundOutline::Disc(b.at(0.0, 17.0), 7.5),
        SurfaceMaterial::Paving,
        b.frame.axis,
        0.0,
        None,
    );
    plan.raise(
        b.slab(-17.0, 0.0, 13.0, 50.0),
        Flat,
        Felt,
        [0.25, 0.238, 0.22],
        12.0,
        0.0,
        Building,
    );
    plan.raise(
        b.slab(17.0, 0.0, 13.0, 50.0),
        Flat,
        Felt,
        [0.25, 0.238, 0.22],
        12.0,
        0.0,
        Building,
    );
    plan.raise(
        b.slab(0.0, 0.0, 21.0, 12.0),
        Flat,
        Ballast,
        CONCRETE,
        9.0,
        0.0,
        Building,
    );
    for (u, v, l, w, h) in [
        (-17.0, -14.0, 6.0, 9.0, 14.5),
        (17.0, 12.0, 5.0, 12.0, 14.0),
        (-17.0, 14.0, 3.0, 5.0, 13.4),
        (17.0, -16.0, 4.0, 4.0, 13.2),
        (-3.0, 0.0, 5.0, 3.0, 10.5),
        (5.0, 1.0, 3.0, 3.0, 10.2),
    ] {
        plan.raise(
            b.slab(u, v, l, w),
            Flat,
            Plain,
            [0.42, 0.42, 0.41],
            h,
            0.0,
            Building,
        );
    }
    trees(
        plan,
        &b,
        &[
            (0.0, -17.0, 2.9),
            (-7.0, 13.0, 2.2),
            (7.5, 21.0, 2.8),
            (-5.0, 25.0, 3.0),
            (27.0, -18.0, 3.2),
            (27.5, 4.0, 3.8),
            (27.0, 20.0, 2.7),
            (-27.0, -6.0, 3.5),
            (-27.5, 16.0, 4.1),
        ],
    );
    for i in 0..5 {
        plan.stalls
            .push((b.slab(-6.5 + 3.0 * i as f32, -25.0, 1.8, 4.4), 0.5));
    }
    let corners = [
        (-23.5, -25.0),
        (-10.5, -25.0),
        (-10.5, -6.0),
        (10.5, -6.0),
        (10.5, -25.0),
        (23.5, -25.0),
        (23.5, 25.0),
        (10.5, 25.0),
        (10.5, 6.0),
        (-10.5, 6.0),
        (-10.5, 25.0),
        (-23.5, 25.0),
    ];
    finish(plan, "H-shaped hospital", &b, &corners, (58.0, 56.0));
}
