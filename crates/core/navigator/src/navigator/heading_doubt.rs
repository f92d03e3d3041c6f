//! A compass that is turned, told by landmarks that must be seen and are not.
//!
//! A heading that is wrong by more than a template bears hides every landmark, and carries the estimate off.
//! So where landmark after landmark is missed, whole frames are laid on the map, by any heading. Several of
//! them that agree on one angle between the compass and the map tell by how much it is turned. The flight
//! since the last landmark that was found is then reckoned anew by the heading turned back.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use super::engine::Engine;
use super::frame_registration::{FrameRegistration, RegisteredFrame, measured};
use super::inputs::Inputs;
use super::{CandidateReport, Doubt, Estimate, Instrument, Outcome, SensorFault};
use pilotage_base::frames::wrap_pi;
use pilotage_base::statistics::chi_square_quantile;
use pilotage_estimation::filter::FilterError;
use pilotage_flight::{ChannelName, Flight};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::Pyramid;
use pilotage_vision::landmark::Refusal;
use pilotage_vision::registration::{FollowSettings, InstrumentReadings};

/// Looks for landmarks, all in vain, after which frames are laid. Sound flights at 400 ft have at most 5 of them
/// on end; at 1000 ft, where landmarks are in view for long, 22. So twice as many are borne each time that the
/// heading proved right, and hardly any time is lost by it.
const MISSED: usize = 10;
/// Landmarks and looks for them, all in vain, that contradict the heading even where no frame could tell: sound
/// flights over the built-in scenarios have at most 26 such looks.
const CONTRADICTED: (usize, usize) = (4, 60);
/// Frames that have to agree, and how many are tried at most before the next landmark is found.
const AGREEING: usize = 3;
const TRIED: usize = 8;
/// Time between two frames that are laid, seconds: gusts and the mount shake each otherwise.
const APART: f64 = 0.9;
/// Farthest place that is searched, in standard deviations, metres: what is farther takes many seconds.
const FARTHEST: f64 = 150.0;
/// Standard deviations that a search reaches.
const REACH: f64 = 2.5;
/// Least standard deviation of how the map is stretched and of the logarithm of the height.
const LEAST_STRETCH: f64 = 0.01;

/// A frame that was laid, and what it says of the compass.
struct CompassReading {
    /// Angle by which the compass reads too far clockwise, radians.
    by: f64,
    /// Its variance, rad².
    variance: f64,
}

/// Knowledge of the compass from laid frames and from landmarks that were missed.
pub struct HeadingDoubt {
    frames: Option<FrameRegistration>,
    /// The filter when a landmark was found last, or at the start, and when that was, seconds.
    confirmed: (Box<dyn Engine>, f64),
    /// Way through the air by the heading since then, metres.
    flown: f64,
    /// Looks in vain since then, how many are borne, and the landmarks.
    missed: usize,
    borne: usize,
    landmarks: BTreeSet<u32>,
    readings: Vec<CompassReading>,
    tried: usize,
    last: f64,
    /// Since when the heading is contradicted, by a laid frame or by all that is missed, seconds.
    contradicted: Option<f64>,
    /// Angle by which the heading was turned back in all, radians, and the time since when, seconds.
    turned: Option<(f64, f64)>,
}

/// The compass is turned.
pub struct TurnedCompass {
    /// By how much too far clockwise, radians.
    pub by: f64,
    /// Since when at the latest, seconds.
    pub since: f64,
    /// The filter then.
    pub engine: Box<dyn Engine>,
}

impl HeadingDoubt {
    /// At the start, with the filter as it is at `time` in seconds; without a map nothing can be found out.
    pub fn new(engine: &dyn Engine, time: f64) -> Result<Self, FilterError> {
        Ok(Self {
            frames: None,
            confirmed: (engine.faded(1.0)?, time),
            flown: 0.0,
            missed: 0,
            borne: MISSED,
            landmarks: BTreeSet::new(),
            readings: Vec::new(),
            tried: 0,
            last: f64::NEG_INFINITY,
            contradicted: None,
            turned: None,
        })
    }

    /// With a `map` to lay frames on, as `settings` know the sensors, `height` metres above the ground.
    pub fn over(&mut self, map: Arc<dyn Imagery>, settings: &NavigatorSettings, height: f64) {
        let sensors = &settings.sensors;
        self.frames = Some(FrameRegistration::new(
            map,
            FollowSettings {
                measured_log_height_deviation: (sensors.height / height.max(1.0))
                    .max(LEAST_STRETCH),
                may_be_turned: false,
                tilt_deviation: sensors.roll.max(sensors.pitch),
                slope_deviation: LEAST_STRETCH,
                shape_deviation: LEAST_STRETCH,
                ..FollowSettings::default()
            },
            settings,
        ));
    }

