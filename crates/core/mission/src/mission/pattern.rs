//! Patterns of parallel passes: a survey over an area, a corridor along a line.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;
use pilotage_raster::camera::CameraModel;

/// Farthest that a mitred corner of a corridor's pass may lie, times the offset of the pass.
const MITRE_LIMIT: f64 = 3.0;

/// Arrangement of passes beside each other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Passes {
    /// Greatest distance between neighbouring passes, metres.
    pub spacing: f64,
    /// Length by which each pass goes on beyond the area at either end, metres: room for the turn.
    pub run_out: f64,
    /// Least distance between passes that are flown one after the other, metres: twice the radius of
    /// a turn, so that the turn back fits. Passes in between are flown later.
    pub least_step: f64,
}

/// Ground that one picture shows from a height: metres across the direction of flight, and along it.
///
/// For a camera that looks down; a mount turned by a quarter swaps the two.
///
/// ```
/// use pilotage_mission::mission::pattern::picture_on_ground;
/// use pilotage_raster::camera::CameraModel;
///
/// // 640 × 480 pixels with a focal length of 320: from 100 m a pixel covers 0.3125 m.
/// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians());
/// let (across, along) = picture_on_ground(&camera, 100.0);
/// assert!((across - 200.0).abs() < 1e-9 && (along - 150.0).abs() < 1e-9);
/// ```
pub fn picture_on_ground(camera: &CameraModel, height: f64) -> (f64, f64) {
    let scale = height / camera.focal;
    let (wide, high) = (camera.width as f64 * scale, camera.height as f64 * scale);
    if camera.mount.yaw.cos().abs() >= std::f64::consts::FRAC_1_SQRT_2 {
        (wide, high)
    } else {
        (high, wide)
    }
}

/// The course of passes that covers an area with the fewest of them, radians clockwise from north:
/// along the edge of its hull across which it is narrowest. `None` for fewer than three corners.
pub fn fewest_passes(area: &[GroundPoint]) -> Option<f64> {
    if area.len() < 3 {
        return None;
    }
    let mut best: Option<(f64, f64)> = None;
    // The narrowest strip around a polygon lies along an edge of its hull, and every edge of the
    // hull joins two corners.
    for (i, a) in area.iter().enumerate() {
        for b in &area[i + 1..] {
            if a.distance(b) < 1e-6 {
                continue;
            }
            let course = (b.east - a.east).atan2(b.north - a.north);
            let (low, high) = extent(area.iter().map(|p| across(p, course)))?;
            if best.is_none_or(|(width, _)| high - low < width - 1e-9) {
                best = Some((high - low, course));
            }
        }
    }
    best.map(|(_, course)| course.rem_euclid(std::f64::consts::PI))
}

/// Way-points of a lawn-mower over an area with passes on `course` (radians clockwise from north) and
/// back, so that no place of the area is farther than half the spacing from a pass.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_mission::mission::pattern::{Passes, survey};
///
/// // 60 m from west to east in passes northward at most 20 m apart: three of them, each in the
/// // middle of its strip.
/// let area = [(0., 0.), (100., 0.), (100., 60.), (0., 60.)].map(|(n, e)| GroundPoint::new(n, e));
/// let passes = Passes { spacing: 20.0, run_out: 5.0, least_step: 0.0 };
/// let way_points = survey(&area, 0.0, &passes);
/// assert_eq!(way_points.len(), 6);
/// assert!(way_points[0].distance(&GroundPoint::new(-5.0, 10.0)) < 1e-9);
/// assert!(way_points[1].distance(&GroundPoint::new(105.0, 10.0)) < 1e-9);
/// ```
pub fn survey(area: &[GroundPoint], course: f64, passes: &Passes) -> Vec<GroundPoint> {
    let Some((low, high)) = extent(area.iter().map(|p| across(p, course))) else {
        return Vec::new();
    };
    let count = strips(high - low, passes.spacing);
    let step = (high - low) / count as f64;
    let mut lines = Vec::new();
    for index in 0..count {
        let (bottom, top) = (low + index as f64 * step, low + (index + 1) as f64 * step);
        // All that lies in the strip, not only on its middle, is to be passed.
        let Some((begin, end)) = extent(strip(area, course, bottom, top)) else {
            continue;
        };
        let middle = 0.5 * (bottom + top);
        let at = |along: f64| {
            let (sin, cos) = course.sin_cos();
            GroundPoint::new(along * cos - middle * sin, along * sin + middle * cos)
        };
        lines.push(vec![at(begin - passes.run_out), at(end + passes.run_out)]);
    }
    there_and_back(&lines, step, passes.least_step)
}

