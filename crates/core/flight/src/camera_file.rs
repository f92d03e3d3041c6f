//! A camera and an origin as flight.json and missions write them: angles in degrees, members named with their units.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::Geodetic;
use pilotage_raster::camera::{CameraModel, Distortion, Lens, Mount};

/// A geodetic position in degrees and metres.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OriginFile {
    /// Latitude, degrees, north positive.
    pub latitude_deg: f64,
    /// Longitude, degrees, east positive.
    pub longitude_deg: f64,
    /// Height, metres.
    #[serde(default)]
    pub height_m: f64,
}

/// A camera with angles in degrees.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// Focal length, pixels; either this or the field of view is stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focal_px: Option<f64>,
    /// Horizontal field of view, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub horizontal_fov_deg: Option<f64>,
    /// Pixels from the outer corner of the top-left pixel; the middle if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub principal_px: Option<[f64; 2]>,
    /// Kind of projection.
    #[serde(default)]
    pub lens: Lens,
    /// Distortion of the lens.
    #[serde(default)]
    pub distortion: Distortion,
    /// Mount of the camera in the body.
    #[serde(default)]
    pub mount_deg: MountFile,
    /// Standard deviation of the mount's roll and of its pitch, degrees; zero if absent.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub mount_deviation_deg: f64,
}

/// Whether a number is not worth writing.
#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

/// Mount of a camera, degrees.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MountFile {
    /// Roll of the camera in the body, degrees.
    pub roll: f64,
    /// Pitch of the camera in the body, degrees.
    pub pitch: f64,
    /// Yaw of the camera in the body, degrees.
    pub yaw: f64,
}

/// Degrees that read back to the same radians, without the digits that only the conversion adds.
fn plain_degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let rounded = (degrees * 1e12).round() / 1e12;
    if rounded.to_radians() == radians {
        rounded
    } else {
        degrees
    }
}

impl OriginFile {
    /// The position as it is written, with degrees that read back to the same radians.
    ///
    /// ```
    /// use pilotage_base::frames::Geodetic;
    /// use pilotage_flight::OriginFile;
    ///
    /// let file = OriginFile::of(&Geodetic::from_degrees(46.84, -91.99, 187.0));
    /// assert_eq!((file.latitude_deg, file.longitude_deg), (46.84, -91.99));
    /// ```
    pub fn of(origin: &Geodetic) -> Self {
        Self {
            latitude_deg: plain_degrees(origin.latitude),
            longitude_deg: plain_degrees(origin.longitude),
            height_m: origin.height,
        }
    }

    /// The position, or in words what is wrong with it.
    ///
    /// ```
    /// use pilotage_flight::OriginFile;
    ///
    /// let origin = OriginFile { latitude_deg: 45.0, longitude_deg: -92.0, height_m: 200.0 };
    /// let place = origin.geodetic()?;
    /// assert!((place.latitude - std::f64::consts::FRAC_PI_4).abs() < 1e-12);
    /// let wrong = OriginFile { latitude_deg: 95.0, ..origin };
    /// assert_eq!(wrong.geodetic(), Err("95 is not a latitude".to_owned()));
    /// # Ok::<(), String>(())
    /// ```
    pub fn geodetic(&self) -> Result<Geodetic, String> {
        if !(-90.0..=90.0).contains(&self.latitude_deg) {
            return Err(format!("{} is not a latitude", self.latitude_deg));
        }
        if !(-360.0..=360.0).contains(&self.longitude_deg) {
            return Err(format!("{} is not a longitude", self.longitude_deg));
        }
        Ok(Geodetic::from_degrees(
            self.latitude_deg,
            self.longitude_deg,
            self.height_m,
        ))
    }
}

