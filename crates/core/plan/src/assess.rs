//! Assessment of how well a landmark can be found: measured, by flying over it before the flight.
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

use super::survival::{GroundLooks, Survival};
use super::{DetectionStatistics, ExpectedDetection, LookTally, ViewResult};
use pilotage_base::frames::{Attitude, GroundPoint, Pose};
use pilotage_mission::settings::SensorNoise;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{PYRAMID_LEVELS, Pyramid};
use pilotage_simulate::other_days::OtherDays;
use pilotage_simulate::other_days::day_ground::{DayGround, crop};
use pilotage_simulate::simulate::{AerialCamera, AerialCameraSettings};
use pilotage_vision::landmark::{
    ChosenDetector, Detector, FrameView, Landmark, SearchRequest, Sighting, TemplateFeatures,
    TemplateSettings, rehearse, tolerance,
};

/// Share of the searched distance that is drawn as on the day: all but the outermost that a search comes to
/// if the filter is off by half a standard deviation of its search window and more.
const DRAWN: f64 = 0.8;

/// Extent of a rehearsal: days and views in which a landmark is looked at before the flight.
///
/// What a place looks like is settled by the day more than by anything else, so a view on another day
/// tells more than another view on the same.
pub struct Rehearsal;

impl Rehearsal {
    /// Days that are rehearsed.
    pub const DAYS: usize = 9;
    /// Views in all, taking turns among the days.
    pub const VIEWS: usize = 18;
    /// Standard deviation of the filter's position that is assumed, per axis, metres.
    pub const POSITION: f64 = 5.0;

    /// Expected detection after views of those days; `None` without a view.
    pub fn expected(views: &[ViewResult]) -> Option<ExpectedDetection> {
        expected(views, Self::DAYS)
    }

    /// Share of views in which a wrong place was accepted.
    pub fn false_matches(views: &[ViewResult]) -> f64 {
        let wrong = views.iter().filter(|v| v.wrong).count();
        wrong as f64 / views.len().max(1) as f64
    }

    /// Those days, drawn by `seed`.
    pub fn days(others: &dyn OtherDays, seed: u64) -> Vec<Arc<dyn Imagery>> {
        others.spread(Self::DAYS, seed)
    }
}

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
    /// Tilt of the camera, in any direction, of which the filter knows: a bank angle, radians.
    pub tilt: f64,
}

/// Looks at one landmark again and again; a view a call, so that the caller can show progress and stop.
pub struct Assessor {
    landmark: Landmark,
    circumstances: Circumstances,
    ground: DayGround,
    detector: ChosenDetector,
    /// Survival of the landmark on maps of another date, where the detector is for these.
    survival: Option<Survival>,
    random: ChaCha8Rng,
    /// Looks so far, with those that were passed over.
    looks: usize,
    views: Vec<ViewResult>,
}

/// A look as it was drawn, before anything is seen.
struct DrawnLook {
    day: usize,
    heading: f64,
    /// Tilt of which the filter does not know, radians.
    attitude_error: f64,
    /// Distance of the landmark from the middle of the whole picture, pixels.
    off_centre: f64,
    /// The part of the picture in which it is looked for.
    crop: CameraModel,
    pose: Pose,
    assumed: Pose,
    /// Of the place on the ground under the assumed pose, per axis, square metres.
    variance: f64,
    /// Distance around the landmark within which it is looked for, metres.
    reach: f64,
    /// Place at which the landmark appears on the ground under the assumed pose.
    expected: GroundPoint,
    /// For the picture.
    random: ChaCha8Rng,
}

impl Assessor {
    /// Prepares to look at `landmark` of `map` on `days`, which need not be kept where they were
    /// looked at; the errors are drawn by `seed`.
    pub fn new(
        landmark: &Landmark,
        map: Arc<dyn Imagery>,
        days: &[Arc<dyn Imagery>],
        circumstances: Circumstances,
        seed: u64,
    ) -> Self {
        let survival = (circumstances.detector.features == TemplateFeatures::Orientation)
            .then(|| lasting(landmark, map.as_ref(), days, &circumstances))
            .flatten();
        Self {
            survival,
            detector: ChosenDetector::new(
                Arc::clone(&map),
                circumstances.detector,
                std::slice::from_ref(landmark),
            ),
            ground: DayGround::new(map, days),
            landmark: landmark.clone(),
            circumstances,
            random: ChaCha8Rng::seed_from_u64(seed),
            looks: 0,
            views: Vec::new(),
        }
    }

