//! Camera by which frames of a flight are looked at.

use std::sync::Arc;

use pilotage_core::calibration::CameraAdjustment;
use pilotage_core::camera::CameraModel;
use pilotage_core::flight::Flight;
use pilotage_core::frames::Geodetic;
use pilotage_core::mission::Mission;
use serde::{Deserialize, Serialize};

/// Camera of a mission and its place beside the log, which a flight is flown with in place of its own.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlownCamera {
    /// The camera; that of the flight if `None`.
    camera: Option<CameraModel>,
    /// Its place in time and pose beside the log.
    to_log: Option<CameraAdjustment>,
}

impl FlownCamera {
    /// The camera that flights are flown with by a mission.
    pub fn of(mission: &Mission) -> Self {
        Self {
            camera: mission.camera.clone(),
            to_log: mission.camera_to_log,
        }
    }

    /// A flight as the mission has it flown.
    pub fn flown(&self, flight: &Arc<Flight>) -> Arc<Flight> {
        let anywhere = Geodetic::from_degrees(0.0, 0.0, 0.0);
        let mission = Mission {
            camera: self.camera.clone(),
            camera_to_log: self.to_log,
            ..Mission::new("", anywhere)
        };
        mission.flown(flight)
    }
}
