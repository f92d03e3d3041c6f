//! The road map: a graph whose edges are curved.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use petgraph::Direction;
use petgraph::graph::{EdgeIndex, NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;
use pilotage_base::frames::{GroundPoint, GroundRect, wrap_pi};

use crate::course::{course_length, heading, place_along};
use crate::line::{RoadClass, RoadLine};
use crate::repeats::{either_way, first_of_each};
use crate::segments::{NearRoad, Segment, SegmentGrid};
use crate::weave::{RoadJoining, weave};

/// Way from a crossing at which the direction of a road that leaves it is taken, metres: farther than the corner of a
/// kerb, nearer than most bends.
const TANGENT_REACH: f64 = 12.0;

/// Turn between two straight pieces from which on they make a corner, radians.
const CORNER: f64 = 0.6;

/// Difference of the headings of two roads that leave a crossing up to which they are one, radians.
const SAME: f64 = 1e-6;

/// A road between two nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadEdge {
    /// Index of the line that it is a part of.
    pub line: usize,
    /// Centre line from the edge's source to its target.
    pub course: Vec<GroundPoint>,
    /// Length of the centre line, metres.
    pub length: f64,
}

/// Place where three roads or more leave.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadCrossing {
    /// Index of its node.
    pub node: usize,
    /// The place.
    pub place: GroundPoint,
    /// Headings of the roads that leave it, outward, radians clockwise from north, in ascending order from -π to π.
    pub directions: Vec<f64>,
}

/// Roads as a graph: ends and crossings joined by curved centre lines.
#[derive(Clone, Debug)]
pub struct RoadMap {
    lines: Vec<RoadLine>,
    graph: UnGraph<GroundPoint, RoadEdge>,
    grid: SegmentGrid,
}

