//! Description of an aid for people, and what an aid does.

use nalgebra::{Matrix2, Point2, Point3};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_flight::{ChannelName, Flight};
use pilotage_mission::settings::SensorNoise;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;

use super::super::SightingReport;
use super::super::expected::AppearanceModel;
use super::super::known_ground::KnownGround;
use super::super::observation::{GaussianState, Observation};
use super::assumed_air::AssumedAir;
use super::error::AidError;

/// Makes an aid, with a value for each of its numbers, from what is known of the ground, if anything is.
pub type BeginAid = fn(&[f64], Option<&KnownGround>) -> Result<Box<dyn Aid>, AidError>;

/// Reason why an aid does not look at the pictures that a camera takes from a pose over level ground, metres below the
/// world's origin, as the end of a sentence; `None` where it does.
pub type PassesOver = fn(&CameraModel, &Pose, f64) -> Option<&'static str>;

/// That of an aid that looks at all of them, or at none.
pub const NONE_PASSED_OVER: PassesOver = |_, _, _| None;

/// Description of an aid.
#[derive(Clone, Copy, Debug)]
pub struct AidInfo {
    /// Name in files and on the command line.
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// Explanation of what it measures and how far that is to be trusted, in sentences.
    pub description: &'static str,
    /// Channels of which it takes its readings: a reading is there when the first has one. An aid without channels
    /// looks at the camera's pictures.
    pub channels: &'static [ChannelName],
    /// Components of what it measures, each with its SI unit.
    pub components: &'static [(&'static str, &'static str)],
    /// Whether it tells the place of the aircraft, so that who flies by it flies by more than dead reckoning.
    pub tells_place: bool,
    /// Pictures that it does not look at.
    pub passes_over: PassesOver,
    /// Numbers that people may set.
    pub numbers: &'static [AidNumber],
}

impl AidInfo {
    /// Whether it looks at the camera's pictures.
    pub const fn sees(&self) -> bool {
        self.channels.is_empty()
    }
}

/// Number that people may set for an aid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AidNumber {
    /// Name in files.
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Value where nobody says another.
    pub usual: f64,
}

/// Stretch of a flight in which an aid may have measured something.
pub struct AidMoment<'a> {
    pub flight: &'a Flight,
    /// End of the step before, seconds.
    pub from: f64,
    /// End of this step, seconds.
    pub until: f64,
    /// Velocity through the air at its end, where no reading tells it.
    pub air: AssumedAir,
    /// The picture that came at its end, if one did that can be looked at.
    pub look: Option<AidLook<'a>>,
}

/// A picture that an aid may look at, and what is believed of the camera that took it.
pub struct AidLook<'a> {
    pub picture: &'a Picture,
    /// Camera, attitude and heights as measured when the picture was taken; the heading's bias is still in it.
    pub model: AppearanceModel<'a>,
    /// Believed pose of the camera over the map, after whatever landmarks said in this picture.
    pub pose: Pose,
    /// Belief about place on the map (north, east, metres) and heading's bias (radians) when the picture was taken.
    pub belief: GaussianState<3>,
    /// Errors of the measured attitude and height, and of the mount.
    pub noise: SensorNoise,
    /// Standard deviation per axis of the map's error that is a state of the filter, metres; 0 where none is.
    pub map_deviation: f64,
}

impl AidLook<'_> {
    /// Height of the camera above the ground, metres, at least one.
    pub fn height(&self) -> f64 {
        (self.model.ground_down - self.model.camera_down).max(1.0)
    }

    /// Standard deviation of the believed place in the direction in which it is greatest, metres.
    pub fn deviation(&self) -> f64 {
        let place: Matrix2<f64> = self.belief.covariance.fixed_view::<2, 2>(0, 0).into();
        place.symmetric_eigenvalues().max().max(0.0).sqrt()
    }

    /// Variance per axis of a map that is good to `of_map`, metres, beyond that of the state for its error, m².
    pub fn beyond_state(&self, of_map: f64) -> f64 {
        (of_map.powi(2) - self.map_deviation.powi(2)).max(0.0)
    }

    /// Ground below the believed camera.
    pub fn below(&self) -> GroundPoint {
        let position = self.pose.position_in_world;
        GroundPoint::new(position.x, position.y)
    }

    /// Pixel of a place on the ground by the believed pose; `None` behind the camera.
    pub fn pixel_of(&self, place: GroundPoint) -> Option<Point2<f64>> {
        let on_ground = Point3::new(place.north, place.east, self.model.ground_down);
        self.model.camera.project(&self.pose, &on_ground)
    }
}

/// A source of corrections.
pub trait Aid: Send {
    /// Its description.
    fn info(&self) -> &'static AidInfo;

    /// Observations that it has made at a moment: true at its end, or when the picture was taken if the aid sees.
    /// The attitude in the kinematics that their models are shown is that of the instruments at the end; that of the
    /// picture is the look's.
    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>>;

    /// Report of what it saw in the picture of the last moment, told once.
    fn sighting(&mut self) -> Option<SightingReport> {
        None
    }
}
