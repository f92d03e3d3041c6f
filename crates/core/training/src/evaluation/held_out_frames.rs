//! Frames of a flight in which a detector may be judged though people labelled others of them.

use nalgebra::{Point2, Point3};

use super::real_frames::known_pose;
use crate::labelled::learned_frames;
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_flight::Flight;
use pilotage_mission::mission::FrameLabels;
use pilotage_raster::camera::CameraModel;

/// Pixels along either side of a frame of which is asked whether another frame shows them.
const GRID: usize = 8;
/// Share of a frame's ground from which on it shows the same as another.
const MOSTLY: f64 = 0.5;

/// Frames that a detector has not learned from, and the number of those that are left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HeldOutFrames {
    /// Their indices, in the order of the flight.
    pub frames: Vec<usize>,
    /// Frames that it may have learned from.
    pub learned: usize,
    /// Frames more than half of whose ground is in one of those, by the poses from which they were taken.
    pub beside: usize,
}

impl HeldOutFrames {
    /// Frames of a flight for the judging of a landmark's detector, given the labels that it may have learned from.
    pub fn of(flight: &Flight, labels: &[FrameLabels], landmark: u32) -> Self {
        let learned = learned_frames(flight, labels, landmark);
        let shown: Vec<_> = learned
            .iter()
            .filter_map(|index| FrameGround::of(flight, *index))
            .collect();
        let mut held_out = Self {
            learned: learned.len(),
            ..Self::default()
        };
        for index in 0..flight.frames.len() {
            if learned.binary_search(&index).is_ok() {
                continue;
            }
            let own = (!shown.is_empty()).then(|| FrameGround::of(flight, index));
            let is_beside =
                |own: FrameGround| shown.iter().any(|other| own.share_in(other) > MOSTLY);
            if own.flatten().is_some_and(is_beside) {
                held_out.beside += 1;
            } else {
                held_out.frames.push(index);
            }
        }
        held_out
    }

    /// Number of frames that are left out, in words; `None` if none is.
    pub fn told(&self) -> Option<String> {
        let (learned, beside) = (self.learned, self.beside);
        (learned > 0).then(|| {
            format!(
                "left out of the real frames: {learned} that are labelled, {beside} that show mostly the same ground"
            )
        })
    }
}

/// Ground that a frame shows.
struct FrameGround {
    camera: CameraModel,
    pose: Pose,
    /// Places of a grid of pixels, without those above the horizon.
    places: Vec<Point3<f64>>,
    middle: GroundPoint,
    /// Largest distance of one of them from their middle, metres.
    radius: f64,
}

impl FrameGround {
    fn of(flight: &Flight, index: usize) -> Option<Self> {
        let pose = known_pose(flight, index)?.0;
        let camera = flight.camera_of_frame(index);
        let part = |cell: usize| (cell as f64 + 0.5) / GRID as f64;
        let (width, height) = (camera.width as f64, camera.height as f64);
        let cells = (0..GRID * GRID).map(|cell| (part(cell % GRID), part(cell / GRID)));
        let pixels = cells.map(|(x, y)| Point2::new(x * width, y * height));
        let down = flight.ground_down;
        let posed = camera.posed(&pose);
        let ground: Vec<_> = pixels
            .filter_map(|pixel| posed.ground_at(&pixel, down))
            .collect();
        let count = ground.len().max(1) as f64;
        let middle = GroundPoint::new(
            ground.iter().map(|place| place.north).sum::<f64>() / count,
            ground.iter().map(|place| place.east).sum::<f64>() / count,
        );
        let distances = ground.iter().map(|place| place.distance(&middle));
        Some(Self {
            radius: distances.fold(0.0, f64::max),
            places: ground
                .iter()
                .map(|place| Point3::new(place.north, place.east, down))
                .collect(),
            middle,
            camera,
            pose,
        })
    }

    /// Share of its pixels whose ground is in another frame.
    fn share_in(&self, other: &Self) -> f64 {
        if self.middle.distance(&other.middle) > self.radius + other.radius {
            return 0.0;
        }
        let (width, height) = (other.camera.width as f64, other.camera.height as f64);
        let posed = other.camera.posed(&other.pose);
        let is_in = |place: &&Point3<f64>| {
            let pixel = posed.project(place);
            pixel.is_some_and(|p| p.x > 0.0 && p.x < width && p.y > 0.0 && p.y < height)
        };
        self.places.iter().filter(is_in).count() as f64 / (GRID * GRID) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::Attitude;
    use pilotage_flight::{Frame, FrameTruth, StartFix, Truth};

    /// Ten frames from 100 m straight down, each 40 m further north, of which each shows 100 m by 100 m.
    fn ten_frames() -> Flight {
        let frame = |number: usize| Frame {
            time: number as f64,
            name: format!("{number}.jpg"),
            stored_turn: 0.0,
        };
        let truth = |number: usize| FrameTruth {
            position: Point3::new(40.0 * number as f64, 0.0, -100.0),
            camera_attitude: Some(Attitude::level(0.0)),
        };
        Flight {
            name: "Field".to_owned(),
            frame_on_globe: None,
            camera: CameraModel::of_focal(400, 400, 400.0),
            ground_down: 0.0,
            channels: Vec::new(),
            frames: (0..10).map(frame).collect(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::default(),
                standard_deviation: 3.0,
            },
            truth: Some(Truth {
                states: Vec::new(),
                frames: (0..10).map(truth).collect(),
            }),
        }
    }

    fn absent_in(numbers: impl Iterator<Item = usize>) -> Vec<FrameLabels> {
        let labels = numbers.map(|number| FrameLabels {
            frame: format!("{number}.jpg"),
            size: (400, 400),
            absent: vec![7],
            ..FrameLabels::default()
        });
        labels.collect()
    }

    #[test]
    fn labelled_frames_and_those_that_show_mostly_their_ground_are_left_out() {
        let flight = ten_frames();
        // Of the next frame 60 m of 100 m are in a labelled one, of the one after 20 m.
        let held_out = HeldOutFrames::of(&flight, &absent_in(0..5), 7);
        assert_eq!((held_out.learned, held_out.beside), (5, 1));
        assert_eq!(held_out.frames, [6, 7, 8, 9]);
        assert_eq!(
            held_out.told().unwrap(),
            "left out of the real frames: 5 that are labelled, 1 that show mostly the same ground"
        );
        let of_others = [
            HeldOutFrames::of(&flight, &absent_in(0..5), 8),
            HeldOutFrames::of(&flight, &[], 7),
        ];
        for all in of_others {
            assert_eq!((all.frames.len(), all.told()), (10, None));
        }
        let mut labels = absent_in(0..5);
        for said in &mut labels {
            said.flight = "another".to_owned();
        }
        assert_eq!(HeldOutFrames::of(&flight, &labels, 7).frames.len(), 10);
    }
}
