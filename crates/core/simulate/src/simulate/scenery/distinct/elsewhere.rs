//! Distinct places away from the first two legs.

use std::f32::consts::FRAC_PI_2;

use super::super::plan::SceneryPlan;
use super::super::scene_kind::SceneKind::{Building, Place};
use super::super::shape::{GroundOutline, Spot, spot};
use super::super::things::Roof::{Cone, Flat, Gable};
use super::super::things::RoofCover::{Ballast, Metal, Tiles};
use super::super::things::{PropForm, SurfaceMaterial};
use super::board::{DrawingBoard, RUST_METAL, SLATE, WHITE_STEEL, finish};

pub(super) fn running_track(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(spot(715.0, 195.0), 0.45);
    let oval = |grow: f32| {
        let mut corners = Vec::new();
        for (center, from) in [(42.0_f32, -FRAC_PI_2), (-42.0, FRAC_PI_2)] {
            for i in 0..=16 {
                let (sin, cos) = (from + i as f32 / 16.0 * std::f32::consts::PI).sin_cos();
                corners.push(b.at(center + (36.0 + grow) * cos, (36.0 + grow) * sin));
            }
        }
        corners
    };
    plan.lay_slab(b.slab(0.0, 0.0, 180.0, 104.0), SurfaceMaterial::Grass, 2.0);
    plan.lay(
        GroundOutline::Polygon(oval(8.0)),
        SurfaceMaterial::Tartan,
        b.frame.axis,
        0.0,
        Some(Place),
    );
    for lane in 0..7 {
        let grow = 8.0 - 1.22 * lane as f32;
        plan.lay(
            GroundOutline::Polygon(oval(grow - 0.1)),
            SurfaceMaterial::Paint,
            b.frame.axis,
            0.0,
            None,
        );
        plan.lay(
            GroundOutline::Polygon(oval(grow - 0.2)),
            SurfaceMaterial::Tartan,
            b.frame.axis,
            0.0,
            None,
        );
    }
    plan.lay(
        GroundOutline::Polygon(oval(0.0)),
        SurfaceMaterial::Turf,
        b.frame.axis,
        0.0,
        None,
    );
    plan.raise(
        b.slab(0.0, 50.0, 40.0, 7.0),
        Flat,
        Metal,
        WHITE_STEEL,
        6.0,
        0.0,
        Building,
    );
    finish(
        plan,
        "running track",
        &b,
        &[(-78.0, -44.0), (78.0, -44.0), (78.0, 44.0), (-78.0, 44.0)],
        (180.0, 108.0),
    );
}

pub(super) fn quarry(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(spot(-780.0, 560.0), 0.8);
    let rim: Vec<Spot> = (0..28)
        .map(|i| {
            let (sin, cos) = (i as f32 * std::f32::consts::TAU / 28.0).sin_cos();
            let wobble = 1.0 + 0.12 * (i as f32 * 1.7).sin() + 0.08 * (i as f32 * 3.1).cos();
            b.at(92.0 * cos * wobble, 60.0 * sin * wobble)
        })
        .collect();
    plan.lay(
        GroundOutline::Polygon(rim.clone()),
        SurfaceMaterial::Rock,
        b.frame.axis,
        4.0,
        Some(Place),
    );
    for (u, v, r) in [
        (-48.0, -14.0, 9.0),
        (-32.0, -22.0, 6.5),
        (-30.0, 16.0, 7.5),
        (-52.0, 10.0, 5.0),
    ] {
        let heap = b.slab(u, v, 2.0 * r, 2.0 * r);
        plan.raise(
            heap,
            Cone,
            Ballast,
            [0.25, 0.23, 0.19],
            0.15,
            0.62 * r,
            Place,
        );
    }
    plan.put(
        b.slab(-14.0, -6.0, 6.5, 3.0),
        3.0,
        PropForm::Truck,
        [0.28, 0.2, 0.04],
    );
    plan.put(
        b.slab(-20.0, 4.0, 8.0, 3.2),
        3.2,
        PropForm::Crate,
        [0.26, 0.18, 0.04],
    );
    plan.raise(
        b.slab(-62.0, -8.0, 14.0, 9.0),
        Gable,
        Metal,
        RUST_METAL,
        5.0,
        1.6,
        Building,
    );
    let lake = b.slab(30.0, 10.0, 52.0, 34.0);
    plan.lay(
        GroundOutline::Ellipse(lake),
        SurfaceMaterial::Pond,
        b.frame.axis,
        3.0,
        None,
    );
    let site = b.slab(0.0, 0.0, 210.0, 140.0);
    plan.reserved.push(site);
    plan.announce("quarry", Place, rim, &site);
}

pub(super) fn cemetery(plan: &mut SceneryPlan) {
    let b = DrawingBoard::new(spot(338.0, 62.0), 0.2);
    plan.lay_slab(b.slab(0.0, 0.0, 84.0, 60.0), SurfaceMaterial::Lawn, 0.3);
    for (u, v) in [(-21.0, -15.0), (21.0, -15.0), (-21.0, 15.0), (21.0, 15.0)] {
        plan.lay_slab(b.slab(u, v, 36.0, 24.0), SurfaceMaterial::Graves, 0.1);
    }
    plan.lay_slab(b.slab(0.0, 0.0, 82.0, 2.6), SurfaceMaterial::Gravel, 0.2);
    plan.lay_slab(b.turned(0.0, 0.0, 2.6, 58.0), SurfaceMaterial::Gravel, 0.2);
    plan.raise(
        b.slab(36.0, -8.0, 9.0, 6.0),
        Gable,
        Tiles,
        SLATE,
        4.0,
        3.0,
        Building,
    );
    finish(
        plan,
        "cemetery",
        &b,
        &[(-42.0, -30.0), (42.0, -30.0), (42.0, 30.0), (-42.0, 30.0)],
        (86.0, 62.0),
    );
}
