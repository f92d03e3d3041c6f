//! The navigator: one call a step.

mod aiding;
mod doubts;
mod laying;

use std::cell::LazyCell;
use std::sync::Arc;

use nalgebra::DVector;

use super::aids::{Aid, AidError, AidInfo, chosen};
use super::engine::{Engine, engine};
use super::expected::AppearanceModel;
use super::frame_registration::FrameRegistration;
use super::heading_doubt::HeadingDoubt;
use super::inputs::Inputs;
use super::known_ground::KnownGround;
use super::looks::LooksAtLandmarks;
use super::observation::Observation;
use super::onlooker::Onlooker;
use super::picture_lag::PictureLag;
use super::possible_places::PossiblePlaces;
use super::recovery::{Recovery, RecoveryVerdict, reconsider};
use super::see::{Associator, Measurement, observation};
use super::ticks::{Tick, ticks};
use super::{
    CandidateReport, Control, FrameReport, JointReport, Outcome, Run, SigmaSets, StepReport,
    StepTiming,
};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_estimation::filter::{FilterError, GateReason, Verdict};
use pilotage_flight::{ChannelName, Flight, FrameSource};
use pilotage_mission::settings::{ChosenAid, Cruise, NavigatorSettings};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::{PYRAMID_LEVELS, Picture, Pyramid};
use pilotage_vision::landmark::{ChosenDetector, Detector, Landmark, Refusal};

/// Why navigation cannot begin or go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NavigatorError {
    /// The flight lacks something.
    #[error("flight \"{flight}\" has no {what}; {remedy}")]
    Missing {
        /// Name of the flight.
        flight: String,
        /// Part that the flight lacks.
        what: String,
        /// Remedy to propose.
        remedy: String,
    },
    /// An aid cannot be switched on.
    #[error(transparent)]
    Aid(#[from] AidError),
    /// The filter cannot go on.
    #[error("the filter stopped at {time:.2} s: {cause}")]
    Filter {
        /// Time of the step, seconds.
        time: f64,
        /// Error of the filter.
        cause: FilterError,
    },
}

