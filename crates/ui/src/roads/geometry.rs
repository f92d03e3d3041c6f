//! Places on roads: what lies at a place, and how two of them are joined.

use pilotage_core::frames::GroundPoint;
use pilotage_core::roads::{RoadLine, place_near};

/// Distance from a point or a road that still counts as on it, points of the screen.
pub const HIT: f64 = 10.0;
/// Greatest distance of a place from the line of a road that leads through it, metres: what was put there was put on it.
const ON: f64 = 1e-3;

/// Place on a road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnRoad {
    /// Index of the road.
    pub road: usize,
    /// Index of the point at which its piece begins.
    pub piece: usize,
    /// The place.
    pub place: GroundPoint,
    /// Distance to it, metres.
    pub distance: f64,
}

/// Nearest place on the centre line of a road within `reach` metres of a point.
pub fn road_at(roads: &[RoadLine], at: GroundPoint, reach: f64) -> Option<OnRoad> {
    nearest_on(roads.iter().enumerate(), at, reach)
}

/// The same of some of the roads, each with its index.
fn nearest_on<'a>(
    roads: impl Iterator<Item = (usize, &'a RoadLine)>,
    at: GroundPoint,
    reach: f64,
) -> Option<OnRoad> {
    let mut nearest: Option<OnRoad> = None;
    for (road, line) in roads {
        for (piece, ends) in line.course.windows(2).enumerate() {
            let [from, to] = [ends[0], ends[1]];
            let is_far = |a: f64, b: f64, c: f64| c < a.min(b) - reach || c > a.max(b) + reach;
            if is_far(from.north, to.north, at.north) || is_far(from.east, to.east, at.east) {
                continue;
            }
            let Some(near) = place_near(ends, at) else {
                continue;
            };
            let distance = near.point.distance(&at);
            let best = nearest.map_or(reach, |it| it.distance);
            if distance <= best {
                nearest = Some(OnRoad {
                    road,
                    piece,
                    place: near.point,
                    distance,
                });
            }
        }
    }
    nearest
}

/// Nearest point of a line within `reach` metres of a place; its index.
pub fn point_at(course: &[GroundPoint], at: GroundPoint, reach: f64) -> Option<usize> {
    let near = course.iter().map(|point| point.distance(&at)).enumerate();
    let near = near.filter(|(_, distance)| *distance <= reach);
    near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|it| it.0)
}

/// Place on a road, but for those of `own`, within `reach` metres of a place: what is put there is put on it. A point of a
/// road, if one is within reach, else the foot on a piece between two.
pub fn snapped(
    roads: &[RoadLine],
    own: &[usize],
    at: GroundPoint,
    reach: f64,
) -> Option<GroundPoint> {
    let others = || {
        let all = roads.iter().enumerate();
        all.filter(|it| !own.contains(&it.0))
    };
    let points = others().filter_map(|(_, road)| {
        let point = road.course[point_at(&road.course, at, reach)?];
        Some((point, point.distance(&at)))
    });
    let point = points.min_by(|a, b| a.1.total_cmp(&b.1)).map(|it| it.0);
    point.or_else(|| nearest_on(others(), at, reach).map(|it| it.place))
}

/// Points of all roads at the place of one, that one first: those of a crossing are one place. Each is a road and the
/// index of its point.
pub fn alike(roads: &[RoadLine], road: usize, point: usize) -> Vec<(usize, usize)> {
    let place = roads.get(road).and_then(|road| road.course.get(point));
    let mut all = vec![(road, point)];
    for (index, line) in roads.iter().enumerate() {
        let points = line.course.iter().enumerate();
        let points = points.filter(|it| Some(it.1) == place);
        let points = points.map(|it| (index, it.0));
        all.extend(points.filter(|it| *it != (road, point)));
    }
    all
}

/// Whether points, each of a road and its index there, are all there and at one place, as those of a crossing are.
pub fn are_one(roads: &[RoadLine], points: &[(usize, usize)]) -> bool {
    let place = |(road, point): &(usize, usize)| roads.get(*road)?.course.get(*point);
    let first = points.first().and_then(place);
    first.is_some() && points.iter().all(|point| place(point) == first)
}

/// Whether a place lies on a road.
pub fn is_on_road(roads: &[RoadLine], place: GroundPoint) -> bool {
    road_at(roads, place, ON).is_some()
}

/// Pieces of roads, but for those of `own`, that lead through a place where their road has no point: the road, and the
/// point at which the piece begins.
pub fn through(roads: &[RoadLine], own: &[usize], place: GroundPoint) -> Vec<(usize, usize)> {
    let others = roads.iter().enumerate();
    let others = others.filter(|it| !own.contains(&it.0) && !it.1.course.contains(&place));
    let pieces = others.filter_map(|other| nearest_on(std::iter::once(other), place, ON));
    pieces.map(|it| (it.road, it.piece)).collect()
}

/// Road beside `own` that has an end where that has one.
pub fn meeting(roads: &[RoadLine], own: usize) -> Option<usize> {
    let ends = |road: &RoadLine| Some([*road.course.first()?, *road.course.last()?]);
    let of_own = ends(roads.get(own)?)?;
    let meets = |road: &RoadLine| {
        ends(road).is_some_and(|ends| ends.iter().any(|end| of_own.contains(end)))
    };
    (0..roads.len()).find(|index| *index != own && meets(&roads[*index]))
}

