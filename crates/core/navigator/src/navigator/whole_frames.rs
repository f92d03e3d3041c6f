//! Whole frames laid on the map, as a measurement of the position.
//!
//! A frame laid on the map says itself how likely chance would have laid it so. Where its place lies outside
//! the filter's gate, one of the two is wrong, and the likelier one gives way: the frame if chance explains
//! it more readily than the filter's own distribution explains such an innovation, else the filter, whose
//! covariance is faded as much as makes the innovation likeliest ([`fading_factor`]).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::engine::{CorrectedStep, Engine, MeasurementModel};
use super::inputs::Inputs;
use super::see::Surprise;
use super::{Estimate, JointReport, LaidPlace, LaidReport};
use pilotage_base::frames::GroundPoint;
use pilotage_base::statistics::chi_square_quantile;
use pilotage_estimation::filter::{FilterError, fading_factor};
use pilotage_flight::{ChannelName, Flight};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::Pyramid;
use pilotage_vision::registration::{
    FollowSettings, Follower, LaidBy, Look, Measured, NotRegistered, Registration,
};

/// Numbers of a place: north and east.
const COMPONENTS: usize = 2;

/// Lays one frame after the other.
pub struct WholeFrames {
    map: Arc<dyn Imagery>,
    follower: Follower,
    /// The follower before the last frame.
    before: Follower,
}

/// A frame, laid or not.
pub struct Laid {
    pub report: LaidReport,
    /// Outline of the picture on the map.
    pub footprint: Vec<GroundPoint>,
}

/// What a frame that was believed did.
pub struct Believed {
    /// The belief that it corrected.
    pub predicted: Estimate,
    pub step: CorrectedStep,
    pub joint: JointReport,
}

impl WholeFrames {
    pub fn new(map: Arc<dyn Imagery>, assumed: FollowSettings) -> Self {
        let follower = Follower::new(assumed);
        Self {
            map,
            before: follower.clone(),
            follower,
        }
    }

    /// Lays frame `index` on the map around where the aircraft is believed to be.
    pub fn lay(
        &mut self,
        flight: &Flight,
        inputs: &Inputs,
        index: usize,
        luminance: &Pyramid,
        predicted: &Estimate,
    ) -> Laid {
        let measured = measured(flight, inputs, flight.frames[index].time);
        self.lay_by(flight, &measured, index, luminance, predicted)
    }

    /// The same by what is `measured`.
    pub fn lay_by(
        &mut self,
        flight: &Flight,
        measured: &Measured,
        index: usize,
        luminance: &Pyramid,
        predicted: &Estimate,
    ) -> Laid {
        self.before = self.follower.clone();
        let time = flight.frames[index].time;
        let camera = flight.camera_of_frame(index);
        let look = Look {
            camera: &camera,
            ground_down: flight.ground_down,
            luminance,
            map: self.map.as_ref(),
        };
        let spread = predicted
            .position_covariance()
            .symmetric_eigenvalues()
            .max();
        let prior =
            self.follower
                .prior(time, predicted.position(), spread.max(0.0).sqrt(), measured);
        match self.follower.follow(time, &look, &prior) {
            Ok(found) => Laid {
                footprint: footprint(&look, &found),
                report: report(&found),
            },
            Err(cause) => Laid {
                footprint: Vec::new(),
                report: not_laid(&cause),
            },
        }
    }

    /// Forgets what the last frame taught: it was not believed.
    pub fn forget_last(&mut self) {
        self.follower = self.before.clone();
    }
}

/// What those of the flight's own instruments say at `time` that are believed then.
pub fn measured(flight: &Flight, inputs: &Inputs, time: f64) -> Measured {
    let is_believed = |name| inputs.doubt(name, time).is_none();
    let value = |name| flight.value(name, time).filter(|_| is_believed(name));
    Measured {
        heading: value(ChannelName::Heading),
        roll: value(ChannelName::Roll),
        pitch: value(ChannelName::Pitch),
        height: value(ChannelName::HeightAboveGround).filter(|height| *height > 0.0),
    }
}

fn footprint(look: &Look<'_>, found: &Registration) -> Vec<GroundPoint> {
    let camera = look.camera.stored_turned(found.stored_turn);
    let look = Look {
        camera: &camera,
        ..*look
    };
    let corners = camera.corners();
    let seen = corners.iter().filter_map(|c| look.ground(&found.fit.at, c));
    seen.collect()
}

fn report(found: &Registration) -> LaidReport {
    LaidReport {
        place: Some(LaidPlace {
            pose: found.camera.pose,
            covariance: found.camera.covariance,
            centre: found.centre,
            centre_covariance: found.centre_covariance,
            matches: found.matches.iter().map(|m| (m.pixel, m.ground)).collect(),
            stored_turn: found.stored_turn,
            shape: found.fit.at.shape,
        }),
        refusal: None,
        laid_by: found.laid_by,
        probability: Some(found.probability),
        tried: found.tried,
        log_false_alarms: found.log_false_alarms,
    }
}

fn not_laid(cause: &NotRegistered) -> LaidReport {
    LaidReport {
        place: None,
        refusal: Some(cause.to_string()),
        laid_by: LaidBy::default(),
        tried: 0,
        log_false_alarms: 0.0,
        probability: Some(cause.probability()),
    }
}

impl Laid {
    /// Corrects `engine` by the place of the frame, if it can be believed; says why not otherwise.
    pub fn correct(
        &mut self,
        settings: &NavigatorSettings,
        engine: &mut Box<dyn Engine>,
    ) -> Result<Option<Believed>, FilterError> {
        let Some(place) = &self.report.place else {
            return Ok(None);
        };
        let position = place.pose.position_in_world;
        let seen = DVector::from_column_slice(&[position.x, position.y]);
        let own = place.covariance.fixed_view::<2, 2>(0, 0);
        let noise = DMatrix::from_fn(COMPONENTS, COMPONENTS, |i, j| {
            settings.measurement_scale * own[(i, j)]
        });
        let model: &MeasurementModel<'_> =
            &|position, _| Some(DVector::from_column_slice(&[position.north, position.east]));
        let expected = engine.expect(model, &noise)?;
        let surprise = Surprise {
            innovation: &seen - expected.mean,
            covariance: expected.covariance,
            noise,
        };
        let nis = surprise.nis()?;
        let threshold = chi_square_quantile(settings.gate_confidence, COMPONENTS as f64);
        let mut recovered = None;
        if nis > threshold {
            // The filter expects such an innovation or a larger one with the probability exp(-NIS / 2).
            let log_expected = -0.5 * nis / std::f64::consts::LN_10;
            let factor = fading_factor(&surprise.innovation, &surprise.covariance, &surprise.noise);
            let Some(factor) = factor.filter(|_| self.report.log_false_alarms < log_expected)
            else {
                self.report.refusal = Some(format!(
                    "it lies {:.1} m from where it was expected, outside the gate (NIS {nis:.0} of at most \
                     {threshold:.0}), and may be chance",
                    surprise.innovation.norm()
                ));
                return Ok(None);
            };
            *engine = engine.faded(factor)?;
            recovered = Some(factor);
        }
        let predicted = engine.state();
        let step = engine.correct(model, &surprise.noise, &seen)?;
        let joint = JointReport {
            nis,
            degrees_of_freedom: COMPONENTS,
            threshold,
            gain: step.gain.clone(),
            innovation: step.innovation.clone(),
            innovation_covariance: step.innovation_covariance.clone(),
            recovered,
        };
        Ok(Some(Believed {
            predicted,
            step,
            joint,
        }))
    }
}
