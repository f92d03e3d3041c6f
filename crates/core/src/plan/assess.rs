//! How well a landmark can be found: measured, by flying over it before the flight.
//!
//! Views of the landmark are rendered with the camera simulator on other days, from any heading, with
//! the errors of position and attitude that the filter will have, and the very detector that will fly
//! looks for it in them.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Matrix2, Matrix4, Point2, Point3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::ExpectedDetection;
use super::days::OtherDays;
use crate::camera::CameraModel;
use crate::frames::{Attitude, Pose};
use crate::imagery::Imagery;
use crate::landmark::{
    Detector, FrameView, Landmark, SearchRequest, Sighting, TemplateDetector, TemplateSettings,
};
use crate::navigator::SensorNoise;
use crate::raster::Pyramid;
use crate::simulate::{AerialCamera, AerialCameraSettings};

/// Levels of the picture pyramid, as in the navigator.
const PYRAMID_LEVELS: usize = 6;
/// A place this far off is wrong if it is off by as many pixels, too: metres and pixels.
const WRONG: (f64, f64) = (2.0, 5.0);

/// Under which circumstances a landmark is looked for.
#[derive(Clone, Debug)]
pub struct Circumstances {
    /// The camera of the flight.
    pub camera: CameraModel,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// Standard deviation of the filter's position per axis, metres.
    pub position: f64,
    /// Errors of the camera's pose.
    pub sensors: SensorNoise,
    /// The detector that will fly.
    pub detector: TemplateSettings,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
}

/// How one view went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Which of the days it was on.
    pub day: usize,
    /// Heading of the camera, radians.
    pub heading: f64,
    /// Distance of the landmark from the middle of the picture, pixels.
    pub off_centre: f64,
    /// What the detector said.
    pub sighting: Sighting,
    /// Distance of the place it found from where the landmark is, metres on the ground.
    pub error: Option<f64>,
    /// Whether it was accepted, though it is wrong.
    pub wrong: bool,
}

impl View {
    /// Whether it was accepted and right.
    pub fn found(&self) -> bool {
        matches!(self.sighting, Sighting::Found(_)) && !self.wrong
    }
}

/// Looks at one landmark again and again; a view a call, so that the caller can show progress and stop.
pub struct Assessor {
    landmark: Landmark,
    circumstances: Circumstances,
    days: Vec<Arc<dyn Imagery>>,
    detector: TemplateDetector,
    random: ChaCha8Rng,
    views: Vec<View>,
}

impl Assessor {
    /// Prepares to look at `landmark` of `map` on `days` other days.
    pub fn new(
        landmark: &Landmark,
        map: Arc<dyn Imagery>,
        others: &dyn OtherDays,
        days: usize,
        circumstances: Circumstances,
        seed: u64,
    ) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let days = (0..days.max(1))
            .map(|_| others.day(random.random::<u64>() >> 1))
            .collect();
        Self {
            detector: TemplateDetector::new(map, circumstances.detector),
            landmark: landmark.clone(),
            circumstances,
            days,
            random,
            views: Vec::new(),
        }
    }

    /// The same days for another landmark or other circumstances.
    pub fn over(
        landmark: &Landmark,
        map: Arc<dyn Imagery>,
        days: &[Arc<dyn Imagery>],
        circumstances: Circumstances,
        seed: u64,
    ) -> Self {
        Self {
            detector: TemplateDetector::new(map, circumstances.detector),
            landmark: landmark.clone(),
            circumstances,
            days: days.to_vec(),
            random: ChaCha8Rng::seed_from_u64(seed),
            views: Vec::new(),
        }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.random)
    }

    /// The next view; days take turns. `None` if the landmark does not fit into the picture.
    pub fn look(&mut self) -> Option<View> {
        let day = self.views.len() % self.days.len();
        let heading = TAU * self.random.random::<f64>();
        let c = self.circumstances.clone();
        let tilt = [
            self.normal() * c.sensors.roll,
            self.normal() * c.sensors.pitch,
        ];
        let attitude = Attitude {
            roll: tilt[0],
            pitch: tilt[1],
            yaw: heading,
        };
        let camera = &c.camera;
        let over = |north: f64, east: f64| Pose {
            position_in_world: Point3::new(north, east, c.ground_down - c.height),
            attitude,
        };
        // Where the middle of the landmark shall appear: anywhere so that all of it is in the picture.
        let b = self.landmark.bounds;
        let half = 0.5 * b.width().hypot(b.height()) * camera.focal / c.height;
        let (w, h) = (camera.width as f64, camera.height as f64);
        let turned = heading.sin().abs() + heading.cos().abs();
        let margin = half / 2.0_f64.sqrt() * turned + 1.0;
        if 2.0 * margin >= w.min(h) {
            return None;
        }
        let wanted = Point2::new(
            margin + (w - 2.0 * margin) * self.random.random::<f64>(),
            margin + (h - 2.0 * margin) * self.random.random::<f64>(),
        );
        let seen = camera.ground_at(&over(0.0, 0.0), &wanted, c.ground_down)?;
        let middle = b.center();
        let pose = over(middle.north - seen.north, middle.east - seen.east);
        let assumed = Pose {
            position_in_world: pose.position_in_world
                + nalgebra::Vector3::new(
                    self.normal() * c.position,
                    self.normal() * c.position,
                    self.normal() * c.sensors.height,
                ),
            attitude: Attitude {
                roll: 0.0,
                pitch: 0.0,
                yaw: heading + self.normal() * c.sensors.yaw,
            },
        };
        // What the errors do to the place on the ground, and how much of the picture is searched for it.
        let lever = c.height * c.sensors.roll.max(c.sensors.pitch);
        let variance = c.position.powi(2) + lever.powi(2);
        let reach = c.detector.search_sigmas * 1.5 * variance.sqrt() * camera.focal / c.height;
        let crop = crop(camera, &wanted, margin + reach + 8.0);
        let aerial = AerialCamera::new(
            crop.clone(),
            AerialCameraSettings {
                mount_vibration_sd: 0.0,
                ..AerialCameraSettings::default()
            },
        );
        let frame = aerial.take(
            self.days[day].as_ref(),
            &pose,
            c.ground_down,
            &mut self.random,
        );
        let luminance = Pyramid::new(frame.picture.to_gray(), PYRAMID_LEVELS);
        let view = FrameView {
            camera: &crop,
            pose: assumed,
            ground_down: c.ground_down,
            luminance: &luminance,
        };
        let request = SearchRequest {
            landmark: &self.landmark,
            displacement_covariance: Matrix2::identity() * variance,
        };
        let sighting = self.detector.detect(&view, &request);
        let point = self.landmark.reference_in_world(c.ground_down);
        let true_pixel = crop.project(&pose, &point)?;
        let expected = crop.ground_at(&assumed, &true_pixel, c.ground_down)?;
        let error = sighting.best().map(|d| d.ground.distance(&expected));
        let pixels = error.map(|e| e * camera.focal / c.height);
        let wrong = matches!(sighting, Sighting::Found(_))
            && error.is_some_and(|e| e > WRONG.0)
            && pixels.is_some_and(|p| p > WRONG.1);
        let view = View {
            day,
            heading,
            off_centre: (wanted - camera.principal).norm(),
            sighting,
            error,
            wrong,
        };
        self.views.push(view);
        Some(view)
    }

    /// The views so far.
    pub fn views(&self) -> &[View] {
        &self.views
    }

    /// What follows from them; `None` without a view.
    pub fn expected(&self) -> Option<ExpectedDetection> {
        expected(&self.views, self.days.len())
    }

    /// Share of the views in which a wrong place was accepted.
    pub fn false_matches(&self) -> f64 {
        let wrong = self.views.iter().filter(|v| v.wrong).count();
        wrong as f64 / self.views.len().max(1) as f64
    }
}

