//! A flight to be flown by several estimators.

use pilotage_core::mission::Mission;
use pilotage_core::navigator::EstimatorChoice;
use pilotage_core::study::Contender;
use serde::{Deserialize, Serialize};

use super::{FlightSource, MapSource};

/// A flight to be flown by several estimators and vehicle models.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContestOrder {
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// Landmarks and settings.
    pub mission: Mission,
    /// Estimators and vehicle models that fly it.
    pub contenders: Vec<Contender>,
    /// Whether the estimates after the flight are judged too.
    pub smooth: bool,
    /// Seed of what an estimator draws.
    pub seed: u64,
}

impl ContestOrder {
    /// Contest of every estimator on the mission's own vehicle model, smoothed too.
    pub fn of_all(flight: FlightSource, map: MapSource, mission: Mission) -> Self {
        Self {
            seed: flight.estimator_seed(),
            flight,
            map,
            contenders: Contender::all(&EstimatorChoice::ALL, &[mission.navigator.vehicle]),
            mission,
            smooth: true,
        }
    }
}
