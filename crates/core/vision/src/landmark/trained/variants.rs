//! Variants of the ground as a detector is shown it: turned and scaled as it may be next to what the filter
//! thinks.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::{Attitude, Pose};

/// Turn to either side that a cascade learns to overlook, radians: the ±5° of the thesis.
const TURN: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// The same of the logarithm of the size.
const LOG_SCALE: f64 = 0.05;

/// Preparation of the picture before a detector sees it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Preparation {
    /// It is rectified with the assumed attitude: north up, straight from above (DeAngelo 2016, chapter 3).
    #[default]
    Rectified,
    /// It is only made as large as the map: turned and tilted as the camera was. To compare with.
    Plain,
}

/// Numbers evenly on both sides of zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Steps {
    /// Count of the numbers.
    pub count: usize,
    /// From one to the next.
    pub step: f64,
}

impl Steps {
    /// Zero alone.
    pub const ZERO: Self = Self {
        count: 1,
        step: 0.0,
    };

    /// As many as it takes for no number from `-range` to `range` to be further than `tolerance` from one.
    pub fn covering(range: f64, tolerance: f64) -> Self {
        let count = (range / tolerance - 1e-9).ceil().max(1.0);
        if count <= 1.0 {
            return Self::ZERO;
        }
        Self {
            count: count as usize,
            step: 2.0 * range / count,
        }
    }

    /// The number with that index.
    pub fn at(&self, index: usize) -> f64 {
        (index as f64 - 0.5 * (self.count as f64 - 1.0)) * self.step
    }

    /// All, ascending.
    pub fn all(&self) -> impl Iterator<Item = f64> + use<> {
        let steps = *self;
        (0..steps.count).map(move |index| steps.at(index))
    }

    /// The one nearest to a value.
    pub fn nearest(&self, value: f64) -> f64 {
        let off = |n: &f64| (n - value).abs();
        self.all()
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .unwrap_or_default()
    }
}

/// Turn and size that the ground may have next to the map under the assumed pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variant {
    /// Turn, radians clockwise.
    pub rotation: f64,
    /// Logarithm of its size.
    pub log_scale: f64,
    /// Preparation of the picture.
    pub preparation: Preparation,
}

impl Variant {
    /// The pose under which ground that appears so under the `assumed` one looks as on the map; places
    /// are kept by their pixels.
    pub fn pose(&self, assumed: &Pose, ground_down: f64) -> Pose {
        let mut pose = *assumed;
        let height = ground_down - assumed.position_in_world.z;
        pose.position_in_world.z = ground_down - height * (-self.log_scale).exp();
        match self.preparation {
            Preparation::Rectified => pose.attitude.yaw -= self.rotation,
            Preparation::Plain => {
                pose.attitude = Attitude {
                    roll: 0.0,
                    pitch: 0.0,
                    yaw: -self.rotation,
                };
            }
        }
        pose
    }
}

/// The turns and sizes in which the ground is shown to a detector, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variants {
    /// Turns, radians clockwise.
    pub turns: Steps,
    /// Logarithms of sizes.
    pub log_scales: Steps,
    /// Preparation of the picture.
    pub preparation: Preparation,
}

impl Default for Variants {
    fn default() -> Self {
        Self {
            turns: Steps::ZERO,
            log_scales: Steps::ZERO,
            preparation: Preparation::default(),
        }
    }
}

impl Variants {
    /// As many as it takes for a cascade to see the ground nearly as on the map, if that is turned by up
    /// to `turn` radians to either side and its size wrong by a factor of up to exp(`log_scale`).
    pub fn covering(turn: f64, log_scale: f64) -> Self {
        Self {
            turns: Steps::covering(turn, TURN),
            log_scales: Steps::covering(log_scale, LOG_SCALE),
            preparation: Preparation::Rectified,
        }
    }

    /// Number of variants.
    pub fn count(&self) -> usize {
        self.turns.count * self.log_scales.count
    }

