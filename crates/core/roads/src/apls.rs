//! Average path length similarity of two road graphs (Van Etten, Lindenbaum and Bacastow 2018, arXiv:1807.01232).
//!
//! Control points stand on nodes and along the edges of one graph and are put on the nearest edges of the other; what
//! counts is by which share the shortest ways between them differ. A point that has no edge near, and a way that is
//! interrupted, count as wholly different. The total is the harmonic mean of both directions.

use std::collections::BTreeMap;

use petgraph::algo::dijkstra;
use petgraph::graph::{NodeIndex, UnGraph};
use pilotage_base::frames::{GroundPoint, GroundRect};

use crate::course::{CoursePlace, course_length, place_along, place_near};
use crate::map::RoadMap;

/// Distance up to which a place at the end of an edge is the node there, per axis, metres.
const COINCIDENT: f64 = 0.05;
/// Distance up to which points are put on the edge on which they stand, metres.
const OWN_REACH: f64 = 5.0;
/// Distance that is less than the rounding of any other, metres.
const ROUNDING: f64 = 1e-3;
/// Shortest way that is compared, metres.
const SHORTEST: f64 = 1e-3;

/// A graph whose nodes have names, which the nodes of two graphs may share.
#[derive(Clone, Debug, Default)]
pub struct AplsGraph {
    /// Name and place of every node.
    pub nodes: Vec<(u64, GroundPoint)>,
    /// Edges.
    pub edges: Vec<AplsEdge>,
}

/// Edge of an [`AplsGraph`].
#[derive(Clone, Debug)]
pub struct AplsEdge {
    /// Indices of the nodes at both ends, the first at the beginning of the course.
    pub ends: [usize; 2],
    /// Length, metres.
    pub length: f64,
    /// Centre line.
    pub course: Vec<GroundPoint>,
}

/// Rules of the comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AplsSettings {
    /// Greatest distance at which a point is put on the other graph, metres.
    pub snap: f64,
    /// Distance between control points along an edge, metres.
    pub spacing: f64,
}

impl Default for AplsSettings {
    fn default() -> Self {
        Self {
            snap: 4.0,
            spacing: 50.0,
        }
    }
}

/// Similarity of two graphs, each from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AplsScore {
    /// Total.
    pub total: f64,
    /// Ways of the truth on the proposal.
    pub truth_onto_proposal: f64,
    /// Ways of the proposal on the truth.
    pub proposal_onto_truth: f64,
    /// Control points of the truth.
    pub of_truth: usize,
    /// Control points of the proposal.
    pub of_proposal: usize,
}

/// Similarity of `proposal` to `truth`.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::{AplsGraph, AplsSettings, RoadJoining, RoadLine, RoadMap, apls};
///
/// let road = |course: &[(f64, f64)]| RoadLine {
///     course: course.iter().map(|(n, e)| GroundPoint::new(*n, *e)).collect(),
///     ..RoadLine::default()
/// };
/// let graph = |lines| AplsGraph::of(&RoadMap::new(lines, RoadJoining::SHARED_POINTS), 0);
/// let truth = graph(vec![road(&[(0.0, 0.0), (0.0, 100.0)]), road(&[(0.0, 100.0), (80.0, 100.0)])]);
/// let score = apls(&truth, &truth, &AplsSettings::default());
/// assert!((score.total - 1.0).abs() < 1e-9);
/// // With one road of two, all ways to and on the other are missing.
/// let half = graph(vec![road(&[(0.0, 0.0), (0.0, 100.0)])]);
/// assert!(apls(&truth, &half, &AplsSettings::default()).truth_onto_proposal < 0.5);
/// ```
pub fn apls(truth: &AplsGraph, proposal: &AplsGraph, settings: &AplsSettings) -> AplsScore {
    let (own_truth, own_proposal) = (
        truth.with_control_points(settings.spacing),
        proposal.with_control_points(settings.spacing),
    );
    let onto = |control: &AplsGraph, other: &AplsGraph| {
        let mut other = CutGraph::of(other.clone());
        for (name, place) in &control.nodes {
            other.insert(*name, *place, settings.snap, true);
        }
        similarity(&Ways::of(control), &Ways::of(&other.graph))
    };
    let forth = onto(&own_truth, proposal);
    let back = onto(&own_proposal, truth);
    let total = if forth > 0.0 && back > 0.0 {
        2.0 / (1.0 / forth + 1.0 / back)
    } else {
        0.0
    };
    AplsScore {
        total,
        truth_onto_proposal: forth,
        proposal_onto_truth: back,
        of_truth: own_truth.nodes.len(),
        of_proposal: own_proposal.nodes.len(),
    }
}

/// Shortest ways of a graph, from one node at a time: those of all nodes at once would take memory by the square of the
/// graph.
struct Ways {
    /// Names of the nodes.
    net: UnGraph<u64, f64>,
    /// Nodes by their names.
    nodes: BTreeMap<u64, NodeIndex>,
}

