//! Frames of real flights in which people showed where a landmark is, to learn from.

use nalgebra::{Point2, Point3};

use super::photo::TrainingPhoto;
use pilotage_base::frames::{GroundRect, Pose};
use pilotage_flight::{ChannelName, Flight, FrameError};
use pilotage_mission::mission::{FrameLabels, LabelBox};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::{PYRAMID_LEVELS, Picture, Pyramid};
use pilotage_vision::landmark::Landmark;

/// Number of the first day of real frames; those of drawn days are below.
const FIRST_DAY: usize = 1000;
/// Parts of the labelled frames of a flight of which the samples of each go together: as many as there are groups of which a
/// stage judges one and fits the others.
const STRETCHES: usize = 5;

/// The frames of `flight` in which `landmark` is labelled, and those labelled as without it, as photos to
/// learn from; `picture` gives the frame with a number. Labels of other flights are left out, as are boxes
/// that are cut or hard to see.
///
/// A label says where in the picture the landmark is. Turn, tilt and size are those of the measured
/// heading, attitude and height, and as uncertain as they are: where the aircraft was does not matter.
///
/// # Errors
/// The first frame that cannot be read.
pub fn labelled_photos(
    flight: &Flight,
    labels: &[FrameLabels],
    landmark: &Landmark,
    mut picture: impl FnMut(usize) -> Result<Picture, FrameError>,
) -> Result<Vec<TrainingPhoto>, FrameError> {
    let mut photos = Vec::new();
    let identity = flight.identity();
    for (index, frame) in flight.frames.iter().enumerate() {
        let Some(said) = said_of(labels, &identity, &frame.name) else {
            continue;
        };
        let camera = flight.camera_of_frame(index);
        let label = clear_box(said, landmark.id);
        let is_absent = said.lacks(landmark.id);
        // Labels may be of a copy of the picture, of another size and shape.
        let scale = [
            camera.width as f64 / f64::from(said.size.0.max(1)),
            camera.height as f64 / f64::from(said.size.1.max(1)),
        ];
        let middle = match label {
            Some(label) => Point2::new(
                0.5 * scale[0] * (label.min[0] + label.max[0]),
                0.5 * scale[1] * (label.min[1] + label.max[1]),
            ),
            None if is_absent => camera.principal,
            None => continue,
        };
        let Some(pose) = pose(flight, frame.time) else {
            continue;
        };
        let size = (landmark.bounds.height(), landmark.bounds.width());
        let Some(place) = camera.ground_at(&pose, &middle, flight.ground_down) else {
            continue;
        };
        photos.push(photo(
            camera,
            pose,
            picture(index)?,
            FIRST_DAY + index,
            GroundRect::centered(place, size.0, size.1),
            label.is_some(),
            flight.ground_down,
        ));
    }
    Ok(photos)
}

/// The photos in the order of their frames, those of a stretch of the flight as of one day: neighbours show nearly the same, so
/// that votes fitted to one of them would be judged by the other. The last of them are those that are judged.
pub(crate) fn in_stretches(mut photos: Vec<TrainingPhoto>) -> Vec<TrainingPhoto> {
    photos.sort_by_key(|photo| photo.day);
    let count = photos.len();
    for (number, photo) in photos.iter_mut().enumerate() {
        photo.day = FIRST_DAY + number * STRETCHES / count;
    }
    photos
}

/// Labels of a picture of a flight.
fn said_of<'a>(labels: &'a [FrameLabels], flight: &str, frame: &str) -> Option<&'a FrameLabels> {
    labels.get(FrameLabels::place_among(labels, flight, frame)?)
}

/// The box of a landmark, if it is neither cut nor hard to see.
fn clear_box(said: &FrameLabels, landmark: u32) -> Option<&LabelBox> {
    let label = said.of(landmark);
    label.filter(|b| !b.truncated && !b.difficult)
}

/// Indices of the frames of a flight from which a landmark is learned where these labels are learned from.
pub(crate) fn learned_frames(flight: &Flight, labels: &[FrameLabels], landmark: u32) -> Vec<usize> {
    let identity = flight.identity();
    let tells = |said: &FrameLabels| clear_box(said, landmark).is_some() || said.lacks(landmark);
    let frames = flight.frames.iter().enumerate();
    let frames =
        frames.filter(|(_, frame)| said_of(labels, &identity, &frame.name).is_some_and(tells));
    frames.map(|(index, _)| index).collect()
}

/// Pose of the camera but for its place: over the origin, as high as measured.
fn pose(flight: &Flight, time: f64) -> Option<Pose> {
    let height = flight.value(ChannelName::HeightAboveGround, time)?;
    Some(Pose {
        position_in_world: Point3::new(0.0, 0.0, flight.ground_down - height),
        attitude: flight.attitude(time)?,
    })
}

fn photo(
    camera: CameraModel,
    pose: Pose,
    picture: Picture,
    day: usize,
    around: GroundRect,
    present: bool,
    ground_down: f64,
) -> TrainingPhoto {
    TrainingPhoto {
        camera,
        pose,
        luminance: Pyramid::new(picture.to_gray(), PYRAMID_LEVELS),
        picture,
        day,
        height: ground_down - pose.position_in_world.z,
        known_tilt: [pose.attitude.roll, pose.attitude.pitch],
        around,
        present,
    }
}
