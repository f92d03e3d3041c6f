//! Houses along streets, with their gardens, drives and sheds; farms and hamlets.

use super::noise::Dice;
use super::plan::SceneryPlan;
use super::shape::{Slab, Spot, spot};
use super::{farm, house};

/// Rows of houses along roads: road name, from, to (metres along), mean spacing, both sides.
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
pub(super) fn build(plan: &mut SceneryPlan, seed: u64) {
    let mut dice = Dice::new(seed, 21);
    for (n, e, angle) in FARMS {
        farm::build(plan, spot(n, e), angle, &mut dice);
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
    plan: &mut SceneryPlan,
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
                    .all(|c| plan.is_clear_of_roads(c, 0.8));
                if clear && plan.is_free(&lot.grown(0.2)) && !under_second_leg(lot.center) {
                    house::lot(plan, &lot, heading, dice);
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
