//! Whole frames laid on the map, as a measurement of the position.
//!
//! A frame laid on the map says itself how likely chance would have laid it so. Where its place lies outside
//! the filter's gate, one of the two is wrong, and the likelier one gives way: the frame if chance explains
//! it more readily than the filter's own distribution explains such an innovation, else the filter, whose
//! covariance is faded as much as makes the innovation likeliest ([`fading_factor`]).

use std::sync::Arc;

use nalgebra::{DMatrix, Matrix2, Vector2, dvector};

use super::engine::{CorrectedStep, Engine, MeasurementModel, place_in_state};
use super::found_places::{FoundPlaces, SearchedRegion};
use super::inputs::Inputs;
use super::observation::{GaussianInnovation, Observation};
use super::place_on_map::PlaceOnMap;
use super::tilt::LastingTilt;
use super::{Estimate, JointReport, RegisteredPlace, RegistrationRefusal, RegistrationReport};
use pilotage_base::frames::{GroundPoint, wrap_pi};
use pilotage_estimation::filter::{FilterError, Gate, Verdict, fading_factor};
use pilotage_estimation::vehicle::{Kinematics, StateComponent};
use pilotage_flight::{ChannelName, Flight};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::Pyramid;
use pilotage_vision::registration::{
    CameraPlace, FollowSettings, Follower, FrameLook, FrameSighting, InstrumentReadings,
    NotRegistered, Registration, RegistrationMethod, outline, sight,
};

/// Numbers of a place: north and east.
const COMPONENTS: usize = 2;

/// Lays one frame after the other.
pub struct FrameRegistration {
    map: Arc<dyn Imagery>,
    follower: Follower,
    tilt: LastingTilt,
    on_map: PlaceOnMap,
    /// Place of the heading's bias in the state of the filter, if it is one.
    heading_bias: Option<usize>,
}

/// A frame, laid or not.
pub struct RegisteredFrame {
    pub report: RegistrationReport,
    /// Outline of the picture on the map.
    pub footprint: Vec<GroundPoint>,
    /// Everywhere that it may lie, as far as it was looked for.
    pub found: FoundPlaces,
    /// Registration of the frame for itself.
    registered: Option<Registration>,
}

/// Effect of a frame that was believed.
pub struct Believed {
    /// The belief that it corrected.
    pub predicted: Estimate,
    pub step: CorrectedStep,
    pub joint: JointReport,
}

impl FrameRegistration {
    /// Over a map, assuming that of the flight, for a filter with these settings.
    pub fn new(
        map: Arc<dyn Imagery>,
        assumed: FollowSettings,
        settings: &NavigatorSettings,
    ) -> Self {
        Self {
            map,
            follower: Follower::new(assumed),
            tilt: LastingTilt::of(settings),
            on_map: PlaceOnMap::of(settings, assumed.map_deviation),
            heading_bias: place_in_state(settings, StateComponent::HeadingBias),
        }
    }

    /// Region of the map in which a frame is looked for where this is believed, whatever the settings allow.
    pub fn around(&self, believed: &Estimate) -> SearchedRegion {
        SearchedRegion::around(believed, &self.on_map)
    }

