//! Real frames, whose flight is known, as looks of an evaluation.

use std::f64::consts::TAU;

use nalgebra::{Point3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::{EvaluatedLook, EvaluatedMark};
use crate::FlightEnvelope;
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_flight::Flight;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::{PYRAMID_LEVELS, Picture, Pyramid};
use pilotage_vision::landmark::trained::{Mark, TrainedDetector, search};
use pilotage_vision::landmark::{FrameView, Landmark, tolerance};

/// Tries to find a place in the picture that is far enough from the landmark.
const TRIES: usize = 50;

/// Looks for a landmark in the frames of a flight, from poses as wrong as the filter's may be.
pub struct FrameJudge<'a> {
    /// The flight, with its truth.
    pub flight: &'a Flight,
    /// Envelope that says how wrong poses are.
    pub envelope: &'a FlightEnvelope,
    /// Number of the flight's day among those of the evaluation.
    pub day: usize,
    /// Draws errors and places.
    pub seed: u64,
}

/// A frame of which the pose is known.
struct KnownFrame {
    pose: Pose,
    /// Whether its attitude is the true one, and not only measured.
    is_true: bool,
    camera: CameraModel,
    luminance: Pyramid,
}

impl FrameJudge<'_> {
    /// A look for the landmark if the frame holds it whole, and one where it is not, if the frame has
    /// room. Nothing where the truth of the frame is not known.
    ///
    /// Where the true attitude of a frame is only measured, a mark is right within three standard deviations of that, and
    /// offsets hold its error, too.
    pub fn looks(
        &self,
        landmark: &Landmark,
        trained: &TrainedDetector,
        index: usize,
        picture: &Picture,
    ) -> Vec<EvaluatedLook> {
        let Some((pose, is_true)) = known_pose(self.flight, index) else {
            return Vec::new();
        };
        let frame = KnownFrame {
            pose,
            is_true,
            camera: self.flight.camera_of_frame(index),
            luminance: Pyramid::new(picture.to_gray(), PYRAMID_LEVELS),
        };
        let mut random = ChaCha8Rng::seed_from_u64(self.seed ^ (index as u64) << 16);
        let mut looks = Vec::new();
        let whole = self.sees(&landmark.bounds, &pose, index);
        if whole {
            let bounds = landmark.bounds;
            looks.extend(self.look(trained, &frame, &bounds, true, &mut random));
        }
        if let Some(other) = self.elsewhere(landmark, &pose, index, &mut random) {
            looks.extend(self.look(trained, &frame, &other, false, &mut random));
        }
        looks
    }

    fn sees(&self, bounds: &GroundRect, pose: &Pose, index: usize) -> bool {
        let camera = self.flight.camera_of_frame(index);
        let (w, h) = (camera.width as f64, camera.height as f64);
        bounds.corners().iter().all(|corner| {
            let in_world = Point3::new(corner.north, corner.east, self.flight.ground_down);
            camera
                .project(pose, &in_world)
                .is_some_and(|pixel| pixel.x > 0.0 && pixel.x < w && pixel.y > 0.0 && pixel.y < h)
        })
    }

    fn height(&self, pose: &Pose) -> f64 {
        self.flight.ground_down - pose.position_in_world.z
    }

    /// Standard deviation of a place on the ground by the errors of roll and pitch, metres.
    fn lever(&self, pose: &Pose) -> f64 {
        let sensors = &self.envelope.sensors;
        self.height(pose) * sensors.roll.max(sensors.pitch)
    }

    /// Distance from where the landmark appears within which a mark is right, metres.
    fn tolerance(&self, frame: &KnownFrame) -> f64 {
        let measured = if frame.is_true {
            0.0
        } else {
            3.0 * self.lever(&frame.pose)
        };
        tolerance(self.height(&frame.pose) / frame.camera.focal).max(measured)
    }

    /// Distance around a place within which it is searched for, metres.
    fn reach(&self, pose: &Pose) -> f64 {
        3.5 * self.envelope.position.hypot(self.lever(pose))
    }

    /// A box as large as the landmark's that the frame holds whole, out of reach of the landmark.
    fn elsewhere(
        &self,
        landmark: &Landmark,
        pose: &Pose,
        index: usize,
        random: &mut ChaCha8Rng,
    ) -> Option<GroundRect> {
        let bounds = landmark.bounds;
        let near = 2.0 * self.reach(pose) + bounds.width().hypot(bounds.height());
        let below = GroundPoint::new(pose.position_in_world.x, pose.position_in_world.y);
        (0..TRIES).find_map(|_| {
            let distance = 1.5 * self.height(pose) * random.random::<f64>();
            let (sin, cos) = (TAU * random.random::<f64>()).sin_cos();
            let place = GroundPoint::new(below.north + distance * cos, below.east + distance * sin);
            let there = GroundRect::centered(place, bounds.height(), bounds.width());
            let apart = place.distance(&bounds.center()) > near;
            (apart && self.sees(&there, pose, index)).then_some(there)
        })
    }

    fn look(
        &self,
        trained: &TrainedDetector,
        frame: &KnownFrame,
        around: &GroundRect,
        present: bool,
        random: &mut ChaCha8Rng,
    ) -> Option<EvaluatedLook> {
        let (camera, pose) = (&frame.camera, &frame.pose);
        let ground_down = self.flight.ground_down;
        let mut normal = |sd: f64| sd * random.sample::<f64, _>(StandardNormal);
        let position = self.envelope.position;
        let off = Vector3::new(normal(position), normal(position), 0.0);
        let heading_error = self.envelope.heading_error * (2.0 * random.random::<f64>() - 1.0);
        let mut assumed = *pose;
        assumed.position_in_world += off;
        assumed.attitude.yaw += heading_error;
        let center = around.center();
        let in_world = Point3::new(center.north, center.east, ground_down);
        let appears = camera.ground_at(&assumed, &camera.project(pose, &in_world)?, ground_down)?;
        let view = FrameView {
            camera,
            pose: assumed,
            ground_down,
            luminance: &frame.luminance,
        };
        let reach = self.reach(pose);
        let found = search(
            &trained.cascade,
            &trained.window,
            &view,
            center,
            (reach, reach),
        );
        let near = present.then(|| self.tolerance(frame));
        let marks = found.unwrap_or_default();
        let mark = |m: &Mark| EvaluatedMark::of(m, &appears, near);
        Some(EvaluatedLook {
            day: self.day,
            height: self.height(pose),
            tilt: pose.attitude.roll.hypot(pose.attitude.pitch),
            heading_error,
            log_scale: 0.0,
            real: true,
            present,
            marks: marks.iter().map(mark).collect(),
        })
    }
}

