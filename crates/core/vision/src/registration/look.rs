//! A picture, its camera and the map on which it is laid.

use nalgebra::{Point2, Point3, Rotation3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use super::MapShape;
use crate::landmark::{GroundView, rectify_plane};
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::Pyramid;

/// A pose over a map that may be stretched. The position below is a place on the map; the height is
/// that above the real ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapPose {
    /// Pose of the body; north and east on the map.
    pub pose: Pose,
    /// Stretch of the map around the pose.
    pub shape: MapShape,
}

/// A picture and what is needed to lay it on the map.
#[derive(Clone, Copy)]
pub struct FrameLook<'a> {
    /// The camera, any turn of the stored picture included.
    pub camera: &'a CameraModel,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Luminance of the picture.
    pub luminance: &'a Pyramid,
    /// The map.
    pub map: &'a dyn Imagery,
}

/// Brings ground points of the map into camera coordinates.
struct CameraFromMap {
    rotation: Rotation3<f64>,
    below: Vector2<f64>,
    height: f64,
    ground_from_map: nalgebra::Matrix2<f64>,
}

impl CameraFromMap {
    fn new(look: &FrameLook<'_>, place: &MapPose) -> Self {
        let position = place.pose.position_in_world;
        Self {
            rotation: look.camera.camera_from_world(&place.pose),
            below: position.xy().coords,
            height: look.ground_down - position.z,
            ground_from_map: place.shape.ground_from_map(),
        }
    }

    fn of(&self, ground: GroundPoint) -> Vector3<f64> {
        let real = self.ground_from_map * (ground.to_vector() - self.below);
        self.rotation * Vector3::new(real.x, real.y, self.height)
    }
}

impl FrameLook<'_> {
    /// Pixel at which a place of the map appears.
    pub fn pixel(&self, place: &MapPose, ground: &GroundPoint) -> Option<Point2<f64>> {
        self.camera
            .pixel_from_camera(&CameraFromMap::new(self, place).of(*ground))
    }

    /// Place of the map that is seen at `pixel`.
    ///
    /// ```
    /// use nalgebra::{Point2, Point3};
    /// use pilotage_base::frames::{Attitude, GroundPoint, Pose};
    /// use pilotage_raster::{camera::CameraModel, imagery::Blank, raster::{Gray, Pyramid}};
    /// use pilotage_vision::registration::{FrameLook, MapPose, MapShape};
    ///
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians()); // focal length 320 pixels
    /// # let luminance = Pyramid::new(Gray::filled(640, 480, 0.0), 1);
    /// # let luminance = &luminance;
    /// let look = FrameLook { camera: &camera, ground_down: 0.0, luminance, map: &Blank };
    /// # let (position_in_world, attitude) = (Point3::new(300.0, 0.0, -160.0), Attitude::level(0.0));
    /// # let pose = Pose { position_in_world, attitude };
    /// // 160 m above (300, 0): 64 pixels above the middle lie 32 m north of it.
    /// let place = MapPose { pose, shape: MapShape::default() };
    /// let ground = look.ground(&place, &Point2::new(320.0, 176.0)).ok_or("above the horizon")?;
    /// assert!(ground.distance(&GroundPoint::new(332.0, 0.0)) < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn ground(&self, place: &MapPose, pixel: &Point2<f64>) -> Option<GroundPoint> {
        let mut at_origin = place.pose;
        at_origin.position_in_world = Point3::new(0.0, 0.0, place.pose.position_in_world.z);
        let real = self.camera.ground_at(&at_origin, pixel, self.ground_down)?;
        let on_map = place.shape.map_from_ground() * real.to_vector();
        Some(GroundPoint::from(
            on_map + place.pose.position_in_world.xy().coords,
        ))
    }

    /// Place of the map in the middle of the picture.
    pub fn centre(&self, place: &MapPose) -> Option<GroundPoint> {
        let middle = Point2::new(
            0.5 * self.camera.width as f64,
            0.5 * self.camera.height as f64,
        );
        self.ground(place, &middle)
    }

    /// The smallest rectangle of the map that holds what the picture shows.
    pub fn footprint(&self, place: &MapPose) -> Option<GroundRect> {
        let corners = self.camera.corners();
        let seen: Option<Vec<GroundPoint>> =
            corners.iter().map(|c| self.ground(place, c)).collect();
        GroundRect::around(seen?)
    }

    /// The picture laid on `window` of the map.
    pub fn rectified(&self, place: &MapPose, window: &Window) -> GroundView {
        let from_map = CameraFromMap::new(self, place);
        rectify_plane(self.camera, self.luminance, window, |g| from_map.of(g))
    }
}
