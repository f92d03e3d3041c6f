//! Looks down at generated countries on other days than the map's.

use std::sync::Arc;

use nalgebra::Point3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use pilotage_base::frames::{Attitude, Pose};
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::Picture;
use pilotage_reference::seeing::SeenTiles;
use pilotage_simulate::other_days::any_day;
use pilotage_simulate::simulate::scenery::{Day, Scenery};
use pilotage_simulate::simulate::{AerialCamera, AerialCameraSettings, Scenario, frame_random};
use pilotage_vision::ground_class::CoverNetwork;

/// Height from which is looked, metres.
const HEIGHT: f64 = 304.8;

/// Looks at one country on one day.
pub struct GeneratedLooks {
    /// Landmarks of the country's map.
    pub known: SeenTiles,
    /// The camera.
    pub camera: AerialCamera,
    /// Draws places and whatever errs.
    pub random: ChaCha8Rng,
    ground: Scenery,
    day: u64,
    index: usize,
}

impl GeneratedLooks {
    /// Looks at the country of `country` on a day drawn by `day`; the map is that of the map's day.
    pub fn of(country: u64, day: u64, network: &CoverNetwork) -> Self {
        let map = Scenery::new(country, Day::map_day());
        let settings = AerialCameraSettings {
            mount_vibration_sd: 0.0,
            ..AerialCameraSettings::default()
        };
        Self {
            ground: map.on_day(any_day(day)),
            known: SeenTiles::of(Arc::new(map), network.clone()),
            camera: AerialCamera::new(Scenario::camera(), settings),
            random: ChaCha8Rng::seed_from_u64(day),
            day,
            index: 0,
        }
    }

    /// The next picture, and the pose from which it was taken: level, of any heading.
    pub fn take(&mut self) -> (Pose, Picture) {
        let bounds = self.ground.bounds();
        let mut along = |size: f64| self.random.random_range(-0.4 * size..0.4 * size);
        let (north, east) = (along(bounds.height()), along(bounds.width()));
        let pose = Pose {
            position_in_world: Point3::new(north, east, -HEIGHT),
            attitude: Attitude::level(self.random.random_range(-3.0..3.0)),
        };
        self.index += 1;
        let mut noise = frame_random(self.day, self.index);
        let frame = self.camera.take(&self.ground, &pose, 0.0, &mut noise);
        (pose, frame.picture)
    }
}