    /// Looks as often as a rehearsal does; not at all if the landmark does not fit into the picture.
    pub fn rehearse(&mut self) {
        for _ in 0..Rehearsal::VIEWS {
            self.look();
        }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.random)
    }

    /// Height of the camera above ground, metres.
    pub fn height(&self) -> f64 {
        self.circumstances.height
    }

    /// The next view; days take turns. `None` if the landmark does not fit into the picture.
    pub fn look(&mut self) -> Option<ViewResult> {
        self.look_on(self.looks)
    }

    /// Leaves the next view to others: draws what it would draw, so that the one after it is the same
    /// as if it had been taken. False if the landmark does not fit into the picture.
    pub fn pass_over(&mut self) -> bool {
        self.draw_look(self.looks).is_some()
    }

    /// A view on a day, counted round. `None` if the landmark does not fit into the picture.
    fn look_on(&mut self, day: usize) -> Option<ViewResult> {
        let look = self.draw_look(day)?;
        Some(self.see(look))
    }

    /// A look on a day, counted round, as it is drawn.
    fn draw_look(&mut self, day: usize) -> Option<DrawnLook> {
        let day = day % self.ground.days();
        let heading = TAU * self.random.random::<f64>();
        let margin = self.margin(heading)?;
        let camera = &self.circumstances.camera;
        let (w, h) = (camera.width as f64, camera.height as f64);
        // Where the middle of the landmark shall appear: anywhere so that all of it is in the picture.
        let wanted = Point2::new(
            margin + (w - 2.0 * margin) * self.random.random::<f64>(),
            margin + (h - 2.0 * margin) * self.random.random::<f64>(),
        );
        self.draw_at(day, heading, wanted)
    }

    /// A view on a day, counted round, from another height (metres) with another tilt (radians).
    pub fn look_from(&mut self, day: usize, height: f64, tilt: f64) -> Option<ViewResult> {
        let usual = (self.circumstances.height, self.circumstances.tilt);
        (self.circumstances.height, self.circumstances.tilt) = (height, tilt);
        let view = self.look_on(day);
        (self.circumstances.height, self.circumstances.tilt) = usual;
        view
    }

    /// Flies over the landmark once, at `speed` m/s with a picture every `period` seconds: on any of the
    /// days, on any heading, to one side of it or the other. The views in which it lies whole.
    pub fn pass(&mut self, speed: f64, period: f64) -> Vec<ViewResult> {
        let day = self.random.random_range(0..self.ground.days());
        let heading = TAU * self.random.random::<f64>();
        let Some(margin) = self.margin(heading) else {
            return Vec::new();
        };
        let c = &self.circumstances;
        let (w, h) = (c.camera.width as f64, c.camera.height as f64);
        let step = speed * period * c.camera.focal / c.height;
        let x = margin + (w - 2.0 * margin) * self.random.random::<f64>();
        let mut y = margin + step * self.random.random::<f64>();
        let mut views = Vec::new();
        while y <= h - margin {
            let look = self.draw_at(day, heading, Point2::new(x, y));
            views.extend(look.map(|look| self.see(look)));
            y += step;
        }
        views
    }

    /// Pixels between the middle of the landmark and the picture's edge at the least; `None` if it does
    /// not fit into the picture.
    fn margin(&self, heading: f64) -> Option<f64> {
        let c = &self.circumstances;
        let b = self.landmark.bounds;
        let half = 0.5 * b.width().hypot(b.height()) * c.camera.focal / c.height;
        let turned = heading.sin().abs() + heading.cos().abs();
        let margin = half / 2.0_f64.sqrt() * turned + 1.0;
        let shorter = c.camera.width.min(c.camera.height) as f64;
        (2.0 * margin < shorter).then_some(margin)
    }

    /// A look on a day, on a heading, with the middle of the landmark at pixel `wanted`.
    fn draw_at(&mut self, day: usize, heading: f64, wanted: Point2<f64>) -> Option<DrawnLook> {
        let c = self.circumstances.clone();
        let margin = self.margin(heading)?;
        let (sin, cos) = (TAU * self.random.random::<f64>()).sin_cos();
        let known = [c.tilt * cos, c.tilt * sin];
        let unknown = [
            self.normal() * c.sensors.roll,
            self.normal() * c.sensors.pitch,
        ];
        let attitude = Attitude {
            roll: known[0] + unknown[0],
            pitch: known[1] + unknown[1],
            yaw: heading,
        };
        let camera = &c.camera;
        let over = |north: f64, east: f64| Pose {
            position_in_world: Point3::new(north, east, c.ground_down - c.height),
            attitude,
        };
        let b = self.landmark.bounds;
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
                roll: known[0],
                pitch: known[1],
                yaw: heading + self.normal() * c.sensors.yaw,
            },
        };
        // What the errors do to the place on the ground, and how much of the picture is searched for it.
        let lever = c.height * c.sensors.roll.max(c.sensors.pitch);
        let variance = c.position.powi(2) + lever.powi(2);
        let reach = c.detector.search_sigmas * 1.5 * variance.sqrt();
        let per_metre = camera.focal / c.height;
        let crop = crop(camera, &wanted, margin + reach * per_metre + 8.0);
        let random = self.random.clone();
        AerialCamera::pass_over(&mut self.random);
        let point = self.landmark.reference_in_world(c.ground_down);
        let true_pixel = crop.project(&pose, &point)?;
        let expected = crop.ground_at(&assumed, &true_pixel, c.ground_down)?;
        self.looks += 1;
        Some(DrawnLook {
            day,
            heading,
            attitude_error: unknown[0].hypot(unknown[1]),
            off_centre: (wanted - camera.principal).norm(),
            crop,
            pose,
            assumed,
            variance,
            reach,
            expected,
            random,
        })
    }

    /// Takes the picture of a look and searches it.
    fn see(&mut self, mut look: DrawnLook) -> ViewResult {
        let reach = DRAWN * look.reach;
        let around = self.landmark.bounds.grown(reach);
        let ground = self.ground.part(look.day, &around);
        let c = &self.circumstances;
        let aerial = AerialCamera::new(
            look.crop.clone(),
            AerialCameraSettings {
                mount_vibration_sd: 0.0,
                ..AerialCameraSettings::default()
            },
        );
        let frame = aerial.take(ground.as_ref(), &look.pose, c.ground_down, &mut look.random);
        let luminance = Pyramid::new(frame.picture.to_gray(), PYRAMID_LEVELS);
        let view = FrameView {
            camera: &look.crop,
            pose: look.assumed,
            ground_down: c.ground_down,
            luminance: &luminance,
        };
        let request = SearchRequest {
            landmark: &self.landmark,
            displacement_covariance: Matrix2::identity() * look.variance,
            turn_deviation: c.sensors.yaw,
            log_scale_deviation: c.sensors.height / c.height,
        };
        let sighting = self.detector.detect(&view, &request);
        let error = sighting.best().map(|d| d.ground.distance(&look.expected));
        let near = tolerance(c.height / c.camera.focal);
        let wrong = matches!(sighting, Sighting::Found(_)) && error.is_some_and(|e| e > near);
        let view = ViewResult {
            day: look.day,
            heading: look.heading,
            height: c.height,
            tilt: c.tilt,
            attitude_error: look.attitude_error,
            off_centre: look.off_centre,
            sighting,
            error,
            wrong,
            lasting: self.survival.map(|survival| survival.probability),
        };
        self.views.push(view);
        view
    }

    /// The views so far.
    pub fn views(&self) -> &[ViewResult] {
        &self.views
    }

    /// Expected detection by the views so far; `None` without a view.
    pub fn expected(&self) -> Option<ExpectedDetection> {
        expected(&self.views, self.ground.days())
    }

    /// Detection statistics for a prediction, by the views so far; nothing is expected without a view.
    pub fn statistics(&self) -> DetectionStatistics {
        let Some(expected) = self.expected() else {
            return DetectionStatistics::default();
        };
        DetectionStatistics {
            by_day: LookTally::by_day(&self.views, self.ground.days()),
            ..DetectionStatistics::everywhere(expected)
        }
    }

    /// Share of the views in which a wrong place was accepted.
    pub fn false_matches(&self) -> f64 {
        Rehearsal::false_matches(&self.views)
    }
}

