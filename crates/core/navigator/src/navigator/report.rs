//! Report of what one step concluded, complete enough to explain itself.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix4, Matrix6, Point2, Vector2};
use serde::{Deserialize, Serialize};

use super::engine::{CorrectedStep, PredictedStep};
use super::{Doubt, Estimate, RegistrationRefusal, SightingReport};
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_base::statistics::circle_radius;
use pilotage_flight::{ChannelName, Flight};
use pilotage_vision::landmark::Refusal;
use pilotage_vision::registration::{MapShape, RegistrationMethod};

/// Readings that drove the prediction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Control {
    /// True airspeed, m/s, where there is one.
    pub airspeed: Option<f64>,
    /// Heading, radians clockwise from north.
    pub heading: f64,
    /// Roll, radians.
    pub roll: f64,
    /// Pitch, radians.
    pub pitch: f64,
    /// Height above the ground plane, metres.
    pub height: f64,
}

impl Control {
    /// Readings of the instruments of `flight` at `time`, seconds.
    pub fn of(flight: &Flight, time: f64) -> Self {
        let value = |name| flight.value(name, time);
        let now = flight.attitude(time).unwrap_or_default();
        Self {
            airspeed: value(ChannelName::Airspeed),
            heading: now.yaw,
            roll: now.roll,
            pitch: now.pitch,
            height: value(ChannelName::HeightAboveGround).unwrap_or(0.0),
        }
    }
}

/// Sigma points at the four moments of a step, n × (2n + 1) each; the first column is the centre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SigmaSets {
    /// Drawn from the estimate before the prediction.
    pub before_predict: DMatrix<f64>,
    /// The same after the process model.
    pub after_predict: DMatrix<f64>,
    /// Those the measurement model saw; `None` on steps without a measurement.
    pub before_correct: Option<DMatrix<f64>>,
    /// Drawn from the corrected estimate; `None` on steps without a measurement.
    pub after_correct: Option<DMatrix<f64>>,
}

/// Milliseconds spent, by the caller's stopwatch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepTiming {
    /// Prediction.
    pub predict: f64,
    /// Rectification and matching.
    pub see: f64,
    /// Gating and correction.
    pub update: f64,
}

/// Outcome of looking for a landmark in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// It corrected the estimate.
    Accepted,
    /// It was looked for and not used.
    Refused(Refusal),
}

/// A landmark that the region manager let through, and what the detector and the gate said.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CandidateReport {
    /// The landmark's id.
    pub landmark: u32,
    /// Expected place of the reference point in the picture, pixels.
    pub predicted_pixel: Point2<f64>,
    /// Innovation covariance at that place, pixels².
    pub innovation_covariance: Matrix2<f64>,
    /// Search region on the ground, metres.
    pub search_region: GroundRect,
    /// The search region's corners in the picture, pixels.
    pub search_outline: Vec<Point2<f64>>,
    /// Place where the reference point was found, pixels, if the detector named a place at all.
    pub measured_pixel: Option<Point2<f64>>,
    /// Turn of its surroundings against the rectified expectation, radians clockwise.
    pub rotation: Option<f64>,
    /// Log scale of its surroundings against the rectified expectation.
    pub log_scale: Option<f64>,
    /// Covariance of (pixel x, pixel y, rotation, log scale), pixels and radians, without the error of
    /// the camera's pose.
    pub measurement_covariance: Option<Matrix4<f64>>,
    /// Best score, -1 to 1.
    pub score: f64,
    /// Second-best peak's score.
    pub second_score: f64,
    /// Probability that it is the landmark, from a detector that says one.
    #[serde(default)]
    pub probability: Option<f64>,
    /// Standard deviations of the turn (radians) and of the logarithm of the size in which it was looked for.
    #[serde(default)]
    pub turn_and_size: [f64; 2],
    /// Innovation: measured minus predicted, pixels.
    pub innovation: Option<Vector2<f64>>,
    /// Normalized innovation squared of this landmark alone, over pixel, rotation and log scale.
    pub nis: Option<f64>,
    /// Threshold of the gate for its degrees of freedom: four, less what the detector left open.
    pub threshold: f64,
    /// Outcome of the search.
    pub outcome: Outcome,
}

