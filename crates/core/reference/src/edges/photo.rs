//! A photo placed by a table of edges.

use std::error::Error;
use std::fmt;

use nalgebra::Point2;
use pilotage_base::frames::{GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;
use pilotage_vision::ground_class::ground_picture;

use super::field::{CORNER, EdgeField, LONGEST};
use super::place::{EdgePlace, EdgePrior, FARTHEST, look_ups, place_by_edges_telling};
use super::seen::{EDGES, edges_seen};
use crate::{GenericLandmark, ReferenceTable};

/// Farthest ground around the middle of a photo that is compared with a table, metres: it takes 0.8 GB.
const FARTHEST_COMPARED: f64 = 2000.0;
/// Most pixels of ground in which edges are sought.
const MOST_PIXELS: f64 = 30e6;
/// Most comparisons of an edge's part with the table: some minutes.
const MOST_LOOK_UPS: f64 = 1e11;
/// Farthest ground that a photo shows, in heights above it.
const FARTHEST_HEIGHTS: f64 = 1.5;

/// Reason why a photo is not placed by its edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotoEdgesError {
    /// It looks past the horizon.
    PastHorizon,
    /// It and its belief reach over too much ground.
    TooWide {
        /// Distance from the believed middle to which the table is needed, metres.
        reach: f64,
    },
    /// Its pixels on the ground are too many.
    TooFine {
        /// Their number.
        pixels: f64,
    },
    /// The belief leaves too many poses to be tried.
    TooOpen {
        /// Number of places by number of headings and scales, millions.
        trials: f64,
        /// Number of edges that were seen.
        edges: usize,
    },
}

impl fmt::Display for PhotoEdgesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PastHorizon => {
                f.write_str("the photo looks past the horizon; edges need one that looks down")
            }
            Self::TooWide { reach } => write!(
                f,
                "the photo and the range of its place reach {reach:.0} m around, and at most {FARTHEST_COMPARED:.0} m are \
                 compared; give a smaller --within, or a photo from lower down"
            ),
            Self::TooFine { pixels } => write!(
                f,
                "the ground of the photo has {:.0} million pixels, and edges are sought in {:.0} million at most; give a \
                 greater --gsd, to this and to the table",
                1e-6 * pixels,
                1e-6 * MOST_PIXELS
            ),
            Self::TooOpen { trials, edges } => write!(
                f,
                "the ranges of place, height and heading are {trials:.0} million poses to be tried by {edges} edges, which takes \
                 hours; give a smaller --within or --heading-within"
            ),
        }
    }
}

impl Error for PhotoEdgesError {}

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
    /// Edges of `picture`, which `camera` took.
    ///
    /// # Errors
    /// A photo that looks past the horizon, or for which memory or patience would not be enough.
    pub fn of(
        camera: &CameraModel,
        picture: &Picture,
        belief: &PhotoBelief,
    ) -> Result<Self, PhotoEdgesError> {
        let (pose, ground) = (&belief.pose, belief.ground_down);
        let height = ground - pose.position_in_world.z;
        let outline = camera.footprint_within(pose, ground, FARTHEST_HEIGHTS * height);
        let rect: GroundRect = GroundRect::around(outline).ok_or(PhotoEdgesError::PastHorizon)?;
        let reach = 0.5 * rect.width().hypot(rect.height()) + FARTHEST * belief.deviation;
        if reach > CORNER * FARTHEST_COMPARED {
            return Err(PhotoEdgesError::TooWide { reach });
        }
        let pixels = rect.width() / belief.gsd * (rect.height() / belief.gsd);
        if pixels > MOST_PIXELS {
            return Err(PhotoEdgesError::TooFine { pixels });
        }
        let own = Self::seen_in(camera, picture, belief);
        let own = own.ok_or(PhotoEdgesError::PastHorizon)?;
        if own.reach > FARTHEST_COMPARED {
            return Err(PhotoEdgesError::TooWide { reach: own.reach });
        }
        let (trials, look_ups) = look_ups(&own.seen, &own.prior);
        if look_ups > MOST_LOOK_UPS {
            return Err(PhotoEdgesError::TooOpen {
                trials: 1e-6 * trials,
                edges: own.seen.len(),
            });
        }
        Ok(own)
    }

    fn seen_in(camera: &CameraModel, picture: &Picture, belief: &PhotoBelief) -> Option<Self> {
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
        self.place_telling(table, &mut |_| ())
    }

    /// As [`Self::place`]; `tell` is told the share that is done, many times.
    pub fn place_telling(
        &self,
        table: &ReferenceTable,
        tell: &mut dyn FnMut(f64),
    ) -> Option<EdgePlace> {
        let field = EdgeField::around(self.prior.middle, self.reach, table);
        place_by_edges_telling(&self.seen, &self.prior, &field, tell)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;
    use pilotage_base::frames::Attitude;

    use super::*;

    fn photo(height: f64, deviation: f64, turn: f64) -> Result<PhotoEdges, PhotoEdgesError> {
        // A chequered floor: it has edges.
        let picture = Picture::from_fn(160, 120, |column, row| {
            [if (column / 20 + row / 20) % 2 == 0 {
                210
            } else {
                40
            }; 3]
        });
        let camera = CameraModel::pinhole(160, 120, 60_f64.to_radians());
        let belief = PhotoBelief {
            pose: Pose {
                position_in_world: Point3::new(0.0, 0.0, -height),
                attitude: Attitude::level(0.3),
            },
            ground_down: 0.0,
            deviation,
            tilt: 0.01,
            turn,
            log_height: 0.02,
            map_deviation: 1.0,
            gsd: 0.5,
        };
        PhotoEdges::of(&camera, &picture, &belief)
    }

    #[test]
    fn photos_that_would_fill_the_memory_or_never_end_are_refused_in_words() {
        let seen = photo(150.0, 10.0, 0.2).ok().unwrap();
        assert!(!seen.seen.is_empty());
        let refused = |height, deviation, turn| photo(height, deviation, turn).err().unwrap();
        // From 4 km the field alone would take 3.9 GB.
        let high = refused(4000.0, 10.0, 0.2);
        assert!(matches!(high, PhotoEdgesError::TooWide { .. }), "{high}");
        // Within 500 m by any heading there are 600 million trials.
        let open = refused(150.0, 200.0, 3.1);
        assert!(matches!(open, PhotoEdgesError::TooOpen { .. }), "{open}");
        assert!(open.to_string().contains("million poses"), "{open}");
    }
}
