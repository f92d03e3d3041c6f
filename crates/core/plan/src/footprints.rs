//! Boxes of the map in the pictures of a flight.

use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;

/// Share of the picture's height that a box keeps from its edge.
const EDGE: f64 = 0.02;

/// Ground in the pictures of a flight, to find the boxes that lie whole in one.
pub(super) struct Footprints<'a> {
    camera: &'a CameraModel,
    frames: &'a [(f64, Pose)],
    ground_down: f64,
    /// For each frame a box around the ground in its picture: what does not touch it is not looked at.
    around: Vec<Option<GroundRect>>,
}

impl<'a> Footprints<'a> {
    /// The pictures that are taken when and where `frames` say.
    pub fn new(camera: &'a CameraModel, frames: &'a [(f64, Pose)], ground_down: f64) -> Self {
        let around = |(_, pose): &(f64, Pose)| surroundings(camera, pose, ground_down);
        Self {
            camera,
            frames,
            ground_down,
            around: frames.iter().map(around).collect(),
        }
    }

    /// Whether the picture of frame `f` holds all of a box.
    pub fn hold(&self, f: usize, bounds: &GroundRect) -> bool {
        self.around[f].is_none_or(|around| around.overlaps(bounds))
            && holds(self.camera, &self.frames[f].1, bounds, self.ground_down)
    }
}

/// A box around the ground in the picture; `None` if part of the picture shows no ground.
fn surroundings(camera: &CameraModel, pose: &Pose, ground_down: f64) -> Option<GroundRect> {
    let corners = camera.corners();
    let on_ground: Option<Vec<GroundPoint>> = corners
        .iter()
        .map(|p| camera.ground_at(pose, p, ground_down))
        .collect();
    let on_ground = on_ground?;
    let most = |f: &dyn Fn(&GroundPoint) -> f64| on_ground.iter().map(f).fold(f64::MIN, f64::max);
    Some(GroundRect {
        north: most(&|p| p.north),
        south: -most(&|p| -p.north),
        east: most(&|p| p.east),
        west: -most(&|p| -p.east),
    })
}

/// Whether the whole box lies in the picture, with [`EDGE`] of the picture to spare.
fn holds(camera: &CameraModel, pose: &Pose, bounds: &GroundRect, ground_down: f64) -> bool {
    camera.holds(pose, bounds, ground_down, EDGE * camera.height as f64)
}