impl RoadMap {
    /// The map of these lines, cut where they meet. What is there twice, in whole lines or in parts, is there once, of the
    /// greatest class.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_roads::{RoadClass, RoadJoining, RoadLine, RoadMap};
    ///
    /// let road = |course: [(f64, f64); 2]| RoadLine {
    ///     class: RoadClass::Tertiary,
    ///     width: 6.0,
    ///     course: course.map(|(north, east)| GroundPoint::new(north, east)).to_vec(),
    ///     ..RoadLine::default()
    /// };
    /// let lines = [road([(-100.0, 0.0), (100.0, 0.0)]), road([(0.0, -50.0), (0.0, 50.0)])];
    /// let joining = RoadJoining { snap: 0.5, crossings: true, reach: 0.0 };
    /// let map = RoadMap::new(lines.to_vec(), joining);
    /// assert_eq!((map.graph().node_count(), map.graph().edge_count()), (5, 4));
    /// assert_eq!(map.crossings()[0].directions.len(), 4);
    /// // 3 m to the right of the road that leads north.
    /// let near = map.nearest(GroundPoint::new(60.0, 3.0), 10.0).ok_or("no road")?;
    /// assert_eq!(near.right.abs(), 3.0);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn new(mut lines: Vec<RoadLine>, joining: RoadJoining) -> Self {
        let woven = weave(&lines, joining);
        let mut uses = vec![0; woven.points.len()];
        let is_first = first_of_each(&woven.lines);
        for (indices, _) in woven.lines.iter().zip(&is_first).filter(|it| *it.1) {
            for (place, index) in indices.iter().enumerate() {
                let is_end = place == 0 || place + 1 == indices.len();
                uses[*index] += if is_end { 2 } else { 1 };
            }
        }
        let mut graph = UnGraph::default();
        let mut nodes: Vec<Option<NodeIndex>> = vec![None; woven.points.len()];
        let mut edges = BTreeMap::new();
        for (line, indices) in woven.lines.iter().enumerate() {
            let mut start = 0;
            for end in 1..indices.len() {
                if uses[indices[end]] < 2 {
                    continue;
                }
                let way = either_way(&indices[start..=end]);
                if let Some(known) = edges.get(&way) {
                    let known: &mut RoadEdge = &mut graph[*known];
                    if lines[line].class > lines[known.line].class {
                        known.line = line;
                    }
                    start = end;
                    continue;
                }
                let course: Vec<GroundPoint> = indices[start..=end]
                    .iter()
                    .map(|i| woven.points[*i])
                    .collect();
                let ends = [indices[start], indices[end]].map(|point| {
                    *nodes[point].get_or_insert_with(|| graph.add_node(woven.points[point]))
                });
                let length = course_length(&course);
                let edge = RoadEdge {
                    line,
                    course,
                    length,
                };
                edges.insert(way, graph.add_edge(ends[0], ends[1], edge));
                start = end;
            }
        }
        for (line, indices) in lines.iter_mut().zip(&woven.lines) {
            line.course = indices.iter().map(|i| woven.points[*i]).collect();
        }
        let grid = SegmentGrid::new(segments(&graph));
        Self { lines, graph, grid }
    }

    /// The lines of which the map was made, with the points at which they meet: shared points join them again.
    pub fn lines(&self) -> &[RoadLine] {
        &self.lines
    }

    /// The graph; its edges' courses lead from source to target.
    pub fn graph(&self) -> &UnGraph<GroundPoint, RoadEdge> {
        &self.graph
    }

    /// The edge with that index.
    ///
    /// # Panics
    /// If the map has no such edge.
    pub fn edge(&self, index: usize) -> &RoadEdge {
        &self.graph[EdgeIndex::new(index)]
    }

    /// Line of the edge with that index.
    ///
    /// # Panics
    /// If the map has no such edge.
    pub fn line_of(&self, edge: usize) -> &RoadLine {
        &self.lines[self.edge(edge).line]
    }

    /// Length of all roads, metres.
    pub fn length(&self) -> f64 {
        self.graph.edge_weights().map(|edge| edge.length).sum()
    }

    /// The smallest rectangle around all roads; `None` without a road.
    pub fn bounds(&self) -> Option<GroundRect> {
        let edges = self.graph.edge_weights();
        GroundRect::around(edges.flat_map(|edge| edge.course.iter().copied()))
    }

    /// The nearest road within `reach` metres of `point`.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_roads::{RoadJoining, RoadLine, RoadMap};
    ///
    /// let course = vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(100.0, 0.0)];
    /// let map = RoadMap::new(vec![RoadLine { course, ..RoadLine::default() }], RoadJoining::SHARED_POINTS);
    /// // Five metres beyond its northern end and twelve to the east: √(5² + 12²) from it.
    /// let place = GroundPoint::new(105.0, 12.0);
    /// let road = map.nearest(place, 20.0).ok_or("no road")?;
    /// assert_eq!((road.distance, road.along, road.right), (13.0, 100.0, 12.0));
    /// assert!(map.nearest(place, 12.5).is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn nearest(&self, point: GroundPoint, reach: f64) -> Option<NearRoad> {
        self.grid.nearest(point, reach, None)
    }

    /// The nearest road within `reach` metres of `point` that runs within `turn` radians of `direction`, in either
    /// sense.
    pub fn nearest_like(
        &self,
        point: GroundPoint,
        reach: f64,
        direction: f64,
        turn: f64,
    ) -> Option<NearRoad> {
        self.grid.nearest(point, reach, Some((direction, turn)))
    }

    /// Every place where three roads or more leave, of the classes from `least` on.
    pub fn crossings(&self) -> Vec<RoadCrossing> {
        self.crossings_of(RoadClass::Path)
    }

    /// The same among roads of the class `least` or a greater one.
    pub fn crossings_of(&self, least: RoadClass) -> Vec<RoadCrossing> {
        let nodes = self.graph.node_indices();
        let crossing = |node: NodeIndex| {
            let mut directions = Vec::new();
            let mut seen = BTreeSet::new();
            for edge in self.graph.edges_directed(node, Direction::Outgoing) {
                let RoadEdge { line, course, .. } = edge.weight();
                // A loop leaves its node twice, and is listed once or twice.
                if self.lines[*line].class < least || !seen.insert(edge.id()) {
                    continue;
                }
                let (from, to) = self.graph.edge_endpoints(edge.id())?;
                if from == node {
                    directions.push(leaving(course));
                }
                if to == node {
                    let back: Vec<GroundPoint> = course.iter().rev().copied().collect();
                    directions.push(leaving(&back));
                }
            }
            directions.sort_by(f64::total_cmp);
            directions.dedup_by(|own, before| *own - *before < SAME);
            // South is at both ends.
            if let [first, .., last] = directions[..]
                && first + TAU - last < SAME
            {
                directions.pop();
            }
            (directions.len() >= 3).then(|| RoadCrossing {
                node: node.index(),
                place: self.graph[node],
                directions,
            })
        };
        nodes.filter_map(crossing).collect()
    }
}

/// Heading in which a course leaves its first point.
fn leaving(course: &[GroundPoint]) -> f64 {
    let ahead = place_along(course, TANGENT_REACH).map_or(course[0], |place| place.point);
    heading(course[0], ahead)
}