/// Line made of two, put together at the ends that are nearest to each other, in the direction of the first.
pub fn joined(one: &[GroundPoint], other: &[GroundPoint]) -> Vec<GroundPoint> {
    let turned = |line: &[GroundPoint], turn: bool| -> Vec<GroundPoint> {
        if turn {
            line.iter().rev().copied().collect()
        } else {
            line.to_vec()
        }
    };
    let gap = |(at_start, is_turned): (bool, bool)| -> f64 {
        let end = if at_start { one.first() } else { one.last() };
        let begin = if at_start == is_turned {
            other.first()
        } else {
            other.last()
        };
        end.zip(begin).map_or(f64::INFINITY, |(a, b)| a.distance(b))
    };
    let ways = [(false, false), (false, true), (true, false), (true, true)];
    let best = ways.into_iter().min_by(|a, b| gap(*a).total_cmp(&gap(*b)));
    let (at_start, is_turned) = best.unwrap_or_default();
    let other = turned(other, is_turned);
    let (mut line, rest) = if at_start {
        (other, one.to_vec())
    } else {
        (one.to_vec(), other)
    };
    let is_shared = line.last() == rest.first();
    line.extend(rest.into_iter().skip(usize::from(is_shared)));
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(east: &[f64]) -> Vec<GroundPoint> {
        east.iter()
            .map(|east| GroundPoint::new(0.0, *east))
            .collect()
    }

    fn road(east: &[f64]) -> RoadLine {
        RoadLine {
            course: line(east),
            ..RoadLine::default()
        }
    }

    #[test]
    fn roads_are_joined_at_their_nearest_ends_whichever_way_they_lead() {
        let whole = line(&[0.0, 10.0, 20.0, 30.0]);
        for (one, other) in [
            ([0.0, 10.0], [20.0, 30.0]),
            ([0.0, 10.0], [30.0, 20.0]),
            ([20.0, 30.0], [0.0, 10.0]),
            ([20.0, 30.0], [10.0, 0.0]),
        ] {
            assert_eq!(joined(&line(&one), &line(&other)), whole);
        }
        let shared = joined(&line(&[0.0, 10.0]), &line(&[20.0, 10.0]));
        assert_eq!(shared, line(&[0.0, 10.0, 20.0]));
    }

    #[test]
    fn the_nearest_road_is_found_between_its_points() {
        let roads = [road(&[0.0, 100.0]), road(&[200.0, 300.0])];
        let found =
            road_at(&roads, GroundPoint::new(3.0, 240.0), 5.0).map(|it| (it.road, it.place));
        assert_eq!(found, Some((1, GroundPoint::new(0.0, 240.0))));
        assert_eq!(road_at(&roads, GroundPoint::new(3.0, 150.0), 5.0), None);
    }

    #[test]
    fn a_place_is_put_on_the_nearest_point_of_another_road_alone() {
        let roads = [road(&[0.0, 100.0]), road(&[103.0, 300.0])];
        let at = GroundPoint::new(1.0, 100.0);
        assert_eq!(snapped(&roads, &[], at, 4.0), Some(line(&[100.0])[0]));
        assert_eq!(snapped(&roads, &[0], at, 4.0), Some(line(&[103.0])[0]));
        assert_eq!(snapped(&roads, &[0], at, 2.0), None);
    }

    #[test]
    fn a_place_beside_a_piece_of_another_road_is_put_on_the_foot_there() {
        let roads = [road(&[0.0, 100.0])];
        let at = GroundPoint::new(3.0, 40.0);
        assert_eq!(snapped(&roads, &[], at, 4.0), Some(line(&[40.0])[0]));
        assert_eq!(snapped(&roads, &[0], at, 4.0), None);
        // Its end is nearer to hand.
        let at = GroundPoint::new(0.5, 97.0);
        assert_eq!(snapped(&roads, &[], at, 4.0), Some(line(&[100.0])[0]));
    }

    #[test]
    fn a_road_leads_through_a_place_on_its_pieces_but_not_where_it_has_a_point() {
        let roads = [road(&[0.0, 50.0, 100.0]), road(&[20.0, 80.0])];
        assert_eq!(through(&roads, &[], line(&[60.0])[0]), [(0, 1), (1, 0)]);
        assert_eq!(through(&roads, &[1], line(&[60.0])[0]), [(0, 1)]);
        assert_eq!(through(&roads, &[], line(&[20.0])[0]), [(0, 0)]);
        assert_eq!(through(&roads, &[], GroundPoint::new(0.1, 60.0)), []);
    }

    #[test]
    fn the_road_that_meets_an_end_is_found() {
        let roads = [
            road(&[0.0, 100.0]),
            road(&[150.0, 300.0]),
            road(&[300.0, 400.0]),
        ];
        assert_eq!(meeting(&roads, 1), Some(2));
        assert_eq!(meeting(&roads, 0), None);
    }
}