/// Way-points of passes along a line, there and back, that cover a corridor `width` metres wide.
pub fn corridor(line: &[GroundPoint], width: f64, passes: &Passes) -> Vec<GroundPoint> {
    let line = bends(line);
    if line.len() < 2 {
        return Vec::new();
    }
    let count = strips(width, passes.spacing);
    let step = width / count as f64;
    let offsets = (0..count).map(|i| (i as f64 + 0.5) * step - 0.5 * width);
    let lines: Vec<_> = offsets
        .map(|offset| beside(&line, offset, passes.run_out))
        .collect();
    there_and_back(&lines, step, passes.least_step)
}

/// Places of a line, which each pass along it has: those at the place of the one before are left out.
pub fn bends(line: &[GroundPoint]) -> Vec<GroundPoint> {
    let mut line = line.to_vec();
    line.dedup_by(|b, a| a.distance(b) < 1e-6);
    line
}

/// Distance of a place to the right of the line through the origin on a course, metres.
fn across(p: &GroundPoint, course: f64) -> f64 {
    let (sin, cos) = course.sin_cos();
    p.east * cos - p.north * sin
}

/// Distance of a place along a course, metres.
fn along(p: &GroundPoint, course: f64) -> f64 {
    let (sin, cos) = course.sin_cos();
    p.north * cos + p.east * sin
}

fn extent(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let mut extent: Option<(f64, f64)> = None;
    for value in values {
        let (low, high) = extent.unwrap_or((value, value));
        extent = Some((low.min(value), high.max(value)));
    }
    extent
}

/// Number of strips that cover `width` if none is wider than `spacing`.
fn strips(width: f64, spacing: f64) -> usize {
    // A hair less, so that rounding does not add a strip.
    let count = (width / spacing.max(0.1) - 1e-9).ceil();
    (count as usize).clamp(1, 10_000)
}

/// Distances along the course of the polygon's edges where they cross a strip or lie in it.
fn strip(area: &[GroundPoint], course: f64, bottom: f64, top: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for (i, a) in area.iter().enumerate() {
        let b = &area[(i + 1) % area.len()];
        let (from, to) = (across(a, course), across(b, course));
        if from >= bottom && from <= top {
            found.push(along(a, course));
        }
        for border in [bottom, top] {
            if (from < border) != (to < border) {
                let share = (border - from) / (to - from);
                let (begin, end) = (along(a, course), along(b, course));
                found.push(begin + share * (end - begin));
            }
        }
    }
    found
}

/// A line `offset` metres to the right of another, with mitred corners, longer by `run_out` at both
/// ends.
fn beside(line: &[GroundPoint], offset: f64, run_out: f64) -> Vec<GroundPoint> {
    let direction = |i: usize| {
        let way = line[i + 1].to_vector() - line[i].to_vector();
        way / way.norm()
    };
    let last = line.len() - 1;
    let place = |i: usize| {
        let before = direction(i.saturating_sub(1).min(last - 1));
        let after = direction(i.min(last - 1));
        let right = |d: nalgebra::Vector2<f64>| nalgebra::Vector2::new(-d.y, d.x);
        let sum = right(before) + right(after);
        // Both sides lie `offset` away: the mitre is the sum over 1 + cos of the turn.
        let mitre = sum / (1.0 + before.dot(&after)).max(2.0 / (MITRE_LIMIT * MITRE_LIMIT));
        let mut p = line[i].to_vector() + offset * mitre;
        if i == 0 {
            p -= run_out * after;
        } else if i == last {
            p += run_out * before;
        }
        GroundPoint::new(p.x, p.y)
    };
    (0..=last).map(place).collect()
}