    /// A picture taken by `camera` over the map.
    fn look<'a>(
        &'a self,
        camera: &'a CameraModel,
        ground_down: f64,
        luminance: &'a Pyramid,
    ) -> FrameLook<'a> {
        FrameLook {
            camera,
            ground_down,
            luminance,
            map: self.map.as_ref(),
        }
    }

    /// Lays frame `index` on the map around where the aircraft is believed to be, by what is `measured`.
    pub fn lay(
        &self,
        flight: &Flight,
        measured: &InstrumentReadings,
        index: usize,
        luminance: &Pyramid,
        predicted: &Estimate,
    ) -> RegisteredFrame {
        let time = flight.frames[index].time;
        let camera = flight.camera_of_frame(index);
        let look = self.look(&camera, flight.ground_down, luminance);
        let tilt_biases = self.tilt.biases(predicted);
        let [roll, pitch] = [measured.roll, measured.pitch].map(Option::unwrap_or_default);
        let heading_bias = self.heading_bias.map_or(0.0, |i| predicted.mean[i]);
        let corrected = InstrumentReadings {
            heading: measured.heading.map(|h| wrap_pi(h - heading_bias)),
            roll: Some(roll - tilt_biases[0]),
            pitch: Some(pitch - tilt_biases[1]),
            ..*measured
        };
        let mut searched = self.around(predicted);
        let (height, _) = self.follower.height(time, measured);
        // A tilt that is wrong moves what is seen by the height times it.
        let by_tilt = height * self.tilt.variance(predicted).sqrt();
        searched.deviation = searched.deviation.hypot(by_tilt);
        let prior = self
            .follower
            .prior(time, searched.position, searched.deviation, &corrected);
        // No farther than the settings allow.
        searched.deviation = prior.position_deviation;
        let FrameSighting { verdict, places } = sight(&look, &prior);
        let (report, footprint) = match &verdict {
            Ok(found) => told(&look, found),
            Err(cause) => (not_laid(cause), Vec::new()),
        };
        RegisteredFrame {
            report,
            footprint,
            registered: verdict.ok(),
            found: FoundPlaces {
                time,
                ground_down: flight.ground_down,
                searched,
                prior,
                tilt_biases,
                tilt: self.tilt,
                on_map: self.on_map,
                places,
            },
        }
    }

    /// Remembers what a frame taught that was laid for itself.
    pub fn learn(&mut self, laid: &RegisteredFrame) {
        if let Some(found) = &laid.registered {
            let FoundPlaces {
                time,
                ground_down,
                prior,
                ..
            } = laid.found;
            self.follower.learn(time, ground_down, &prior, found);
        }
    }

    /// Follower, with what the frames have taught so far.
    pub fn follower(&self) -> &Follower {
        &self.follower
    }

    /// Goes on by what other frames have taught.
    pub fn go_on_by(&mut self, follower: Follower) {
        self.follower = follower;
    }

    /// Report of frame `index` when it lies at `place`, and its outline on the map.
    pub fn laid_at(
        &self,
        flight: &Flight,
        index: usize,
        luminance: &Pyramid,
        place: &Registration,
    ) -> (RegistrationReport, Vec<GroundPoint>) {
        let camera = flight.camera_of_frame(index);
        let look = self.look(&camera, flight.ground_down, luminance);
        told(&look, place)
    }
}

/// Report of a frame that lies at `place`, and its outline on the map.
fn told(look: &FrameLook<'_>, place: &Registration) -> (RegistrationReport, Vec<GroundPoint>) {
    let outline = outline(look, &place.fit.at, place.stored_turn);
    (report(place), outline)
}

/// Readings at `time` of those of the flight's own instruments that are believed then.
pub fn measured(flight: &Flight, inputs: &Inputs, time: f64) -> InstrumentReadings {
    let is_believed = |name| inputs.doubt(name, time).is_none();
    let value = |name| flight.value(name, time).filter(|_| is_believed(name));
    InstrumentReadings {
        heading: value(ChannelName::Heading),
        roll: value(ChannelName::Roll),
        pitch: value(ChannelName::Pitch),
        height: value(ChannelName::HeightAboveGround).filter(|height| *height > 0.0),
    }
}

impl From<&Registration> for RegisteredPlace {
    fn from(found: &Registration) -> Self {
        Self {
            pose: found.camera.pose,
            covariance: found.camera.covariance,
            centre: found.centre,
            centre_covariance: found.centre_covariance,
            matches: found.matches.iter().map(|m| (m.pixel, m.ground)).collect(),
            stored_turn: found.stored_turn,
            shape: found.fit.at.shape,
        }
    }
}

fn report(found: &Registration) -> RegistrationReport {
    RegistrationReport {
        place: Some(found.into()),
        refusal: None,
        refused_as: None,
        laid_by: found.laid_by,
        probability: Some(found.probability),
        tried: found.tried,
        log_false_alarms: found.log_false_alarms,
    }
}

