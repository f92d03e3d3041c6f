//! The faults of a camera, as settings.

use serde::{Deserialize, Serialize};

/// The faults of the camera. All random ones are drawn anew for each frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AerialCameraSettings {
    /// Standard deviation of the vibration of the mount about each axis, radians (DeAngelo 2016:
    /// 1°). Zero where the given poses shake already.
    pub mount_vibration_sd: f64,
    /// Standard deviation of the natural logarithm of the exposure.
    pub exposure_gain_sd: f64,
    /// Blur of the optics, standard deviation in pixels.
    pub blur_sigma: f64,
    /// Share of the light lost in the corners of the picture.
    pub vignetting: f64,
    /// Standard deviation of the noise of each pixel and colour at mid grey, in grey levels of 255;
    /// it grows with the root of the light.
    pub noise_sd: f64,
    /// Quality of the JPEG file from 1 to 100; `None` leaves the picture as the sensor gave it.
    pub jpeg_quality: Option<u8>,
}

impl Default for AerialCameraSettings {
    /// A small consumer camera in a shaking mount.
    fn default() -> Self {
        Self {
            mount_vibration_sd: 1f64.to_radians(),
            exposure_gain_sd: 0.06,
            blur_sigma: 0.45,
            vignetting: 0.15,
            noise_sd: 2.5,
            jpeg_quality: Some(88),
        }
    }
}

impl AerialCameraSettings {
    /// No fault at all.
    pub fn ideal() -> Self {
        Self {
            mount_vibration_sd: 0.0,
            exposure_gain_sd: 0.0,
            blur_sigma: 0.0,
            vignetting: 0.0,
            noise_sd: 0.0,
            jpeg_quality: None,
        }
    }
}
