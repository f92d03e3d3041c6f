//! Photographs of a landmark from all over the envelope, and what the filter would think of them.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Matrix2, Point2, Point3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::envelope::FlightEnvelope;
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{PYRAMID_LEVELS, Picture, Pyramid};
use pilotage_simulate::other_days::day_ground::{DayGround, crop};
use pilotage_simulate::simulate::{AerialCamera, AerialCameraSettings};
use pilotage_vision::landmark::{FrameView, Landmark};

/// Standard deviations of the search region that the detector is given.
const SEARCH_SIGMAS: f64 = 3.5;
/// Parts what the filter thinks from what the photos are drawn by.
const THOUGHTS: u64 = 0x7a1_0e04;
/// Tries to place a landmark in a picture before it is said not to fit.
const TRIES: usize = 1000;

/// The part of a picture around one place.
pub struct TrainingPhoto {
    /// The camera of that part.
    pub camera: CameraModel,
    /// Pose of the camera.
    pub pose: Pose,
    /// Picture that the camera takes.
    pub picture: Picture,
    /// The luminance of that.
    pub luminance: Pyramid,
    /// Index of the day of the photo.
    pub day: usize,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// Tilt of which the filter knows, roll and pitch, radians.
    pub known_tilt: [f64; 2],
    /// The box that it is around: the landmark's, or one like it elsewhere.
    pub around: GroundRect,
    /// Whether that is the landmark's.
    pub present: bool,
}

/// Belief of the filter about a photo.
#[derive(Clone, Copy, Debug)]
pub struct Assumed {
    /// Pose that the filter thinks the camera had.
    pub pose: Pose,
    /// Error of its heading, radians.
    pub heading_error: f64,
    /// Logarithm of the size in which the ground appears from there.
    pub log_scale: f64,
    /// Place at which the middle of the photo's box appears on the ground under that pose.
    pub appears: GroundPoint,
    /// Covariance of the search (north, east), m².
    pub covariance: Matrix2<f64>,
}

impl TrainingPhoto {
    /// View that a detector is given.
    pub fn view(&self, assumed: &Assumed, ground_down: f64) -> FrameView<'_> {
        FrameView {
            camera: &self.camera,
            pose: assumed.pose,
            ground_down,
            luminance: &self.luminance,
        }
    }

    /// Place at which the middle of the photo's box appears on the ground to somebody who thinks that the
    /// camera was at `pose`.
    pub fn appears(&self, pose: &Pose, ground_down: f64) -> Option<GroundPoint> {
        let middle = self.around.center();
        let in_world = Point3::new(middle.north, middle.east, ground_down);
        let pixel = self.camera.project(&self.pose, &in_world)?;
        self.camera.ground_at(pose, &pixel, ground_down)
    }
}

impl Assumed {
    /// Turn in which the ground appears from there, radians clockwise.
    pub fn rotation(&self) -> f64 {
        -self.heading_error
    }
}

/// Takes photos of a landmark. The photos are the same whatever is assumed of them in between.
#[derive(Clone)]
pub struct Photographer {
    landmark: Landmark,
    envelope: FlightEnvelope,
    ground: DayGround,
    random: ChaCha8Rng,
    /// Draws what the filter thinks.
    thoughts: ChaCha8Rng,
    taken: usize,
}

