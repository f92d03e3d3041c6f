//! Settings of one flight of a study.

use pilotage_core::navigator::{ChosenAid, EstimatorChoice, VehicleChoice};
use pilotage_core::plan::TestedInstrument;
use pilotage_core::simulate::SensorSpec;
use serde::{Deserialize, Serialize};

use super::fault_kind::FaultKind;

/// Longest time that can be flown, seconds.
pub(crate) const LONGEST: f64 = 3600.0;
/// Time flown of a scenario where the plan does not say it, seconds.
const USUAL: f64 = 60.0;

/// Settings of one flight as far as the plan says them, angles in radians and all else in SI. What it does not say is
/// resolved by the flight: it is that of the scenario or mission, or else the usual.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunSettings {
    /// Name of the scenario.
    pub scenario: String,
    /// Longest time flown, seconds, if another than the usual: a minute of a scenario, all of a mission's route up to an
    /// hour.
    pub seconds: Option<f64>,
    /// Height above ground, metres, if another than the scenario's.
    pub height: Option<f64>,
    /// Speed of the wind, m/s, if another than the scenario's.
    pub wind_speed: Option<f64>,
    /// Direction from which it blows, radians, if another than the scenario's.
    pub wind_from: Option<f64>,
    /// Deviation per axis of a wind added by chance, m/s.
    pub wind_scatter: f64,
    /// Errors of the sensors.
    pub sensors: SensorSpec,
    /// Whether the filter is told of those; otherwise it takes those of the mission or the usual ones for granted. Over a
    /// scenario it is, by a mission it is not, unless the plan says it.
    pub is_told: Option<bool>,
    /// Deviation of the wind at the start that the filter assumes, m/s, if another than the scenario's.
    pub start_wind: Option<f64>,
    /// Process model, if another than the scenario's.
    pub vehicle: Option<VehicleChoice>,
    /// Estimator, if another than the mission's.
    pub estimator: Option<EstimatorChoice>,
    /// Spread of the sigma points.
    pub alpha: Option<f64>,
    /// Confidence of the gate.
    pub gate: Option<f64>,
    /// Factor on the covariance of measurements, if another than the mission's.
    pub measurement_scale: Option<f64>,
    /// Shortest step of the filter between frames, seconds, if another than the mission's.
    pub step: Option<f64>,
    /// Share of days on which a landmark can be recognised.
    pub recognised: f64,
    /// Share of frames that find it then.
    pub per_frame: f64,
    /// Deviation of a found place per axis, metres.
    pub place: f64,
    /// Deviation of a found turn and logarithm of size.
    pub turn: f64,
    /// Instruments whose error walks, with the deviation of a step each second, m/s or radians.
    pub walks: Vec<(TestedInstrument, f64)>,
    /// Constant errors: airspeed m/s, heading, roll, pitch radians, height metres.
    pub offsets: [f64; 5],
    /// Constant error of the first position (north, east), metres.
    pub start_offset: [f64; 2],
    /// Fault of an instrument.
    pub fault: FaultKind,
    /// Time at which it begins, seconds.
    pub fault_from: f64,
    /// Angle by which a heading is turned, radians.
    pub fault_turn: f64,
    /// Time by which a camera is late, seconds.
    pub fault_delay: f64,
    /// Whether the navigator thinks of late pictures and turned compasses.
    pub doubts: bool,
    /// Keys of aids beside pictures, if others than the mission's.
    pub aids: Option<Vec<String>>,
    /// Name of the mission in the plan that is flown in place of a scenario; [`StudyFlight`](super::StudyFlight) has the
    /// mission itself.
    #[serde(skip)]
    pub mission: Option<String>,
    /// Name of its route, if another than the first.
    #[serde(skip)]
    pub route: Option<String>,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            scenario: "distinct-400ft-wind".to_owned(),
            seconds: None,
            height: None,
            wind_speed: None,
            wind_from: None,
            wind_scatter: 0.0,
            // A mount that does not shake, for found places have an error of their own.
            sensors: SensorSpec {
                mount_vibration: 0.0,
                ..SensorSpec::default()
            },
            is_told: None,
            start_wind: None,
            vehicle: None,
            estimator: None,
            alpha: None,
            gate: None,
            measurement_scale: None,
            step: None,
            recognised: 1.0,
            per_frame: 0.7,
            place: 0.16,
            turn: 0.01,
            walks: Vec::new(),
            offsets: [0.0; 5],
            start_offset: [0.0; 2],
            fault: FaultKind::None,
            fault_from: 20.0,
            fault_turn: 20_f64.to_radians(),
            fault_delay: 1.0,
            doubts: true,
            aids: None,
            mission: None,
            route: None,
        }
    }
}

impl RunSettings {
    /// Keys of the aids that a study can read: the others look at pictures, or at a height that the vehicle model has not.
    pub(crate) const READ_AIDS: [&'static str; 3] =
        ["gps-position", "gps-velocity", "magnetic-heading"];

    /// Whether a study can read an aid.
    pub(crate) fn reads(aid: &ChosenAid) -> bool {
        Self::READ_AIDS.contains(&aid.key.as_str())
    }

    /// Longest time flown, seconds, of a mission or of a scenario.
    pub(crate) fn longest(&self, is_mission: bool) -> f64 {
        self.seconds
            .unwrap_or(if is_mission { LONGEST } else { USUAL })
    }

    /// Whether the filter is told of the errors of the sensors, by a mission or over a scenario.
    pub(crate) fn tells(&self, is_mission: bool) -> bool {
        self.is_told.unwrap_or(!is_mission)
    }
}
