//! The pictures of a simulated flight, made when they are asked for.

use std::sync::Arc;

use nalgebra::Matrix3;

use super::scenario::FlightDay;
use super::scenery::{DEMO_SEED, Scenery};
use crate::camera::CameraModel;
use crate::flight::{Flight, FrameError, FrameSource};
use crate::frames::{GroundPoint, GroundRect, Pose};
use crate::imagery::{Imagery, Window};
use crate::raster::{Picture, encode_jpeg, warp_projective};

/// Quality of the camera's JPEG files.
const JPEG_QUALITY: u8 = 92;

/// A flight that did not happen, and its pictures.
#[derive(Clone)]
pub struct SimulatedFlight {
    /// What was measured, and the truth.
    pub flight: Flight,
    /// The pictures.
    pub frames: SimulatedFrames,
    /// The seed of gusts, sensors and pictures.
    pub seed: u64,
    /// The day on which the camera saw the ground.
    pub day: FlightDay,
}

/// Renders frame by frame; any order gives the same pictures.
#[derive(Clone)]
pub struct SimulatedFrames {
    imagery: Option<Arc<dyn Imagery>>,
    day: FlightDay,
    camera: CameraModel,
    ground_down: f64,
    poses: Vec<Option<Pose>>,
    names: Vec<String>,
}

impl SimulatedFrames {
    /// Pictures of the generated scenery on `day` from the true poses of `flight`.
    ///
    /// The scenery is laid out with the first picture.
    pub fn new(flight: &Flight, day: FlightDay) -> Self {
        let truth = flight.truth.as_ref().map_or(&[][..], |t| &t.frames);
        Self {
            imagery: None,
            day,
            camera: flight.camera.clone(),
            ground_down: flight.ground_down,
            poses: truth.iter().map(crate::flight::FrameTruth::pose).collect(),
            names: flight.frames.iter().map(|f| f.name.clone()).collect(),
        }
    }

    /// The same over other imagery, e.g. a cached one that is shared with others.
    #[must_use]
    pub fn over(mut self, imagery: Arc<dyn Imagery>) -> Self {
        self.imagery = Some(imagery);
        self
    }

    /// What the camera sees, laid out now if it was not yet.
    pub fn imagery(&mut self) -> Arc<dyn Imagery> {
        let day = self.day;
        Arc::clone(
            self.imagery
                .get_or_insert_with(|| Arc::new(Scenery::new(DEMO_SEED, day.day()))),
        )
    }
}

impl FrameSource for SimulatedFrames {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let pose = self
            .poses
            .get(index)
            .ok_or(FrameError::OutOfRange(index))?
            .ok_or_else(|| FrameError::Unreadable {
                name: self.names[index].clone(),
                cause: "the flight does not tell from where it was taken".to_owned(),
            })?;
        let imagery = self.imagery();
        Ok(plain_picture(
            imagery.as_ref(),
            &self.camera,
            &pose,
            self.ground_down,
        ))
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let picture = self.picture(index)?;
        encode_jpeg(&picture, JPEG_QUALITY).map_err(|e| FrameError::Unreadable {
            name: self.names[index].clone(),
            cause: e.to_string(),
        })
    }
}

/// The ground as an undistorted pinhole sees it.
///
/// A pixel's ray is Rᵀ K⁻¹ (x, y, 1) and meets the ground at the position plus height / ray.z times
/// the ray; the place in the window is affine in that, so that the whole is one projective matrix.
fn plain_picture(
    imagery: &dyn Imagery,
    camera: &CameraModel,
    pose: &Pose,
    ground_down: f64,
) -> Picture {
    let position = pose.position_in_world;
    let height = ground_down - position.z;
    let gsd = (0.8 * height / camera.focal).max(imagery.native_gsd());
    let footprint = GroundRect::around(camera.footprint(pose, ground_down)).unwrap_or_else(|| {
        GroundRect::centered(GroundPoint::new(position.x, position.y), 1.0, 1.0)
    });
    let window = Window::covering(&footprint.grown(2.0 * gsd), gsd);
    let ground = imagery.window(&window).map(|[r, g, b, _]| [r, g, b]);
    let ray_from_pixel = Matrix3::new(
        1.0 / camera.focal,
        0.0,
        -camera.principal.x / camera.focal,
        0.0,
        1.0 / camera.focal,
        -camera.principal.y / camera.focal,
        0.0,
        0.0,
        1.0,
    );
    let world_from_camera = camera.camera_from_world(pose).inverse();
    let place_from_ray = Matrix3::new(
        0.0,
        height / gsd,
        (position.y - window.west_edge) / gsd,
        -height / gsd,
        0.0,
        (window.north_edge - position.x) / gsd,
        0.0,
        0.0,
        1.0,
    );
    let place_from_pixel = place_from_ray * world_from_camera.matrix() * ray_from_pixel;
    warp_projective(
        &ground,
        &place_from_pixel,
        camera.width,
        camera.height,
        [0; 3],
    )
}

#[cfg(test)]
mod tests {
    use super::super::scenario::{Overrides, Scenario};
    use super::*;

    #[test]
    #[ignore = "writes pictures to be looked at"]
    fn write_some_pictures() {
        for scenario in [&Scenario::all()[0], &Scenario::all()[2]] {
            let mut flight = scenario.simulate(1, &Overrides::default());
            for index in [8, 40, 78, 132] {
                let bytes = flight.frames.encoded(index).unwrap();
                std::fs::write(format!("/tmp/{}-{index}.jpg", scenario.name), bytes).unwrap();
            }
        }
    }
}