    /// Takes notice of a `way` through the air by the heading, metres.
    pub fn moved(&mut self, way: f64) {
        self.flown += way;
    }

    /// Takes notice of what became of the landmarks of a frame at `time`, after which the filter is `engine`.
    pub fn notice(
        &mut self,
        candidates: &[CandidateReport],
        engine: &dyn Engine,
        time: f64,
    ) -> Result<(), FilterError> {
        if candidates.iter().any(|c| c.outcome == Outcome::Accepted) {
            // A landmark bears a compass that is somewhat off; a frame that told so is not forgotten for it.
            let is_open = self.contradicted.is_some() && self.is_trying();
            return if is_open {
                Ok(())
            } else {
                self.confirm(engine, time)
            };
        }
        for candidate in candidates {
            let Outcome::Refused(refusal) = candidate.outcome else {
                continue;
            };
            // What is not in the picture, or has nothing to be found by, is not missed.
            if !matches!(
                refusal,
                Refusal::OutOfPicture | Refusal::Flat | Refusal::Untrained
            ) {
                self.missed += 1;
                self.landmarks.insert(candidate.landmark);
            }
        }
        if self.landmarks.len() >= CONTRADICTED.0 && self.missed >= CONTRADICTED.1 {
            self.contradicted.get_or_insert(time);
        }
        Ok(())
    }

    /// The heading is right, as far as is known at `time`, when the filter is `engine`.
    pub fn confirm(&mut self, engine: &dyn Engine, time: f64) -> Result<(), FilterError> {
        self.confirmed = (engine.faded(1.0)?, time);
        self.flown = 0.0;
        self.missed = 0;
        self.landmarks.clear();
        self.readings.clear();
        self.tried = 0;
        self.contradicted = None;
        Ok(())
    }

    /// Whether frames are laid, whatever landmarks they show.
    pub fn is_trying(&self) -> bool {
        self.frames.is_some() && self.missed >= self.borne && self.tried < TRIED
    }

    /// Lays frame `index` if the compass is in doubt; what came of it.
    pub fn lay(
        &mut self,
        flight: &Flight,
        inputs: &Inputs,
        index: usize,
        luminance: &Pyramid,
        predicted: &Estimate,
    ) -> Option<RegisteredFrame> {
        let time = flight.frames[index].time;
        let is_read = inputs.doubt(ChannelName::Heading, time).is_none();
        if !(self.is_trying() && is_read && time - self.last >= APART) {
            return None;
        }
        let frames = self.frames.as_mut()?;
        self.last = time;
        self.tried += 1;
        let mut wide = predicted.clone();
        let reach = self.flown / REACH;
        let deviation = (predicted.greatest_variance() + reach * reach)
            .sqrt()
            .min(FARTHEST);
        wide.covariance
            .fixed_view_mut::<2, 2>(0, 0)
            .copy_from(&nalgebra::Matrix2::from_diagonal_element(deviation.powi(2)));
        let measured = InstrumentReadings {
            heading: None,
            ..measured(flight, inputs, time)
        };
        let laid = frames.lay(flight, &measured, index, luminance, &wide);
        frames.learn(&laid);
        Some(laid)
    }

    /// Tests the compass, which reads `heading` radians, by a laid frame: `Some` once enough frames agree
    /// that the compass is turned. The report says that the frame was laid to try the heading.
    pub fn read(
        &mut self,
        laid: &mut RegisteredFrame,
        heading: f64,
        settings: &NavigatorSettings,
    ) -> Result<Option<TurnedCompass>, FilterError> {
        let Some(place) = &laid.report.place else {
            return Ok(None);
        };
        let by = wrap_pi(heading - place.pose.attitude.yaw);
        laid.report.refusal = Some(format!(
            "it was laid to try the heading, which reads {:.0}° to the right of it",
            by.to_degrees()
        ));
        let variance = place.covariance[(5, 5)] + settings.sensors.yaw.powi(2);
        self.readings.push(CompassReading { by, variance });
        let usual = chi_square_quantile(settings.gate_confidence, 1.0);
        let Some((by, variance)) = agreed(&self.readings, settings.gate_confidence) else {
            if by * by > variance * usual {
                self.contradicted.get_or_insert(self.last);
            }
            return Ok(None);
        };
        if by * by <= variance * usual {
            // The heading is right: what is missed is missed for another reason.
            self.contradicted = None;
            self.borne *= 2;
            self.missed = 0;
            self.landmarks.clear();
            self.readings.clear();
            return Ok(None);
        }
        let (engine, since) = (self.confirmed.0.faded(1.0)?, self.confirmed.1);
        let before = self.turned.map_or(0.0, |(before, _)| before);
        self.turned = Some((wrap_pi(before + by), self.last));
        Ok(Some(TurnedCompass { by, since, engine }))
    }

