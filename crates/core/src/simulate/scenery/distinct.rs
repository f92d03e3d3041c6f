//! The distinct places: the nine buildings under the first leg, the pool, and a few elsewhere.
//!
//! Their layout is the same for every seed; flight scenarios rely on it.

use std::f32::consts::FRAC_PI_2;

use super::labels::SceneKind::{Building, Place, Pool, Tank};
use super::noise::Dice;
use super::plan::{LEG_ONE_HEADING, Plan, leg_one};
use super::shape::{Outline, Slab, Spot, spot};
use super::things::Cover::{Ballast, Felt, Glass, Metal, Plain, Tiles};
use super::things::Roof::{Cone, Dome, Flat, Gable, Hip, Sawtooth, Vault};
use super::things::{Form, Ground, Habit};

const SLATE: [f32; 3] = [0.085, 0.088, 0.1];
const RED_TILE: [f32; 3] = [0.16, 0.08, 0.056];
const WHITE_STEEL: [f32; 3] = [0.4, 0.405, 0.405];
const GRAY_FELT: [f32; 3] = [0.2, 0.2, 0.195];
const GREEN_METAL: [f32; 3] = [0.088, 0.118, 0.098];
const RUST_METAL: [f32; 3] = [0.185, 0.125, 0.095];
const GLASS: [f32; 3] = [0.34, 0.4, 0.39];
const CONCRETE: [f32; 3] = [0.26, 0.25, 0.235];

/// A drawing board at a place: coordinates along and across a heading.
struct Board {
    frame: Slab,
    angle: f32,
}

impl Board {
    fn new(center: Spot, angle: f32) -> Self {
        Self {
            frame: Slab::new(center, angle, 1.0, 1.0),
            angle,
        }
    }
    fn at(&self, along: f32, across: f32) -> Spot {
        self.frame.at(along, across)
    }
    /// A rectangle of `length` along by `width` across.
    fn slab(&self, along: f32, across: f32, length: f32, width: f32) -> Slab {
        Slab::new(self.at(along, across), self.angle, length, width)
    }
    /// The same turned by a quarter: the ridge runs across.
    fn turned(&self, along: f32, across: f32, length: f32, width: f32) -> Slab {
        Slab::new(
            self.at(along, across),
            self.angle + FRAC_PI_2,
            width,
            length,
        )
    }
    fn outline(&self, corners: &[(f32, f32)]) -> Vec<Spot> {
        corners.iter().map(|&(u, v)| self.at(u, v)).collect()
    }
}

/// Trees at fixed places: along, across, crown radius.
fn trees(plan: &mut Plan, board: &Board, places: &[(f32, f32, f32)]) {
    let mut dice = Dice::new(41, plan.crowns.len() as u64);
    for &(u, v, radius) in places {
        plan.plant(board.at(u, v), radius, Habit::Broadleaf, &mut dice);
    }
}

/// A clipped hedge from one place to another.
fn hedge(plan: &mut Plan, board: &Board, from: (f32, f32), to: (f32, f32)) {
    let mut dice = Dice::new(43, plan.crowns.len() as u64);
    let (a, b) = (board.at(from.0, from.1), board.at(to.0, to.1));
    let steps = ((b - a).length() / 0.8) as usize;
    for i in 0..=steps {
        let p = a + (b - a) * (i as f32 / steps.max(1) as f32);
        let radius = dice.range(0.75, 0.95);
        plan.plant(p, radius, Habit::Shrub, &mut dice);
    }
}

/// Builds all of them.
pub(super) fn build(plan: &mut Plan) {
    dairy_barn(plan);
    greenhouses(plan);
    church(plan);
    school(plan);
    sports_hall(plan);
    hospital(plan);
    supermarket(plan);
    water_tanks(plan);
    sawtooth_factory(plan);
    pool(plan);
    warehouse(plan);
    running_track(plan);
    quarry(plan);
    cemetery(plan);
}

fn finish(plan: &mut Plan, name: &str, board: &Board, corners: &[(f32, f32)], size: (f32, f32)) {
    let site = board.slab(0.0, 0.0, size.0, size.1);
    plan.reserved.push(site);
    plan.announce(name, Building, board.outline(corners), &site);
}

fn dairy_barn(plan: &mut Plan) {
    let b = Board::new(leg_one(62.0, -16.0), LEG_ONE_HEADING + 0.35);
    plan.lay_slab(b.slab(0.0, 2.0, 62.0, 44.0), Ground::Dirt, 2.5);
    plan.lay_slab(b.slab(-2.0, -15.0, 50.0, 9.0), Ground::Concrete, 0.4);
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
        plan.put(s, 1.3, Form::Bale, [0.42, 0.35, 0.2]);
    }
    plan.put(
        b.slab(12.0, 13.0, 4.8, 2.2),
        2.6,
        Form::Truck,
        [0.06, 0.13, 0.04],
    );
    plan.put(
        b.slab(17.0, 15.0, 6.0, 2.3),
        1.6,
        Form::Crate,
        [0.21, 0.055, 0.035],
    );
    let corners = [(-25.0, -8.5), (21.0, -8.5), (21.0, 8.5), (-25.0, 8.5)];
    finish(plan, "dairy barn", &b, &corners, (64.0, 44.0));
}

