//! Straight pieces of centre lines, found by place.

use pilotage_base::frames::GroundPoint;

use crate::course::{between, heading, nearest_share};

/// Side of a cell, metres.
const CELL: f64 = 64.0;

/// Straight piece of an edge.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub edge: u32,
    pub from: GroundPoint,
    pub to: GroundPoint,
    /// Way along the edge at `from`, metres.
    pub along: f64,
    /// Turns of the curve's heading at both ends against the segment's own, radians: a curve that is drawn in straight
    /// pieces turns all along them.
    pub turns: [f64; 2],
}

/// Road beside a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearRoad {
    /// Index of the edge.
    pub edge: usize,
    /// Nearest place of its centre line.
    pub foot: GroundPoint,
    /// Heading of the curve there, radians clockwise from north.
    pub heading: f64,
    /// Way along the edge, metres.
    pub along: f64,
    /// Distance of the place to the right of the centre line, seen along its heading, metres; negative to the left.
    pub right: f64,
    /// Distance, metres: more than `right` says beyond a road's end.
    pub distance: f64,
}

/// Segments by the cells that they touch, in the order of the cells.
#[derive(Clone, Debug, Default)]
pub struct SegmentGrid {
    segments: Vec<Segment>,
    cells: Vec<((i32, i32), u32)>,
}

fn cell(value: f64) -> i32 {
    (value / CELL).floor() as i32
}

/// Angle between two directions without sense, 0 to π/2, radians.
pub fn angle_between_directions(a: f64, b: f64) -> f64 {
    let half_turn = std::f64::consts::PI;
    let apart = (a - b).rem_euclid(half_turn);
    apart.min(half_turn - apart)
}

impl SegmentGrid {
    pub fn new(segments: Vec<Segment>) -> Self {
        let mut cells = Vec::new();
        for (index, s) in segments.iter().enumerate() {
            // Cells of short pieces, so that a long slanted segment is not put into all of its bounding box.
            let pieces = (s.from.distance(&s.to) / CELL).ceil().max(1.0) as usize;
            for piece in 0..pieces {
                let at = |k: usize| between(s.from, s.to, k as f64 / pieces as f64);
                let (a, b) = (at(piece), at(piece + 1));
                for n in cell(a.north.min(b.north))..=cell(a.north.max(b.north)) {
                    for e in cell(a.east.min(b.east))..=cell(a.east.max(b.east)) {
                        cells.push(((n, e), index as u32));
                    }
                }
            }
        }
        cells.sort_unstable();
        cells.dedup();
        Self { segments, cells }
    }

    /// Visits every segment that has a point within `reach` metres of `point`, some of them twice, and others.
    pub fn visit(&self, point: GroundPoint, reach: f64, mut visit: impl FnMut(&Segment)) {
        let east = (cell(point.east - reach), cell(point.east + reach));
        for north in cell(point.north - reach)..=cell(point.north + reach) {
            let first = self.cells.partition_point(|(c, _)| *c < (north, east.0));
            let row = self.cells[first..].iter();
            for (_, index) in row.take_while(|(c, _)| *c <= (north, east.1)) {
                visit(&self.segments[*index as usize]);
            }
        }
    }

    /// The nearest road within `reach` metres whose direction is within `turn` radians of `direction`, in either sense.
    pub fn nearest(
        &self,
        point: GroundPoint,
        reach: f64,
        like: Option<(f64, f64)>,
    ) -> Option<NearRoad> {
        let mut best: Option<(f64, Segment, f64)> = None;
        self.visit(point, reach, |s| {
            let share = nearest_share(s.from, s.to, point);
            let distance = between(s.from, s.to, share).distance(&point);
            let is_nearer = best.is_none_or(|(least, ..)| distance < least);
            let is_like = like.is_none_or(|(direction, turn)| {
                angle_between_directions(heading(s.from, s.to), direction) <= turn
            });
            if distance <= reach && is_nearer && is_like {
                best = Some((distance, *s, share));
            }
        });
        let (distance, s, share) = best?;
        let foot = between(s.from, s.to, share);
        let straight = heading(s.from, s.to);
        let off = point.to_vector() - s.from.to_vector();
        Some(NearRoad {
            edge: s.edge as usize,
            foot,
            heading: straight + s.turns[0] + share * (s.turns[1] - s.turns[0]),
            along: s.along + share * s.from.distance(&s.to),
            right: off.y * straight.cos() - off.x * straight.sin(),
            distance,
        })
    }
}