    /// Doubt about the heading, if there is one.
    pub fn doubt(&self) -> Option<Doubt> {
        let (why, since) = match (self.contradicted, self.turned) {
            (Some(since), _) => (SensorFault::Contradicted, since),
            (None, Some((by, since))) => (SensorFault::Turned { by }, since),
            (None, None) => return None,
        };
        Some(Doubt {
            instrument: Instrument::Channel(ChannelName::Heading),
            why,
            since,
        })
    }

    /// Standard deviation of the place per axis that a heading of which nothing is known leaves while it is
    /// contradicted, metres: zero else.
    ///
    /// Whoever flew D through the air by a heading that is any angle δ off is 2 D |sin δ/2| from where he
    /// believes to be; its mean square is 2 D², half of it on each axis.
    pub fn stray(&self) -> f64 {
        self.contradicted.map_or(0.0, |_| self.flown)
    }
}

/// The angle on which the latest readings agree, and its variance, rad².
fn agreed(readings: &[CompassReading], confidence: f64) -> Option<(f64, f64)> {
    let latest = &readings[readings.len().checked_sub(AGREEING)?..];
    let about = latest[0].by;
    let information: f64 = latest.iter().map(|r| r.variance.recip()).sum();
    let weighted = |r: &CompassReading| wrap_pi(r.by - about) / r.variance;
    let mean = latest.iter().map(weighted).sum::<f64>() / information;
    let off = |r: &CompassReading| wrap_pi(r.by - about - mean);
    let squared: f64 = latest.iter().map(|r| off(r).powi(2) / r.variance).sum();
    let is_one = squared <= chi_square_quantile(confidence, (AGREEING - 1) as f64);
    let is_near = latest.iter().all(|r| off(r).abs() < FRAC_PI_2);
    (is_one && is_near).then(|| (wrap_pi(about + mean), information.recip()))
}

