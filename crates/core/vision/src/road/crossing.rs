//! Places where roads meet, by the arms that cut circles around them.

use std::f64::consts::TAU;

use pilotage_raster::raster::{Gray, Raster};

use super::ridge::RoadBody;
use super::seen::{RoadPoint, SeenCrossing, outward};

/// Steps around a circle.
const STEPS: usize = 96;
/// Radii of the circles beyond the half width, pixels.
const BEYOND: [f64; 3] = [7.0, 12.0, 17.0];
/// Greatest turn of an arm from circle to circle, radians.
const TURN: f64 = 0.45;
/// Least angle between two arms, radians.
const APART: f64 = 0.6;
/// Pixels within which there is one crossing only.
const NEAR: f64 = 16.0;

/// An arm: its middles on the circles, as vectors from the middle of these.
struct Arm {
    middles: [[f64; 2]; 3],
    probability: f64,
}

impl Arm {
    /// Unit vector outward along the arm, from its first to its last middle.
    fn along(&self) -> [f64; 2] {
        let [first, _, last] = self.middles;
        let (x, y) = (last[0] - first[0], last[1] - first[1]);
        let length = x.hypot(y).max(1e-9);
        [x / length, y / length]
    }
}

/// The crossings of the roads whose centre lines have these points.
pub(super) fn crossings(
    body: &RoadBody,
    probability: &Gray,
    points: &[RoadPoint],
) -> Vec<SeenCrossing> {
    let mut candidates: Vec<(f64, SeenCrossing)> = Vec::new();
    for point in points {
        let arms = arms(body, probability, point.pixel, 0.5 * point.width);
        if arms.len() < 3 {
            continue;
        }
        let place = meeting(point.pixel, &arms);
        let moved = (place[0] - point.pixel[0]).hypot(place[1] - point.pixel[1]);
        if moved > NEAR {
            continue;
        }
        let mean = arms.iter().map(|a| a.probability).sum::<f64>() / arms.len() as f64;
        let mut directions: Vec<f64> = arms
            .iter()
            .map(|a| outward(a.along()[0], a.along()[1]))
            .collect();
        directions.sort_by(f64::total_cmp);
        let crossing = SeenCrossing {
            pixel: place,
            directions,
            probability: mean,
        };
        candidates.push((mean + 0.2 * arms.len() as f64 - 0.04 * moved, crossing));
    }
    candidates.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut found: Vec<SeenCrossing> = Vec::new();
    for (_, crossing) in candidates {
        let [x, y] = crossing.pixel;
        let near = |other: &SeenCrossing| (other.pixel[0] - x).hypot(other.pixel[1] - y) < NEAR;
        if !found.iter().any(near) {
            found.push(crossing);
        }
    }
    found
}

/// The arms that cut all circles around a place.
fn arms(body: &RoadBody, probability: &Gray, place: [f64; 2], half_width: f64) -> Vec<Arm> {
    let mut arms: Vec<Arm> = Vec::new();
    let runs = BEYOND.map(|beyond| runs(&body.mask, place, half_width + beyond));
    // Most points of a road have two.
    if runs.iter().any(|of_circle| of_circle.len() < 3) {
        return arms;
    }
    let radii = BEYOND.map(|beyond| half_width + beyond);
    for &first in &runs[0] {
        let nearest = |of_circle: &[f64], angle: f64| {
            let turn = |a: &f64| ((a - angle + 1.5 * TAU) % TAU - 0.5 * TAU).abs();
            let best = of_circle
                .iter()
                .copied()
                .min_by(|a, b| turn(a).total_cmp(&turn(b)));
            best.filter(|a| turn(a) < TURN)
        };
        let Some(second) = nearest(&runs[1], first) else {
            continue;
        };
        let Some(third) = nearest(&runs[2], second) else {
            continue;
        };
        let angles = [first, second, third];
        let middles =
            std::array::from_fn(|i| [radii[i] * angles[i].cos(), radii[i] * angles[i].sin()]);
        let mean = middles
            .iter()
            .map(|m: &[f64; 2]| value_at(probability, [place[0] + m[0], place[1] + m[1]]));
        let probability = mean.sum::<f64>() / 3.0;
        let arm = Arm {
            middles,
            probability,
        };
        let [x, y] = arm.along();
        let is_apart = |other: &Arm| {
            let [ox, oy] = other.along();
            x * ox + y * oy < APART.cos()
        };
        if arms.iter().all(is_apart) {
            arms.push(arm);
        }
    }
    arms
}

