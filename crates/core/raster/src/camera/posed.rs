//! A camera at one pose: what depends on the pose alone is computed once, for many points and pixels.

use nalgebra::{Point2, Point3, Rotation3, Vector3};

use super::CameraModel;
use pilotage_base::frames::{GroundPoint, Pose};

/// Camera at one pose.
#[derive(Clone, Copy, Debug)]
pub struct PosedCamera<'a> {
    camera: &'a CameraModel,
    camera_from_world: Rotation3<f64>,
    position_in_world: Point3<f64>,
}

impl CameraModel {
    /// The camera of a vehicle at `pose`.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{Attitude, Pose};
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians()); // focal length 320 pixels
    /// let (position_in_world, attitude) = (Point3::new(0.0, 0.0, -100.0), Attitude::level(0.0));
    /// let posed = camera.posed(&Pose { position_in_world, attitude });
    /// let pixels: Option<Vec<_>> = [0.0, 10.0].map(|n| posed.project(&Point3::new(n, 0.0, 0.0))).into_iter().collect();
    /// let pixels = pixels.ok_or("behind the lens")?;
    /// assert!((pixels[0].y - 240.0).abs() < 1e-9 && (pixels[1].y - 208.0).abs() < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn posed(&self, pose: &Pose) -> PosedCamera<'_> {
        PosedCamera {
            camera: self,
            camera_from_world: self.camera_from_world(pose),
            position_in_world: pose.position_in_world,
        }
    }
}

impl PosedCamera<'_> {
    /// Pixel at which a point appears (see [`CameraModel::project`]).
    pub fn project(&self, point_in_world: &Point3<f64>) -> Option<Point2<f64>> {
        let p = self.camera_from_world * (point_in_world - self.position_in_world);
        self.camera.pixel_from_camera(&p)
    }

    /// Centre of the lens in the world, metres.
    pub fn lens_in_world(&self) -> Point3<f64> {
        let axis = self.camera_from_world.inverse() * Vector3::z();
        self.position_in_world + self.camera.centre_along_axis() * axis
    }

    /// Ground point that is seen at a pixel (see [`CameraModel::ground_at`]).
    pub fn ground_at(&self, pixel: &Point2<f64>, ground_down: f64) -> Option<GroundPoint> {
        let ray = self.camera_from_world.inverse() * self.camera.ray_in_camera(pixel);
        let lens = self.lens_in_world();
        let height = ground_down - lens.z;
        (ray.z > 1e-6 * ray.norm() && height > 0.0).then(|| {
            let scale = height / ray.z;
            GroundPoint::new(lens.x + scale * ray.x, lens.y + scale * ray.y)
        })
    }
}
