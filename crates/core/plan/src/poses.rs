//! Poses of a camera over a path or a whole map, where the flight is not known yet.

use std::f64::consts::PI;

use nalgebra::Point3;

use pilotage_base::frames::{Attitude, GroundPoint, Pose};
use pilotage_raster::imagery::{Imagery, Window};

/// Headings of the pictures taken anywhere: half a turn of them, for a picture is as wide on both sides.
const HEADINGS: usize = 4;

/// Level poses at `height` metres over a path, two a second at `speed` m/s: where the camera will be as
/// far as a line on the map tells.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_plan::poses_over;
///
/// // 100 m at 20 m/s with two pictures a second: one every 10 m, both ends included.
/// let path = [GroundPoint::new(0.0, 0.0), GroundPoint::new(0.0, 100.0)];
/// let poses = poses_over(&path, 120.0, 20.0, 0.0);
/// assert_eq!(poses.len(), 11);
/// let (time, pose) = poses[3];
/// assert!((time - 1.5).abs() < 1e-9 && (pose.position_in_world.y - 30.0).abs() < 1e-9);
/// ```
pub fn poses_over(
    path: &[GroundPoint],
    height: f64,
    speed: f64,
    ground_down: f64,
) -> Vec<(f64, Pose)> {
    let mut poses = Vec::new();
    let mut travelled = 0.0;
    let mut due = 0.0;
    let step = 0.5 * speed.max(0.1);
    for leg in path.windows(2) {
        let way = leg[1].to_vector() - leg[0].to_vector();
        let length = way.norm();
        if length < 1e-9 {
            continue;
        }
        let course = way.y.atan2(way.x);
        while due <= travelled + length {
            let at = leg[0].to_vector() + way * ((due - travelled) / length);
            let pose = Pose {
                position_in_world: Point3::new(at.x, at.y, ground_down - height),
                attitude: Attitude::level(course),
            };
            poses.push((due / speed.max(0.1), pose));
            due += step;
        }
        travelled += length;
    }
    poses
}

/// Level poses at `height` metres over what `map` shows, `step` metres apart, each on several headings,
/// and so far apart in time that no fix lasts from one to the next: for a map over which nobody knows the
/// route yet.
pub fn poses_all_over(
    map: &dyn Imagery,
    height: f64,
    step: f64,
    ground_down: f64,
) -> Vec<(f64, Pose)> {
    let region = map.bounds();
    let count = |length: f64| (length / step.max(0.1)).floor().max(0.0) as usize + 1;
    let mut poses = Vec::new();
    for row in 0..count(region.height()) {
        for column in 0..count(region.width()) {
            let north = region.south + step * row as f64;
            let east = region.west + step * column as f64;
            if !shows_ground(map, GroundPoint::new(north, east)) {
                continue;
            }
            for turn in 0..HEADINGS {
                let pose = Pose {
                    position_in_world: Point3::new(north, east, ground_down - height),
                    attitude: Attitude::level(PI * turn as f64 / HEADINGS as f64),
                };
                poses.push((1e3 * poses.len() as f64, pose));
            }
        }
    }
    poses
}

/// Whether a map shows ground at a place: it may be transparent, or pure black or white, around it.
pub fn shows_ground(map: &dyn Imagery, place: GroundPoint) -> bool {
    let gsd = map.native_gsd().max(1.0);
    let window = Window {
        north_edge: place.north + 0.5 * gsd,
        west_edge: place.east - 0.5 * gsd,
        gsd,
        width: 1,
        height: 1,
    };
    let [red, green, blue, alpha] = map.window(&window).get(0, 0);
    alpha == 255 && red.max(green).max(blue) > 2 && red.min(green).min(blue) < 253
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::GroundRect;
    use pilotage_raster::raster::{Raster, Rgba};

    /// Ground in the west, nothing in the east.
    struct HalfAMap;

    impl Imagery for HalfAMap {
        fn name(&self) -> &'static str {
            "half a map"
        }

        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 400.0, 400.0)
        }

        fn native_gsd(&self) -> f64 {
            0.5
        }

        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |column, row| {
                let east = window.ground_at(column as f64, row as f64).east;
                if east < 0.0 {
                    [90, 90, 90, 255]
                } else {
                    [0; 4]
                }
            })
        }
    }

    #[test]
    fn nobody_is_expected_to_fly_where_the_map_shows_nothing() {
        let poses = poses_all_over(&HalfAMap, 100.0, 50.0, 0.0);
        assert!(poses.iter().all(|(_, p)| p.position_in_world.y < 1.0));
        // Nine rows, four columns and perhaps the rim, on every heading.
        assert!(poses.len() >= 9 * 4 * HEADINGS, "{}", poses.len());
        assert_eq!(poses.len() % HEADINGS, 0);
    }
}
