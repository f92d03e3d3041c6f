//! Requests to every detector, and its answers.

use nalgebra::{Matrix2, Matrix4};
use serde::{Deserialize, Serialize};

use super::Landmark;
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Pyramid;

/// Standard deviation of a turn that a detector does not measure, radians.
pub const UNKNOWN_TURN: f64 = 0.5;
/// The same of the logarithm of a size.
pub const UNKNOWN_LOG_SCALE: f64 = 0.3;

/// Number of components that a detector measured, from its covariance of two of place, turn (radians) and
/// logarithm of the size: the place, and what of the other two it did not leave open. So many degrees of
/// freedom has the normalized innovation squared, to which what is left open adds nothing.
pub fn measured(covariance: &Matrix4<f64>) -> usize {
    let turn = covariance[(2, 2)] < UNKNOWN_TURN.powi(2);
    let size = covariance[(3, 3)] < UNKNOWN_LOG_SCALE.powi(2);
    2 + usize::from(turn) + usize::from(size)
}

/// A camera picture and the pose that is assumed for it.
#[derive(Clone, Copy, Debug)]
pub struct FrameView<'a> {
    /// The camera, any turn of the stored picture included.
    pub camera: &'a CameraModel,
    /// The pose from the predicted state and the measured attitude.
    pub pose: Pose,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Luminance of the picture.
    pub luminance: &'a Pyramid,
}

/// A landmark and how far from its expected place it may appear.
#[derive(Clone, Copy, Debug)]
pub struct SearchRequest<'a> {
    /// Landmark to look for.
    pub landmark: &'a Landmark,
    /// Covariance (north, east) of the difference between the place at which the landmark will
    /// appear under the assumed pose and its place on the map, m²: the innovation covariance carried
    /// to the ground.
    pub displacement_covariance: Matrix2<f64>,
    /// Standard deviation of the turn of the picture against the map that the assumed pose leaves, radians.
    pub turn_deviation: f64,
    /// Standard deviation of the natural logarithm of the landmark's size in the picture that it leaves.
    pub log_scale_deviation: f64,
}

impl SearchRequest<'_> {
    /// Half extents (north, east) of the search region, metres, at `sigmas` standard deviations.
    pub fn half_extents(&self, sigmas: f64) -> (f64, f64) {
        let c = &self.displacement_covariance;
        (
            sigmas * c[(0, 0)].max(0.0).sqrt(),
            sigmas * c[(1, 1)].max(0.0).sqrt(),
        )
    }

    /// Ground that the landmark's box may cover under the assumed pose.
    ///
    /// ```
    /// use nalgebra::Matrix2;
    /// # use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_vision::landmark::{Landmark, SearchRequest};
    ///
    /// let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 20.0, 20.0);
    /// let landmark = Landmark::new(1, "Barn", bounds);
    /// let request = SearchRequest {
    ///     landmark: &landmark,
    ///     displacement_covariance: Matrix2::new(25.0, 0.0, 0.0, 100.0), // 5 m north, 10 m east
    ///     turn_deviation: 0.1,
    ///     log_scale_deviation: 0.1,
    /// };
    /// let region = request.region(3.0);
    /// assert_eq!((region.height(), region.width()), (20.0 + 2.0 * 15.0, 20.0 + 2.0 * 30.0));
    /// ```
    pub fn region(&self, sigmas: f64) -> GroundRect {
        let (north, east) = self.half_extents(sigmas);
        let b = self.landmark.bounds;
        GroundRect {
            south: b.south - north,
            north: b.north + north,
            west: b.west - east,
            east: b.east + east,
        }
    }
}

/// Place, turn and size of a landmark that was found, with the scores.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detection {
    /// Ground point at which the reference point appears under the assumed pose.
    pub ground: GroundPoint,
    /// Covariance of (north, east, rotation, log scale) from the shape of the peak, metres and radians.
    pub covariance: Matrix4<f64>,
    /// Score of the best place, -1 to 1.
    pub score: f64,
    /// Score of the best place elsewhere in the search region.
    pub second_score: f64,
    /// Probability that it is the landmark, against other places and against its not being seen at all; `None`
    /// from a detector that judges by scores alone.
    #[serde(default)]
    pub probability: Option<f64>,
    /// Turn of the picture against the map at the peak, radians clockwise.
    pub rotation: f64,
    /// Size in the picture relative to the map at the peak.
    pub scale: f64,
}

/// Why a landmark was not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Refusal {
    /// Its patch on the map has no texture to match.
    Flat,
    /// The best score is too low.
    LowScore,
    /// A second place looks nearly as good.
    Ambiguous,
    /// The best place lies at the edge of the search region.
    AtSearchEdge,
    /// The patch lies partly outside the picture wherever it was looked for.
    OutOfPicture,
    /// The innovation is too large for its covariance.
    OutsideGate,
    /// It contradicts the other landmarks of the frame.
    Contradicted,
    /// It may be the look-alike of a landmark that is out of the picture.
    LookAlike,
    /// No detector was trained for it.
    Untrained,
}

impl Refusal {
    /// Every refusal, in the order in which people read them.
    pub const ALL: [Self; 9] = [
        Self::Flat,
        Self::LowScore,
        Self::Ambiguous,
        Self::LookAlike,
        Self::AtSearchEdge,
        Self::OutOfPicture,
        Self::OutsideGate,
        Self::Contradicted,
        Self::Untrained,
    ];

    /// Short name in files and tables.
    pub fn key(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::LowScore => "low_score",
            Self::Ambiguous => "ambiguous",
            Self::AtSearchEdge => "at_search_edge",
            Self::OutOfPicture => "out_of_picture",
            Self::OutsideGate => "outside_gate",
            Self::Contradicted => "contradicted",
            Self::LookAlike => "look_alike",
            Self::Untrained => "untrained",
        }
    }

    /// The reason in words.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Flat => "the map patch has no texture to match",
            Self::LowScore => "the best score is too low",
            Self::Ambiguous => "a second place looks nearly as good",
            Self::AtSearchEdge => "the best place lies at the edge of the search region",
            Self::OutOfPicture => "the patch is cut by the edge of the picture",
            Self::OutsideGate => "it lies too far from where it was expected",
            Self::Contradicted => "it contradicts the other landmarks of the frame",
            Self::LookAlike => {
                "it may be a look-alike of the landmark, which may be out of the picture"
            }
            Self::Untrained => "no detector was trained for it",
        }
    }
}

/// Answer of a detector on one landmark in one picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Sighting {
    /// It is there.
    Found(Detection),
    /// It may not be used; the best place, if any, is kept for people to see.
    Refused(Refusal, Option<Detection>),
}

impl Sighting {
    /// The best place, used or not.
    pub fn best(&self) -> Option<&Detection> {
        match self {
            Self::Found(detection) => Some(detection),
            Self::Refused(_, best) => best.as_ref(),
        }
    }
}

/// Something that finds landmarks in pictures.
pub trait Detector: Send {
    /// Looks for the landmark of `request` in `view`.
    fn detect(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting;
}
