//! The camera: lens, distortion, mount.

use nalgebra::{Matrix3, Point2, Point3, Rotation2, Rotation3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use super::Distortion;
use pilotage_base::frames::{GroundPoint, Pose};

/// A point nearer to the lens plane than this, metres, is behind the lens.
const NEAREST: f64 = 1e-9;

/// Projection of a direction to a pixel before distortion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Lens {
    /// A pinhole; the working model.
    #[default]
    Pinhole,
    /// The thesis' printed perspective with one λ as pixels and as metres (eqs 38-42): a pinhole of
    /// λ pixels whose centre is moved λ metres along the axis. The camera's `focal` is not used.
    Lambda {
        /// λ of eq 40; the same number counts pixels in the picture and metres in the world.
        lambda: f64,
    },
    /// Appendix A: pixels proportional to the angles of azimuth and depression (eqs 57-66). The
    /// angles of view follow from the camera's `focal`, so that it agrees with the pinhole at the
    /// middle of each edge.
    Angular,
}

/// Attitude of the camera in the body: zero looks straight down with the picture's top forward.
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
    /// Standard deviation of the mount's roll and of its pitch, radians: zero where they are stated.
    pub mount_deviation: f64,
}

/// Standard deviation of the roll and of the pitch of a mount that nobody states and that is taken to look straight down,
/// radians.
pub const UNSTATED_MOUNT_DEVIATION: f64 = 10.0 * std::f64::consts::PI / 180.0;

