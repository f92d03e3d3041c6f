//! Finding a route: from A to B over places where a fix will be had.
//!
//! Uncertainty grows with the way since the last fix, so that the worst uncertainty of a route is that
//! of its longest stretch without one. Places that give a fix are the nodes of a graph, and its edges the
//! ways between them around no-fly areas. The least longest stretch within a length budget is found by
//! bisection over the stretches that occur: for each, the shortest path over edges no longer than it.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use serde::{Deserialize, Serialize};

use crate::frames::GroundPoint;

/// A closed polygon that must not be flown over, its corners in either order.
pub type NoFlyArea = Vec<GroundPoint>;

/// What to find.
#[derive(Clone, Debug)]
pub struct RouteQuestion<'a> {
    /// Where the route begins; a fix is had there.
    pub from: GroundPoint,
    /// Where it ends.
    pub to: GroundPoint,
    /// Places over which a fix will be had.
    pub fixes: &'a [GroundPoint],
    /// Distance from the way at which a fix is still had: half a picture, metres.
    pub reach: f64,
    /// Areas to fly around.
    pub no_fly: &'a [NoFlyArea],
    /// Distance that is kept from the corners of no-fly areas, metres.
    pub clearance: f64,
    /// Greatest length of the route over that of the shortest allowed one, e.g. 1.3.
    pub budget: f64,
}

/// A route and what it is worth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundRoute {
    /// Way-points, both ends included.
    pub way_points: Vec<GroundPoint>,
    /// Its length, metres.
    pub length: f64,
    /// Its longest stretch without a fix, metres.
    pub longest_gap: f64,
}

/// The shortest allowed route, and the one with the least longest stretch without a fix within the
/// budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundRoutes {
    /// The shortest allowed.
    pub shortest: FoundRoute,
    /// The one that is never long without a fix; the shortest itself where nothing is better.
    pub surest: FoundRoute,
}

/// A way between two nodes.
#[derive(Clone, Debug)]
struct Way {
    to: usize,
    length: f64,
    /// Corners of no-fly areas on it.
    around: Vec<GroundPoint>,
}

