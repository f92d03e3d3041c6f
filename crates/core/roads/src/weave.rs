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
    /// Whether lines that cross without a common point do meet there: not so where bridges are drawn.
    pub crossings: bool,
    /// Ends that no other line shares are led on to the nearest line within this, metres.
    pub reach: f64,
}

impl RoadJoining {
    /// Only shared points join lines, as in OpenStreetMap.
    pub const SHARED_POINTS: Self = Self {
        snap: 1e-3,
        crossings: false,
        reach: 0.0,
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
    if joining.crossings || joining.reach > 0.0 {
        Pieces::of(&set, &woven).join(&mut set, &mut woven, joining);
    }
    Woven {
        points: set.points,
        lines: woven,
    }
}

/// The straight pieces of all lines, found by place.
struct Pieces {
    /// Each with its index as its edge.
    segments: Vec<Segment>,
    /// Line of each piece, and the points at its ends.
    owners: Vec<(usize, [usize; 2])>,
    grid: SegmentGrid,
}

/// Points that pieces get: piece, share of the way along it, point.
type Cuts = Vec<(usize, f64, usize)>;

impl Pieces {
    fn of(set: &PointSet, lines: &[Vec<usize>]) -> Self {
        let (mut segments, mut owners) = (Vec::new(), Vec::new());
        for (line, indices) in lines.iter().enumerate() {
            for pair in indices.windows(2) {
                segments.push(Segment {
                    edge: owners.len() as u32,
                    from: set.points[pair[0]],
                    to: set.points[pair[1]],
                    along: 0.0,
                    turns: [0.0; 2],
                });
                owners.push((line, [pair[0], pair[1]]));
            }
        }
        Self {
            grid: SegmentGrid::new(segments.clone()),
            segments,
            owners,
        }
    }

    /// Puts common points into lines where they cross, and where one ends beside another.
    fn join(&self, set: &mut PointSet, lines: &mut [Vec<usize>], joining: RoadJoining) {
        let mut cuts = Vec::new();
        if joining.crossings {
            self.cross(set, &mut cuts);
        }
        // Ends are led on after the pieces are cut, so that these stay the pieces that they were.
        let mut led_on = Vec::new();
        for (line, indices) in lines.iter().enumerate() {
            // A ring has no end.
            if let [first, between @ .., last] = &indices[..]
                && first != last
            {
                for (is_last, end) in [(false, *first), (true, *last)] {
                    let mut others = lines.iter().enumerate().filter(|it| it.0 != line);
                    let is_shared = between.contains(&end) || others.any(|it| it.1.contains(&end));
                    if !is_shared && cuts.iter().all(|(_, _, point)| *point != end) {
                        led_on.extend(self.lead_on((line, is_last, end), set, &mut cuts, joining));
                    }
                }
            }
        }
        cuts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut piece = 0;
        for indices in lines.iter_mut() {
            let mut cut_line: Vec<usize> = indices.first().copied().into_iter().collect();
            for end in indices.iter().skip(1) {
                let first = cuts.partition_point(|(cut, ..)| *cut < piece);
                let own = cuts[first..].iter().take_while(|(cut, ..)| *cut == piece);
                cut_line.extend(own.map(|(_, _, point)| *point));
                cut_line.push(*end);
                piece += 1;
            }
            cut_line.dedup();
            *indices = cut_line;
        }
        for (line, is_last, point) in led_on {
            let place = if is_last { lines[line].len() } else { 0 };
            lines[line].insert(place, point);
        }
    }

