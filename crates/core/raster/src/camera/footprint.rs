//! The ground that the camera sees.

use nalgebra::{Point2, Point3};

use super::CameraModel;
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};

/// Pieces into which an edge of the picture is cut where it is bent.
const BENT_PIECES: usize = 12;
/// Pieces where it is straight and the horizon is far.
const STRAIGHT_PIECES: usize = 4;
/// Halvings to find where an edge crosses the limit.
const HALVINGS: usize = 40;

/// The farthest ground of a footprint, in heights above ground.
pub const FARTHEST_HEIGHTS: f64 = 20.0;

impl CameraModel {
    /// Outline of the ground in view, clockwise on the picture from its top-left corner; empty if
    /// no ground is in view.
    ///
    /// Ground farther than [`FARTHEST_HEIGHTS`] times the height above it is cut off, and so is
    /// what lies over the horizon. A straight edge of an undistorted picture has only its ends.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{Attitude, GroundRect, Pose};
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians());
    /// # let (position_in_world, attitude) = (Point3::new(0.0, 0.0, -100.0), Attitude::level(0.0));
    /// # let pose = Pose { position_in_world, attitude };
    /// // 100 m up, level, heading north: 200 m across, and 480 / 640 of that along.
    /// let seen = GroundRect::around(camera.footprint(&pose, 0.0)).ok_or("nothing in view")?;
    /// assert!((seen.width() - 200.0).abs() < 1e-9);
    /// assert!((seen.height() - 150.0).abs() < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn footprint(&self, pose: &Pose, ground_down: f64) -> Vec<GroundPoint> {
        let height = ground_down - pose.position_in_world.z;
        self.footprint_within(pose, ground_down, FARTHEST_HEIGHTS * height)
    }

    /// As [`Self::footprint`], with the farthest ground given in metres from the nadir point.
    pub fn footprint_within(
        &self,
        pose: &Pose,
        ground_down: f64,
        farthest: f64,
    ) -> Vec<GroundPoint> {
        let position = pose.position_in_world;
        let below = GroundPoint::new(position.x, position.y);
        if !(farthest.is_finite() && ground_down > position.z) {
            return Vec::new();
        }
        let ground = |pixel: &Point2<f64>| {
            self.ground_at(pose, pixel, ground_down)
                .filter(|g| g.distance(&below) <= farthest)
        };
        let corners = self.corners();
        let all_near = corners.iter().all(|corner| ground(corner).is_some());
        let pieces = match (self.bends(), all_near) {
            (true, _) => BENT_PIECES,
            (false, true) => 1,
            (false, false) => STRAIGHT_PIECES,
        };
        let outline: Vec<Point2<f64>> = (0..4)
            .flat_map(|side| {
                let (from, to) = (corners[side], corners[(side + 1) % 4]);
                (0..pieces).map(move |i| from + (to - from) * (i as f64 / pieces as f64))
            })
            .collect();
        let mut polygon = Vec::new();
        let mut ends = Vec::new();
        for (index, from) in outline.iter().enumerate() {
            let to = outline[(index + 1) % outline.len()];
            let (here, there) = (ground(from), ground(&to));
            polygon.extend(here);
            if here.is_some() != there.is_some() {
                let (seen, unseen) = if here.is_some() {
                    (*from, to)
                } else {
                    (to, *from)
                };
                polygon.extend(last_seen(seen, unseen, &ground));
                ends.push(polygon.len());
            }
        }
        // Between leaving and re-entering the picture's outline runs along the limit: an arc.
        if let [leaves, enters] = ends[..] {
            let re_entry_first = ground(&outline[0]).is_none();
            let (a, b) = (polygon.get(leaves - 1), polygon.get(enters - 1));
            if let (Some(&a), Some(&b)) = (a, b) {
                let arc = |from: GroundPoint, to: GroundPoint| {
                    arc_within_view(self, pose, ground_down, farthest, from, to)
                };
                if re_entry_first {
                    // The part in view runs from `a` to `b`; the arc closes the polygon at its end.
                    polygon.extend(arc(b, a));
                } else {
                    let between = arc(a, b);
                    polygon.splice(leaves..leaves, between);
                }
            }
        }
        polygon
    }

    /// Whether the whole of `rect`, on the plane `ground_down` metres below the world's origin level,
    /// lies in the picture, `margin` pixels or more from its edges.
    pub fn holds(&self, pose: &Pose, rect: &GroundRect, ground_down: f64, margin: f64) -> bool {
        rect.corners().into_iter().all(|corner| {
            let point = Point3::new(corner.north, corner.east, ground_down);
            let pixel = self.project(pose, &point);
            pixel.is_some_and(|p| self.in_picture(&p, margin))
        })
    }

    /// Corners of the picture, clockwise from the top left.
    pub fn corners(&self) -> [Point2<f64>; 4] {
        let (w, h) = (self.width as f64, self.height as f64);
        [
            Point2::new(0.0, 0.0),
            Point2::new(w, 0.0),
            Point2::new(w, h),
            Point2::new(0.0, h),
        ]
    }

    /// Whether straight lines of the ground come out bent.
    fn bends(&self) -> bool {
        !self.distortion.is_none() || self.lens == super::Lens::Angular
    }
}

/// The last ground seen on the way from a pixel that sees ground to one that does not.
fn last_seen(
    mut seen: Point2<f64>,
    mut unseen: Point2<f64>,
    ground: &impl Fn(&Point2<f64>) -> Option<GroundPoint>,
) -> Option<GroundPoint> {
    for _ in 0..HALVINGS {
        let middle = nalgebra::center(&seen, &unseen);
        if ground(&middle).is_some() {
            seen = middle;
        } else {
            unseen = middle;
        }
    }
    ground(&seen)
}

/// Points between two on the circle of the farthest ground, on the side that is in view.
fn arc_within_view(
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
    farthest: f64,
    from: GroundPoint,
    to: GroundPoint,
) -> Vec<GroundPoint> {
    let center = pose.position_in_world;
    let angle = |p: GroundPoint| (p.east - center.y).atan2(p.north - center.x);
    let turn = pilotage_base::frames::wrap_pi(angle(to) - angle(from));
    let point = |share: f64, turn: f64| {
        let (sin, cos) = (angle(from) + share * turn).sin_cos();
        GroundPoint::new(center.x + farthest * cos, center.y + farthest * sin)
    };
    let in_view = |p: GroundPoint| {
        camera
            .project(pose, &Point3::new(p.north, p.east, ground_down))
            .is_some_and(|pixel| camera.in_picture(&pixel, -1.0))
    };
    let other_way = turn - std::f64::consts::TAU * turn.signum();
    let turn = if in_view(point(0.5, turn)) || !in_view(point(0.5, other_way)) {
        turn
    } else {
        other_way
    };
    (1..8).map(|i| point(f64::from(i) / 8.0, turn)).collect()
}