impl CameraFile {
    /// The camera as it is written, with degrees that read back to the same radians.
    pub fn of(camera: &CameraModel) -> Self {
        Self {
            width: camera.width,
            height: camera.height,
            focal_px: Some(camera.focal),
            horizontal_fov_deg: None,
            principal_px: Some([camera.principal.x, camera.principal.y]),
            lens: camera.lens,
            distortion: camera.distortion,
            mount_deg: MountFile {
                roll: plain_degrees(camera.mount.roll),
                pitch: plain_degrees(camera.mount.pitch),
                yaw: plain_degrees(camera.mount.yaw),
            },
            mount_deviation_deg: plain_degrees(camera.mount_deviation),
        }
    }

    /// The camera, or in words what is wrong with it.
    ///
    /// ```
    /// use pilotage_flight::CameraFile;
    /// use pilotage_raster::camera::CameraModel;
    ///
    /// let mut file = CameraFile::of(&CameraModel::pinhole(640, 480, 1.0));
    /// // As many cameras are described: by the field of view instead of the focal length.
    /// (file.focal_px, file.horizontal_fov_deg) = (None, Some(90.0));
    /// assert!((file.camera()?.focal - 320.0).abs() < 1e-9);
    /// // Nobody measured how it was mounted.
    /// file.mount_deviation_deg = 10.0;
    /// assert_eq!(file.camera()?.mount_deviation, 10_f64.to_radians());
    /// file.mount_deviation_deg = -1.0;
    /// assert!(file.camera().is_err());
    /// file.mount_deviation_deg = 0.0;
    /// file.width = 0;
    /// assert!(file.camera().is_err());
    /// # Ok::<(), String>(())
    /// ```
    pub fn camera(&self) -> Result<CameraModel, String> {
        if !(1..=30_000).contains(&self.width) || !(1..=30_000).contains(&self.height) {
            return Err(format!(
                "a picture of {} x {} pixels is not plausible",
                self.width, self.height
            ));
        }
        let mut camera = match (self.focal_px, self.horizontal_fov_deg) {
            (Some(focal), None) if focal > 0.0 => CameraModel {
                focal,
                ..CameraModel::pinhole(self.width, self.height, 1.0)
            },
            (None, Some(fov)) if fov > 0.0 && fov < 180.0 => {
                CameraModel::pinhole(self.width, self.height, fov.to_radians())
            }
            (Some(_), Some(_)) | (None, None) => {
                return Err("state either focal_px or horizontal_fov_deg".to_owned());
            }
            _ => return Err("the focal length or field of view is out of range".to_owned()),
        };
        if let Some([x, y]) = self.principal_px {
            camera.principal = nalgebra::Point2::new(x, y);
        }
        if let Lens::Lambda { lambda } = self.lens
            && !(lambda > 0.0 && lambda.is_finite())
        {
            return Err(format!("a lens with a λ of {lambda} px shows nothing"));
        }
        camera.lens = self.lens;
        camera.distortion = self.distortion;
        camera.mount = Mount {
            roll: self.mount_deg.roll.to_radians(),
            pitch: self.mount_deg.pitch.to_radians(),
            yaw: self.mount_deg.yaw.to_radians(),
        };
        if !(0.0..=45.0).contains(&self.mount_deviation_deg) {
            return Err(format!(
                "a mount that is known to {}° is not plausible",
                self.mount_deviation_deg
            ));
        }
        camera.mount_deviation = self.mount_deviation_deg.to_radians();
        Ok(camera)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lens_whose_lambda_is_no_length_is_refused() {
        let camera = |lambda: f64| {
            let mut camera = CameraModel::pinhole(640, 480, 1.0);
            camera.lens = Lens::Lambda { lambda };
            CameraFile::of(&camera).camera()
        };
        assert_eq!(camera(500.0).unwrap().lens, Lens::Lambda { lambda: 500.0 });
        for lambda in [0.0, -500.0, f64::INFINITY, f64::NAN] {
            let why = camera(lambda).unwrap_err();
            assert!(why.contains("λ"), "{why}");
        }
    }
}
