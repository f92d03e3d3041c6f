//! Geometry of courses: polylines on the ground.

use pilotage_base::frames::GroundPoint;

/// Place on a course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoursePlace {
    /// The place itself.
    pub point: GroundPoint,
    /// Way along the course from its first point, metres.
    pub along: f64,
    /// Heading of the course there, radians clockwise from north, from -π to π.
    pub heading: f64,
}

/// Length of a course, metres.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::course_length;
///
/// let course = [(0.0, 0.0), (3.0, 4.0), (3.0, 10.0)].map(|(north, east)| GroundPoint::new(north, east));
/// assert_eq!(course_length(&course), 11.0);
/// ```
pub fn course_length(course: &[GroundPoint]) -> f64 {
    course.windows(2).map(|w| w[0].distance(&w[1])).sum()
}

/// Heading from `from` to `to`, radians clockwise from north.
pub(crate) fn heading(from: GroundPoint, to: GroundPoint) -> f64 {
    (to.east - from.east).atan2(to.north - from.north)
}

/// Place between `from` (share 0) and `to` (share 1).
pub(crate) fn between(from: GroundPoint, to: GroundPoint, share: f64) -> GroundPoint {
    GroundPoint::new(
        from.north + share * (to.north - from.north),
        from.east + share * (to.east - from.east),
    )
}

/// Share of the way from `from` to `to`, 0 to 1, at which the straight line between them comes nearest to `point`.
pub fn nearest_share(from: GroundPoint, to: GroundPoint, point: GroundPoint) -> f64 {
    let way = to.to_vector() - from.to_vector();
    let squared = way.norm_squared();
    if squared == 0.0 {
        return 0.0;
    }
    ((point.to_vector() - from.to_vector()).dot(&way) / squared).clamp(0.0, 1.0)
}

/// Place `along` metres along a course.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::place_along;
///
/// let course = [GroundPoint::new(0.0, 0.0), GroundPoint::new(0.0, 10.0)];
/// let place = place_along(&course, 4.0).ok_or("two points")?;
/// assert_eq!((place.point.east, place.heading.to_degrees()), (4.0, 90.0));
/// assert!(place_along(&course[..1], 4.0).is_none());
/// # Ok::<(), &str>(())
/// ```
///
/// At its ends where it is shorter; `None` for fewer than two points.
pub fn place_along(course: &[GroundPoint], along: f64) -> Option<CoursePlace> {
    let last = course.len().checked_sub(2)?;
    let mut before = 0.0;
    for (index, piece) in course.windows(2).enumerate() {
        let length = piece[0].distance(&piece[1]);
        if along <= before + length || index == last {
            let rest = (along - before).clamp(0.0, length);
            let share = if length > 0.0 { rest / length } else { 0.0 };
            return Some(CoursePlace {
                point: between(piece[0], piece[1], share),
                along: before + rest,
                heading: heading(piece[0], piece[1]),
            });
        }
        before += length;
    }
    None
}

/// Place of a course that is nearest to `point`; `None` for fewer than two points.
pub fn place_near(course: &[GroundPoint], point: GroundPoint) -> Option<CoursePlace> {
    let mut before = 0.0;
    let mut best: Option<(f64, CoursePlace)> = None;
    for piece in course.windows(2) {
        let length = piece[0].distance(&piece[1]);
        let share = nearest_share(piece[0], piece[1], point);
        let foot = between(piece[0], piece[1], share);
        let distance = foot.distance(&point);
        if best.is_none_or(|(least, _)| distance < least) {
            let place = CoursePlace {
                point: foot,
                along: before + share * length,
                heading: heading(piece[0], piece[1]),
            };
            best = Some((distance, place));
        }
        before += length;
    }
    best.map(|(_, place)| place)
}

/// The line without the points that lie within `tolerance` metres of the rest (Douglas and Peucker 1973).
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::thinned;
///
/// let line = [(0.0, 0.0), (0.2, 10.0), (0.0, 20.0), (9.0, 20.0)].map(|(n, e)| GroundPoint::new(n, e));
/// assert_eq!(thinned(&line, 0.5), [line[0], line[2], line[3]]);
/// ```
pub fn thinned(course: &[GroundPoint], tolerance: f64) -> Vec<GroundPoint> {
    let mut keeps = vec![false; course.len()];
    let Some(last) = course.len().checked_sub(1) else {
        return Vec::new();
    };
    (keeps[0], keeps[last]) = (true, true);
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let off = (from + 1..to.max(from + 1)).map(|i| {
            let share = nearest_share(course[from], course[to], course[i]);
            let foot = between(course[from], course[to], share);
            (i, foot.distance(&course[i]))
        });
        let farthest = off.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((at, _)) = farthest.filter(|it| it.1 > tolerance) {
            keeps[at] = true;
            spans.extend([(from, at), (at, to)]);
        }
    }
    let kept = course.iter().zip(keeps).filter(|it| it.1);
    kept.map(|(point, _)| *point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner() -> Vec<GroundPoint> {
        [(0.0, 0.0), (30.0, 0.0), (30.0, 40.0)]
            .map(|(n, e)| GroundPoint::new(n, e))
            .to_vec()
    }

    #[test]
    fn a_way_along_a_corner_goes_round_it() {
        let course = corner();
        assert_eq!(course_length(&course), 70.0);
        let place = place_along(&course, 40.0).unwrap();
        assert_eq!(place.point, GroundPoint::new(30.0, 10.0));
        assert_eq!(place.heading, std::f64::consts::FRAC_PI_2);
        assert_eq!(place_along(&course, 99.0).unwrap().along, 70.0);
        assert_eq!(place_along(&course[..1], 1.0), None);
    }

    #[test]
    fn the_nearest_place_lies_at_the_foot_of_the_perpendicular_or_at_a_corner() {
        let course = corner();
        let place = place_near(&course, GroundPoint::new(26.0, 25.0)).unwrap();
        assert_eq!(place.point, GroundPoint::new(30.0, 25.0));
        assert_eq!(place.along, 55.0);
        let outside = place_near(&course, GroundPoint::new(33.0, -4.0)).unwrap();
        assert_eq!(outside.point, GroundPoint::new(30.0, 0.0));
    }
}