impl RouteQuestion<'_> {
    /// Finds both routes; `None` if no-fly areas lie over an end or between the ends all around.
    pub fn find(&self) -> Option<FoundRoutes> {
        let (direct, around) = self.way(self.from, self.to)?;
        let mut line = vec![self.from];
        line.extend(around);
        line.push(self.to);
        let shortest = self.route(line);
        let most = self.budget * direct;
        // Both ends first, then every fix that the budget allows to pass at all.
        let mut nodes = vec![self.from, self.to];
        nodes.extend(self.fixes.iter().copied().filter(|f| {
            self.from.distance(f) + f.distance(&self.to) <= most && !self.forbidden(f)
        }));
        let ways = self.ways(&nodes, direct);
        let mut gaps: Vec<f64> = ways.iter().flatten().map(|w| w.length).collect();
        gaps.sort_by(f64::total_cmp);
        let (mut low, mut high) = (0, gaps.len());
        let mut surest = None;
        while low < high {
            let middle = usize::midpoint(low, high);
            match path(&nodes, &ways, gaps[middle], most) {
                Some(line) => {
                    surest = Some(self.route(line));
                    high = middle;
                }
                None => low = middle + 1,
            }
        }
        Some(FoundRoutes {
            // Fixes beside the shortest may make it the surest as well.
            surest: surest
                .filter(|s| s.longest_gap < shortest.longest_gap)
                .unwrap_or_else(|| shortest.clone()),
            shortest,
        })
    }

    /// The route over a line, with the fixes that lie within reach of it.
    fn route(&self, way_points: Vec<GroundPoint>) -> FoundRoute {
        let mut passed = vec![0.0];
        let mut length = 0.0;
        for leg in way_points.windows(2) {
            let way = leg[1].to_vector() - leg[0].to_vector();
            let long = way.norm();
            let mut on_leg: Vec<f64> = self
                .fixes
                .iter()
                .filter_map(|fix| {
                    let to = fix.to_vector() - leg[0].to_vector();
                    let along = (way.dot(&to) / long.max(1e-9)).clamp(0.0, long);
                    let off = (to - way * (along / long.max(1e-9))).norm();
                    (off <= self.reach).then_some(length + along)
                })
                .collect();
            on_leg.sort_by(f64::total_cmp);
            passed.extend(on_leg);
            length += long;
        }
        passed.push(length);
        let gaps = passed.windows(2).map(|p| p[1] - p[0]);
        FoundRoute {
            longest_gap: gaps.fold(0.0, f64::max),
            length,
            way_points,
        }
    }

    /// Ways between all pairs of nodes that are no longer than `longest`.
    fn ways(&self, nodes: &[GroundPoint], longest: f64) -> Vec<Vec<Way>> {
        let mut ways: Vec<Vec<Way>> = vec![Vec::new(); nodes.len()];
        for i in 0..nodes.len() {
            for j in i + 1..nodes.len() {
                if nodes[i].distance(&nodes[j]) > longest {
                    continue;
                }
                let Some((length, around)) = self.way(nodes[i], nodes[j]) else {
                    continue;
                };
                let mut back = around.clone();
                back.reverse();
                ways[i].push(Way {
                    to: j,
                    length,
                    around,
                });
                ways[j].push(Way {
                    to: i,
                    length,
                    around: back,
                });
            }
        }
        ways
    }

    /// Length of the shortest way from `a` to `b` around the no-fly areas, and the corners it turns at.
    fn way(&self, a: GroundPoint, b: GroundPoint) -> Option<(f64, Vec<GroundPoint>)> {
        if self.free(&a, &b) {
            return Some((a.distance(&b), Vec::new()));
        }
        let mut nodes = vec![a, b];
        nodes.extend(self.corners());
        let ways: Vec<Vec<Way>> = (0..nodes.len())
            .map(|i| {
                let others = (0..nodes.len()).filter(|j| *j != i);
                others
                    .filter(|j| self.free(&nodes[i], &nodes[*j]))
                    .map(|j| Way {
                        to: j,
                        length: nodes[i].distance(&nodes[j]),
                        around: Vec::new(),
                    })
                    .collect()
            })
            .collect();
        let line = path(&nodes, &ways, f64::INFINITY, f64::INFINITY)?;
        let length = line.windows(2).map(|p| p[0].distance(&p[1])).sum();
        Some((length, line[1..line.len() - 1].to_vec()))
    }

    /// Corners of the no-fly areas, moved away from their middle by the clearance.
    fn corners(&self) -> Vec<GroundPoint> {
        let mut corners = Vec::new();
        for area in self.no_fly {
            let n = area.len().max(1) as f64;
            let middle = area
                .iter()
                .map(|p| p.to_vector())
                .sum::<nalgebra::Vector2<f64>>()
                / n;
            for corner in area {
                let out = corner.to_vector() - middle;
                let place: GroundPoint =
                    (corner.to_vector() + out.normalize() * self.clearance.max(0.1)).into();
                if !self.forbidden(&place) {
                    corners.push(place);
                }
            }
        }
        corners
    }

    fn forbidden(&self, p: &GroundPoint) -> bool {
        self.no_fly.iter().any(|area| inside(area, p))
    }

    fn free(&self, a: &GroundPoint, b: &GroundPoint) -> bool {
        let middle: GroundPoint = (0.5 * (a.to_vector() + b.to_vector())).into();
        !self.forbidden(&middle)
            && self.no_fly.iter().all(|area| {
                (0..area.len()).all(|i| !cross(a, b, &area[i], &area[(i + 1) % area.len()]))
            })
    }
}

/// Whether a point lies in a polygon (crossing number).
fn inside(area: &[GroundPoint], p: &GroundPoint) -> bool {
    let mut within = false;
    for i in 0..area.len() {
        let (a, b) = (&area[i], &area[(i + 1) % area.len()]);
        if (a.east > p.east) != (b.east > p.east) {
            let north = a.north + (p.east - a.east) / (b.east - a.east) * (b.north - a.north);
            if p.north < north {
                within = !within;
            }
        }
    }
    within
}