fn greenhouses(plan: &mut Plan) {
    let b = Board::new(leg_one(140.0, 20.0), LEG_ONE_HEADING - 0.5);
    plan.lay_slab(b.slab(0.0, 0.0, 46.0, 48.0), Ground::Gravel, 1.0);
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
    plan.lay_slab(b.slab(0.0, 26.0, 38.0, 5.0), Ground::Beds, 0.3);
    let corners = [(-20.0, -21.7), (20.0, -21.7), (20.0, 21.7), (-20.0, 21.7)];
    finish(plan, "greenhouse rows", &b, &corners, (48.0, 52.0));
}

fn church(plan: &mut Plan) {
    let b = Board::new(leg_one(217.0, -8.0), FRAC_PI_2 + 0.12);
    plan.lay_slab(b.slab(0.0, 0.0, 52.0, 44.0), Ground::Lawn, 0.3);
    plan.lay_slab(b.slab(3.0, 15.5, 40.0, 11.0), Ground::Graves, 0.2);
    plan.lay_slab(b.slab(8.0, -16.5, 26.0, 9.0), Ground::Graves, 0.2);
    plan.lay_slab(b.slab(-22.5, 0.0, 9.0, 3.0), Ground::Paving, 0.2);
    plan.lay_slab(b.slab(0.0, 0.0, 44.0, 15.0), Ground::Gravel, 0.3);
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

fn school(plan: &mut Plan) {
    let b = Board::new(leg_one(296.0, 18.0), LEG_ONE_HEADING + 0.06);
    plan.lay_slab(b.slab(0.0, 0.0, 58.0, 50.0), Ground::Lawn, 0.4);
    plan.lay_slab(b.slab(7.0, 7.0, 40.0, 32.0), Ground::Asphalt, 0.2);
    plan.lay_slab(b.slab(12.0, 10.0, 24.0, 13.0), Ground::Tartan, 0.1);
    for (u, v, l, w) in [
        (12.0, 3.8, 23.6, 0.12),
        (12.0, 16.2, 23.6, 0.12),
        (0.2, 10.0, 0.12, 12.4),
        (23.8, 10.0, 0.12, 12.4),
        (12.0, 10.0, 0.12, 12.4),
    ] {
        plan.lay_slab(b.slab(u, v, l, w), Ground::Paint, 0.0);
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
        Form::Crate,
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

fn sports_hall(plan: &mut Plan) {
    let b = Board::new(leg_one(371.0, -22.0), LEG_ONE_HEADING - 0.85);
    plan.lay_slab(b.slab(0.0, 3.0, 52.0, 40.0), Ground::Asphalt, 0.3);
    plan.lay_slab(b.slab(0.0, 18.5, 48.0, 5.2), Ground::Stalls, 0.0);
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

fn hospital(plan: &mut Plan) {
    let b = Board::new(leg_one(450.0, 6.0), LEG_ONE_HEADING + 0.2);
    plan.lay_slab(b.slab(0.0, 0.0, 60.0, 56.0), Ground::Lawn, 0.4);
    plan.lay_slab(b.slab(0.0, -18.0, 20.0, 20.0), Ground::Asphalt, 0.2);
    plan.lay(
        Outline::Disc(b.at(0.0, -17.0), 5.0),
        Ground::Lawn,
        b.frame.axis,
        0.1,
        None,
    );
    plan.lay(
        Outline::Disc(b.at(0.0, 17.0), 7.5),
        Ground::Paving,
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

fn supermarket(plan: &mut Plan) {
    let b = Board::new(leg_one(526.0, -14.0), LEG_ONE_HEADING - 0.12);
    plan.lay_slab(b.slab(0.0, 0.0, 64.0, 60.0), Ground::Asphalt, 0.4);
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
        plan.lay_slab(b.slab(0.0, across, 58.0, 9.6), Ground::Stalls, 0.0);
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

fn water_tanks(plan: &mut Plan) {
    let b = Board::new(leg_one(606.0, 16.0), LEG_ONE_HEADING + 0.55);
    plan.lay_slab(b.slab(0.0, 0.0, 60.0, 38.0), Ground::Gravel, 1.2);
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

fn sawtooth_factory(plan: &mut Plan) {
    let b = Board::new(leg_one(684.0, -10.0), LEG_ONE_HEADING - 0.3);
    plan.lay_slab(b.slab(2.0, 0.0, 66.0, 52.0), Ground::Concrete, 1.2);
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
            Form::Crate,
            [[0.2, 0.07, 0.05], [0.06, 0.1, 0.17], [0.26, 0.26, 0.25]][i % 3],
        );
    }
    plan.put(
        b.slab(30.0, -12.0, 2.5, 12.0),
        3.6,
        Form::Truck,
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

fn pool(plan: &mut Plan) {
    let b = Board::new(spot(-492.5, -257.5), 1.25 * std::f32::consts::PI);
    plan.lay_slab(b.slab(0.0, 8.0, 60.0, 46.0), Ground::Lawn, 0.4);
    plan.lay_slab(b.slab(0.0, 1.0, 36.0, 23.0), Ground::Paving, 0.0);
    plan.lay(
        Outline::Slab(b.slab(0.0, 0.0, 25.0, 12.5)),
        Ground::Pool,
        b.frame.axis,
        0.0,
        Some(Pool),
    );
    plan.lay(
        Outline::Disc(b.at(-16.0, 14.5), 3.6),
        Ground::Paving,
        b.frame.axis,
        0.0,
        None,
    );
    plan.lay(
        Outline::Disc(b.at(-16.0, 14.5), 2.8),
        Ground::Pool,
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
    plan.lay_slab(b.slab(37.0, 6.0, 10.0, 26.0), Ground::Asphalt, 0.3);
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
        plan.put(lounger, 0.4, Form::Crate, cloth);
    }
    for (u, v) in [(-10.0, 10.6), (1.5, 10.8), (13.0, 10.4), (15.8, -8.0)] {
        let shade = b.slab(u, v, 2.8, 2.8);
        plan.raise(shade, Cone, Plain, [0.4, 0.38, 0.34], 2.2, 0.6, Building);
    }
    plan.lay_slab(b.slab(25.0, 6.0, 15.0, 2.4), Ground::Paving, 0.1);
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

fn warehouse(plan: &mut Plan) {
    let b = Board::new(spot(548.0, 572.0), 0.3);
    plan.lay_slab(b.slab(0.0, 4.0, 84.0, 66.0), Ground::Asphalt, 0.8);
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
                Form::Truck,
                [0.5, 0.5, 0.49],
            );
        }
    }
    let corners = [(-34.0, -26.0), (34.0, -26.0), (34.0, 10.0), (-34.0, 10.0)];
    finish(plan, "warehouse", &b, &corners, (86.0, 70.0));
}

fn running_track(plan: &mut Plan) {
    let b = Board::new(spot(715.0, 195.0), 0.45);
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
    plan.lay_slab(b.slab(0.0, 0.0, 180.0, 104.0), Ground::Grass, 2.0);
    plan.lay(
        Outline::Polygon(oval(8.0)),
        Ground::Tartan,
        b.frame.axis,
        0.0,
        Some(Place),
    );
    for lane in 0..7 {
        let grow = 8.0 - 1.22 * lane as f32;
        plan.lay(
            Outline::Polygon(oval(grow - 0.1)),
            Ground::Paint,
            b.frame.axis,
            0.0,
            None,
        );
        plan.lay(
            Outline::Polygon(oval(grow - 0.2)),
            Ground::Tartan,
            b.frame.axis,
            0.0,
            None,
        );
    }
    plan.lay(
        Outline::Polygon(oval(0.0)),
        Ground::Turf,
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

fn quarry(plan: &mut Plan) {
    let b = Board::new(spot(-780.0, 560.0), 0.8);
    let rim: Vec<Spot> = (0..28)
        .map(|i| {
            let (sin, cos) = (i as f32 * std::f32::consts::TAU / 28.0).sin_cos();
            let wobble = 1.0 + 0.12 * (i as f32 * 1.7).sin() + 0.08 * (i as f32 * 3.1).cos();
            b.at(92.0 * cos * wobble, 60.0 * sin * wobble)
        })
        .collect();
    plan.lay(
        Outline::Polygon(rim.clone()),
        Ground::Rock,
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
        Form::Truck,
        [0.28, 0.2, 0.04],
    );
    plan.put(
        b.slab(-20.0, 4.0, 8.0, 3.2),
        3.2,
        Form::Crate,
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
        Outline::Ellipse(lake),
        Ground::Pond,
        b.frame.axis,
        3.0,
        None,
    );
    let site = b.slab(0.0, 0.0, 210.0, 140.0);
    plan.reserved.push(site);
    plan.announce("quarry", Place, rim, &site);
}

fn cemetery(plan: &mut Plan) {
    let b = Board::new(spot(338.0, 62.0), 0.2);
    plan.lay_slab(b.slab(0.0, 0.0, 84.0, 60.0), Ground::Lawn, 0.3);
    for (u, v) in [(-21.0, -15.0), (21.0, -15.0), (-21.0, 15.0), (21.0, 15.0)] {
        plan.lay_slab(b.slab(u, v, 36.0, 24.0), Ground::Graves, 0.1);
    }
    plan.lay_slab(b.slab(0.0, 0.0, 82.0, 2.6), Ground::Gravel, 0.2);
    plan.lay_slab(b.turned(0.0, 0.0, 2.6, 58.0), Ground::Gravel, 0.2);
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