/// Survival of a landmark on maps of another date; `None` if it cannot be rehearsed.
fn lasting(
    landmark: &Landmark,
    map: &dyn Imagery,
    days: &[Arc<dyn Imagery>],
    circumstances: &Circumstances,
) -> Option<Survival> {
    let bounds = &landmark.bounds;
    let lever = circumstances.height * circumstances.sensors.roll.max(circumstances.sensors.pitch);
    let radius = circumstances.detector.search_sigmas * circumstances.position.hypot(lever);
    let radius = radius.max(bounds.width().max(bounds.height()));
    let by = TemplateFeatures::Orientation;
    let days = days
        .iter()
        .map(|day| rehearse(map, day.as_ref(), bounds, radius, by));
    let days: Option<Vec<_>> = days.collect();
    Some(GroundLooks::of(map, bounds).survival(&days?))
}

/// Pseudo-counts of days on which a landmark is found and is not (a Beta prior), in units of days.
///
/// Days are the trials: in 440 of 1,000 passes over places of every quality the landmark was found in no
/// frame, in 505 in nine of ten and more. Their likelihood is flat about it, with its maximum at 0.15
/// and 0.2.
const PRIOR: [f64; 2] = [0.2, 0.2];

/// Expected detection after these views of `days` days.
///
/// The probability is the mean share of the days' views in which the landmark is found, shrunk by
/// [`PRIOR`]. How views of a day go together tells the rest: of the views of a day on which another was
/// successful, the share that are, too, is the probability in a frame of a day on which the landmark is
/// recognised, shrunk by half a success and half a failure (Jeffreys). Where real maps of another date tell how
/// likely a landmark is accepted, that is the probability.
fn expected(views: &[ViewResult], days: usize) -> Option<ExpectedDetection> {
    let lasting = views.first()?.lasting;
    let trials: Vec<(f64, f64)> = LookTally::by_day(views, days)
        .iter()
        .filter(|day| day.looks > 0)
        .map(|day| (day.found as f64, day.looks as f64))
        .collect();
    Some(expectation(&trials, lasting, views))
}