/// Pose of the camera of a frame of a flight, and whether its attitude is the true one; else that is as it was measured.
pub(super) fn known_pose(flight: &Flight, index: usize) -> Option<(Pose, bool)> {
    let truth = flight.truth.as_ref()?;
    let of_frame = truth.frames.get(index);
    if let Some(pose) = of_frame.and_then(pilotage_flight::FrameTruth::pose) {
        return Some((pose, true));
    }
    let time = flight.frames.get(index)?.time;
    let pose = Pose {
        position_in_world: of_frame
            .map(|frame| frame.position)
            .or_else(|| truth.position(time))?,
        attitude: flight.attitude(time)?,
    };
    Some((pose, false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_simulate::simulate::{Overrides, Scenario};

    #[test]
    fn a_landmark_under_the_camera_is_whole_in_the_frame_and_other_places_are_out_of_its_reach() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        let flight = scenario.simulate(3, &Overrides::default()).flight;
        let sensors = mission.navigator.sensors;
        let envelope = FlightEnvelope::around(&flight.camera, scenario.height, sensors);
        let judge = FrameJudge {
            flight: &flight,
            envelope: &envelope,
            day: 0,
            seed: 1,
        };
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let (mut whole, mut elsewhere) = (0, 0);
        for index in 0..flight.frames.len() {
            let (pose, _) = known_pose(&flight, index).unwrap();
            let truth = flight.truth.as_ref().unwrap().frames[index];
            assert_eq!(Some(pose), truth.pose());
            for landmark in &mission.landmarks {
                let seen = judge.sees(&landmark.bounds, &pose, index);
                let beside = landmark.bounds.center().distance(&GroundPoint::new(
                    pose.position_in_world.x,
                    pose.position_in_world.y,
                ));
                assert!(!seen || beside < 2.0 * scenario.height);
                whole += usize::from(seen);
            }
            let landmark = &mission.landmarks[0];
            if let Some(place) = judge.elsewhere(landmark, &pose, index, &mut random) {
                let apart = place.center().distance(&landmark.bounds.center());
                assert!(apart > 2.0 * judge.reach(&pose));
                assert!((place.width() - landmark.bounds.width()).abs() < 1e-9);
                assert!(judge.sees(&place, &pose, index));
                elsewhere += 1;
            }
        }
        assert!(whole > 20 && elsewhere > 20, "{whole} {elsewhere}");
    }

    #[test]
    fn marks_are_as_near_as_in_photos_but_where_the_attitude_is_only_measured() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mut flight = scenario.simulate(3, &Overrides::default()).flight;
        let sensors = scenario.mission().navigator.sensors;
        let envelope = FlightEnvelope::around(&flight.camera, scenario.height, sensors);
        let near = |flight: &Flight| {
            let judge = FrameJudge {
                flight,
                envelope: &envelope,
                day: 0,
                seed: 1,
            };
            let (pose, is_true) = known_pose(flight, 5).unwrap();
            let frame = KnownFrame {
                pose,
                is_true,
                camera: flight.camera.clone(),
                luminance: Pyramid::new(Picture::from_fn(4, 4, |_, _| [0; 3]).to_gray(), 1),
            };
            (judge.tolerance(&frame), judge.height(&pose))
        };
        // From 400 ft two metres, as in photos: a mark 4 m beside the landmark is something else.
        let (stated, _) = near(&flight);
        assert_eq!(stated, 2.0);
        for frame in &mut flight.truth.as_mut().unwrap().frames {
            frame.camera_attitude = None;
        }
        let (measured, height) = near(&flight);
        assert!((measured - 3.0 * height * sensors.roll.max(sensors.pitch)).abs() < 1e-9);
        assert!(measured > 6.0, "{measured}");
    }

    #[test]
    fn without_a_truth_there_is_nothing_to_judge() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mut flight = scenario.simulate(3, &Overrides::default()).flight;
        flight.truth = None;
        assert!(known_pose(&flight, 0).is_none());
    }
}
