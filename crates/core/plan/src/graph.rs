//! The graph of ways between places, and the cheapest path through it that is never long without a fix.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::blind_way::{BlindWay, Unsure};
use super::question::RouteQuestion;
use pilotage_base::frames::GroundPoint;

/// Metres without a fix are told apart by this ratio: a path is only followed further if it comes to a
/// place with a class less than every cheaper one.
const RATIO: f64 = 1.1;
/// Metres without a fix below which paths are alike.
const FINEST: f64 = 20.0;
/// Classes of metres without a fix, up to 200 km.
const CLASSES: usize = 97;

/// The class of so many metres without a fix.
fn class(u: f64) -> usize {
    let class = (u / FINEST).max(1.0).ln() / RATIO.ln();
    (class as usize).min(CLASSES - 1)
}

/// The least that a path paid to come to each node with at most each class of metres without a fix.
struct Frontier(Vec<f64>);

impl Frontier {
    fn new(nodes: usize) -> Self {
        Self(vec![f64::INFINITY; nodes * CLASSES])
    }

    /// Whether a path that paid `order` would be better than all before.
    fn wants(&self, node: usize, u: f64, order: f64) -> bool {
        self.0[node * CLASSES + class(u)] > order
    }

    /// Takes a path that paid `order`; whoever comes with more and later is no better and forgotten.
    fn take(&mut self, node: usize, u: f64, order: f64) {
        for other in &mut self.0[node * CLASSES + class(u)..(node + 1) * CLASSES] {
            *other = other.min(order);
        }
    }

    /// Whether nobody came cheaper since.
    fn still(&self, node: usize, u: f64, order: f64) -> bool {
        self.0[node * CLASSES + class(u)] >= order
    }
}

/// Aim of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Aimed {
    /// The cheapest that never has more than so many metres without a fix.
    Under(f64),
    /// The one with the least integral of metres without a fix plus its cost at so much a metre.
    Priced(f64),
}

/// A way between two nodes.
#[derive(Clone, Debug)]
struct GraphEdge {
    to: usize,
    cost: f64,
    blind: BlindWay,
}

/// Places, the first that where the path begins and the second that where it ends, and ways.
pub(super) struct Graph {
    nodes: Vec<GroundPoint>,
    ways: Vec<Vec<GraphEdge>>,
    next: usize,
}

/// Label of a path: the node that it has come to, with its cost and uncertainty.
struct PathLabel {
    node: usize,
    cost: f64,
    unsure: Unsure,
    before: Option<usize>,
}

/// A label in the queue: the least first.
struct Queued {
    order: f64,
    /// Price that is paid so far, as the order has it.
    paid: f64,
    cost: f64,
    unsure: Unsure,
    node: usize,
    before: Option<usize>,
}

impl PartialEq for Queued {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Queued {}
impl PartialOrd for Queued {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Queued {
    fn cmp(&self, other: &Self) -> Ordering {
        other.order.total_cmp(&self.order)
    }
}

impl Graph {
    /// A graph without ways yet.
    pub fn new(nodes: Vec<GroundPoint>) -> Self {
        Self {
            ways: vec![Vec::new(); nodes.len()],
            nodes,
            next: 0,
        }
    }

    /// Share of the nodes whose ways are known.
    pub fn progress(&self) -> f32 {
        self.next as f32 / self.nodes.len().max(1) as f32
    }

    /// Finds the ways between the next node and those behind it, as far as a path over them can cost no
    /// more than `most`; false when all are known.
    pub fn connect_next(&mut self, question: &RouteQuestion, most: f64) -> bool {
        let i = self.next;
        if i >= self.nodes.len() {
            return false;
        }
        self.next += 1;
        let ground = question.ground();
        let a = self.nodes[i];
        let least = |a: &GroundPoint, b: &GroundPoint| question.least_cost(a, b);
        let (from, to) = (self.nodes[0], self.nodes[1]);
        for j in i + 1..self.nodes.len() {
            let b = self.nodes[j];
            let through = |a: &GroundPoint, b: &GroundPoint| {
                least(&from, a) + least(a, b) + least(b, &to) <= most * (1.0 + 1e-9)
            };
            let (there, back) = (through(&a, &b), through(&b, &a));
            if !(there || back) || a.distance(&b) < 1.0 || !question.allows(&a, &b) {
                continue;
            }
            for (begin, end, wanted) in [(i, j, there), (j, i, back)] {
                let way = ground.follow(&self.nodes[begin], &self.nodes[end]);
                // Nothing leads into the first node or out of the second.
                if let Some(blind) = way.filter(|_| wanted && end != 0 && begin != 1) {
                    self.ways[begin].push(GraphEdge {
                        to: end,
                        cost: question.cost(blind.length, blind.time),
                        blind,
                    });
                }
            }
        }
        true
    }

