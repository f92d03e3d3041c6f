//! An aerial camera over any imagery: what the vehicle would have photographed.
//!
//! The ground is a horizontal plane textured by the imagery. Each pixel is taken from the levels of
//! detail whose sampling fits its footprint on the ground; then come the faults of a real camera,
//! in the order in which light meets them: optics, exposure, sensor, file.

mod ground;
mod sensor;
mod settings;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use pilotage_base::frames::Pose;
use pilotage_raster::camera::{CameraModel, RayTable};
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{Picture, decode_picture, encode_jpeg};

pub use settings::AerialCameraSettings;

/// A photograph and the truth about it.
#[derive(Clone, Debug, PartialEq)]
pub struct AerialFrame {
    /// Picture that the file shows.
    pub picture: Picture,
    /// The JPEG file, if the settings want one.
    pub encoded: Option<Vec<u8>>,
    /// Pose from which it was taken, vibration included: the camera model projects with it.
    pub pose: Pose,
}

/// A camera ready to take pictures.
#[derive(Clone, Debug)]
pub struct AerialCamera {
    model: CameraModel,
    settings: AerialCameraSettings,
    rays: RayTable,
}

impl AerialCamera {
    /// Prepares the rays of `model`.
    pub fn new(model: CameraModel, settings: AerialCameraSettings) -> Self {
        Self {
            rays: RayTable::new(&model),
            model,
            settings,
        }
    }

    /// The camera model.
    pub fn model(&self) -> &CameraModel {
        &self.model
    }

    /// Shake and exposure of the camera, in standard deviations. All numbers are always drawn: one fault
    /// switched off does not change the others.
    fn faults(random: &mut ChaCha8Rng) -> (Vector3<f64>, f64) {
        let shake = Vector3::from_fn(|_, _| StandardNormal.sample(random));
        (shake, StandardNormal.sample(random))
    }

    /// Draws from `random` what [`take`](Self::take) would, without a picture.
    pub fn pass_over(random: &mut ChaCha8Rng) {
        Self::faults(random);
        sensor::pass_over(random);
    }

    /// Takes a picture of `imagery`, spread on the plane `ground_down` metres below the world's
    /// origin, from `pose` and the vibration drawn from `random`.
    ///
    /// The imagery is asked for windows on the tile grid of
    /// [`CachedImagery`](pilotage_raster::imagery::CachedImagery), so that one of those saves the drawing of
    /// ground that an earlier frame has seen.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{Attitude, GroundPoint, Pose};
    /// # use pilotage_base::georeference::GroundFromPixel;
    /// # use pilotage_raster::{camera::CameraModel, imagery::GeoreferencedPicture, raster::Raster};
    /// use pilotage_simulate::simulate::{AerialCamera, AerialCameraSettings, frame_random};
    /// # let colour = |x| if x < 200 { [40, 80, 40, 255] } else { [200, 180, 160, 255] };
    /// # let picture = Raster::from_fn(400, 400, |x, _| colour(x));
    /// # let place = GroundFromPixel::north_up(GroundPoint::new(200.0, -200.0), 1.0);
    /// # let ground = GeoreferencedPicture::new("halves", picture, place).ok_or("no area")?;
    ///
    /// // Over ground that is dark in the west and bright in the east, heading north.
    /// let camera = CameraModel::pinhole(64, 48, 60_f64.to_radians());
    /// let camera = AerialCamera::new(camera, AerialCameraSettings::ideal());
    /// let (position_in_world, attitude) = (Point3::new(0.0, 0.0, -100.0), Attitude::level(0.0));
    /// let pose = Pose { position_in_world, attitude };
    /// let frame = camera.take(&ground, &pose, 0.0, &mut frame_random(1, 0));
    /// assert_eq!(frame.picture.get(5, 24), [40, 80, 40]);
    /// assert_eq!(frame.picture.get(58, 24), [200, 180, 160]);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn take(
        &self,
        imagery: &dyn Imagery,
        pose: &Pose,
        ground_down: f64,
        random: &mut ChaCha8Rng,
    ) -> AerialFrame {
        let (shake, exposure) = Self::faults(random);
        let shake = shake * self.settings.mount_vibration_sd;
        let mut pose = *pose;
        pose.attitude.roll += shake.x;
        pose.attitude.pitch += shake.y;
        pose.attitude.yaw += shake.z;
        let light = ground::render(&self.model, &self.rays, imagery, &pose, ground_down);
        let gain = (self.settings.exposure_gain_sd * exposure).exp();
        let picture = sensor::expose(light, &self.model, &self.settings, gain, random);
        let encoded = self
            .settings
            .jpeg_quality
            .and_then(|quality| encode_jpeg(&picture, quality).ok());
        let decoded = encoded
            .as_deref()
            .and_then(|bytes| decode_picture(bytes).ok());
        AerialFrame {
            picture: decoded.unwrap_or(picture),
            encoded,
            pose,
        }
    }
}

/// The generator for frame `index` of the flight with this seed: frames can be taken in any order.
pub fn frame_random(seed: u64, index: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream((2 << 32) | index as u64);
    random
}