fn segments(graph: &UnGraph<GroundPoint, RoadEdge>) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (edge, RoadEdge { course, .. }) in graph.edge_weights().enumerate() {
        let headings: Vec<f64> = course.windows(2).map(|w| heading(w[0], w[1])).collect();
        // Half of the turn from one piece to the next, where that is a bend and no corner.
        let half_turn = |piece: usize| {
            let (own, next) = (headings.get(piece), headings.get(piece + 1));
            let turn = own.zip(next).map_or(0.0, |(own, next)| wrap_pi(next - own));
            if turn.abs() < CORNER { 0.5 * turn } else { 0.0 }
        };
        let mut along = 0.0;
        for (piece, pair) in course.windows(2).enumerate() {
            segments.push(Segment {
                edge: edge as u32,
                from: pair[0],
                to: pair[1],
                along,
                turns: [
                    piece
                        .checked_sub(1)
                        .map_or(0.0, |before| -half_turn(before)),
                    half_turn(piece),
                ],
            });
            along += pair[0].distance(&pair[1]);
        }
    }
    segments
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn line(course: &[(f64, f64)]) -> RoadLine {
        RoadLine {
            width: 6.0,
            course: course
                .iter()
                .map(|(n, e)| GroundPoint::new(*n, *e))
                .collect(),
            ..RoadLine::default()
        }
    }

    #[test]
    fn a_line_is_cut_where_another_shares_its_point_and_nowhere_else() {
        let lines = vec![
            line(&[(0.0, 0.0), (0.0, 50.0), (0.0, 100.0), (0.0, 150.0)]),
            line(&[(80.0, 100.0), (0.0, 100.0)]),
            // Passes over the first without a common point: a bridge.
            line(&[(-10.0, 20.0), (10.0, 20.0)]),
        ];
        let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
        assert_eq!(map.graph().edge_count(), 4);
        assert_eq!(map.graph().node_count(), 6);
        assert_eq!(map.length(), 150.0 + 80.0 + 20.0);
        let crossings = map.crossings();
        assert_eq!(crossings.len(), 1);
        assert_eq!(crossings[0].place, GroundPoint::new(0.0, 100.0));
        assert_eq!(crossings[0].directions, [-FRAC_PI_2, 0.0, FRAC_PI_2]);
    }

    #[test]
    fn lines_that_cross_or_end_beside_each_other_are_joined_when_asked() {
        let joining = RoadJoining {
            snap: 0.1,
            crossings: true,
            reach: 2.0,
        };
        let lines = vec![
            line(&[(0.0, -100.0), (0.0, 100.0)]),
            line(&[(-40.0, -30.0), (40.0, -30.0)]),
            // Ends 1.5 m before the first.
            line(&[(60.0, 50.0), (1.5, 50.0)]),
        ];
        let map = RoadMap::new(lines, joining);
        let crossings = map.crossings();
        assert_eq!(crossings.len(), 2);
        assert_eq!(crossings[0].place, GroundPoint::new(0.0, -30.0));
        assert_eq!(crossings[0].directions.len(), 4);
        assert_eq!(crossings[1].directions.len(), 3);
        assert_eq!(crossings[1].place, GroundPoint::new(0.0, 50.0));
        assert_eq!(map.graph().edge_count(), 6);
        assert_eq!(map.length(), 200.0 + 80.0 + 60.0);
    }

    #[test]
    fn a_ring_that_nothing_meets_is_one_edge_and_one_met_by_two_roads_is_cut() {
        let ring = line(&[
            (0.0, 0.0),
            (50.0, 0.0),
            (50.0, 50.0),
            (0.0, 50.0),
            (0.0, 0.0),
        ]);
        let alone = RoadMap::new(vec![ring.clone()], RoadJoining::SHARED_POINTS);
        assert_eq!(
            (alone.graph().node_count(), alone.graph().edge_count()),
            (1, 1)
        );
        assert!(alone.crossings().is_empty());
        let met = vec![ring, line(&[(50.0, 50.0), (90.0, 90.0)])];
        let met = RoadMap::new(met, RoadJoining::SHARED_POINTS);
        assert_eq!(met.graph().edge_count(), 3);
        assert_eq!(met.crossings().len(), 1);
    }

    #[test]
    fn the_side_of_a_road_is_that_seen_along_it() {
        let map = RoadMap::new(
            vec![line(&[(0.0, 0.0), (100.0, 100.0), (100.0, 300.0)])],
            RoadJoining::SHARED_POINTS,
        );
        // South-east of a road to the north-east: right.
        let near = map.nearest(GroundPoint::new(47.0, 53.0), 20.0).unwrap();
        assert!((near.right - 18_f64.sqrt()).abs() < 1e-12, "{near:?}");
        assert!((near.along - 5000_f64.sqrt()).abs() < 1e-9);
        let left = map.nearest(GroundPoint::new(104.0, 180.0), 20.0).unwrap();
        assert!((left.right + 4.0).abs() < 1e-12);
        assert_eq!(left.heading, FRAC_PI_2);
        assert!(map.nearest(GroundPoint::new(104.0, 180.0), 3.9).is_none());
        // Beyond the end the foot is the end.
        let beyond = map.nearest(GroundPoint::new(103.0, 304.0), 20.0).unwrap();
        assert!((beyond.distance - 5.0).abs() < 1e-12 && (beyond.right + 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_place_beside_two_roads_is_matched_to_the_one_that_runs_like_it() {
        let lines = vec![
            line(&[(0.0, -100.0), (0.0, 100.0)]),
            line(&[(-100.0, 0.0), (100.0, 0.0)]),
        ];
        let map = RoadMap::new(
            lines,
            RoadJoining {
                snap: 0.1,
                crossings: true,
                reach: 0.0,
            },
        );
        let at = GroundPoint::new(2.0, 5.0);
        let any = map.nearest(at, 20.0).unwrap();
        let like = map.nearest_like(at, 20.0, PI - 0.1, 0.3).unwrap();
        assert_eq!(any.distance, 2.0);
        assert_eq!(like.distance, 5.0);
        assert!(map.nearest_like(at, 20.0, 0.8, 0.3).is_none());
    }
}