impl CameraModel {
    /// An undistorted pinhole with the principal point in the middle, looking straight down.
    ///
    /// `horizontal_fov` in radians.
    ///
    /// ```
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// // Half of 640 pixels under 45°: the focal length is 320 pixels.
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians());
    /// assert!((camera.focal - 320.0).abs() < 1e-9);
    /// assert_eq!((camera.principal.x, camera.principal.y), (320.0, 240.0));
    /// ```
    pub fn pinhole(width: usize, height: usize, horizontal_fov: f64) -> Self {
        Self::of_focal(
            width,
            height,
            0.5 * width as f64 / (0.5 * horizontal_fov).tan(),
        )
    }

    /// [`CameraModel::pinhole`] by its focal length in pixels.
    ///
    /// ```
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let camera = CameraModel::of_focal(640, 480, 320.0);
    /// assert!((camera.horizontal_fov() - 90_f64.to_radians()).abs() < 1e-12);
    /// ```
    pub fn of_focal(width: usize, height: usize, focal: f64) -> Self {
        Self {
            width,
            height,
            focal,
            principal: Point2::new(0.5 * width as f64, 0.5 * height as f64),
            lens: Lens::Pinhole,
            distortion: Distortion::default(),
            mount: Mount::default(),
            mount_deviation: 0.0,
        }
    }

    /// Angle between the sides of the picture, radians, by the focal length alone (lens and distortion aside).
    pub fn horizontal_fov(&self) -> f64 {
        2.0 * (0.5 * self.width as f64 / self.focal).atan()
    }

    /// The camera of pictures that were stored turned by `turn`, radians clockwise: the mount stays as it is,
    /// and the picture turns about its middle, with the principal point and what the lens distorts to one side.
    #[must_use]
    pub fn stored_turned(&self, turn: f64) -> Self {
        let mount = &self.mount;
        // Who turns a camera counter-clockwise sees its picture turned clockwise.
        let mounted = Rotation3::from_euler_angles(mount.roll, mount.pitch, mount.yaw)
            * Rotation3::from_euler_angles(0.0, 0.0, -turn);
        let (roll, pitch, yaw) = mounted.euler_angles();
        // With y down this turns clockwise.
        let turned = Rotation2::new(turn);
        let middle = Point2::new(0.5 * self.width as f64, 0.5 * self.height as f64);
        // With d = (p2, p1) the tangential distortion is 2 (d·v) v + r² d, which turns with d.
        let tangential = turned * Vector2::new(self.distortion.p2, self.distortion.p1);
        Self {
            mount: Mount { roll, pitch, yaw },
            principal: middle + turned * (self.principal - middle),
            distortion: Distortion {
                p1: tangential.y,
                p2: tangential.x,
                ..self.distortion
            },
            ..self.clone()
        }
    }

    /// Rotation that takes body vectors to camera vectors.
    ///
    /// DeAngelo 2016, eq 37, with the mount angles before it; a mount pitch is his rotation of a
    /// forward-looking camera.
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

    /// Pixel at which `point_in_world` appears, or `None` if it lies behind the lens or so far
    /// outside the view that the distortion folds back.
    ///
    /// The pixel may lie outside the picture. DeAngelo 2016, eqs 32-46, with a pinhole in place of
    /// his λ.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{Attitude, Pose};
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let camera = CameraModel::pinhole(640, 480, 90_f64.to_radians()); // focal length 320 pixels
    /// // 100 m above the origin, level, heading north: 10 m on the ground are 32 pixels.
    /// let (position_in_world, attitude) = (Point3::new(0.0, 0.0, -100.0), Attitude::level(0.0));
    /// let pose = Pose { position_in_world, attitude };
    /// let north = camera.project(&pose, &Point3::new(10.0, 0.0, 0.0)).ok_or("behind the lens")?;
    /// assert!((north.x - 320.0).abs() < 1e-9 && (north.y - 208.0).abs() < 1e-9);
    /// // And back.
    /// let ground = camera.ground_at(&pose, &north, 0.0).ok_or("above the horizon")?;
    /// assert!((ground.north - 10.0).abs() < 1e-9 && ground.east.abs() < 1e-9);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn project(&self, pose: &Pose, point_in_world: &Point3<f64>) -> Option<Point2<f64>> {
        self.posed(pose).project(point_in_world)
    }

    /// Pixel of a point in camera coordinates (metres); `None` as in [`Self::project`].
    pub fn pixel_from_camera(&self, p: &Vector3<f64>) -> Option<Point2<f64>> {
        let depth = p.z - self.centre_along_axis();
        // Also refuses what is not a number.
        if !(depth > NEAREST && p.x.is_finite() && p.y.is_finite() && depth.is_finite()) {
            return None;
        }
        let ideal = Point2::new(p.x / depth, p.y / depth);
        if !self.distortion.is_valid_at(&ideal) {
            return None;
        }
        let seen = self.distortion.distort(&ideal);
        let (scale_x, scale_y) = self.pixels_per_unit();
        let offset = match self.lens {
            Lens::Pinhole | Lens::Lambda { .. } => seen,
            Lens::Angular => Point2::new(seen.x.atan(), seen.y.atan()),
        };
        let pixel = Point2::new(
            scale_x * offset.x + self.principal.x,
            scale_y * offset.y + self.principal.y,
        );
        (pixel.x.is_finite() && pixel.y.is_finite()).then_some(pixel)
    }

    /// Direction in camera coordinates (z = 1) that is seen at `pixel`.
    ///
    /// The ray starts at the centre of the lens, which [`Lens::Lambda`] puts λ metres along the axis.
    pub fn ray_in_camera(&self, pixel: &Point2<f64>) -> Vector3<f64> {
        let seen = self.seen_at(pixel);
        let ideal = self.distortion.undistort(&seen);
        Vector3::new(ideal.x, ideal.y, 1.0)
    }

    /// Pixel to the distorted place in units of the focal length.
    pub(super) fn seen_at(&self, pixel: &Point2<f64>) -> Point2<f64> {
        let (scale_x, scale_y) = self.pixels_per_unit();
        let x = (pixel.x - self.principal.x) / scale_x;
        let y = (pixel.y - self.principal.y) / scale_y;
        match self.lens {
            Lens::Pinhole | Lens::Lambda { .. } => Point2::new(x, y),
            // A right angle is at infinity: stop just before.
            Lens::Angular => Point2::new(x.clamp(-1.57, 1.57).tan(), y.clamp(-1.57, 1.57).tan()),
        }
    }

    /// Centre of the lens in camera coordinates, metres along the axis.
    pub(super) fn centre_along_axis(&self) -> f64 {
        match self.lens {
            Lens::Lambda { lambda } => lambda,
            Lens::Pinhole | Lens::Angular => 0.0,
        }
    }

    /// Pixels per unit of tangent (pinhole) or of angle (Appendix A), across and down.
    fn pixels_per_unit(&self) -> (f64, f64) {
        let per_angle = |pixels: usize| {
            let half = 0.5 * pixels as f64;
            half / (half / self.focal).atan()
        };
        match self.lens {
            Lens::Pinhole => (self.focal, self.focal),
            Lens::Lambda { lambda } => (lambda, lambda),
            Lens::Angular => (per_angle(self.width), per_angle(self.height)),
        }
    }

    /// Centre of the lens in the world, metres.
    pub fn lens_in_world(&self, pose: &Pose) -> Point3<f64> {
        self.posed(pose).lens_in_world()
    }

    /// Ground point at which the ray through `pixel` meets the horizontal plane `ground_down` metres below
    /// the world's origin level, or `None` if it does not point down.
    pub fn ground_at(
        &self,
        pose: &Pose,
        pixel: &Point2<f64>,
        ground_down: f64,
    ) -> Option<GroundPoint> {
        self.posed(pose).ground_at(pixel, ground_down)
    }

    /// Whether the pixel lies in the picture, at least `margin` pixels from its edge.
    pub fn in_picture(&self, pixel: &Point2<f64>, margin: f64) -> bool {
        (margin..=self.width as f64 - margin).contains(&pixel.x)
            && (margin..=self.height as f64 - margin).contains(&pixel.y)
    }
}