impl Ways {
    fn of(graph: &AplsGraph) -> Self {
        let mut net = UnGraph::default();
        let nodes = graph.nodes.iter().map(|(name, _)| net.add_node(*name));
        let nodes: Vec<NodeIndex> = nodes.collect();
        for edge in &graph.edges {
            net.add_edge(nodes[edge.ends[0]], nodes[edge.ends[1]], edge.length);
        }
        Self {
            nodes: nodes.iter().map(|node| (net[*node], *node)).collect(),
            net,
        }
    }

    /// Lengths of the ways from a node to all that it reaches, by their names; `None` if there is none of that name.
    fn from(&self, name: u64) -> Option<BTreeMap<u64, f64>> {
        let reached = dijkstra(&self.net, *self.nodes.get(&name)?, None, |edge| {
            *edge.weight()
        });
        let lengths = reached.into_iter();
        Some(
            lengths
                .map(|(node, length)| (self.net[node], length))
                .collect(),
        )
    }
}

/// Mean similarity of the ways.
fn similarity(ways: &Ways, others: &Ways) -> f64 {
    let (mut differences, mut count) = (0.0, 0_u64);
    for from in ways.nodes.keys() {
        let there = others.from(*from);
        for (to, length) in ways.from(*from).unwrap_or_default() {
            if to == *from || there.is_some() && length < SHORTEST {
                continue;
            }
            count += 1;
            differences += match there.as_ref().and_then(|there| there.get(&to)) {
                Some(other) => ((length - other).abs() / length).min(1.0),
                None => 1.0,
            };
        }
    }
    if count == 0 {
        return 0.0;
    }
    1.0 - differences / count as f64
}

impl AplsGraph {
    /// Graph of a road map, its nodes named from `first` on: graphs that are compared share no names, unless their nodes
    /// are the same.
    pub fn of(map: &RoadMap, first: u64) -> Self {
        let graph = map.graph();
        let named = graph.node_weights().zip(first..);
        let edges = graph.edge_indices().filter_map(|edge| {
            let (from, to) = graph.edge_endpoints(edge)?;
            Some(AplsEdge {
                ends: [from.index(), to.index()],
                length: graph[edge].length,
                course: graph[edge].course.clone(),
            })
        });
        Self {
            nodes: named.map(|(place, name)| (name, *place)).collect(),
            edges: edges.collect(),
        }
    }

    /// The graph with points along its edges as nodes.
    fn with_control_points(&self, spacing: f64) -> Self {
        let mut cut = CutGraph::of(self.clone());
        let mut next = self.nodes.iter().map(|(name, _)| *name).max().unwrap_or(0) + 1;
        for edge in &self.edges {
            if edge.length < 0.75 * spacing {
                continue;
            }
            let pieces = if edge.length <= spacing {
                2
            } else {
                (edge.length / spacing).ceil() as usize
            };
            // A single piece has its middle at half of the drawn line, several stand at shares of the stated length.
            let whole = if edge.length <= spacing {
                course_length(&edge.course)
            } else {
                edge.length
            };
            for piece in 1..pieces {
                let along = whole * piece as f64 / pieces as f64;
                if let Some(place) = place_along(&edge.course, along) {
                    cut.insert(next, place.point, OWN_REACH, false);
                    next += 1;
                }
            }
        }
        cut.graph
    }
}

/// Graph whose edges are cut, with the rectangle around each of them: most edges are far from most points.
struct CutGraph {
    graph: AplsGraph,
    around: Vec<Option<GroundRect>>,
}

fn around(edge: &AplsEdge) -> Option<GroundRect> {
    GroundRect::around(edge.course.iter().copied())
}

impl CutGraph {
    fn of(graph: AplsGraph) -> Self {
        Self {
            around: graph.edges.iter().map(around).collect(),
            graph,
        }
    }

    fn push(&mut self, edge: AplsEdge) {
        self.around.push(around(&edge));
        self.graph.edges.push(edge);
    }