/// The part of the picture within `half` pixels of `middle`, as a camera of its own.
fn crop(camera: &CameraModel, middle: &Point2<f64>, half: f64) -> CameraModel {
    let span = |middle: f64, size: usize| {
        let low = (middle - half).floor().max(0.0);
        let high = (middle + half).ceil().min(size as f64);
        (low, high - low)
    };
    let (left, width) = span(middle.x, camera.width);
    let (top, height) = span(middle.y, camera.height);
    CameraModel {
        width: width as usize,
        height: height as usize,
        principal: Point2::new(camera.principal.x - left, camera.principal.y - top),
        ..camera.clone()
    }
}

/// A landmark is recognised on a day if it is found in any view of that day; both shares are shrunk by
/// half a success and half a failure (Jeffreys' prior).
fn expected(views: &[View], days: usize) -> Option<ExpectedDetection> {
    if views.is_empty() {
        return None;
    }
    let shrunk = |hits: usize, of: usize| (hits as f64 + 0.5) / (of as f64 + 1.0);
    let on = |day: usize| views.iter().filter(move |v| v.day == day);
    let flown: Vec<usize> = (0..days).filter(|d| on(*d).next().is_some()).collect();
    let good: Vec<usize> = flown
        .iter()
        .copied()
        .filter(|d| on(*d).any(View::found))
        .collect();
    let found: Vec<&View> = views.iter().filter(|v| v.found()).collect();
    let tried = good.iter().map(|d| on(*d).count()).sum();
    let covariances = found.iter().filter_map(|v| v.sighting.best());
    let sum: Matrix4<f64> = covariances.map(|d| d.covariance).sum();
    Some(ExpectedDetection {
        recognised: shrunk(good.len(), flown.len()),
        per_frame: shrunk(found.len(), tried),
        covariance: sum / found.len().max(1) as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::{GroundPoint, GroundRect};
    use crate::imagery::CachedImagery;
    use crate::plan::days::SceneryDays;
    use crate::simulate::Scenario;
    use crate::simulate::scenery::DEMO_SEED;

    /// The landmark of that name, moved by (north, east) metres.
    fn rate(name: &str, north: f64, east: f64) -> (ExpectedDetection, f64) {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        let landmark = mission.landmarks.iter().find(|l| l.name == name).unwrap();
        let center = landmark.bounds.center();
        let bounds = GroundRect::centered(
            GroundPoint::new(center.north + north, center.east + east),
            landmark.bounds.width(),
            landmark.bounds.height(),
        );
        let landmark = &Landmark::new(1, name, bounds);
        let map = Arc::new(CachedImagery::new(Arc::new(Scenario::map()), 64));
        let circumstances = Circumstances {
            camera: Scenario::camera(),
            height: scenario.height,
            position: 4.0,
            sensors: mission.navigator.sensors,
            detector: mission.navigator.detector,
            ground_down: 0.0,
        };
        let days = SceneryDays { seed: DEMO_SEED };
        let mut assessor = Assessor::new(landmark, map, &days, 3, circumstances, 11);
        for _ in 0..18 {
            assessor.look().unwrap();
        }
        (assessor.expected().unwrap(), assessor.false_matches())
    }

    #[test]
    fn a_pool_is_found_more_often_than_a_piece_of_the_road_beside_it() {
        let (pool, wrong) = rate("swimming pool", 0.0, 0.0);
        let (road, _) = rate("swimming pool", 20.0, -30.0);
        println!("{pool:?} {road:?}");
        assert!(pool.probability() > 0.7, "{pool:?}");
        assert!(road.probability() < 0.5 * pool.probability(), "{road:?}");
        assert_eq!(wrong, 0.0);
    }
}
