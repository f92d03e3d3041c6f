//! Roads that are there twice.

use std::collections::{BTreeMap, BTreeSet};

use pilotage_base::frames::GroundPoint;

use crate::line::RoadLine;

/// Distance up to which two points are the same, metres: files keep places to a millimetre.
const SAME: f64 = 0.02;
/// Side of the cells in which lines are looked up by their mean, metres.
const CELL: f64 = 1.0;

/// The lines whose centre line is none of `known` and of the lines before, in either direction; places to 2 cm. What has no
/// two points is kept.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::{RoadLine, without_known};
///
/// let line = |east: [f64; 2]| RoadLine {
///     course: east.map(|east| GroundPoint::new(0.0, east)).to_vec(),
///     ..RoadLine::default()
/// };
/// let known = [line([0.0, 50.0])];
/// let new = without_known(&known, vec![line([50.001, 0.0]), line([0.0, 60.0]), line([60.0, 0.0])]);
/// assert_eq!(new, [line([0.0, 60.0])]);
/// ```
pub fn without_known(known: &[RoadLine], lines: Vec<RoadLine>) -> Vec<RoadLine> {
    let mut cells: BTreeMap<(i64, i64), Vec<Vec<GroundPoint>>> = BTreeMap::new();
    let mut is_new = |line: &RoadLine| {
        if line.course.len() < 2 {
            return true;
        }
        let (north, east) = cell(&line.course);
        let around =
            (north - 1..=north + 1).flat_map(|n| (east - 1..=east + 1).map(move |e| (n, e)));
        let mut near = around.filter_map(|cell| cells.get(&cell)).flatten();
        let is_new = !near.any(|course| is_same(course, &line.course));
        if is_new {
            let here = cells.entry((north, east)).or_default();
            here.push(line.course.clone());
        }
        is_new
    };
    for line in known {
        is_new(line);
    }
    lines.into_iter().filter(|line| is_new(line)).collect()
}

/// Cell in which the mean of a course lies, which is the same in both directions.
fn cell(course: &[GroundPoint]) -> (i64, i64) {
    let number = |sum: f64| (sum / course.len() as f64 / CELL).floor() as i64;
    (
        number(course.iter().map(|point| point.north).sum()),
        number(course.iter().map(|point| point.east).sum()),
    )
}

fn is_same(one: &[GroundPoint], other: &[GroundPoint]) -> bool {
    let is_near = |(a, b): (&GroundPoint, &GroundPoint)| a.distance(b) <= SAME;
    one.len() == other.len()
        && (one.iter().zip(other).all(is_near) || one.iter().zip(other.iter().rev()).all(is_near))
}

/// Points of a way, in the same order in whichever direction it is gone.
pub fn either_way(points: &[usize]) -> Vec<usize> {
    let back: Vec<usize> = points.iter().rev().copied().collect();
    back.min(points.to_vec())
}

/// Whether each line is the first with its points, in either direction.
pub fn first_of_each(lines: &[Vec<usize>]) -> Vec<bool> {
    let mut seen = BTreeSet::new();
    lines
        .iter()
        .map(|points| seen.insert(either_way(points)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RoadClass, RoadJoining, RoadMap};

    fn line(class: RoadClass, course: &[(f64, f64)]) -> RoadLine {
        let points = course.iter().map(|(n, e)| GroundPoint::new(*n, *e));
        RoadLine {
            class,
            course: points.collect(),
            ..RoadLine::default()
        }
    }

    #[test]
    fn a_line_that_is_there_twice_makes_no_crossings_and_is_as_long_as_once() {
        let course = [(0.0, 0.0), (0.0, 50.0), (10.0, 100.0), (0.0, 150.0)];
        let mut back = course;
        back.reverse();
        let lines = vec![
            line(RoadClass::Track, &course),
            line(RoadClass::Track, &course),
            line(RoadClass::Primary, &back),
        ];
        let once = RoadMap::new(lines[..1].to_vec(), RoadJoining::SHARED_POINTS);
        let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
        assert_eq!(map.crossings(), []);
        assert_eq!(map.graph().edge_count(), 1);
        assert_eq!(map.length(), once.length());
        assert_eq!(map.line_of(0).class, RoadClass::Primary);
    }

    #[test]
    fn a_part_that_two_lines_share_is_one_road() {
        let lines = vec![
            line(RoadClass::Track, &[(0.0, 0.0), (0.0, 50.0), (0.0, 100.0)]),
            line(RoadClass::Track, &[(0.0, 100.0), (0.0, 50.0), (40.0, 50.0)]),
        ];
        let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
        assert_eq!(map.length(), 100.0 + 40.0);
        let arms: Vec<usize> = map.crossings().iter().map(|c| c.directions.len()).collect();
        assert_eq!(arms, [3]);
    }

    #[test]
    fn a_road_that_leads_on_through_points_of_another_is_no_further_arm() {
        // The second one lacks the point between, and runs to the south, where headings end at π and begin at -π.
        let lines = vec![
            line(RoadClass::Track, &[(0.0, 0.0), (-50.0, 0.0), (-100.0, 0.0)]),
            line(RoadClass::Track, &[(0.0, 0.0), (-90.0, -1e-5)]),
            line(RoadClass::Track, &[(0.0, 0.0), (0.0, 80.0)]),
        ];
        let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
        assert_eq!(map.crossings(), []);
    }
}
