//! A photo placed by a table of edges.

use nalgebra::Point2;
use pilotage_base::frames::Pose;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;
use pilotage_vision::ground_class::ground_picture;

use super::field::{CORNER, EdgeField, LONGEST};
use super::place::{EdgePlace, EdgePrior, FARTHEST, place_by_edges};
use super::seen::{EDGES, edges_seen};
use crate::{GenericLandmark, ReferenceTable};

/// Belief about the pose of a photo over level ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotoBelief {
    /// Assumed pose.
    pub pose: Pose,
    /// Height of the ground, metres below the world's origin.
    pub ground_down: f64,
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
    /// Ground in a pixel in which the table's edges were sought, metres: those of the photo are sought alike.
    pub gsd: f64,
}

/// Edges of a photo, and what is believed of it.
pub struct PhotoEdges {
    /// Edges where they lie by the assumed pose.
    pub seen: Vec<GenericLandmark>,
    prior: EdgePrior,
    reach: f64,
}

impl PhotoEdges {
    /// Edges of `picture`, which `camera` took; `None` where it looks past the horizon.
    pub fn of(camera: &CameraModel, picture: &Picture, belief: &PhotoBelief) -> Option<Self> {
        let (pose, ground) = (&belief.pose, belief.ground_down);
        let (window, pixels) = ground_picture(camera, pose, ground, picture, belief.gsd)?;
        let half = |pixels: usize| 0.5 * pixels as f64;
        let pixel = Point2::new(half(picture.width()), half(picture.height()));
        let middle = camera.ground_at(pose, &pixel, ground)?;
        let height = ground - pose.position_in_world.z;
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
        Some(Self {
            seen: edges_seen(&window, &pixels, EDGES),
            reach: grown * away.fold(0.0, f64::max) + FARTHEST * prior.deviation,
            prior,
        })
    }

    /// Belief about the middle of the photo.
    pub fn prior(&self) -> &EdgePrior {
        &self.prior
    }

    /// Farthest from the believed middle that edges of a table can tell of the place, metres.
    pub fn reach(&self) -> f64 {
        CORNER * self.reach + LONGEST
    }

    /// Place by the edges of `table`; `None` of a photo without edges.
    pub fn place(&self, table: &ReferenceTable) -> Option<EdgePlace> {
        let field = EdgeField::around(self.prior.middle, self.reach, table);
        place_by_edges(&self.seen, &self.prior, &field)
    }
}