/// Lines flown one after the other, every second one backwards; where they lie too close for the
/// turn between them, some are left out at first and flown later.
fn there_and_back(lines: &[Vec<GroundPoint>], step: f64, least_step: f64) -> Vec<GroundPoint> {
    let leap = ((least_step / step.max(0.1)) - 1e-9).ceil().max(1.0) as usize;
    let leap = leap.min(lines.len().max(1));
    let order = (0..leap).flat_map(|first| (first..lines.len()).step_by(leap));
    let mut path = Vec::new();
    for (turn, index) in order.enumerate() {
        let mut line = lines[index].clone();
        if turn % 2 == 1 {
            line.reverse();
        }
        path.append(&mut line);
    }
    path
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn at(places: &[(f64, f64)]) -> Vec<GroundPoint> {
        let places = places.iter();
        places.map(|(n, e)| GroundPoint::new(*n, *e)).collect()
    }

    fn passes(spacing: f64) -> Passes {
        Passes {
            spacing,
            run_out: 0.0,
            least_step: 0.0,
        }
    }

    fn away(p: &GroundPoint, a: &GroundPoint, b: &GroundPoint) -> f64 {
        let way = b.to_vector() - a.to_vector();
        let share = (p.to_vector() - a.to_vector()).dot(&way) / way.norm_squared().max(1e-12);
        let foot = a.to_vector() + share.clamp(0.0, 1.0) * way;
        (p.to_vector() - foot).norm()
    }

    fn covered(p: &GroundPoint, path: &[GroundPoint]) -> f64 {
        let pairs = path.chunks(2).map(|pair| away(p, &pair[0], &pair[1]));
        pairs.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_field_is_flown_along_its_longer_side_there_and_back() {
        let field = at(&[(0.0, 0.0), (0.0, 400.0), (100.0, 400.0), (100.0, 0.0)]);
        let course = fewest_passes(&field).unwrap();
        assert!((course.to_degrees() - 90.0).abs() < 1e-9);
        let path = survey(&field, course, &passes(50.0));
        assert_eq!(path.len(), 4);
        let easts: Vec<i64> = path.iter().map(|p| p.east.round() as i64).collect();
        assert_eq!(easts, [0, 400, 400, 0]);
        let mut norths: Vec<i64> = path.iter().map(|p| p.north.round() as i64).collect();
        norths.sort_unstable();
        assert_eq!(norths, [25, 25, 75, 75]);
    }

    #[test]
    fn where_turns_do_not_fit_passes_in_between_are_flown_later() {
        let field = at(&[(0.0, 0.0), (0.0, 400.0), (100.0, 400.0), (100.0, 0.0)]);
        let wide = Passes {
            least_step: 50.0,
            run_out: 30.0,
            ..passes(25.0)
        };
        let path = survey(&field, 90.0_f64.to_radians(), &wide);
        assert_eq!(path.len(), 8);
        // Two sweeps over every other pass; only between the sweeps lies a neighbour.
        let is_wide = |turn: &[GroundPoint]| turn[0].distance(&turn[1]) >= 50.0 - 1e-9;
        let turns: Vec<bool> = path[1..7].chunks(2).map(is_wide).collect();
        assert_eq!(turns, [true, false, true]);
        assert!((path[0].east + 30.0).abs() < 1e-9, "it begins outside");
    }

    #[test]
    fn the_passes_of_a_corridor_keep_their_distance_around_a_bend() {
        let line = at(&[(0.0, 0.0), (500.0, 0.0), (500.0, 500.0)]);
        let path = corridor(&line, 60.0, &passes(30.0));
        assert_eq!(path.len(), 6);
        for p in &path {
            let near = away(p, &line[0], &line[1]).min(away(p, &line[1], &line[2]));
            assert!((15.0 - 1e-9..=15.0 * 1.5).contains(&near), "{p:?} {near}");
        }
        assert!(
            path[2].distance(&path[3]) < 31.0,
            "the way back begins beside"
        );
    }

    #[test]
    fn a_camera_on_its_side_sees_farther_along_than_across() {
        let mut camera = CameraModel::pinhole(640, 480, 60.0_f64.to_radians());
        let (across, along) = picture_on_ground(&camera, 100.0);
        assert!((across - 115.47).abs() < 0.01 && (along - 86.6).abs() < 0.01);
        camera.mount.yaw = 90.0_f64.to_radians();
        assert_eq!(picture_on_ground(&camera, 100.0), (along, across));
    }

    proptest! {
        #[test]
        fn no_corner_or_inner_place_of_an_area_is_missed(
            radii in prop::collection::vec(40.0_f64..200.0, 3..9),
            spacing in 10.0_f64..80.0,
            course in 0.0_f64..std::f64::consts::PI,
            inward in 0.0_f64..1.0,
        ) {
            let count = radii.len() as f64;
            let area: Vec<GroundPoint> = radii
                .iter()
                .enumerate()
                .map(|(i, r)| {
                    let angle = std::f64::consts::TAU * i as f64 / count;
                    GroundPoint::new(r * angle.cos(), r * angle.sin())
                })
                .collect();
            let path = survey(&area, course, &passes(spacing));
            for corner in &area {
                let place = GroundPoint::new(inward * corner.north, inward * corner.east);
                prop_assert!(covered(&place, &path) <= 0.5 * spacing + 1e-6);
            }
        }
    }
}
