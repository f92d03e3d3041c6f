//! Estimators and vehicle models beside each other.

use serde::{Deserialize, Serialize};

use super::Tally;
use crate::navigator::ErrorFigures;
use pilotage_estimation::filter::ConsistencySummary;
use pilotage_mission::settings::{EstimatorChoice, NavigatorSettings, VehicleChoice};

/// One way of navigating.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Contender {
    /// The estimator.
    pub estimator: EstimatorChoice,
    /// The process model.
    pub vehicle: VehicleChoice,
}

impl Contender {
    /// Every one of `estimators` on every one of `vehicles`, model by model.
    pub fn all(estimators: &[EstimatorChoice], vehicles: &[VehicleChoice]) -> Vec<Self> {
        let of = |vehicle: &VehicleChoice| {
            let vehicle = *vehicle;
            let with = move |estimator: &EstimatorChoice| Self {
                estimator: *estimator,
                vehicle,
            };
            estimators.iter().map(with).collect::<Vec<_>>()
        };
        vehicles.iter().flat_map(of).collect()
    }

    /// `settings` with this estimator and model; `seed` is for what the estimator draws.
    pub fn settings(&self, settings: &NavigatorSettings, seed: u64) -> NavigatorSettings {
        let mut settings = settings.clone();
        settings.vehicle = self.vehicle;
        settings.estimator.choice = self.estimator;
        settings.estimator.particles.seed = seed;
        settings
    }
}

/// A line of the table: what became of one contender over all flights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonRow {
    /// Who.
    pub contender: Contender,
    /// Whether these are the estimates after the flight, of the smoother, in place of those in flight.
    pub smoothed: bool,
    /// Flights navigated to their end.
    pub flights: usize,
    /// Flights that could not be navigated to their end.
    pub failed: usize,
    /// Distance of the position from the true one over all steps whose truth is known, metres.
    pub position_error_m: Option<ErrorFigures>,
    /// Normalized estimation error squared of the position: two degrees of freedom. The bounds of its
    /// mean take every flight for one independent sample, as the errors of its steps are alike.
    pub nees: Option<ConsistencySummary>,
    /// Normalized innovation squared of the corrections, with the bounds of as many independent samples;
    /// none for smoothed estimates.
    pub nis: Option<ConsistencySummary>,
    /// Camera frames that corrected the estimate.
    pub frames_with_update: usize,
    /// Landmarks that corrected the estimate.
    pub updates_accepted: usize,
    /// Landmarks that were looked for and not used.
    pub updates_refused: usize,
    /// Mean time of a step's prediction and correction, milliseconds; seeing is not in it. For smoothed
    /// estimates that of the smoother, as far as it was measured.
    pub ms_per_step: f64,
}

/// Estimators and models over the same flights, in one table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// A line per contender, and one more for its smoothed estimates where those were asked for.
    pub rows: Vec<ComparisonRow>,
}

impl Comparison {
    /// The table of what was tallied.
    pub fn of(tallies: &[Tally]) -> Self {
        Self {
            rows: tallies.iter().flat_map(Tally::rows).collect(),
        }
    }
}
