//! Settings of one flight of a study.

use pilotage_core::navigator::{AidInfo, EstimatorChoice, VehicleChoice};
use pilotage_core::plan::TestedInstrument;
use pilotage_core::simulate::SensorSpec;
use serde::{Deserialize, Serialize};

use super::fault_kind::FaultKind;

/// Settings of one flight, angles in radians and all else in SI.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunSettings {
    /// Name of the scenario.
    pub scenario: String,
    /// Longest time flown, seconds.
    pub seconds: f64,
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
    /// Whether the filter is told of those; otherwise it takes the usual ones for granted.
    pub is_told: bool,
    /// Deviation of the wind at the start that the filter assumes, m/s, if another than the scenario's.
    pub start_wind: Option<f64>,
    /// Process model, if another than the scenario's.
    pub vehicle: Option<VehicleChoice>,
    /// Estimator.
    pub estimator: EstimatorChoice,
    /// Spread of the sigma points.
    pub alpha: Option<f64>,
    /// Confidence of the gate.
    pub gate: Option<f64>,
    /// Factor on the covariance of measurements.
    pub measurement_scale: f64,
    /// Shortest step of the filter between frames, seconds.
    pub step: f64,
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
    /// Keys of aids beside pictures.
    pub aids: Vec<String>,
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
            seconds: 60.0,
            height: None,
            wind_speed: None,
            wind_from: None,
            wind_scatter: 0.0,
            // A mount that does not shake, for found places have an error of their own.
            sensors: SensorSpec {
                mount_vibration: 0.0,
                ..SensorSpec::default()
            },
            is_told: true,
            start_wind: None,
            vehicle: None,
            estimator: EstimatorChoice::default(),
            alpha: None,
            gate: None,
            measurement_scale: 1.0,
            step: 0.0,
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
            aids: Vec::new(),
            mission: None,
            route: None,
        }
    }
}

impl RunSettings {
    /// Numbers of its aids, by their descriptions.
    pub(crate) fn chosen_aids(&self) -> impl Iterator<Item = &'static AidInfo> {
        let all = AidInfo::ALL.iter().copied();
        all.filter(|info| self.aids.iter().any(|key| key == info.key))
    }
}