/// The correction by all accepted landmarks together, or by the place of a whole frame: then its numbers
/// are north and east, metres, and no landmark of the frame is looked for, lest its pixels count twice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointReport {
    /// Normalized innovation squared of the stacked innovation.
    pub nis: f64,
    /// Its degrees of freedom: four for each of m landmarks, less what their detectors left open.
    pub degrees_of_freedom: usize,
    /// Threshold of the gate.
    pub threshold: f64,
    /// Kalman gain, n × 4m; per landmark pixel x, pixel y, rotation, log scale.
    pub gain: DMatrix<f64>,
    /// Innovation, 4m, pixels and radians.
    pub innovation: DVector<f64>,
    /// Innovation covariance, 4m × 4m, pixels and radians.
    pub innovation_covariance: DMatrix<f64>,
    /// Factor by which the filter's covariance had been too small, where what was seen spoke against the
    /// filter, surely enough, and it gave way.
    pub recovered: Option<f64>,
}

/// Correction by an aid beside pictures, or what the gate refused of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UpdateReport {
    /// Name of the aid in files.
    pub aid: String,
    /// Measured vector of m components, in their SI units.
    pub measured: DVector<f64>,
    /// Innovation: measured minus expected, m.
    pub innovation: DVector<f64>,
    /// Innovation covariance, m × m.
    pub innovation_covariance: DMatrix<f64>,
    /// Normalized innovation squared.
    pub nis: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Threshold of the gate.
    pub threshold: f64,
    /// Kalman gain, n × m; `None` where the gate refused it.
    pub gain: Option<DMatrix<f64>>,
}

impl UpdateReport {
    /// Whether it corrected the estimate.
    pub fn is_accepted(&self) -> bool {
        self.gain.is_some()
    }
}

/// Observations in a camera frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameReport {
    /// Index of the frame in the flight.
    pub index: usize,
    /// The pose that the predicted state and the measured attitude gave.
    pub assumed_pose: Pose,
    /// Outline of the picture on the ground.
    pub footprint: Vec<GroundPoint>,
    /// Landmarks looked for.
    pub candidates: Vec<CandidateReport>,
    /// The correction, if any landmark was accepted or the whole frame was.
    pub joint: Option<JointReport>,
    /// Result of laying the whole frame on the map, where that was tried.
    #[serde(default)]
    pub laid: Option<RegistrationReport>,
    /// Why the frame could not be used at all, if so.
    pub trouble: Option<String>,
}

/// A whole frame laid on the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegistrationReport {
    /// Place of the frame on the map; `None` if it could not be laid.
    pub place: Option<RegisteredPlace>,
    /// Why it did not correct the estimate, in words; `None` if it did.
    pub refusal: Option<String>,
    /// Kind of that reason; runs of before do not say.
    #[serde(default)]
    pub refused_as: Option<RegistrationRefusal>,
    /// By what it was believed.
    #[serde(default)]
    pub laid_by: RegistrationMethod,
    /// Patches that could have been found on the map.
    pub tried: usize,
    /// Logarithm (base 10) of how likely the place is wrong: agreements as good as this one that chance would
    /// give on other ground, or the probability that the whole frame lies elsewhere.
    pub log_false_alarms: f64,
    /// Probability of the likeliest place by the whole frame's edges; runs of before do not say.
    #[serde(default)]
    pub probability: Option<f64>,
}

impl RegistrationReport {
    /// The frame leaves open where it lies, for a reason of its own or for what is followed beside it.
    pub(super) fn left_open(&mut self, followed: String) {
        self.refused_as.get_or_insert(RegistrationRefusal::Open);
        let told = self.refusal.take().into_iter().chain([followed]);
        self.refusal = Some(told.collect::<Vec<_>>().join("; "));
    }

