//! Lines woven into a net: points that are the same, and places where lines cross.

use std::collections::BTreeMap;

use pilotage_base::frames::GroundPoint;

use crate::course::{between, nearest_share};
use crate::line::RoadLine;
use crate::segments::{Segment, SegmentGrid};

/// Rule by which lines belong together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadJoining {
    /// Points nearer to each other than this are the same, metres.
    pub snap: f64,
    /// Whether lines that cross without a common point do meet there, and ends within `snap` of another line reach it:
    /// not so where bridges are drawn.
    pub crossings: bool,
}

impl RoadJoining {
    /// Only shared points join lines, as in OpenStreetMap.
    pub const SHARED_POINTS: Self = Self {
        snap: 1e-3,
        crossings: false,
    };
}

/// Points, and each line as indices of them.
pub struct Woven {
    pub points: Vec<GroundPoint>,
    pub lines: Vec<Vec<usize>>,
}

/// Points by cells of the size of the tolerance.
struct PointSet {
    snap: f64,
    points: Vec<GroundPoint>,
    cells: BTreeMap<(i64, i64), Vec<usize>>,
}

impl PointSet {
    fn cell(&self, p: GroundPoint) -> (i64, i64) {
        (
            (p.north / self.snap).floor() as i64,
            (p.east / self.snap).floor() as i64,
        )
    }

    /// Index of the nearest known point within the tolerance, or of a further one.
    fn index(&mut self, p: GroundPoint) -> usize {
        let (n, e) = self.cell(p);
        let around = (n - 1..=n + 1).flat_map(|n| (e - 1..=e + 1).map(move |e| (n, e)));
        let known = around.filter_map(|cell| self.cells.get(&cell)).flatten();
        let distance = |i: &usize| self.points[*i].distance(&p);
        let nearest = known.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(same) = nearest.filter(|i| distance(i) <= self.snap) {
            return *same;
        }
        let index = self.points.len();
        self.points.push(p);
        self.cells.entry((n, e)).or_default().push(index);
        index
    }
}

/// Weaves `lines`, of which those with fewer than two points become empty.
pub fn weave(lines: &[RoadLine], joining: RoadJoining) -> Woven {
    let mut set = PointSet {
        snap: joining.snap.max(1e-6),
        points: Vec::new(),
        cells: BTreeMap::new(),
    };
    let mut woven: Vec<Vec<usize>> = Vec::new();
    for line in lines {
        let mut indices: Vec<usize> = line.course.iter().map(|p| set.index(*p)).collect();
        indices.dedup();
        if indices.len() < 2 {
            indices.clear();
        }
        woven.push(indices);
    }
    if joining.crossings {
        cross(&mut set, &mut woven);
    }
    Woven {
        points: set.points,
        lines: woven,
    }
}

/// Puts common points into lines where they cross, and where one ends beside another.
fn cross(set: &mut PointSet, lines: &mut [Vec<usize>]) {
    // Pieces (line, piece) as segments whose `edge` is their place in this list.
    let mut pieces: Vec<(usize, usize)> = Vec::new();
    let mut segments = Vec::new();
    for (line, indices) in lines.iter().enumerate() {
        for (piece, pair) in indices.windows(2).enumerate() {
            segments.push(Segment {
                edge: pieces.len() as u32,
                from: set.points[pair[0]],
                to: set.points[pair[1]],
                along: 0.0,
            });
            pieces.push((line, piece));
        }
    }
    let grid = SegmentGrid::new(segments.clone());
    // Shares along each piece at which it gets a point.
    let mut cuts: Vec<Vec<(f64, usize)>> = vec![Vec::new(); pieces.len()];
    for (index, own) in segments.iter().enumerate() {
        let middle = between(own.from, own.to, 0.5);
        let reach = 0.5 * own.from.distance(&own.to) + set.snap;
        let mut others = Vec::new();
        grid.visit(middle, reach, |other| others.push(other.edge as usize));
        others.sort_unstable();
        others.dedup();
        let (line, piece) = pieces[index];
        let ends = [lines[line][piece], lines[line][piece + 1]];
        for other in others.into_iter().filter(|other| *other > index) {
            let (their_line, their_piece) = pieces[other];
            let theirs = [
                lines[their_line][their_piece],
                lines[their_line][their_piece + 1],
            ];
            if ends.iter().any(|end| theirs.contains(end)) {
                continue;
            }
            if let Some((share, their_share)) = meeting(own, &segments[other]) {
                let point = set.index(between(own.from, own.to, share));
                cuts[index].push((share, point));
                cuts[other].push((their_share, point));
            }
        }
    }
    for indices in lines.iter() {
        let (Some(first), Some(last)) = (indices.first(), indices.last()) else {
            continue;
        };
        for end in [*first, *last] {
            let point = set.points[end];
            grid.visit(point, set.snap, |other| {
                let (line, piece) = pieces[other.edge as usize];
                let theirs = [lines[line][piece], lines[line][piece + 1]];
                let share = nearest_share(other.from, other.to, point);
                let foot = between(other.from, other.to, share);
                if !theirs.contains(&end) && foot.distance(&point) <= set.snap {
                    cuts[other.edge as usize].push((share, end));
                }
            });
        }
    }
    let mut pieces = cuts.into_iter();
    for indices in lines.iter_mut() {
        let Some(first) = indices.first().copied() else {
            continue;
        };
        let mut cut_line = vec![first];
        for end in &indices[1..] {
            let mut cuts = pieces.next().unwrap_or_default();
            cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
            cut_line.extend(cuts.iter().map(|(_, point)| *point));
            cut_line.push(*end);
        }
        cut_line.dedup();
        *indices = cut_line;
    }
}

/// Shares along two segments at which they cross; `None` where they do not, or are parallel.
fn meeting(a: &Segment, b: &Segment) -> Option<(f64, f64)> {
    let (u, v) = (
        a.to.to_vector() - a.from.to_vector(),
        b.to.to_vector() - b.from.to_vector(),
    );
    let between = b.from.to_vector() - a.from.to_vector();
    let turned = u.perp(&v);
    if turned.abs() < 1e-9 * u.norm() * v.norm() {
        return None;
    }
    let (share, other) = (between.perp(&v) / turned, between.perp(&u) / turned);
    let inside = 0.0..=1.0;
    (inside.contains(&share) && inside.contains(&other)).then_some((share, other))
}