/// Middles of the runs of road along a circle, radians from right towards down.
fn runs(mask: &Raster<bool>, [x, y]: [f64; 2], radius: f64) -> Vec<f64> {
    let angle = |step: f64| step * TAU / STEPS as f64;
    let is_road = |step: usize| {
        let (sin, cos) = angle(step as f64).sin_cos();
        let (column, row) = ((x + radius * cos).floor(), (y + radius * sin).floor());
        let inside = column >= 0.0
            && row >= 0.0
            && column < mask.width() as f64
            && row < mask.height() as f64;
        inside && mask.get(column as usize, row as usize)
    };
    let road: Vec<bool> = (0..STEPS).map(is_road).collect();
    let Some(gap) = road.iter().position(|r| !r) else {
        return Vec::new();
    };
    let mut middles = Vec::new();
    let mut start = None;
    for i in 1..=STEPS {
        let step = gap + i;
        match (road[step % STEPS], start) {
            (true, None) => start = Some(step),
            (false, Some(from)) => {
                middles.push(angle(0.5 * (from + step - 1) as f64) % TAU);
                start = None;
            }
            _ => {}
        }
    }
    middles
}

fn value_at(picture: &Gray, [x, y]: [f64; 2]) -> f64 {
    let limit = |value: f64, size: usize| (value.max(0.0) as usize).min(size - 1);
    f64::from(picture.get(limit(x, picture.width()), limit(y, picture.height())))
}

/// The place that lies nearest to the lines along all arms, in the sense of least squares.
fn meeting([px, py]: [f64; 2], arms: &[Arm]) -> [f64; 2] {
    let [mut xx, mut xy, mut yy, mut bx, mut by] = [0.0; 5];
    for arm in arms {
        let [ux, uy] = arm.along();
        let (nx, ny) = (-uy, ux);
        let [mx, my] = arm.middles[1];
        let distance = nx * mx + ny * my;
        xx += nx * nx;
        xy += nx * ny;
        yy += ny * ny;
        bx += nx * distance;
        by += ny * distance;
    }
    let determinant = xx * yy - xy * xy;
    if determinant < 0.05 {
        return [px, py];
    }
    [
        px + (yy * bx - xy * by) / determinant,
        py + (xx * by - xy * bx) / determinant,
    ]
}

#[cfg(test)]
mod tests {
    use super::super::ridge::{ridge_points, road_mask};
    use super::*;

    /// Roads that leave (100, 90) in the given directions, degrees clockwise from up.
    fn star(directions: &[f64]) -> Gray {
        Gray::from_fn(200, 180, |x, y| {
            let (dx, dy) = (x as f64 + 0.5 - 100.0, y as f64 + 0.5 - 90.0);
            let on_arm = directions.iter().any(|d| {
                let (sin, cos) = d.to_radians().sin_cos();
                let (ahead, beside) = (dx * sin - dy * cos, dx * cos + dy * sin);
                ahead > -5.0 && beside.abs() < 5.0
            });
            if on_arm { 0.9 } else { 0.03 }
        })
    }

    fn found(directions: &[f64]) -> Vec<SeenCrossing> {
        let probability = star(directions);
        let body = RoadBody::new(road_mask(&probability, 0.5, 0.5));
        let points = ridge_points(&body, &probability);
        crossings(&body, &probability, &points)
    }

    #[test]
    fn three_and_four_arms_make_a_crossing_with_their_directions() {
        for directions in [
            &[0.0, 90.0, 180.0, 270.0][..],
            &[20.0, 110.0, 200.0],
            &[75.0, 165.0, 255.0, 345.0],
            &[0.0, 120.0, 240.0],
            &[10.0, 140.0, 190.0],
        ] {
            let all = found(directions);
            assert_eq!(all.len(), 1, "{directions:?}: {all:?}");
            let crossing = &all[0];
            let off = (crossing.pixel[0] - 100.0).hypot(crossing.pixel[1] - 90.0);
            assert!(off < 2.5, "{directions:?}: {off}");
            assert_eq!(crossing.directions.len(), directions.len(), "{all:?}");
            for (ours, theirs) in crossing.directions.iter().zip(directions) {
                // The arm to the north may come first or last.
                let turns = crossing.directions.iter();
                let near = turns
                    .map(|d| (d - theirs.to_radians()).cos())
                    .fold(-1.0, f64::max);
                assert!(near > 0.98, "{directions:?}: {ours}");
            }
        }
    }

    #[test]
    fn a_straight_road_and_a_bend_are_no_crossings() {
        for directions in [&[30.0, 210.0][..], &[0.0, 90.0]] {
            assert!(found(directions).is_empty());
        }
    }
}