/// Expected detection by trials, such as the days of a landmark: in how many looks of each it was found, and the
/// looks. `lasting` is what real maps of another date tell of the share that is found.
pub(super) fn expectation<'a>(
    trials: &[(f64, f64)],
    lasting: Option<f64>,
    views: impl IntoIterator<Item = &'a ViewResult>,
) -> ExpectedDetection {
    let share: f64 = trials.iter().map(|(found, all)| found / all).sum();
    let [hits, misses] = PRIOR;
    let rehearsed = (share + hits) / (trials.len() as f64 + hits + misses);
    let overall = lasting.unwrap_or(rehearsed);
    let pairs = |f: fn(f64, f64) -> f64| trials.iter().map(|(h, n)| f(*h, *n)).sum::<f64>();
    let (both, one) = (pairs(|h, _| h * (h - 1.0)), pairs(|h, n| h * (n - 1.0)));
    let per_frame = ((both + 0.5) / (one + 1.0)).clamp(overall, 1.0);
    let found: Vec<&ViewResult> = views.into_iter().filter(|v| v.found()).collect();
    let covariances = found.iter().filter_map(|v| v.sighting.best());
    let sum: Matrix4<f64> = covariances.map(|d| d.covariance).sum();
    ExpectedDetection {
        recognised: overall / per_frame,
        per_frame,
        covariance: sum / found.len().max(1) as f64,
    }
}

#[cfg(test)]
#[path = "assess_tests.rs"]
mod tests;