/// A picture that was looked at, with what of its landmarks corrected the estimate.
type SeenPicture = (Picture, Option<Observation<'static>>);

/// Runs a flight through the estimator, one step a call.
pub struct Navigator {
    flight: Arc<Flight>,
    inputs: Inputs,
    landmarks: Vec<Landmark>,
    settings: NavigatorSettings,
    engine: Box<dyn Engine>,
    recovery: Option<Recovery>,
    /// Estimate of the pictures' lag; none where whole frames are laid.
    lag: Option<PictureLag>,
    /// Knowledge of a turned compass; none where whole frames are laid.
    heading: Option<HeadingDoubt>,
    detector: Box<dyn Detector>,
    whole_frames: Option<FrameRegistration>,
    /// Other places at which the aircraft may be; only whole frames tell.
    possible: PossiblePlaces,
    /// Looks at landmarks that were taken in.
    looks: LooksAtLandmarks,
    /// Aids beside pictures.
    aids: Vec<Box<dyn Aid>>,
    ticks: Vec<Tick>,
    next: usize,
    time: f64,
    unaided: DVector<f64>,
    sparing: bool,
}

impl Navigator {
    /// Prepares to navigate `flight` by what is known of the `ground`, each landmark found by the detector that was
    /// chosen for it.
    ///
    /// ```
    /// # use std::sync::Arc;
    /// # use pilotage_base::frames::GroundPoint;
    /// # use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
    /// # use pilotage_raster::camera::CameraModel;
    /// # use pilotage_flight::NoPictures;
    /// # use pilotage_mission::settings::NavigatorSettings;
    /// use pilotage_navigator::navigator::{KnownGround, Navigator};
    /// # use pilotage_raster::imagery::Blank;
    /// # let channel = |name, mean: f64, by: f64| Channel {
    /// #     name,
    /// #     times: (0..=50).map(|i| 0.2 * f64::from(i)).collect(),
    /// #     values: (0..=50).map(|i| if i % 2 == 0 { mean + by } else { mean - by }).collect(),
    /// # };
    /// # let flight = Flight {
    /// #     name: "eastward".to_owned(),
    /// #     frame_on_globe: None,
    /// #     camera: CameraModel::pinhole(640, 480, 1.0),
    /// #     ground_down: 0.0,
    /// #     channels: vec![
    /// #         channel(ChannelName::Airspeed, 20.0, 0.1),
    /// #         channel(ChannelName::Heading, 90_f64.to_radians(), 0.001),
    /// #     ],
    /// #     frames: Vec::new(),
    /// #     start: StartFix { time: 0.0, position: GroundPoint::new(0.0, 0.0), standard_deviation: 3.0 },
    /// #     truth: None,
    /// # };
    ///
    /// // 20 m/s towards the east for ten seconds, without pictures, in a wind of 4 m/s or so.
    /// let settings = NavigatorSettings::default();
    /// let ground = KnownGround::new(Arc::new(Blank));
    /// let navigator = Navigator::new(Arc::new(flight), &ground, &settings)?;
    /// let run = navigator.fly(&mut NoPictures, &|| 0.0)?;
    /// let last = run.step_at(10.0).ok_or("no step")?;
    /// assert!(last.after.position().distance(&GroundPoint::new(0.0, 200.0)) < 1.0);
    /// assert!((40.0..44.0).contains(&last.after.greatest_variance().sqrt()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        flight: Arc<Flight>,
        ground: &KnownGround,
        settings: &NavigatorSettings,
    ) -> Result<Self, NavigatorError> {
        let settings = &settings.clone().for_camera_of(&flight);
        let map = Arc::clone(&ground.map);
        let landmarks = &ground.landmarks;
        let detector = ChosenDetector::new(Arc::clone(&map), settings.detector, landmarks);
        let mut navigator = Self::prepare(
            flight,
            landmarks,
            Box::new(detector),
            settings,
            Some(ground),
        )?;
        if let Some(assumed) = settings.whole_frames {
            let frames = FrameRegistration::new(map, assumed, &navigator.settings);
            navigator.whole_frames = Some(frames);
        } else if let Some(heading) = &mut navigator.heading {
            let height = Control::of(&navigator.flight, navigator.time).height;
            heading.over(map, &navigator.settings, height);
        }
        Ok(navigator)
    }

    /// As [`Navigator::new`], with another detector, and with nothing known of the ground but landmarks.
    pub fn with_detector(
        flight: Arc<Flight>,
        landmarks: &[Landmark],
        detector: Box<dyn Detector>,
        settings: &NavigatorSettings,
    ) -> Result<Self, NavigatorError> {
        Self::prepare(flight, landmarks, detector, settings, None)
    }

    fn prepare(
        flight: Arc<Flight>,
        landmarks: &[Landmark],
        detector: Box<dyn Detector>,
        settings: &NavigatorSettings,
        ground: Option<&KnownGround>,
    ) -> Result<Self, NavigatorError> {
        settings.check().map_err(|cause| NavigatorError::Filter {
            time: flight.start.time,
            cause,
        })?;
        let is_found_by_frames = settings.whole_frames.is_some();
        let sees = |aid: &ChosenAid| AidInfo::named(&aid.key).is_ok_and(AidInfo::sees);
        let looks = !landmarks.is_empty() || settings.aids.iter().any(sees);
        for (name, remedy, is_needed) in [
            (
                ChannelName::Heading,
                "give it one, or lay whole pictures on a map by a vehicle model without airspeed",
                settings.vehicle.needs_heading() || !is_found_by_frames,
            ),
            (
                ChannelName::HeightAboveGround,
                "give it one, or lay whole pictures on a map",
                !is_found_by_frames && looks,
            ),
        ] {
            let has_none = flight.channel(name).is_none_or(|c| c.times.is_empty());
            if is_needed && has_none {
                return Err(NavigatorError::Missing {
                    flight: flight.name.clone(),
                    what: format!("readings of channel {}", name.key()),
                    remedy: remedy.to_owned(),
                });
            }
        }
        let inputs = Inputs::of(&flight);
        let mut settings = settings.clone().for_camera_of(&flight);
        settings.sensors = settings.sensors.with_biases_within();
        if let Some((airspeed, deviation)) = inputs.cruise() {
            settings.process.cruise = Cruise {
                airspeed,
                deviation,
            };
        }
        let start = flight.start;
        let [north, east] = settings.start.offset;
        let position = GroundPoint::new(start.position.north + north, start.position.east + east);
        let deviation = start.standard_deviation.max(settings.start.position);
        let engine =
            engine(&settings, position, deviation).map_err(|cause| NavigatorError::Filter {
                time: start.time,
                cause,
            })?;
        let unaided = engine.state().mean;
        let (lag, heading) = if is_found_by_frames {
            (None, None)
        } else {
            (
                PictureLag::new(engine.as_ref()).ok(),
                HeadingDoubt::new(engine.as_ref(), start.time).ok(),
            )
        };
        let aids = chosen(&settings.aids, &flight, ground)?;
        let read: Vec<_> = aids
            .iter()
            .filter_map(|aid| aid.info().channels.first())
            .copied()
            .collect();
        let ticks = ticks(&flight, settings.shortest_step, &read);
        Ok(Self {
            inputs,
            landmarks: landmarks.to_vec(),
            settings,
            engine,
            recovery: None,
            lag,
            heading,
            detector,
            whole_frames: None,
            possible: PossiblePlaces::new(),
            looks: LooksAtLandmarks::default(),
            aids,
            ticks,
            next: 0,
            time: start.time,
            unaided,
            sparing: false,
            flight,
        })
    }

    /// Asks only for pictures in which a landmark may lie: for studies of many flights, whose pictures
    /// nobody looks at. What cannot be read where there is nothing to see is not told then.
    #[must_use]
    pub fn sparing(mut self) -> Self {
        self.sparing = true;
        self
    }

    /// Takes all instruments for sound: thinks neither of late pictures nor of a turned compass. For studies of many
    /// flights whose instruments are known to be.
    #[must_use]
    pub fn trusting(mut self) -> Self {
        self.lag = None;
        self.heading = None;
        self
    }

    /// The run without its steps.
    pub fn run_head(&self) -> Run {
        Run {
            name: self.flight.name.clone(),
            settings: self.settings.clone(),
            landmarks: self.landmarks.clone(),
            state_names: self.engine.components(),
            steps: Vec::new(),
        }
    }

    /// Steps done, and steps in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.next, self.ticks.len())
    }

    /// Index of the frame of the next step, if it has one.
    pub fn next_frame(&self) -> Option<usize> {
        self.ticks.get(self.next)?.frame
    }

    /// Takes the next step; `None` when the flight is over.
    ///
    /// `stopwatch` gives milliseconds of any clock that never goes back.
    pub fn advance(
        &mut self,
        frames: &mut dyn FrameSource,
        stopwatch: &dyn Fn() -> f64,
    ) -> Option<Result<StepReport, NavigatorError>> {
        let tick = *self.ticks.get(self.next)?;
        self.next += 1;
        let step = self.step(tick, frames, stopwatch);
        if step.is_err() {
            self.next = self.ticks.len();
        }
        Some(step.map_err(|cause| NavigatorError::Filter {
            time: tick.time,
            cause,
        }))
    }

    /// Takes all steps that are left; the run of them.
    ///
    /// `stopwatch` gives milliseconds of any clock that never goes back.
    ///
    /// # Errors
    /// A step that the filter cannot take.
    pub fn fly(
        mut self,
        frames: &mut dyn FrameSource,
        stopwatch: &dyn Fn() -> f64,
    ) -> Result<Run, NavigatorError> {
        let mut run = self.run_head();
        while let Some(step) = self.advance(frames, stopwatch) {
            run.steps.push(step?);
        }
        Ok(run)
    }

    fn step(
        &mut self,
        tick: Tick,
        frames: &mut dyn FrameSource,
        stopwatch: &dyn Fn() -> f64,
    ) -> Result<StepReport, FilterError> {
        let begun = stopwatch();
        let time = tick.time;
        // A first reading may be taken for one at the start and come just before it.
        let dt = (time - self.time).max(0.0);
        let input = self.inputs.between(&self.flight, self.time, time);
        let control = Control::of(&self.flight, time);
        if let Some(lag) = &mut self.lag {
            if lag.replace(&mut self.engine, self.time) {
                self.recovery = None;
            }
            lag.predict(&input, dt);
        }
        let predicted = self.engine.predict(&input, dt)?;
        self.recovery = self.recovery.take().and_then(|s| s.moved(&input, dt));
        self.possible.moved(&input, dt);
        self.unaided = self.engine.dead_reckon(&self.unaided, &input, dt);
        if let Some(heading) = &mut self.heading {
            heading.moved(self.engine.speed_by_heading(&input) * dt);
        }
        self.time = self.time.max(time);
        let mut report = StepReport {
            time,
            dt,
            control,
            before: predicted.before,
            after: predicted.after.clone(),
            predicted: predicted.after,
            sigma: SigmaSets {
                before_predict: predicted.sigma_before,
                after_predict: predicted.sigma_after,
                before_correct: None,
                after_correct: None,
            },
            dead_reckoned: GroundPoint::new(self.unaided[0], self.unaided[1]),
            doubts: self.inputs.doubts(time),
            frame: None,
            timing: StepTiming {
                predict: stopwatch() - begun,
                see: 0.0,
                update: 0.0,
            },
            updates: Vec::new(),
            sightings: Vec::new(),
        };
        let seen = self.take_frame(tick, frames, &mut report, stopwatch)?;
        if !self.aids.is_empty() {
            let begun = stopwatch();
            self.take_aids(time - dt, tick.frame.zip(seen), &mut report)?;
            report.timing.update += stopwatch() - begun;
        }
        self.conclude(&mut report);
        Ok(report)
    }

    /// Looks at the frame of a step, if it has one; its picture, if that could be looked at, with what of its landmarks
    /// corrected the estimate.
    fn take_frame(
        &mut self,
        tick: Tick,
        frames: &mut dyn FrameSource,
        report: &mut StepReport,
        stopwatch: &dyn Fn() -> f64,
    ) -> Result<Option<SeenPicture>, FilterError> {
        let time = tick.time;
        if let Some(index) = tick.frame {
            self.looks.forget(time);
            self.look_back(index);
            let trouble = self.blindness(time);
            let trouble = if trouble.is_some() {
                trouble
            } else if !self.sparing || self.is_laying() || self.aids_see() || self.may_see(index) {
                match frames.picture(index) {
                    Ok(picture) => {
                        let landmarks = self.look(index, &picture, report, stopwatch)?;
                        // Where the frame was laid after all, the estimate may have begun anew.
                        let is_laid = report.frame.as_ref().is_some_and(|f| f.laid.is_some());
                        return Ok(Some((picture, landmarks.filter(|_| !is_laid))));
                    }
                    Err(trouble) => Some(trouble.to_string()),
                }
            } else {
                None
            };
            report.frame = Some(self.blind(index, trouble));
        }
        Ok(None)
    }

    /// Why no landmark can be looked for at `time`, if so: nobody knows how the camera looks at the ground.
    fn blindness(&self, time: f64) -> Option<String> {
        let needed = [
            ChannelName::Heading,
            ChannelName::HeightAboveGround,
            ChannelName::Roll,
            ChannelName::Pitch,
        ];
        let doubt = needed
            .into_iter()
            .find_map(|name| self.inputs.doubt(name, time))
            .filter(|_| self.whole_frames.is_none())?;
        Some(format!(
            "{}, so that nobody knows where the camera looks",
            doubt.words()
        ))
    }

    /// Appearance model of a picture that comes now.
    fn appearance_model<'a>(&self, camera: &'a CameraModel) -> AppearanceModel<'a> {
        let lag = self.lag.as_ref().map_or(0.0, PictureLag::assumed);
        let control = Control::of(&self.flight, self.time - lag);
        AppearanceModel::of(&self.flight, camera, &control)
    }

    /// Whether any landmark may lie in frame `index`.
    fn may_see(&self, index: usize) -> bool {
        let camera = self.flight.camera_of_frame(index);
        let model = self.appearance_model(&camera);
        let looked = (index, &self.looks);
        let associator = Associator::new(&self.settings, self.engine.as_ref(), model, looked);
        !associator.candidates(&self.landmarks).is_empty()
    }

    fn blind(&self, index: usize, trouble: Option<String>) -> FrameReport {
        let camera = self.flight.camera_of_frame(index);
        let model = self.appearance_model(&camera);
        let pose = model.pose(self.engine.seen_from(), self.engine.heading_bias());
        FrameReport {
            index,
            assumed_pose: pose,
            footprint: footprint(&model, &pose),
            candidates: Vec::new(),
            joint: None,
            laid: None,
            trouble,
        }
    }

    /// See, associate, gate, update; the observation by which it did.
    fn look(
        &mut self,
        index: usize,
        picture: &Picture,
        report: &mut StepReport,
        stopwatch: &dyn Fn() -> f64,
    ) -> Result<Option<Observation<'static>>, FilterError> {
        let begun = stopwatch();
        let luminance = LazyCell::new(|| Pyramid::new(picture.to_gray(), PYRAMID_LEVELS));
        if self.whole_frames.is_some() && self.lay(index, &luminance, report, begun, stopwatch)? {
            return Ok(None);
        }
        let camera = self.flight.camera_of_frame(index);
        let model = self.appearance_model(&camera);
        let looked = (index, &self.looks);
        let associator = Associator::new(&self.settings, self.engine.as_ref(), model, looked);
        let (pose, candidates) = (associator.pose, associator.candidates(&self.landmarks));
        let mut reports: Vec<CandidateReport> = Vec::with_capacity(candidates.len());
        let mut measurements: Vec<Measurement<'_>> = Vec::new();
        let (mut found, mut doubtful, mut refused) = (Vec::new(), Vec::new(), Vec::new());
        for (landmark, mut candidate) in candidates {
            let place =
                associator.look(landmark, &mut candidate, &luminance, self.detector.as_mut());
            let is_doubtful = candidate.outcome == Outcome::Refused(Refusal::LookAlike);
            let number = reports.len();
            match place {
                Some(place) if is_doubtful => doubtful.push((landmark, number, place)),
                Some(place) => {
                    found.push((landmark, number, place));
                    match associator.judge(landmark, &mut candidate, number, place) {
                        Some(measurement) => measurements.push(measurement),
                        None => refused.push((landmark, number, place)),
                    }
                }
                None => {}
            }
            reports.push(candidate);
        }
        let seen = stopwatch();
        if let Some(lag) = &mut self.lag {
            let onlooker = Onlooker {
                flight: &self.flight,
                inputs: &self.inputs,
                camera: &camera,
                time: self.time,
            };
            lag.weigh(&associator, &onlooker, &found, &reports)?;
        }
        let agreed = associator.agree(measurements, &mut reports)?;
        let mut agreed = associator.confirm(agreed, doubtful, &mut reports)?;
        let mut recovered = None;
        if agreed.0.is_empty() {
            let recovery = self.recovery.take();
            match reconsider(recovery, &associator, &refused, &mut reports) {
                RecoveryVerdict::Unsure(recovery) => self.recovery = recovery,
                RecoveryVerdict::TakesOver {
                    engine,
                    fading,
                    step,
                    agreed: others,
                } => {
                    self.engine = engine;
                    if let Some(step) = step {
                        report.begun_by(step);
                    }
                    report.predicted = self.engine.state();
                    agreed = others;
                    recovered = Some(fading);
                }
            }
        } else {
            self.recovery = None;
        }
        let ((agreed, nis, threshold), mut joint, mut taken) = (agreed, None, None);
        if !agreed.is_empty() {
            let seen = observation(&self.settings, &agreed, &model, &pose);
            let step = seen.correct(self.engine.as_mut())?;
            self.possible = PossiblePlaces::new();
            let verdict = Verdict {
                accepted: true,
                nis,
                threshold,
                dof: seen.degrees,
                reason: GateReason::WithinExpectation,
            };
            joint = Some(JointReport::of(&verdict, &step, recovered));
            self.looks
                .note(agreed.iter().map(|seen| seen.landmark.id), self.time);
            report.corrected_by(report.predicted.clone(), step);
            taken = Some(seen);
        }
        let is_looked_for = !reports.is_empty();
        report.frame = Some(FrameReport {
            index,
            assumed_pose: pose,
            footprint: footprint(&model, &pose),
            candidates: reports,
            joint,
            laid: report.frame.take().and_then(|frame| frame.laid),
            trouble: None,
        });
        report.timing.see = seen - begun;
        report.timing.update = stopwatch() - seen;
        if is_looked_for || self.is_laying() {
            self.try_heading(index, &luminance, report)?;
        }
        Ok(taken)
    }
}

/// Outline of the picture that a camera at `pose` takes, on the ground.
fn footprint(model: &AppearanceModel<'_>, pose: &Pose) -> Vec<GroundPoint> {
    let (w, h) = (model.camera.width as f64, model.camera.height as f64);
    [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)]
        .into_iter()
        .filter_map(|(x, y)| {
            model
                .camera
                .ground_at(pose, &nalgebra::Point2::new(x, y), model.ground_down)
        })
        .collect()
}

#[cfg(test)]
#[path = "pipeline/step_tests.rs"]
mod step_tests;

#[cfg(test)]
#[path = "pipeline/mount_tests.rs"]
mod mount_tests;