fn between(random: &mut ChaCha8Rng, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * random.random::<f64>()
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

impl Photographer {
    /// Of `landmark` of `map` on `days`; everything is drawn by `seed`.
    pub fn new(
        landmark: &Landmark,
        map: Arc<dyn Imagery>,
        days: &[Arc<dyn Imagery>],
        envelope: FlightEnvelope,
        seed: u64,
    ) -> Self {
        Self {
            landmark: landmark.clone(),
            envelope,
            ground: DayGround::new(map, days),
            random: ChaCha8Rng::seed_from_u64(seed),
            thoughts: ChaCha8Rng::seed_from_u64(seed ^ THOUGHTS),
            taken: 0,
        }
    }

    /// The envelope.
    pub fn envelope(&self) -> &FlightEnvelope {
        &self.envelope
    }

    /// Errors that the search must expect of a place on the ground, per axis, square metres.
    fn variance(&self, height: f64) -> f64 {
        let lever = height * self.envelope.sensors.roll.max(self.envelope.sensors.pitch);
        self.envelope.position.powi(2) + lever.powi(2)
    }

    /// Distance around a place within which it is searched for, metres.
    pub fn reach(&self) -> f64 {
        SEARCH_SIGMAS * self.variance(self.envelope.height[1]).sqrt()
    }

    /// Distance from the landmark from which on the search of neither reaches the other, metres.
    pub fn apart(&self) -> f64 {
        let bounds = self.landmark.bounds;
        2.0 * self.reach() + bounds.width().hypot(bounds.height())
    }

    /// Has the next photo be of the day whose turn it is for photo `number`.
    pub(super) fn turn_to(&mut self, number: usize) {
        self.taken = number;
    }

    /// The next photo of the landmark; days take turns. `None` if it does not fit into the picture.
    pub fn take(&mut self) -> Option<TrainingPhoto> {
        let bounds = self.landmark.bounds;
        self.take_of(bounds, true)
    }

    /// The next photo around another place, as large as the landmark.
    pub fn take_elsewhere(&mut self, place: GroundPoint) -> Option<TrainingPhoto> {
        let b = self.landmark.bounds;
        let there = GroundRect::centered(place, b.height(), b.width());
        self.take_of(there, false)
    }

    fn take_of(&mut self, around: GroundRect, present: bool) -> Option<TrainingPhoto> {
        for _ in 0..TRIES {
            if let Some(photo) = self.try_to_take(around, present) {
                self.taken += 1;
                return Some(photo);
            }
        }
        None
    }

    fn try_to_take(&mut self, around: GroundRect, present: bool) -> Option<TrainingPhoto> {
        let day = self.taken % self.ground.days();
        let height = between(&mut self.random, self.envelope.height);
        let heading = TAU * self.random.random::<f64>();
        let direction = TAU * self.random.random::<f64>();
        // Over the disk of tilts, more of which are small.
        let tilt = between(&mut self.random, [0.0, self.envelope.tilt]);
        let known_tilt = [tilt * direction.cos(), tilt * direction.sin()];
        let sensors = self.envelope.sensors;
        let attitude = Attitude {
            roll: known_tilt[0] + normal(&mut self.random) * sensors.roll,
            pitch: known_tilt[1] + normal(&mut self.random) * sensors.pitch,
            yaw: heading,
        };
        let (camera, ground_down) = (self.envelope.camera.clone(), self.envelope.ground_down);
        let (w, h) = (camera.width as f64, camera.height as f64);
        let wanted = Point2::new(
            w * self.random.random::<f64>(),
            h * self.random.random::<f64>(),
        );
        let over = |north: f64, east: f64| Pose {
            position_in_world: Point3::new(north, east, ground_down - height),
            attitude,
        };
        let seen = camera.ground_at(&over(0.0, 0.0), &wanted, ground_down)?;
        let middle = around.center();
        let pose = over(middle.north - seen.north, middle.east - seen.east);
        // All of the box must lie in the picture, however it is tilted.
        let mut half = 0.0_f64;
        for corner in around.corners() {
            let in_world = Point3::new(corner.north, corner.east, ground_down);
            let pixel = camera.project(&pose, &in_world)?;
            let inside = pixel.x > 2.0 && pixel.x < w - 2.0 && pixel.y > 2.0 && pixel.y < h - 2.0;
            if !inside {
                return None;
            }
            half = half
                .max((pixel.x - wanted.x).abs())
                .max((pixel.y - wanted.y).abs());
        }
        let reach = self.reach();
        let part = crop(
            &camera,
            &wanted,
            half + 1.5 * reach * camera.focal / height + 8.0,
        );
        let ground = self.ground.part(day, &around.grown(1.6 * reach));
        let faults = AerialCameraSettings {
            mount_vibration_sd: 0.0,
            blur_sigma: between(&mut self.random, self.envelope.blur),
            noise_sd: between(&mut self.random, self.envelope.noise),
            ..AerialCameraSettings::default()
        };
        let aerial = AerialCamera::new(part.clone(), faults);
        let frame = aerial.take(ground.as_ref(), &pose, ground_down, &mut self.random);
        Some(TrainingPhoto {
            camera: part,
            pose,
            luminance: Pyramid::new(frame.picture.to_gray(), PYRAMID_LEVELS),
            picture: frame.picture,
            day,
            height,
            known_tilt,
            around,
            present,
        })
    }

    /// Belief that the filter may have about a photo, drawn anew at each call.
    pub fn assume(&mut self, photo: &TrainingPhoto) -> Option<Assumed> {
        let position = self.envelope.position;
        let thoughts = &mut self.thoughts;
        let off = Vector3::new(
            normal(thoughts) * position,
            normal(thoughts) * position,
            normal(thoughts) * self.envelope.sensors.height,
        );
        let widest = self.envelope.heading_error;
        let heading_error = between(thoughts, [-widest, widest]);
        let pose = Pose {
            position_in_world: photo.pose.position_in_world + off,
            attitude: Attitude {
                roll: photo.known_tilt[0],
                pitch: photo.known_tilt[1],
                yaw: photo.pose.attitude.yaw + heading_error,
            },
        };
        let ground_down = self.envelope.ground_down;
        let appears = photo.appears(&pose, ground_down)?;
        let assumed_height = ground_down - pose.position_in_world.z;
        Some(Assumed {
            pose,
            heading_error,
            log_scale: (assumed_height / photo.height).ln(),
            appears,
            covariance: Matrix2::identity() * self.variance(photo.height),
        })
    }
}