/// Whether two segments cross at inner points of both.
fn cross(a: &GroundPoint, b: &GroundPoint, c: &GroundPoint, d: &GroundPoint) -> bool {
    let side = |p: &GroundPoint, q: &GroundPoint, r: &GroundPoint| {
        (q.north - p.north) * (r.east - p.east) - (q.east - p.east) * (r.north - p.north)
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// A place in the queue of Dijkstra's search: the shortest first.
struct Reached {
    length: f64,
    node: usize,
}

impl PartialEq for Reached {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Reached {}
impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        other.length.total_cmp(&self.length)
    }
}

/// Shortest path from node 0 to node 1 over ways no longer than `gap`, if it is within `most` metres.
fn path(nodes: &[GroundPoint], ways: &[Vec<Way>], gap: f64, most: f64) -> Option<Vec<GroundPoint>> {
    let mut best = vec![f64::INFINITY; nodes.len()];
    let mut before: Vec<Option<(usize, usize)>> = vec![None; nodes.len()];
    let mut queue = BinaryHeap::new();
    best[0] = 0.0;
    queue.push(Reached {
        length: 0.0,
        node: 0,
    });
    while let Some(Reached { length, node }) = queue.pop() {
        if node == 1 {
            break;
        }
        if length > best[node] {
            continue;
        }
        for (index, way) in ways[node]
            .iter()
            .enumerate()
            .filter(|(_, w)| w.length <= gap)
        {
            let reached = length + way.length;
            if reached <= most && reached < best[way.to] {
                best[way.to] = reached;
                before[way.to] = Some((node, index));
                queue.push(Reached {
                    length: reached,
                    node: way.to,
                });
            }
        }
    }
    best[1].is_finite().then(|| {
        let mut line = vec![nodes[1]];
        let mut at = 1;
        while let Some((from, index)) = before[at] {
            line.extend(ways[from][index].around.iter().rev().copied());
            line.push(nodes[from]);
            at = from;
        }
        line.reverse();
        line
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(north: f64, east: f64) -> GroundPoint {
        GroundPoint::new(north, east)
    }

    #[test]
    fn a_detour_over_fixes_is_taken_while_the_budget_allows_it() {
        let fixes = [
            point(300.0, 250.0),
            point(700.0, 250.0),
            point(500.0, 2000.0),
        ];
        let question = RouteQuestion {
            from: point(0.0, 0.0),
            to: point(1000.0, 0.0),
            fixes: &fixes,
            reach: 30.0,
            no_fly: &[],
            clearance: 10.0,
            budget: 1.3,
        };
        let found = question.find().unwrap();
        assert_eq!(found.shortest.longest_gap, 1000.0);
        assert_eq!(found.surest.way_points.len(), 4, "{found:?}");
        assert!(found.surest.longest_gap <= 400.0 + 1e-9);
        let poor = RouteQuestion {
            budget: 1.05,
            ..question
        };
        assert_eq!(poor.find().unwrap().surest.way_points.len(), 2);
    }

    #[test]
    fn a_no_fly_area_is_flown_around_with_its_clearance() {
        let area = vec![
            point(400.0, -200.0),
            point(600.0, -200.0),
            point(600.0, 100.0),
            point(400.0, 100.0),
        ];
        let question = RouteQuestion {
            from: point(0.0, 0.0),
            to: point(1000.0, 0.0),
            fixes: &[],
            reach: 30.0,
            no_fly: std::slice::from_ref(&area),
            clearance: 20.0,
            budget: 2.0,
        };
        let route = question.find().unwrap().shortest;
        assert!(route.way_points.iter().any(|p| p.east > 100.0), "{route:?}");
        assert!(route.length > 1000.0 && route.length < 1100.0);
        let walled = RouteQuestion {
            to: point(500.0, 0.0),
            ..question
        };
        assert_eq!(walled.find(), None, "the end lies inside");
    }

    proptest! {
        #[test]
        fn the_surest_route_keeps_to_its_budget_and_is_never_longer_without_a_fix(
            fixes in prop::collection::vec((-200.0_f64..1200.0, -500.0_f64..500.0), 0..25),
            budget in 1.0_f64..1.6,
        ) {
            let fixes: Vec<GroundPoint> = fixes.into_iter().map(|(n, e)| point(n, e)).collect();
            let question = RouteQuestion {
                from: point(0.0, 0.0),
                to: point(1000.0, 0.0),
                fixes: &fixes,
                reach: 30.0,
                no_fly: &[],
                clearance: 10.0,
                budget,
            };
            let found = question.find().unwrap();
            prop_assert!(found.surest.length <= budget * found.shortest.length + 1e-6);
            prop_assert!(found.surest.longest_gap <= found.shortest.longest_gap + 1e-9);
            let walked: f64 = found.surest.way_points.windows(2).map(|p| p[0].distance(&p[1])).sum();
            prop_assert!((walked - found.surest.length).abs() < 1e-6);
        }
    }
}