fn not_laid(cause: &NotRegistered) -> RegistrationReport {
    RegistrationReport {
        place: None,
        refusal: Some(cause.to_string()),
        refused_as: Some(RegistrationRefusal::from(cause)),
        laid_by: RegistrationMethod::default(),
        tried: 0,
        log_false_alarms: 0.0,
        probability: Some(cause.probability()),
    }
}

/// The place of a frame as an observation of the position on the map, judged.
pub struct SeenPlace {
    observation: Observation<'static>,
    innovation: GaussianInnovation,
    verdict: Verdict,
}

impl SeenPlace {
    /// Innovation of `place` against what `engine` expects.
    pub fn by(
        settings: &NavigatorSettings,
        engine: &dyn Engine,
        found: &FoundPlaces,
        place: &Registration,
    ) -> Result<Self, FilterError> {
        let CameraPlace { pose, by_tilt, .. } = place.camera;
        let position = pose.position_in_world;
        // A map's error that is a state of the filter is no noise of its measurements.
        let of_map = Matrix2::identity() * found.on_map.beyond_state();
        let of_tilt = found.tilt.variance_of_noise() * by_tilt * by_tilt.transpose();
        let own = found.told(place) + of_map + of_tilt;
        let assumed = Vector2::from(found.tilt_biases);
        let on_map = move |seen: &Kinematics| {
            let biases = seen.tilt_bias.map_or(assumed, Vector2::from);
            // The truth is smaller than a reading with a bias, and the camera is elsewhere by it.
            let place = seen.on_map.to_vector() + by_tilt * (biases - assumed);
            Some(dvector![place.x, place.y])
        };
        let observation = Observation {
            measured: dvector![position.x, position.y],
            noise: DMatrix::from_fn(COMPONENTS, COMPONENTS, |i, j| {
                settings.measurement_scale * own[(i, j)]
            }),
            weakened: None,
            model: MeasurementModel::of_pose(on_map),
            degrees: COMPONENTS,
            in_picture: None,
        };
        let innovation = observation.innovation(engine)?;
        let gate = Gate {
            confidence: settings.gate_confidence,
        };
        Ok(Self {
            verdict: observation.verdict(&innovation, gate)?,
            observation,
            innovation,
        })
    }

    /// Corrects `engine`, whose covariance was widened by the factor `recovered` if any.
    pub fn correct(
        self,
        engine: &mut dyn Engine,
        recovered: Option<f64>,
    ) -> Result<Believed, FilterError> {
        let predicted = engine.state();
        let step = self.observation.correct(engine)?;
        let joint = JointReport::of(&self.verdict, &step, recovered);
        Ok(Believed {
            predicted,
            step,
            joint,
        })
    }
}

impl RegisteredFrame {
    /// Corrects `engine` by the place of the frame, if it can be believed; says why not otherwise.
    pub fn correct(
        &mut self,
        settings: &NavigatorSettings,
        engine: &mut Box<dyn Engine>,
    ) -> Result<Option<Believed>, FilterError> {
        let Some(place) = &self.registered else {
            return Ok(None);
        };
        let seen = SeenPlace::by(settings, engine.as_ref(), &self.found, place)?;
        let Verdict { nis, threshold, .. } = seen.verdict;
        let mut recovered = None;
        if nis > threshold {
            // The filter expects such an innovation or a larger one with the probability exp(-NIS / 2).
            let log_expected = -0.5 * nis / std::f64::consts::LN_10;
            let innovation = &seen.innovation;
            let factor = fading_factor(
                &innovation.innovation,
                &innovation.covariance,
                &innovation.noise,
            );
            let Some(factor) = factor.filter(|_| self.report.log_false_alarms < log_expected)
            else {
                self.report.refused_as = Some(RegistrationRefusal::OutsideGate);
                self.report.refusal = Some(format!(
                    "it lies {:.1} m from where it was expected, outside the gate (NIS {nis:.0} of at most \
                     {threshold:.0}), and may be chance",
                    innovation.innovation.norm()
                ));
                return Ok(None);
            };
            *engine = engine.faded(factor)?;
            recovered = Some(factor);
        }
        seen.correct(engine.as_mut(), recovered).map(Some)
    }
}

#[cfg(test)]
#[path = "frame_registration_tests.rs"]
mod tests;
