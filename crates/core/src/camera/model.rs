//! The camera: lens, distortion, mount.

use nalgebra::{Matrix3, Point2, Point3, Rotation3, Vector3};
use serde::{Deserialize, Serialize};

use crate::frames::{GroundPoint, Pose};

/// How a direction becomes a pixel before distortion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Lens {
    /// A pinhole; the working model.
    #[default]
    Pinhole,
    /// The thesis' printed perspective with one λ in pixels and metres (eqs 38-42): a pinhole whose
    /// centre is moved λ along the axis. `lambda` is in world units (metres).
    Lambda {
        /// λ of eq 40, metres and pixels at once.
        lambda: f64,
    },
    /// Appendix A: pixels proportional to angles (eqs 57-66).
    Angular,
}

/// Brown-Conrady distortion in OpenCV's order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Distortion {
    /// Radial coefficient of r².
    pub k1: f64,
    /// Radial coefficient of r⁴.
    pub k2: f64,
    /// First tangential coefficient.
    pub p1: f64,
    /// Second tangential coefficient.
    pub p2: f64,
    /// Radial coefficient of r⁶.
    pub k3: f64,
}

/// How the camera sits in the body: zero looks straight down with the picture's top forward.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mount {
    /// Roll of the camera about the body's forward axis, radians.
    pub roll: f64,
    /// Pitch about the body's right axis, radians; nose-up positive, so it tilts the view forward.
    pub pitch: f64,
    /// Turn about the body's down axis, radians, clockwise seen from above.
    pub yaw: f64,
}

/// A camera rigidly fixed to the vehicle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraModel {
    /// Picture width, pixels.
    pub width: usize,
    /// Picture height, pixels.
    pub height: usize,
    /// Focal length, pixels.
    pub focal: f64,
    /// Principal point, pixels from the outer corner of the top-left pixel.
    pub principal: Point2<f64>,
    /// Lens model.
    pub lens: Lens,
    /// Lens distortion.
    pub distortion: Distortion,
    /// Mount angles.
    pub mount: Mount,
}

impl CameraModel {
    /// An undistorted pinhole with the principal point in the middle, looking straight down.
    ///
    /// `horizontal_fov` in radians.
    pub fn pinhole(width: usize, height: usize, horizontal_fov: f64) -> Self {
        Self {
            width,
            height,
            focal: 0.5 * width as f64 / (0.5 * horizontal_fov).tan(),
            principal: Point2::new(0.5 * width as f64, 0.5 * height as f64),
            lens: Lens::Pinhole,
            distortion: Distortion::default(),
            mount: Mount::default(),
        }
    }

    /// Rotation that takes body vectors to camera vectors.
    ///
    /// DeAngelo 2016, eq 37, with the mount angles before it.
    pub fn camera_from_body(&self) -> Rotation3<f64> {
        // Camera x is body right, camera y is body backward, camera z is body down.
        let nominal = Rotation3::from_matrix_unchecked(Matrix3::new(
            0.0, 1.0, 0.0, //
            -1.0, 0.0, 0.0, //
            0.0, 0.0, 1.0,
        ));
        let mounted =
            Rotation3::from_euler_angles(self.mount.roll, self.mount.pitch, self.mount.yaw);
        nominal * mounted.inverse()
    }

    /// Rotation that takes world vectors to camera vectors for a vehicle at `pose`.
    pub fn camera_from_world(&self, pose: &Pose) -> Rotation3<f64> {
        self.camera_from_body() * pose.attitude.world_from_body().inverse()
    }

    /// Pixel at which `point_in_world` appears, or `None` if it lies behind the lens.
    ///
    /// The pixel may lie outside the picture. DeAngelo 2016, eqs 32-46, with a pinhole in place of
    /// his λ.
    pub fn project(&self, pose: &Pose, point_in_world: &Point3<f64>) -> Option<Point2<f64>> {
        let p = self.camera_from_world(pose) * (point_in_world - pose.position_in_world);
        self.pixel_from_camera(&p)
    }

    /// Pixel of a point in camera coordinates, or `None` if it lies behind the lens.
    pub fn pixel_from_camera(&self, p: &Vector3<f64>) -> Option<Point2<f64>> {
        (p.z > 1e-9).then(|| {
            Point2::new(
                self.focal * p.x / p.z + self.principal.x,
                self.focal * p.y / p.z + self.principal.y,
            )
        })
    }

    /// Direction in camera coordinates (z = 1) that is seen at `pixel`.
    pub fn ray_in_camera(&self, pixel: &Point2<f64>) -> Vector3<f64> {
        Vector3::new(
            (pixel.x - self.principal.x) / self.focal,
            (pixel.y - self.principal.y) / self.focal,
            1.0,
        )
    }

    /// Where the ray through `pixel` meets the horizontal plane `ground_down` metres below the
    /// world's origin level, or `None` if it does not point down.
    pub fn ground_at(
        &self,
        pose: &Pose,
        pixel: &Point2<f64>,
        ground_down: f64,
    ) -> Option<GroundPoint> {
        let ray = self.camera_from_world(pose).inverse() * self.ray_in_camera(pixel);
        let height = ground_down - pose.position_in_world.z;
        (ray.z > 1e-6 * ray.norm() && height > 0.0).then(|| {
            let scale = height / ray.z;
            GroundPoint::new(
                pose.position_in_world.x + scale * ray.x,
                pose.position_in_world.y + scale * ray.y,
            )
        })
    }

    /// Whether the pixel lies in the picture, at least `margin` pixels from its edge.
    pub fn in_picture(&self, pixel: &Point2<f64>, margin: f64) -> bool {
        (margin..=self.width as f64 - margin).contains(&pixel.x)
            && (margin..=self.height as f64 - margin).contains(&pixel.y)
    }
}
