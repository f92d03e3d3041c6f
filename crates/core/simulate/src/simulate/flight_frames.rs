//! The pictures of a simulated flight, made when they are asked for.

use std::sync::Arc;

use super::aerial_camera::{AerialCamera, AerialCameraSettings, AerialFrame, frame_random};
use super::flight_day::FlightDay;
use super::scenery::{DEMO_SEED, Scenery};
use pilotage_base::frames::Pose;
use pilotage_flight::{Flight, FrameError, FrameSource};
use pilotage_raster::imagery::CachedImagery;
use pilotage_raster::raster::{Picture, encode_png};

/// Memory for tiles of the scenery where pictures are 640 pixels wide: some ten times the ground of a picture, as flights
/// go on and seldom come back. Larger pictures show as much more.
const CACHE_MEGABYTES: usize = 32;
const CACHED_WIDTH: usize = 640;

/// A flight that did not happen, and its pictures.
#[derive(Clone)]
pub struct SimulatedFlight {
    /// Measurements of the flight, and the truth.
    pub flight: Flight,
    /// The pictures.
    pub frames: SimulatedFrames,
    /// The seed of gusts, sensors and pictures.
    pub seed: u64,
    /// The day on which the camera saw the ground.
    pub day: FlightDay,
}

/// Takes frame by frame; any order gives the same pictures.
#[derive(Clone)]
pub struct SimulatedFrames {
    imagery: Option<Arc<CachedImagery>>,
    ground: Option<Scenery>,
    day: FlightDay,
    seed: u64,
    camera: Arc<AerialCamera>,
    ground_down: f64,
    poses: Vec<Option<Pose>>,
    names: Vec<String>,
}

impl SimulatedFrames {
    /// Pictures of the generated scenery on `day` from the true poses of `flight`; the camera's own
    /// noise follows from `seed`.
    ///
    /// The scenery is laid out with the first picture.
    pub fn new(flight: &Flight, day: FlightDay, seed: u64) -> Self {
        // The true poses shake already.
        let settings = AerialCameraSettings {
            mount_vibration_sd: 0.0,
            ..AerialCameraSettings::default()
        };
        let truth = flight.truth.as_ref().map_or(&[][..], |t| &t.frames);
        Self {
            imagery: None,
            ground: None,
            day,
            seed,
            camera: Arc::new(AerialCamera::new(flight.camera.clone(), settings)),
            ground_down: flight.ground_down,
            poses: truth
                .iter()
                .map(pilotage_flight::FrameTruth::pose)
                .collect(),
            names: flight.frames.iter().map(|f| f.name.clone()).collect(),
        }
    }

    /// The same over other imagery, e.g. one that is shared with others.
    #[must_use]
    pub fn over(mut self, imagery: Arc<CachedImagery>) -> Self {
        self.imagery = Some(imagery);
        self
    }

    /// The same over the scenery of `ground`, on the flight's own day; laid out with the first
    /// picture.
    #[must_use]
    pub fn over_ground(mut self, ground: Scenery) -> Self {
        self.ground = Some(ground);
        self
    }

    /// Imagery that the camera sees, laid out now if it was not yet.
    pub fn imagery(&mut self) -> Arc<CachedImagery> {
        let day = self.day.day();
        let ground = &self.ground;
        let wider = self.camera.model().width.div_ceil(CACHED_WIDTH).max(1);
        let megabytes = CACHE_MEGABYTES * wider * wider;
        Arc::clone(self.imagery.get_or_insert_with(|| {
            let scenery = match ground {
                Some(ground) => ground.on_day(day),
                None => Scenery::new(DEMO_SEED, day),
            };
            Arc::new(CachedImagery::new(Arc::new(scenery), megabytes))
        }))
    }

    /// Frame number `index` with its file and the pose from which it was taken.
    pub fn frame(&mut self, index: usize) -> Result<AerialFrame, FrameError> {
        let pose = self
            .poses
            .get(index)
            .ok_or(FrameError::OutOfRange(index))?
            .ok_or_else(|| {
                self.unreadable(index, &"the flight does not tell from where it was taken")
            })?;
        let imagery = self.imagery();
        let mut random = frame_random(self.seed, index);
        Ok(self
            .camera
            .take(&*imagery, &pose, self.ground_down, &mut random))
    }

    fn unreadable(&self, index: usize, cause: &dyn ToString) -> FrameError {
        FrameError::Unreadable {
            name: self.names[index].clone(),
            cause: cause.to_string(),
        }
    }
}

impl FrameSource for SimulatedFrames {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        Ok(self.frame(index)?.picture)
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let frame = self.frame(index)?;
        match frame.encoded {
            Some(bytes) => Ok(bytes),
            None => encode_png(&frame.picture).map_err(|e| self.unreadable(index, &e)),
        }
    }
}
