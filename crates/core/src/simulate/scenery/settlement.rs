//! Houses along streets, with their gardens, drives and sheds; farms and hamlets.

use std::f32::consts::{FRAC_PI_2, PI};

use super::labels::SceneKind;
use super::noise::Dice;
use super::plan::Plan;
use super::shape::{Outline, Slab, Spot, spot};
use super::things::{Cover, Form, Ground, Habit, RoadClass, Roof};

const ROOFS: [[f32; 3]; 9] = [
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

/// Where houses stand along roads: road name, from, to (metres along), mean spacing, both sides.
const ROWS: [(&str, f32, f32, f32); 18] = [
    ("High Street", 60.0, 2000.0, 21.0),
    ("Back Street", 30.0, 2000.0, 22.0),
    ("Church Street", 15.0, 2000.0, 22.0),
    ("School Street", 15.0, 2000.0, 21.0),
    ("Market Street", 15.0, 2000.0, 22.0),
    ("Tank Street", 15.0, 2000.0, 24.0),
    ("Low Street", 15.0, 2000.0, 20.0),
    ("Upper Street", 15.0, 2000.0, 20.0),
    ("Track Street", 60.0, 2000.0, 26.0),
    ("West Road", 60.0, 220.0, 28.0),
    ("West Road", 560.0, 1020.0, 38.0),
    ("East Road", 60.0, 240.0, 34.0),
    ("North Road", 300.0, 480.0, 30.0),
    ("Mill Lane", 40.0, 260.0, 44.0),
    ("Mill Lane", 780.0, 1130.0, 34.0),
    ("Quarry Lane", 560.0, 900.0, 36.0),
    ("Quarry Lane", 1200.0, 1400.0, 40.0),
    ("Orchard Lane", 120.0, 560.0, 50.0),
];

/// Farm yards: place and heading.
const FARMS: [(f32, f32, f32); 8] = [
    (760.0, -800.0, 0.4),
    (-330.0, 770.0, 1.1),
    (860.0, 250.0, 2.0),
    (-860.0, 170.0, 0.2),
    (-230.0, -640.0, 2.6),
    (200.0, 930.0, 0.9),
    (250.0, -900.0, 1.8),
    (-960.0, -420.0, 0.6),
];

/// Builds farms first, then the rows of houses where there is room.
pub(super) fn build(plan: &mut Plan, seed: u64) {
    let mut dice = Dice::new(seed, 21);
    for (n, e, angle) in FARMS {
        farm(plan, spot(n, e), angle, &mut dice);
    }
    for (name, from, to, spacing) in ROWS {
        let curves: Vec<(Vec<Spot>, f32)> = plan
            .roads
            .iter()
            .filter(|r| r.name == Some(name))
            .map(|r| (r.curve.clone(), r.half_width))
            .collect();
        for (curve, half_width) in curves {
            row(plan, &curve, half_width, (from, to, spacing), &mut dice);
        }
    }
}

/// The place and heading `along` metres down a curve.
pub(super) fn station(curve: &[Spot], along: f32) -> Option<(Spot, Spot)> {
    let mut left = along;
    for w in curve.windows(2) {
        let length = (w[1] - w[0]).length();
        if left <= length {
            let axis = (w[1] - w[0]).unit();
            return Some((w[0] + axis * left, axis));
        }
        left -= length;
    }
    None
}

/// The strip around the second leg that stays free of houses.
fn under_second_leg(p: Spot) -> bool {
    let axis = spot(
        -std::f32::consts::FRAC_1_SQRT_2,
        -std::f32::consts::FRAC_1_SQRT_2,
    );
    let d = p - spot(-200.0, 70.0);
    (-40.0..560.0).contains(&d.dot(axis)) && axis.cross(d).abs() < 95.0
}

fn row(
    plan: &mut Plan,
    curve: &[Spot],
    half_width: f32,
    (from, to, spacing): (f32, f32, f32),
    dice: &mut Dice,
) {
    for side in [-1.0_f32, 1.0] {
        let mut along = from + dice.range(0.0, spacing);
        while along < to {
            let Some((place, axis)) = station(curve, along) else {
                break;
            };
            let width = dice.range(16.0, 21.0).min(spacing);
            let depth = dice.range(26.0, 36.0);
            let out = axis.right() * side;
            let heading = out.e.atan2(out.n);
            let mut built = false;
            for try_depth in [depth, 26.0, 21.0] {
                let lot = Slab::new(
                    place + out * (half_width + 1.6 + 0.5 * try_depth),
                    heading,
                    try_depth,
                    width,
                );
                let clear = lot
                    .corners()
                    .into_iter()
                    .chain([lot.center])
                    .all(|c| plan.road_clearance(c) > 0.8);
                if clear && plan.is_free(&lot.grown(0.2)) && !under_second_leg(lot.center) {
                    house_lot(plan, &lot, heading, dice);
                    built = true;
                    break;
                }
            }
            along += if built {
                width + dice.range(0.4, (spacing - 15.0).max(1.0))
            } else {
                4.0
            };
        }
    }
}

/// One lot: its axis points away from the street.
fn house_lot(plan: &mut Plan, lot: &Slab, heading: f32, dice: &mut Dice) {
    let (front, half) = (-lot.half_along, lot.half_across);
    let mirror = if dice.chance(0.5) { 1.0 } else { -1.0 };
    plan.lay_slab(*lot, Ground::Lawn, 0.35);
    let setback = dice.range(5.0, 8.0);
    let (length, width) = (dice.range(9.5, 13.5), dice.range(7.2, 9.0));
    let wobble = dice.range(-0.05, 0.05);
    let across_street = dice.chance(0.7);
    let center = lot.at(
        front + setback + 0.5 * if across_street { width } else { length },
        mirror * -1.6,
    );
    let angle = heading + wobble + if across_street { FRAC_PI_2 } else { 0.0 };
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
        Cover::Tiles,
        color,
        eaves,
        rise,
        SceneKind::House,
    );
    if dice.chance(0.4) {
        let wing = Slab::new(
            slab.at(0.25 * length * mirror, 0.5 * width),
            angle + FRAC_PI_2,
            width * 0.9,
            5.0,
        );
        plan.raise(
            wing,
            roof,
            Cover::Tiles,
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
            Cover::Plain,
            [0.16, 0.1, 0.08],
            eaves + rise + 0.4,
            0.0,
            SceneKind::House,
        );
    }
    let drive_v = mirror * (half - 2.3);
    let drive_length = setback + dice.range(3.0, 9.0);
    let surface = dice.pick(&[
        Ground::Asphalt,
        Ground::Gravel,
        Ground::Paving,
        Ground::Concrete,
    ]);
    let drive = Slab::new(
        lot.at(front + 0.5 * drive_length - 1.2, drive_v),
        heading,
        drive_length + 2.4,
        3.2,
    );
    plan.lay_slab(drive, surface, 0.1);
    plan.stalls.push((
        Slab::new(drive.at(dice.range(-2.0, 0.2), 0.0), heading, 4.4, 1.8),
        0.6,
    ));
    if dice.chance(0.45) {
        let garage = Slab::new(
            lot.at(front + drive_length + 3.0, drive_v),
            heading,
            6.0,
            3.6,
        );
        plan.raise(
            garage,
            Roof::Gable,
            Cover::Tiles,
            color,
            2.5,
            1.1,
            SceneKind::House,
        );
    }
    let walk = Slab::new(
        lot.at(front + 0.5 * setback, mirror * -1.6),
        heading,
        setback,
        1.2,
    );
    plan.lay_slab(walk, Ground::Paving, 0.05);
    let back = front + setback + length.max(width) + 2.0;
    if back + 4.0 < lot.half_along {
        let patio = Slab::new(
            lot.at(front + setback + 0.5 * width + 6.2, mirror * -2.0),
            heading,
            3.5,
            5.0,
        );
        plan.lay_slab(patio, Ground::Paving, 0.05);
        if dice.chance(0.35) {
            let beds = Slab::new(
                lot.at(lot.half_along - 4.0, mirror * 3.0),
                heading,
                5.0,
                6.0,
            );
            plan.lay_slab(beds, Ground::Beds, 0.2);
        }
        if dice.chance(0.55) {
            let shed = Slab::new(
                lot.at(lot.half_along - 2.2, mirror * -(half - 2.2)),
                heading,
                2.6,
                3.2,
            );
            let tone = dice.range(0.1, 0.3);
            plan.raise(
                shed,
                Roof::Gable,
                Cover::Felt,
                [tone, tone * 0.95, tone * 0.9],
                2.0,
                0.6,
                SceneKind::House,
            );
        }
        for _ in 0..dice.bits() % 5 {
            let u = dice.range(back, lot.half_along);
            let v = dice.range(-half, half);
            let r = dice.range(1.3, 4.0);
            let p = lot.at(u, v);
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
    for side in [-1.0, 1.0] {
        if dice.chance(0.5) {
            let mut u = front + 3.0;
            while u < lot.half_along {
                let r = dice.range(0.6, 1.0);
                plan.plant(lot.at(u, side * (half - 0.3)), r, Habit::Shrub, dice);
                u += r * 1.05;
            }
        } else {
            for _ in 0..3 {
                let r = dice.range(0.4, 1.3);
                let p = lot.at(dice.range(front + 1.0, lot.half_along), side * (half - 1.0));
                plan.plant(p, r, Habit::Shrub, dice);
            }
        }
    }
}

fn farm(plan: &mut Plan, center: Spot, angle: f32, dice: &mut Dice) {
    let yard = Slab::new(
        center,
        angle,
        dice.range(52.0, 66.0),
        dice.range(40.0, 52.0),
    );
    plan.lay(
        Outline::Slab(yard),
        Ground::Dirt,
        yard.axis,
        3.5,
        Some(SceneKind::Yard),
    );
    plan.reserved.push(yard.grown(4.0));
    let (a, b) = (yard.half_along, yard.half_across);
    let colors = [
        [0.3, 0.31, 0.31],
        [0.25, 0.13, 0.1],
        [0.12, 0.17, 0.13],
        [0.4, 0.4, 0.38],
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
        Cover::Metal,
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
        Cover::Metal,
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
            Cover::Metal,
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
    plan.lay_slab(house.grown(6.0), Ground::Lawn, 0.8);
    plan.reserved.push(house.grown(6.0));
    plan.raise(
        house,
        Roof::Gable,
        Cover::Tiles,
        dice.pick(&ROOFS),
        5.2,
        3.4,
        SceneKind::House,
    );
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
            Cover::Plain,
            [0.42, 0.43, 0.43],
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
            Form::Bale,
            [0.42, 0.36, 0.22],
        );
    }
    for _ in 0..4 {
        let p = yard.at(dice.range(-0.4, 0.6) * a, dice.range(-0.2, 0.5) * b);
        let slab = Slab::new(p, dice.range(0.0, PI), dice.range(3.5, 7.0), 2.2);
        if plan.is_clear_of_solids(&slab) {
            let color = dice.pick(&[
                [0.05, 0.16, 0.05],
                [0.3, 0.04, 0.03],
                [0.3, 0.2, 0.05],
                [0.2, 0.2, 0.2],
            ]);
            plan.put(slab, 2.4, dice.pick(&[Form::Truck, Form::Crate]), color);
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
    // A drive to the nearest road.
    let nearest = plan
        .roads
        .iter()
        .filter(|r| r.class > RoadClass::Track)
        .flat_map(|r| r.curve.iter().copied())
        .min_by(|x, y| (*x - center).length().total_cmp(&(*y - center).length()));
    if let Some(end) = nearest {
        let middle = (end + center) * 0.5 + (end - center).unit().right() * dice.range(-12.0, 12.0);
        plan.roads.push(super::things::Road {
            class: RoadClass::Track,
            curve: super::shape::smooth_curve(&[end, middle, center], 5.0),
            half_width: 1.6,
            name: None,
            village: false,
        });
    }
}
