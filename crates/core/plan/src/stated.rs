//! Flights without pictures: landmarks are found as often and as well as it is stated of them.
//!
//! What a prediction says of detections is taken for granted, and all the rest of the navigation is as
//! in any flight: thousands of flights in the time of one with pictures.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{Point2, Vector4};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::PlannedLandmark;
use pilotage_base::frames::Pose;
use pilotage_flight::{Flight, FrameError, FrameSource, FrameTruth};
use pilotage_raster::raster::Picture;
use pilotage_vision::geometry::appearance;
use pilotage_vision::landmark::{Detection, Detector, FrameView, Refusal, SearchRequest, Sighting};

/// A seed of one flight is not that of another use of it.
const SALT: u64 = 0x4d;

/// Finds landmarks as stated: on days on which they can be recognised, in as many frames, with errors of
/// the stated covariance.
pub struct StatedDetector {
    /// By the landmark's id: what is stated, and whether it can be recognised on the day.
    planned: BTreeMap<u32, (PlannedLandmark, f64)>,
    taken_from: Arc<Mutex<Option<Pose>>>,
    random: ChaCha8Rng,
}

/// Empty pictures that tell the detector from where they were taken.
pub struct StatedFrames {
    poses: Vec<Option<Pose>>,
    now: Arc<Mutex<Option<Pose>>>,
    asked: usize,
}

impl StatedFrames {
    /// Number of pictures that were asked for.
    pub fn asked(&self) -> usize {
        self.asked
    }
}

/// A detector and frames for a flight with truth, whose day and misses are drawn by `seed`; `None`
/// without the truth.
pub fn as_stated(
    flight: &Flight,
    landmarks: &[PlannedLandmark],
    seed: u64,
) -> Option<(StatedDetector, StatedFrames)> {
    let truth = flight.truth.as_ref()?;
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ SALT);
    let planned = landmarks
        .iter()
        .map(|l| (l.landmark.id, (l.clone(), random.random())));
    let planned = planned.collect();
    let now = Arc::new(Mutex::new(None));
    let frames = StatedFrames {
        poses: truth.frames.iter().map(FrameTruth::pose).collect(),
        now: Arc::clone(&now),
        asked: 0,
    };
    let detector = StatedDetector {
        planned,
        taken_from: now,
        random,
    };
    Some((detector, frames))
}

impl StatedDetector {
    fn sight(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Option<Detection> {
        let landmark = request.landmark;
        let chance: f64 = self.random.random();
        let pose = (*self
            .taken_from
            .lock()
            .unwrap_or_else(PoisonError::into_inner))?;
        let (planned, day) = self.planned.get(&landmark.id)?;
        let height = view.ground_down - pose.position_in_world.z;
        let expected = planned.detection.at(height)?;
        let bounds = &landmark.bounds;
        let whole = view.camera.holds(&pose, bounds, view.ground_down, 0.0);
        if !whole || *day >= expected.recognised || chance >= expected.per_frame {
            return None;
        }
        let point = landmark.reference_in_world(view.ground_down);
        let seen = appearance(view.camera, &pose, &view.pose, &point)?;
        let pixel = Point2::new(seen.x, seen.y);
        let ground = view
            .camera
            .ground_at(&view.pose, &pixel, view.ground_down)?;
        let unit = Vector4::from_fn(|_, _| StandardNormal.sample(&mut self.random));
        let error = expected.covariance.cholesky()?.l() * unit;
        Some(Detection {
            ground: (ground.to_vector() + error.xy()).into(),
            covariance: expected.covariance,
            score: 0.9,
            second_score: 0.1,
            probability: None,
            rotation: seen[2] + error[2],
            scale: (seen[3] + error[3]).exp(),
        })
    }
}

impl Detector for StatedDetector {
    fn detect(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting {
        self.sight(view, request)
            .map_or(Sighting::Refused(Refusal::LowScore, None), Sighting::Found)
    }
}

impl FrameSource for StatedFrames {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let pose = self.poses.get(index).copied().flatten();
        *self.now.lock().unwrap_or_else(PoisonError::into_inner) = pose;
        self.asked += 1;
        Ok(Picture::filled(8, 8, [0; 3]))
    }

    fn encoded(&mut self, _: usize) -> Result<Vec<u8>, FrameError> {
        Ok(Vec::new())
    }
}
