//! A photo placed by a table of edges.

use nalgebra::Point2;
use pilotage_base::frames::Pose;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;
use pilotage_vision::ground_class::ground_picture;

use super::field::EdgeField;
use super::place::{EdgePlace, EdgePrior, FARTHEST, place_by_edges};
use super::seen::{EDGE_GSD, edges_seen};
use crate::{GenericClass, ReferenceTable};

/// Belief about the pose of a photo over level ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotoBelief {
    /// Assumed pose; the ground is at zero.
    pub pose: Pose,
    /// Standard deviation of its position, metres per axis.
    pub deviation: f64,
    /// Standard deviation of roll and pitch, radians.
    pub tilt: f64,
    /// Farthest that the heading is off, radians.
    pub turn: f64,
    /// Standard deviation of the logarithm of the true height over the assumed one.
    pub log_height: f64,
    /// Standard deviation of the map's own places, metres per axis.
    pub map_deviation: f64,
}

/// Place of a photo by the edges of `table`; `None` where the camera looks past the horizon or shows no edge.
pub fn place_photo(
    camera: &CameraModel,
    picture: &Picture,
    belief: &PhotoBelief,
    table: &ReferenceTable,
) -> Option<EdgePlace> {
    let (window, pixels) = ground_picture(camera, &belief.pose, 0.0, picture, EDGE_GSD)?;
    let half = |pixels: usize| 0.5 * pixels as f64;
    let pixel = Point2::new(half(picture.width()), half(picture.height()));
    let middle = camera.ground_at(&belief.pose, &pixel, 0.0)?;
    let height = belief.pose.position_in_world.z;
    let prior = EdgePrior {
        middle,
        deviation: belief.deviation.hypot(belief.tilt * height),
        turn: belief.turn,
        log_height: belief.log_height,
        map_deviation: belief.map_deviation,
    };
    let corners = window.rect().corners();
    let away = corners.iter().map(|corner| corner.distance(&middle));
    let grown = (FARTHEST * prior.log_height).exp();
    let reach = grown * away.fold(0.0, f64::max) + FARTHEST * prior.deviation;
    let field = EdgeField::around(middle, reach, table);
    let seen = edges_seen(&window, &pixels, GenericClass::Other(0));
    place_by_edges(&seen, &prior, &field)
}
