//! Runs as versions 6 to 9 of their files have them: without biases of the camera's pose, those before 9 without
//! what aids saw, those before 8 without errors of detectors on the ground, and version 6 without aids beside pictures.

use serde::Deserialize;

use super::{
    Control, Doubt, Estimate, FrameReport, Run, SigmaSets, StepReport, StepTiming, UpdateReport,
};
use pilotage_base::frames::GroundPoint;
use pilotage_mission::settings::{
    ChosenAid, EstimatorSettings, NavigatorSettings, ProcessNoise, SensorNoise, StartError,
    VehicleChoice,
};
use pilotage_vision::landmark::{Landmark, TemplateSettings};
use pilotage_vision::registration::FollowSettings;

/// The first bytes of a file of version 6.
pub const HEADER_6: &[u8] = b"PILOTAGE RUN 6\n";
/// The first bytes of a file of version 7.
pub const HEADER_7: &[u8] = b"PILOTAGE RUN 7\n";
/// The first bytes of a file of version 8.
pub const HEADER_8: &[u8] = b"PILOTAGE RUN 8\n";
/// The first bytes of a file of version 9.
pub const HEADER_9: &[u8] = b"PILOTAGE RUN 9\n";

/// A run whose settings and steps have the forms of their version.
#[derive(Deserialize)]
pub struct RunBefore<S, T> {
    name: String,
    settings: S,
    landmarks: Vec<Landmark>,
    state_names: Vec<(String, String)>,
    steps: Vec<T>,
}

/// A run of version 9.
pub type RunOfVersion9 = RunBefore<SettingsWithAids<SensorsOnGround>, StepReport>;
/// A run of version 8.
pub type RunOfVersion8 = RunBefore<SettingsWithAids<SensorsOnGround>, StepWithUpdates>;
/// A run of version 7.
pub type RunOfVersion7 = RunBefore<SettingsWithAids<Sensors>, StepWithUpdates>;
/// A run of version 6.
pub type RunOfVersion6 = RunBefore<Settings<Sensors>, Step>;

/// Settings of versions 7 to 9.
#[derive(Deserialize)]
pub struct SettingsWithAids<S> {
    settings: Settings<S>,
    aids: Vec<ChosenAid>,
    estimates_height: bool,
}

/// Noise of the camera's pose of versions 6 and 7.
#[derive(Deserialize)]
pub struct Sensors {
    roll: f64,
    pitch: f64,
    yaw: f64,
    height: f64,
    pixel: f64,
}

/// Noise of the camera's pose of versions 8 and 9.
#[derive(Deserialize)]
pub struct SensorsOnGround {
    sensors: Sensors,
    ground: f64,
}

/// Settings of version 6.
#[derive(Deserialize)]
pub struct Settings<S> {
    vehicle: VehicleChoice,
    alpha: f64,
    beta: f64,
    redraw: bool,
    gate_confidence: f64,
    start: StartError,
    process: ProcessNoise,
    sensors: S,
    measurement_scale: f64,
    detector: TemplateSettings,
    most_landmarks: usize,
    shortest_step: f64,
    estimator: EstimatorSettings,
    whole_frames: Option<FollowSettings>,
}

/// A step of version 6.
#[derive(Deserialize)]
pub struct Step {
    time: f64,
    dt: f64,
    control: Control,
    before: Estimate,
    predicted: Estimate,
    after: Estimate,
    sigma: SigmaSets,
    dead_reckoned: GroundPoint,
    doubts: Vec<Doubt>,
    frame: Option<FrameReport>,
    timing: StepTiming,
}

/// A step of versions 7 and 8.
#[derive(Deserialize)]
pub struct StepWithUpdates {
    step: Step,
    updates: Vec<UpdateReport>,
}

impl From<Sensors> for SensorNoise {
    fn from(of: Sensors) -> Self {
        Self {
            roll: of.roll,
            pitch: of.pitch,
            yaw: of.yaw,
            height: of.height,
            pixel: of.pixel,
            ground: 0.0,
            tilt_bias: 0.0,
            yaw_bias: 0.0,
            height_bias: 0.0,
        }
    }
}

impl From<SensorsOnGround> for SensorNoise {
    fn from(of: SensorsOnGround) -> Self {
        Self {
            ground: of.ground,
            ..of.sensors.into()
        }
    }
}

impl<S: Into<SensorNoise>> From<Settings<S>> for NavigatorSettings {
    fn from(of: Settings<S>) -> Self {
        Self {
            vehicle: of.vehicle,
            alpha: of.alpha,
            beta: of.beta,
            redraw: of.redraw,
            gate_confidence: of.gate_confidence,
            start: of.start,
            process: of.process,
            sensors: of.sensors.into(),
            measurement_scale: of.measurement_scale,
            detector: of.detector,
            most_landmarks: of.most_landmarks,
            shortest_step: of.shortest_step,
            estimator: of.estimator,
            whole_frames: of.whole_frames,
            aids: Vec::new(),
            estimates_height: false,
        }
    }
}

impl<S: Into<SensorNoise>> From<SettingsWithAids<S>> for NavigatorSettings {
    fn from(of: SettingsWithAids<S>) -> Self {
        Self {
            aids: of.aids,
            estimates_height: of.estimates_height,
            ..of.settings.into()
        }
    }
}

impl<S, T> From<RunBefore<S, T>> for Run
where
    S: Into<NavigatorSettings>,
    T: Into<StepReport>,
{
    fn from(run: RunBefore<S, T>) -> Self {
        Self {
            name: run.name,
            settings: run.settings.into(),
            landmarks: run.landmarks,
            state_names: run.state_names,
            steps: run.steps.into_iter().map(Into::into).collect(),
        }
    }
}

impl From<StepWithUpdates> for StepReport {
    fn from(of: StepWithUpdates) -> Self {
        Self {
            updates: of.updates,
            ..of.step.into()
        }
    }
}

impl From<Step> for StepReport {
    fn from(step: Step) -> Self {
        Self {
            time: step.time,
            dt: step.dt,
            control: step.control,
            before: step.before,
            predicted: step.predicted,
            after: step.after,
            sigma: step.sigma,
            dead_reckoned: step.dead_reckoned,
            doubts: step.doubts,
            frame: step.frame,
            timing: step.timing,
            updates: Vec::new(),
            sightings: Vec::new(),
        }
    }
}