/// `flight` with the heading turned back by `by` radians from `since` on, seconds.
pub fn turned_back(flight: &Flight, by: f64, since: f64) -> Flight {
    let mut flight = flight.clone();
    let channels = flight.channels.iter_mut();
    for heading in channels.filter(|channel| channel.name == ChannelName::Heading) {
        let first = heading.times.partition_point(|time| *time <= since);
        for value in &mut heading.values[first..] {
            *value = wrap_pi(*value - by);
        }
    }
    flight
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Point2};

    use super::super::engine::engine;
    use super::super::flight_for_tests::flight_of;
    use super::*;
    use pilotage_base::frames::{Attitude, GroundPoint, GroundRect};
    use pilotage_estimation::vehicle::{ControlInput, Multirotor};
    use pilotage_flight::Channel;
    use pilotage_mission::settings::VehicleChoice;

    fn readings(degrees: &[f64]) -> Vec<CompassReading> {
        let reading = |by: &f64| CompassReading {
            by: by.to_radians(),
            variance: 1_f64.to_radians().powi(2),
        };
        degrees.iter().map(reading).collect()
    }

    #[test]
    fn three_frames_that_agree_tell_the_angle_and_two_or_torn_ones_do_not() {
        assert!(agreed(&readings(&[20.0, 21.0]), 0.997).is_none());
        assert!(agreed(&readings(&[20.0, 40.0, 21.0]), 0.997).is_none());
        let (by, variance) = agreed(&readings(&[50.0, 20.0, 22.0, 21.0]), 0.997).unwrap();
        assert!((by.to_degrees() - 21.0).abs() < 1e-9, "{by}");
        assert!((variance.sqrt().to_degrees() - 1.0 / 3_f64.sqrt()).abs() < 1e-9);
        let (by, _) = agreed(&readings(&[179.0, -179.0, 180.0]), 0.997).unwrap();
        assert!((by.abs().to_degrees() - 180.0).abs() < 1e-9, "{by}");
    }
    /// Ten seconds at 18 m/s on heading 30°.
    fn flight() -> Flight {
        let times: Vec<f64> = (0..=20).map(|i| 0.5 * f64::from(i)).collect();
        let channel = |name, value| Channel {
            name,
            values: vec![value; times.len()],
            times: times.clone(),
        };
        flight_of(vec![
            channel(ChannelName::Airspeed, 18.0),
            channel(ChannelName::Heading, 30_f64.to_radians()),
        ])
    }

    #[test]
    fn a_heading_is_turned_back_from_the_time_on_when_it_was_right_last() {
        let flight = turned_back(&flight(), 20_f64.to_radians(), 4.0);
        let heading = |time| {
            flight
                .value(ChannelName::Heading, time)
                .unwrap()
                .to_degrees()
        };
        assert!((heading(4.0) - 30.0).abs() < 1e-9 && (heading(4.5) - 10.0).abs() < 1e-9);
        assert_eq!(flight.value(ChannelName::Airspeed, 9.0), Some(18.0));
    }

    #[test]
    fn landmarks_missed_again_and_again_contradict_the_heading_until_one_is_found() {
        let settings = NavigatorSettings::default();
        let engine = engine(&settings, GroundPoint::default(), 3.0).unwrap();
        let mut doubt = HeadingDoubt::new(engine.as_ref(), 0.0).unwrap();
        let missed: Vec<CandidateReport> = (0..5).map(|id| candidate(id, false)).collect();
        for second in 0..12 {
            assert!(doubt.doubt().is_none());
            assert!(!doubt.is_trying(), "there is no map");
            doubt
                .notice(&missed, engine.as_ref(), f64::from(second))
                .unwrap();
        }
        assert_eq!(doubt.doubt().unwrap().why, SensorFault::Contradicted);
        // Ten seconds without an airspeed: 18 m/s are assumed.
        let level = ControlInput::without_airspeed(Attitude::level(0.5));
        for _ in 0..10 {
            doubt.moved(engine.speed_by_heading(&level));
        }
        assert!((doubt.stray() - 180.0).abs() < 1e-9, "{}", doubt.stray());
        doubt
            .notice(&[candidate(1, true)], engine.as_ref(), 10.0)
            .unwrap();
        assert!(doubt.doubt().is_none() && doubt.stray() == 0.0);
    }

    #[test]
    fn only_vehicles_that_fly_by_their_heading_stray_by_it() {
        let speed = |vehicle, input: &ControlInput| {
            let settings = NavigatorSettings {
                vehicle,
                ..NavigatorSettings::default()
            };
            let mut engine = engine(&settings, GroundPoint::default(), 3.0).unwrap();
            engine.predict(input, 100.0).unwrap();
            engine.speed_by_heading(input)
        };
        let read = ControlInput::new(20.0, Attitude::level(0.5));
        let airplane = speed(VehicleChoice::AirplaneWind, &read);
        assert!((airplane - 20.0).abs() < 1e-9, "{airplane}");
        assert_eq!(speed(VehicleChoice::ConstantVelocity, &read), 0.0);
        let moved = ControlInput {
            ground_velocity: Some(nalgebra::Vector2::new(3.0, 0.0)),
            ..read
        };
        assert_eq!(speed(VehicleChoice::VelocityDriven, &moved), 0.0);
        // Nose down by 5°: 9.81 tan 5° against its drag.
        let tilted = ControlInput::without_airspeed(Attitude {
            pitch: -5_f64.to_radians(),
            ..Attitude::level(0.5)
        });
        let multirotor = speed(VehicleChoice::Multirotor, &tilted);
        let drag = Multirotor::default().drag;
        assert!((multirotor * drag - 0.858).abs() < 2e-3, "{multirotor}");
    }

    fn candidate(landmark: u32, is_found: bool) -> CandidateReport {
        CandidateReport {
            landmark,
            predicted_pixel: Point2::origin(),
            innovation_covariance: Matrix2::identity(),
            search_region: GroundRect::centered(GroundPoint::default(), 1.0, 1.0),
            search_outline: Vec::new(),
            measured_pixel: None,
            rotation: None,
            log_scale: None,
            measurement_covariance: None,
            score: 0.2,
            second_score: 0.1,
            probability: None,
            turn_and_size: [0.02, 0.01],
            innovation: None,
            nis: None,
            threshold: 16.0,
            outcome: if is_found {
                Outcome::Accepted
            } else {
                Outcome::Refused(Refusal::LowScore)
            },
        }
    }
}
