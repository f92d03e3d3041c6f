//! Contenders of a study: ways of navigating.

use serde::{Deserialize, Serialize};

use pilotage_mission::settings::{EstimatorChoice, NavigatorSettings, VehicleChoice};

/// Way of navigating.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Contender {
    /// The estimator.
    pub estimator: EstimatorChoice,
    /// The process model.
    pub vehicle: VehicleChoice,
}

impl Contender {
    /// Every one of `estimators` on every one of `vehicles`, model by model.
    ///
    /// ```
    /// use pilotage_mission::settings::{EstimatorChoice, VehicleChoice};
    /// use pilotage_navigator::study::Contender;
    ///
    /// let vehicles = [VehicleChoice::AirplaneWind, VehicleChoice::RandomWalk];
    /// let all = Contender::all(&EstimatorChoice::ALL, &vehicles);
    /// assert_eq!(all.len(), 3 * 2);
    /// // Model by model.
    /// assert!(all[..3].iter().all(|one| one.vehicle == VehicleChoice::AirplaneWind));
    /// ```
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
