//! Routes with as few way-points as they need, and none that the aircraft cannot turn at.

use serde::{Deserialize, Serialize};

use super::find::{FoundRoute, RouteQuestion};
use crate::frames::GroundPoint;

/// Sharpest turn that is anticipated before a way-point, radians; as in the guidance.
const SHARPEST: f64 = 2.4;

/// How the aircraft turns from one leg onto the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Turns {
    /// Radius, metres.
    pub radius: f64,
    /// Way over the ground while it rolls into the turn, metres.
    pub roll_in: f64,
}

impl Turns {
    /// Way before and behind a way-point that the turn there needs, metres.
    pub fn lead(&self, before: &GroundPoint, at: &GroundPoint, after: &GroundPoint) -> f64 {
        let (a, b) = (
            at.to_vector() - before.to_vector(),
            after.to_vector() - at.to_vector(),
        );
        let turn = a.perp(&b).atan2(a.dot(&b)).abs();
        if turn < 1e-3 {
            return 0.0;
        }
        self.radius * (0.5 * turn.min(SHARPEST)).tan() + self.roll_in
    }
}

/// Index of the first leg that is too short for the turns at its ends; `None` if all fit.
pub fn fits(way_points: &[GroundPoint], turns: &Turns) -> Option<usize> {
    let lead = |i: usize| {
        if i == 0 || i + 1 >= way_points.len() {
            0.0
        } else {
            turns.lead(&way_points[i - 1], &way_points[i], &way_points[i + 1])
        }
    };
    (0..way_points.len().saturating_sub(1))
        .find(|&i| way_points[i].distance(&way_points[i + 1]) < lead(i) + lead(i + 1))
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

#[cfg(test)]
mod tests {
    use super::*;

    const TURNS: Turns = Turns {
        radius: 65.0,
        roll_in: 10.0,
    };

    fn line(points: &[(f64, f64)]) -> Vec<GroundPoint> {
        points
            .iter()
            .map(|(n, e)| GroundPoint::new(*n, *e))
            .collect()
    }

    #[test]
    fn a_leg_between_two_right_angles_needs_two_radii() {
        let long = line(&[(0.0, 0.0), (500.0, 0.0), (500.0, 151.0), (0.0, 151.0)]);
        assert_eq!(fits(&long, &TURNS), None);
        let short = line(&[(0.0, 0.0), (500.0, 0.0), (500.0, 149.0), (0.0, 149.0)]);
        assert_eq!(fits(&short, &TURNS), Some(1));
    }

    #[test]
    fn a_way_point_on_a_straight_line_needs_no_room() {
        let straight = line(&[(0.0, 0.0), (5.0, 0.0), (9.0, 0.0)]);
        assert_eq!(fits(&straight, &TURNS), None);
    }
}
