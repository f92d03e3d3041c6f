//! Expected appearance of landmarks from a state, in pixels about the place where they are looked at.
//!
//! Whoever assumes a wrong position sees a landmark on flat ground displaced by as much, however the
//! camera is tilted: on the ground the expectation is linear in the position. In the picture it is not,
//! and beyond the horizon of a banked camera it does not exist, while a filter that is lost has sigma
//! points everywhere. So it is taken on the ground and carried into pixels by the slope at one place of
//! the picture.

use nalgebra::{DVector, Matrix2, Matrix4, Point2, Point3, Vector2};

use super::Control;
use pilotage_base::frames::{Attitude, GroundPoint, Pose};
use pilotage_flight::Flight;
use pilotage_raster::camera::CameraModel;
use pilotage_vision::geometry::{COMPONENTS, ground_jacobian, place_covariance, pose_jacobian};

/// A place in the picture, and how the ground around it maps into the picture.
#[derive(Clone, Copy, Debug)]
pub struct Anchor {
    /// The place.
    pub pixel: Point2<f64>,
    /// The ground that is seen there under the assumed pose.
    pub ground: GroundPoint,
    /// Change of the pixel with the ground point (north, east), pixels per metre.
    pub to_pixel: Matrix2<f64>,
}

impl Anchor {
    /// At `pixel`; `None` where the ray does not reach the ground.
    pub fn at(
        camera: &CameraModel,
        pose: &Pose,
        pixel: &Point2<f64>,
        ground_down: f64,
    ) -> Option<Self> {
        Some(Self {
            pixel: *pixel,
            ground: camera.ground_at(pose, pixel, ground_down)?,
            to_pixel: ground_jacobian(camera, pose, pixel, ground_down)?.try_inverse()?,
        })
    }

    /// At the place of the picture at which `point` is expected, or that is nearest to it; in the middle
    /// if the point does not appear before the lens at all.
    pub fn of(camera: &CameraModel, pose: &Pose, point: &Point3<f64>) -> Option<Self> {
        let (w, h) = (camera.width as f64, camera.height as f64);
        let nearest = camera
            .project(pose, point)
            .map(|p| Point2::new(p.x.clamp(0.0, w), p.y.clamp(0.0, h)));
        nearest
            .and_then(|pixel| Self::at(camera, pose, &pixel, point.z))
            .or_else(|| Self::at(camera, pose, &camera.principal, point.z))
    }

    /// The pixel of a ground point, by the slope here.
    pub fn pixel_of(&self, place: &GroundPoint) -> Point2<f64> {
        self.pixel + self.to_pixel * (place.to_vector() - self.ground.to_vector())
    }

    /// Covariance of what is measured here (pixel x, pixel y, rotation, log scale) that comes from the ground's
    /// being so many metres per axis (a standard deviation) beside where the map has it.
    pub fn in_pixels(&self, deviation: f64) -> Matrix4<f64> {
        let mut covariance = Matrix4::zeros();
        let place = place_covariance(&self.to_pixel, deviation);
        covariance.fixed_view_mut::<2, 2>(0, 0).copy_from(&place);
        covariance
    }

    /// `pose` moved so that `point` appears here.
    pub fn seen_from(&self, pose: &Pose, point: &Point3<f64>) -> Pose {
        let mut moved = *pose;
        moved.position_in_world.x += point.x - self.ground.north;
        moved.position_in_world.y += point.y - self.ground.east;
        moved
    }

    /// Change of what is measured of `point`, seen here, with roll, pitch, yaw and height (see
    /// [`pose_jacobian`]).
    pub fn pose_jacobian(
        &self,
        camera: &CameraModel,
        pose: &Pose,
        point: &Point3<f64>,
    ) -> Option<Matrix4<f64>> {
        pose_jacobian(camera, &self.seen_from(pose, point), point)
    }
}

/// Inputs of the prediction of how landmarks appear from a state.
#[derive(Clone, Copy)]
pub struct AppearanceModel<'a> {
    pub camera: &'a CameraModel,
    /// As measured; the heading's bias is still in it.
    pub attitude: Attitude,
    /// Down coordinate of the camera in the world, metres.
    pub camera_down: f64,
    pub ground_down: f64,
}

impl<'a> AppearanceModel<'a> {
    /// When the instruments of `flight` say `control`.
    pub fn of(flight: &Flight, camera: &'a CameraModel, control: &Control) -> Self {
        Self {
            camera,
            attitude: Attitude {
                roll: control.roll,
                pitch: control.pitch,
                yaw: control.heading,
            },
            camera_down: flight.ground_down - control.height,
            ground_down: flight.ground_down,
        }
    }