    /// The best path within `most`, as its places.
    ///
    /// Labels are taken in the order of what they cost. One that comes to a node later than another is
    /// worth following only if it has fewer metres without a fix: that makes the search exact but for
    /// the width of the classes, and for turns: a path that may not turn onto a way hides dearer ones to the
    /// same node that might.
    pub fn solve(
        &self,
        question: &RouteQuestion,
        aimed: Aimed,
        most: f64,
    ) -> Option<Vec<GroundPoint>> {
        let ahead: Vec<f64> = self
            .nodes
            .iter()
            .map(|n| question.least_cost(n, &self.nodes[1]))
            .collect();
        let free = self.nodes.iter().map(|n| question.leaves_room_to_turn(n));
        let free: Vec<bool> = free.collect();
        let mut frontier = Frontier::new(self.nodes.len());
        let mut labels: Vec<PathLabel> = Vec::new();
        let mut queue = BinaryHeap::new();
        queue.push(Queued {
            order: 0.0,
            paid: 0.0,
            cost: 0.0,
            unsure: Unsure::START,
            node: 0,
            before: None,
        });
        while let Some(head) = queue.pop() {
            if head.node != 0 && !frontier.still(head.node, head.unsure.metres, head.order) {
                continue;
            }
            let number = labels.len();
            labels.push(PathLabel {
                node: head.node,
                cost: head.cost,
                unsure: head.unsure,
                before: head.before,
            });
            if head.node == 1 {
                return Some(self.line(&labels, number));
            }
            let label = &labels[number];
            for way in &self.ways[label.node] {
                let cost = label.cost + way.cost;
                let unsure = way.blind.after(label.unsure);
                if cost + ahead[way.to] > most * (1.0 + 1e-9)
                    || Self::passed(&labels, number, way.to)
                {
                    continue;
                }
                let (paid, order) = match aimed {
                    Aimed::Under(limit) => {
                        if way.blind.worst(label.unsure) > limit {
                            continue;
                        }
                        (cost, cost + ahead[way.to])
                    }
                    Aimed::Priced(price) => {
                        let blind = way.blind.integral.of(label.unsure);
                        let paid = head.paid + blind + price * way.blind.length;
                        (paid, paid)
                    }
                };
                let turns = || {
                    let before = label.before.filter(|_| !free[label.node]);
                    before.is_none_or(|before| {
                        let line = [labels[before].node, label.node, way.to];
                        question.allows_turns(&line.map(|node| self.nodes[node]))
                    })
                };
                if !frontier.wants(way.to, unsure.metres, order) || !turns() {
                    continue;
                }
                frontier.take(way.to, unsure.metres, order);
                queue.push(Queued {
                    order,
                    paid,
                    cost,
                    unsure,
                    node: way.to,
                    before: Some(number),
                });
            }
        }
        None
    }

    /// Whether the path to a label leads over a node: circling over a landmark makes it no surer.
    fn passed(labels: &[PathLabel], last: usize, node: usize) -> bool {
        let mut at = Some(last);
        while let Some(number) = at {
            if labels[number].node == node {
                return true;
            }
            at = labels[number].before;
        }
        false
    }

    fn line(&self, labels: &[PathLabel], last: usize) -> Vec<GroundPoint> {
        let mut line = Vec::new();
        let mut at = Some(last);
        while let Some(number) = at {
            line.push(self.nodes[labels[number].node]);
            at = labels[number].before;
        }
        line.reverse();
        line
    }
}