    /// Finds where pieces cross that share no point.
    fn cross(&self, set: &mut PointSet, cuts: &mut Cuts) {
        for (index, own) in self.segments.iter().enumerate() {
            let middle = between(own.from, own.to, 0.5);
            let reach = 0.5 * own.from.distance(&own.to) + set.snap;
            let mut others = Vec::new();
            self.grid
                .visit(middle, reach, |other| others.push(other.edge as usize));
            others.sort_unstable();
            others.dedup();
            let ends = self.owners[index].1;
            for other in others.into_iter().filter(|other| *other > index) {
                if self.owners[other].1.iter().any(|end| ends.contains(end)) {
                    continue;
                }
                if let Some((share, their_share)) = meeting(own, &self.segments[other]) {
                    let point = set.index(between(own.from, own.to, share));
                    cuts.push((index, share, point));
                    cuts.push((other, their_share, point));
                }
            }
        }
    }

    /// Joins the end of a line (whether it is the last point, and which) with the nearest other line, and returns the
    /// point that the line gets beyond its end, if any.
    fn lead_on(
        &self,
        (line, is_last, end): (usize, bool, usize),
        set: &mut PointSet,
        cuts: &mut Cuts,
        joining: RoadJoining,
    ) -> Option<(usize, bool, usize)> {
        let point = set.points[end];
        let reach = joining.reach.max(set.snap);
        let mut nearest: Option<(f64, usize, f64, GroundPoint)> = None;
        self.grid.visit(point, reach, |other| {
            let share = nearest_share(other.from, other.to, point);
            let foot = between(other.from, other.to, share);
            let distance = foot.distance(&point);
            let is_nearer = nearest.is_none_or(|(least, ..)| distance < least);
            if self.owners[other.edge as usize].0 != line && distance <= reach && is_nearer {
                nearest = Some((distance, other.edge as usize, share, foot));
            }
        });
        let (distance, piece, share, foot) = nearest?;
        if distance <= set.snap {
            cuts.push((piece, share, end));
            return None;
        }
        let met = set.index(foot);
        cuts.push((piece, share, met));
        Some((line, is_last, met))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::RoadMap;

    const JOINING: RoadJoining = RoadJoining {
        snap: 0.1,
        crossings: false,
        reach: 7.0,
    };

    fn line(course: &[(f64, f64)]) -> RoadLine {
        let points = course.iter().map(|(n, e)| GroundPoint::new(*n, *e));
        RoadLine {
            course: points.collect(),
            ..RoadLine::default()
        }
    }

    #[test]
    fn a_ring_has_no_end_that_is_led_on_to_another_road() {
        let ring = [
            (0.0, 0.0),
            (20.0, 0.0),
            (20.0, 20.0),
            (0.0, 20.0),
            (0.0, 0.0),
        ];
        // Passes 5 m west of the ring's first point.
        let road = [(-50.0, -5.0), (50.0, -5.0)];
        let map = RoadMap::new(vec![line(&ring), line(&road)], JOINING);
        assert_eq!(map.graph().edge_count(), 2);
        assert_eq!(map.length(), 80.0 + 100.0);
        assert_eq!(map.crossings(), []);
    }

    #[test]
    fn an_end_on_its_own_line_is_joined_already_and_the_other_one_is_led_on() {
        // A loop with a stalk: it begins 5 m east of the road, and ends on its second point, 6.5 m east of it.
        let looped = [
            (0.0, 0.0),
            (0.0, 1.5),
            (20.0, 1.5),
            (20.0, 21.5),
            (0.0, 1.5),
        ];
        let road = [(-50.0, -5.0), (50.0, -5.0)];
        let map = RoadMap::new(vec![line(&looped), line(&road)], JOINING);
        let crossings = map.crossings();
        let places: Vec<GroundPoint> = crossings.iter().map(|it| it.place).collect();
        let expected = [(0.0, -5.0), (0.0, 1.5)].map(|(n, e)| GroundPoint::new(n, e));
        assert!(places.iter().all(|it| expected.contains(it)), "{places:?}");
        assert_eq!(
            [0, 1].map(|index| crossings[index].directions.len()),
            [3; 2]
        );
        // The stalk with what it is led on by, the triangle, and the road.
        let of_loop = 20.0 + 20.0 + 800_f64.sqrt();
        assert!((map.length() - (6.5 + of_loop + 100.0)).abs() < 1e-9);
    }
}