    /// The pose for a state.
    pub fn pose(&self, position: GroundPoint, heading_bias: f64) -> Pose {
        Pose {
            position_in_world: Point3::new(position.north, position.east, self.camera_down),
            attitude: Attitude {
                yaw: self.attitude.yaw - heading_bias,
                ..self.attitude
            },
        }
    }
}

/// Appearances (pixel x, pixel y, rotation, log scale) of landmarks at `places` for a state, stacked, when the instruments
/// measure `attitude`, to somebody who assumes `assumed`, each in pixels about its anchor. They exist for every state.
pub fn appearances(
    attitude: &Attitude,
    places: &[(GroundPoint, Anchor)],
    assumed: &Pose,
    position: GroundPoint,
    heading_bias: f64,
) -> DVector<f64> {
    // A camera turned less than assumed sees the ground turned on about the place below it.
    let turned = assumed.attitude.yaw - (attitude.yaw - heading_bias);
    let (sin, cos) = turned.sin_cos();
    let below = assumed.position_in_world.xy().coords;
    let mut stacked = DVector::zeros(COMPONENTS * places.len());
    for (i, (place, anchor)) in places.iter().enumerate() {
        let arm = place.to_vector() - position.to_vector();
        let turned_arm = Vector2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
        let pixel = anchor.pixel_of(&(below + turned_arm).into());
        let scale = 0.0;
        for (row, value) in [pixel.x, pixel.y, turned, scale].into_iter().enumerate() {
            stacked[COMPONENTS * i + row] = value;
        }
    }
    stacked
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::GroundRect;
    use pilotage_vision::geometry::appearance;
    use pilotage_vision::landmark::Landmark;

    fn model(camera: &CameraModel, roll: f64) -> AppearanceModel<'_> {
        AppearanceModel {
            camera,
            attitude: Attitude {
                roll,
                pitch: -0.06,
                yaw: 0.8,
            },
            camera_down: -120.0,
            ground_down: 0.0,
        }
    }

    fn landmark(north: f64, east: f64) -> Landmark {
        let bounds = GroundRect::centered(GroundPoint::new(north, east), 30.0, 30.0);
        Landmark::new(1, "barn", bounds)
    }

    #[test]
    fn a_landmark_appears_where_the_cameras_of_both_poses_say() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let model = model(&camera, 0.2);
        let assumed = model.pose(GroundPoint::new(3.0, -4.0), 0.01);
        let landmark = landmark(20.0, -15.0);
        let (at, bias) = (GroundPoint::new(-6.0, 9.0), 0.05);
        let point = landmark.reference_in_world(0.0);
        let seen = appearance(&camera, &model.pose(at, bias), &assumed, &point).unwrap();
        // About the very pixel the slope does not matter.
        let anchor = Anchor::at(&camera, &assumed, &Point2::new(seen.x, seen.y), 0.0).unwrap();
        let places = [(landmark.reference, anchor)];
        let said = appearances(&model.attitude, &places, &assumed, at, bias);
        let off = (said.fixed_rows::<COMPONENTS>(0) - seen).norm();
        assert!(off < 1e-6, "{said} {seen}");
    }

    #[test]
    fn an_error_of_the_map_is_as_many_pixels_as_the_ground_is_large() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let pose = model(&camera, 0.0).pose(GroundPoint::default(), 0.0);
        let level = Pose {
            attitude: Attitude::level(0.8),
            ..pose
        };
        let anchor = Anchor::at(&camera, &level, &camera.principal, 0.0).unwrap();
        let covariance = anchor.in_pixels(3.0);
        let expected = (3.0 * camera.focal / 120.0).powi(2);
        for axis in [0, 1] {
            assert!((covariance[(axis, axis)] / expected - 1.0).abs() < 1e-9);
        }
        assert!(covariance[(0, 1)].abs() < 1e-9 && covariance[(2, 2)] == 0.0);
    }

    #[test]
    fn a_landmark_behind_a_banked_camera_has_a_place_in_the_picture() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let model = model(&camera, 0.5);
        let assumed = model.pose(GroundPoint::default(), 0.0);
        let mut behind = 0;
        for (north, east) in [(-400.0, 400.0), (400.0, -400.0), (400.0, 400.0), (5.0, 9.0)] {
            let point = landmark(north, east).reference_in_world(0.0);
            let anchor = Anchor::of(&camera, &assumed, &point).unwrap();
            assert!(camera.in_picture(&anchor.pixel, -1e-9), "{anchor:?}");
            let pose = anchor.seen_from(&assumed, &point);
            let seen = camera.project(&pose, &point).unwrap();
            assert!((seen - anchor.pixel).norm() < 1e-6, "{seen} {anchor:?}");
            behind += usize::from(camera.project(&assumed, &point).is_none());
        }
        assert!(behind > 0);
    }
}