    /// The one with that index.
    pub fn at(&self, index: usize) -> Variant {
        Variant {
            rotation: self.turns.at(index % self.turns.count),
            log_scale: self.log_scales.at(index / self.turns.count),
            preparation: self.preparation,
        }
    }

    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = Variant> + use<> {
        let variants = *self;
        (0..variants.count()).map(move |index| variants.at(index))
    }

    /// The one in which ground that appears so looks most as on the map.
    pub fn nearest(&self, rotation: f64, log_scale: f64) -> Variant {
        Variant {
            rotation: self.turns.nearest(rotation),
            log_scale: self.log_scales.nearest(log_scale),
            preparation: self.preparation,
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use pilotage_base::frames::GroundPoint;
    use pilotage_raster::camera::CameraModel;

    /// Turn and log of the size with which a metre of ground from `place` to the north appears on the
    /// ground to somebody who believes `assumed`, and where `place` does.
    fn seen(truth: &Pose, assumed: &Pose, place: &GroundPoint) -> (f64, f64, GroundPoint) {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let appears = |north: f64| {
            let point = Point3::new(place.north + north, place.east, 0.0);
            let pixel = camera.project(truth, &point).unwrap();
            camera.ground_at(assumed, &pixel, 0.0).unwrap()
        };
        let (here, there) = (appears(0.0), appears(1.0));
        let arm = there.to_vector() - here.to_vector();
        (arm.y.atan2(arm.x), arm.norm().ln(), here)
    }

    #[test]
    fn steps_leave_nothing_further_than_the_tolerance() {
        assert_eq!(Steps::covering(0.09, 0.09), Steps::ZERO);
        for (range, tolerance) in [(0.22, 0.05), (0.16, 0.0873), (0.1, 0.09)] {
            let steps = Steps::covering(range, tolerance);
            for i in 0..=100 {
                let value = range * (0.02 * f64::from(i) - 1.0);
                assert!((steps.nearest(value) - value).abs() <= tolerance + 1e-12);
            }
            let fewer = Steps {
                count: steps.count - 1,
                step: 2.0 * range / (steps.count as f64 - 1.0),
            };
            assert!((fewer.nearest(range) - range).abs() > tolerance);
        }
    }

    #[test]
    fn from_the_pose_of_its_variant_ground_looks_as_on_the_map() {
        let truth = Pose {
            position_in_world: Point3::new(3.0, -8.0, -44.0),
            attitude: Attitude {
                roll: 0.1,
                pitch: -0.05,
                yaw: 0.9,
            },
        };
        let mut assumed = truth;
        assumed.attitude.yaw += 0.12;
        assumed.position_in_world.z = -40.0;
        let place = GroundPoint::new(10.0, -5.0);
        let (rotation, log_scale, _) = seen(&truth, &assumed, &place);
        // A camera that is higher than assumed sees things smaller.
        assert!((rotation - 0.12).abs() < 1e-9 && (log_scale + 1.1_f64.ln()).abs() < 1e-9);
        let variant = Variant {
            rotation,
            log_scale,
            preparation: Preparation::Rectified,
        };
        let (rotation, log_scale, there) = seen(&truth, &variant.pose(&assumed, 0.0), &place);
        assert!(rotation.abs() < 1e-9 && log_scale.abs() < 1e-9);
        assert!(there.distance(&place) < 1e-9);
    }

    #[test]
    fn a_plain_picture_is_turned_as_the_camera_was() {
        let assumed = Pose {
            position_in_world: Point3::new(0.0, 0.0, -40.0),
            attitude: Attitude::level(1.1),
        };
        let variants = Variants {
            preparation: Preparation::Plain,
            ..Variants::default()
        };
        let pose = variants.at(0).pose(&assumed, 0.0);
        let (rotation, log_scale, _) = seen(&assumed, &pose, &GroundPoint::new(1.0, 2.0));
        assert!((rotation + 1.1).abs() < 1e-9 && log_scale.abs() < 1e-9);
    }
}