    /// Puts a node on the nearest edge within `reach` metres, unless one has that name. A node that stands there is
    /// renamed if `renames`, else joined by an edge without length.
    fn insert(&mut self, name: u64, point: GroundPoint, reach: f64, renames: bool) {
        let mut nearest: Option<(usize, CoursePlace, f64)> = None;
        let edges = self.graph.edges.iter().zip(&self.around).enumerate();
        for (index, (edge, around)) in edges {
            let is_far = around.is_none_or(|rect| !rect.grown(reach + ROUNDING).contains(&point));
            let place = if is_far {
                None
            } else {
                place_near(&edge.course, point)
            };
            let Some(place) = place else { continue };
            let distance = place.point.distance(&point);
            if nearest.is_none_or(|(.., least)| distance < least) {
                nearest = Some((index, place, distance));
            }
        }
        let Some((index, place, distance)) = nearest else {
            return;
        };
        let is_known = |node: &(u64, GroundPoint)| node.0 == name;
        if distance > reach || self.graph.nodes.iter().any(is_known) {
            return;
        }
        let edge = &self.graph.edges[index];
        let whole = course_length(&edge.course);
        if place.along <= 0.0 || place.along >= whole {
            let stands = |node: &usize| {
                let at = self.graph.nodes[*node].1;
                (at.north - place.point.north).abs() <= COINCIDENT
                    && (at.east - place.point.east).abs() <= COINCIDENT
            };
            let Some(node) = edge.ends.into_iter().find(stands) else {
                return;
            };
            if renames {
                self.graph.nodes[node].0 = name;
                return;
            }
            let own = self.graph.nodes.len();
            self.graph.nodes.push((name, place.point));
            self.push(AplsEdge {
                ends: [own, node],
                length: 0.0,
                course: vec![place.point, self.graph.nodes[node].1],
            });
            return;
        }
        let own = self.graph.nodes.len();
        self.graph.nodes.push((name, place.point));
        self.around.remove(index);
        let edge = self.graph.edges.remove(index);
        let (mut first, mut second) = (Vec::new(), vec![place.point]);
        let mut along = 0.0;
        for (i, p) in edge.course.iter().enumerate() {
            if i > 0 {
                along += edge.course[i - 1].distance(p);
            }
            if along < place.along {
                first.push(*p);
            } else if along > place.along {
                second.push(*p);
            }
        }
        first.push(place.point);
        for (ends, course) in [([edge.ends[0], own], first), ([own, edge.ends[1]], second)] {
            self.push(AplsEdge {
                ends,
                length: course_length(&course),
                course,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of `side` by `side` crooked streets, without some of them, named from `first` on.
    fn town(side: i32, first: u64) -> AplsGraph {
        let off = |row: i32, column: i32, k: i32| {
            let value = f64::from(row * 37 + column * 101 + k * 53).sin() * 43_758.5;
            value - value.floor()
        };
        let corner = |row: i32, column: i32| {
            let (north, east) = (off(row, column, 1), off(row, column, 2));
            GroundPoint::new(
                90.0 * (f64::from(row) + 0.4 * north),
                90.0 * (f64::from(column) + 0.4 * east),
            )
        };
        let mut graph = AplsGraph::default();
        let node = |row: i32, column: i32| (row * side + column) as usize;
        for row in 0..side {
            for column in 0..side {
                let name = first + node(row, column) as u64;
                graph.nodes.push((name, corner(row, column)));
            }
        }
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                for (other, axis) in [((row + 1, column), 3), ((row, column + 1), 4)] {
                    if off(row, column, axis) + first as f64 * 1e-9 < 0.85 {
                        let course = vec![corner(row, column), corner(other.0, other.1)];
                        graph.edges.push(AplsEdge {
                            ends: [node(row, column), node(other.0, other.1)],
                            length: course_length(&course),
                            course,
                        });
                    }
                }
            }
        }
        graph
    }

    /// As the whole table of all ways tells it.
    fn by_all_ways(control: &AplsGraph, other: &AplsGraph) -> f64 {
        let table = |graph: &AplsGraph| -> BTreeMap<u64, BTreeMap<u64, f64>> {
            let mut net: UnGraph<(), f64> = UnGraph::default();
            let nodes: Vec<NodeIndex> = graph.nodes.iter().map(|_| net.add_node(())).collect();
            for edge in &graph.edges {
                net.add_edge(nodes[edge.ends[0]], nodes[edge.ends[1]], edge.length);
            }
            let name = |node: NodeIndex| graph.nodes[node.index()].0;
            let from = |start: &NodeIndex| {
                let reached = dijkstra(&net, *start, None, |edge| *edge.weight());
                (
                    name(*start),
                    reached.into_iter().map(|(n, l)| (name(n), l)).collect(),
                )
            };
            nodes.iter().map(from).collect()
        };
        let (ways, others) = (table(control), table(other));
        let (mut differences, mut count) = (0.0, 0);
        for (from, reached) in &ways {
            let there = others.get(from);
            for (to, length) in reached {
                if to == from || there.is_some() && *length < SHORTEST {
                    continue;
                }
                count += 1;
                differences += match there.and_then(|there| there.get(to)) {
                    Some(other) => ((length - other).abs() / length).min(1.0),
                    None => 1.0,
                };
            }
        }
        1.0 - differences / f64::from(count)
    }

    #[test]
    fn ways_from_one_node_at_a_time_tell_what_all_at_once_told_to_the_bit() {
        let (truth, proposal) = (town(11, 0), town(11, 90_000_000));
        let control = truth.with_control_points(50.0);
        assert!(control.nodes.len() > truth.nodes.len() + 50);
        let mut cut = CutGraph::of(proposal.clone());
        for (name, place) in &control.nodes {
            cut.insert(*name, *place, 4.0, true);
        }
        let score = apls(&truth, &proposal, &AplsSettings::default());
        assert!(
            (0.2..0.999).contains(&score.truth_onto_proposal),
            "{score:?}"
        );
        assert_eq!(score.truth_onto_proposal, by_all_ways(&control, &cut.graph));
    }
}