    /// Whether its place corrected the estimate.
    pub fn is_believed(&self) -> bool {
        self.refusal.is_none()
    }
}

/// Place of a whole frame on the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegisteredPlace {
    /// Pose of the body, the slope of the ground told from its tilt.
    pub pose: Pose,
    /// Covariance of north, east, down (metres), roll, pitch, yaw (radians).
    pub covariance: Matrix6<f64>,
    /// Place of the map in the middle of the picture.
    pub centre: GroundPoint,
    /// Covariance of that place (north, east), m².
    pub centre_covariance: Matrix2<f64>,
    /// Patches that agree: pixel, and place on the map.
    pub matches: Vec<(Point2<f64>, GroundPoint)>,
    /// Turn of the stored picture beyond the known one, radians clockwise, a multiple of a quarter turn.
    pub stored_turn: f64,
    /// Stretch of the map's picture at that place.
    pub shape: MapShape,
}

impl FrameReport {
    /// Landmarks that corrected the estimate.
    pub fn accepted(&self) -> impl Iterator<Item = &CandidateReport> {
        self.candidates
            .iter()
            .filter(|c| c.outcome == Outcome::Accepted)
    }
}

/// Record of one step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepReport {
    /// Seconds in the flight's time base, at the end of the step.
    pub time: f64,
    /// Length of the prediction, seconds.
    pub dt: f64,
    /// Readings that drove the prediction.
    pub control: Control,
    /// Before the prediction: what the step before ended with, unless another belief took over in this one
    /// (see [`JointReport::recovered`]); then what that one believed.
    pub before: Estimate,
    /// After the prediction.
    pub predicted: Estimate,
    /// After the correction; equal to `predicted` where there was none. While it is open how late the
    /// pictures come, this belief spreads over all lags ([`super::SensorFault::MayBeLate`]), and while it is open at
    /// which of several places the vehicle is, over all of them; the next step begins without that.
    pub after: Estimate,
    /// Sigma points.
    pub sigma: SigmaSets,
    /// Position by dead reckoning alone, without any landmark.
    pub dead_reckoned: GroundPoint,
    /// Instruments that are not believed at the end of the step.
    #[serde(default)]
    pub doubts: Vec<Doubt>,
    /// The camera frame of this step, if any.
    pub frame: Option<FrameReport>,
    /// Time spent.
    pub timing: StepTiming,
    /// Aids beside pictures that had a reading, in the order in which they were asked.
    #[serde(default)]
    pub updates: Vec<UpdateReport>,
    /// Reports of what aids saw in the picture of this step.
    #[serde(default)]
    pub sightings: Vec<SightingReport>,
}

impl StepReport {
    /// Radius around the estimated position within which the vehicle is in 95 of 100 cases, metres: what a position is
    /// "within" wherever it is told.
    pub fn radius_held(&self) -> f64 {
        circle_radius(&self.after.position_covariance(), 0.95)
    }

    /// Another belief took over, which was moved here by `step`.
    pub(super) fn begun_by(&mut self, step: PredictedStep) {
        self.before = step.before;
        self.sigma.before_predict = step.sigma_before;
        self.sigma.after_predict = step.sigma_after;
    }

    /// The belief `predicted` was corrected by `step`.
    pub(super) fn corrected_by(&mut self, predicted: Estimate, step: CorrectedStep) {
        self.predicted = predicted;
        self.after = step.after;
        self.sigma.before_correct = Some(step.sigma_before);
        self.sigma.after_correct = Some(step.sigma_after);
    }

    /// The estimate was corrected by `step` of an aid, after whatever the frame did.
    pub(super) fn aided_by(&mut self, step: CorrectedStep) {
        self.after = step.after;
        self.sigma.before_correct.get_or_insert(step.sigma_before);
        self.sigma.after_correct = Some(step.sigma_after);
    }

    /// Whether landmarks or a whole picture corrected the estimate in this step.
    pub fn corrected(&self) -> bool {
        self.frame.as_ref().is_some_and(|f| f.joint.is_some())
    }
}
