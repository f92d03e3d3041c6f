//! Routes with as few way-points as they need, and none that the aircraft cannot turn at.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::found::FoundRoute;
use super::question::RouteQuestion;
use super::turns::fits;
use pilotage_base::frames::GroundPoint;

/// Rounds in which way-points are moved, and the directions that are tried.
const POLISHING: usize = 24;
/// See [`POLISHING`].
const DIRECTIONS: u32 = 8;
/// Share by which a route is better, at least, if a way-point is to be moved for it.
const LEAST_GAIN: f64 = 1e-3;

/// Moves way-points, one by one and by less and less, as long as that makes the route better and it costs
/// no more than `most`: the nodes of the graph do not know of the turns.
pub(super) fn polish(question: &RouteQuestion, route: FoundRoute, most: f64) -> FoundRoute {
    let mut now = route;
    let mut step = question.pass;
    for _ in 0..POLISHING {
        let mut better = false;
        for i in 1..now.way_points.len().saturating_sub(1) {
            for direction in 0..DIRECTIONS {
                let (sin, cos) = (TAU * f64::from(direction) / f64::from(DIRECTIONS)).sin_cos();
                let mut line = now.way_points.clone();
                line[i] = (line[i].to_vector() + step * Vector2::new(cos, sin)).into();
                let moved = question.judge(&line).filter(|moved| {
                    question.aimed(moved) < (1.0 - LEAST_GAIN) * question.aimed(&now)
                        && question.cost(moved.length, moved.time) <= most
                        && fits(&line, &question.turns).is_none()
                });
                if let Some(moved) = moved {
                    now = moved;
                    better = true;
                }
            }
        }
        if !better {
            step *= 0.5;
        }
    }
    now
}

/// Takes way-points out of a route, or makes one of two, as long as it gets worse by no more than the share `worse` and costs
/// no more than `most`; then those between which the aircraft cannot turn, at whatever price.
pub(super) fn pull_tight(
    question: &RouteQuestion,
    route: &FoundRoute,
    most: f64,
    worse: f64,
) -> FoundRoute {
    let limit = (1.0 + worse) * question.aimed(route);
    let allowed = |line: &[GroundPoint]| {
        let judged = question.judge(line)?;
        (question.cost(judged.length, judged.time) <= most * (1.0 + 1e-9)).then_some(judged)
    };
    let best = |lines: Vec<Vec<GroundPoint>>| {
        let judged = lines.iter().filter_map(|line| allowed(line));
        judged.min_by(|a, b| question.aimed(a).total_cmp(&question.aimed(b)))
    };
    let mut now = route.clone();
    loop {
        let line = &now.way_points;
        let inner = 1..line.len().saturating_sub(1);
        let removed = inner.clone().map(|i| without(line, i));
        let merged = inner.skip(1).map(|i| merged(line, i - 1));
        let simpler = removed.chain(merged).collect();
        match best(simpler).filter(|r| question.aimed(r) <= limit) {
            Some(simpler) => now = simpler,
            None => break,
        }
    }
    while let Some(leg) = fits(&now.way_points, &question.turns) {
        let line = &now.way_points;
        let inner = |i: usize| i > 0 && i + 1 < line.len();
        let mut others: Vec<Vec<GroundPoint>> = [leg, leg + 1]
            .into_iter()
            .filter(|i| inner(*i))
            .map(|i| without(line, i))
            .collect();
        if inner(leg) && inner(leg + 1) {
            others.push(merged(line, leg));
        }
        match best(others) {
            Some(flyable) => now = flyable,
            None => break,
        }
    }
    now
}

/// The line with two way-points made one, between them.
fn merged(line: &[GroundPoint], index: usize) -> Vec<GroundPoint> {
    let mut shorter = without(line, index + 1);
    let (a, b) = (line[index].to_vector(), line[index + 1].to_vector());
    shorter[index] = GroundPoint::from(0.5 * (a + b));
    shorter
}

fn without(line: &[GroundPoint], index: usize) -> Vec<GroundPoint> {
    let mut shorter = line.to_vec();
    shorter.remove(index);
    shorter
}
