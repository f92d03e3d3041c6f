//! The filter behind one door, whatever the size of its state.

mod door;
mod estimator;
mod extended;
mod particles;
#[cfg(test)]
mod tests;
mod unscented;
mod vehicle;

use std::sync::Arc;

use self::estimator::FilterEngine;
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::filter::{
    Ekf, FilterError, ParticleFilter, Redraw, Ukf, UnscentedSettings,
};
use pilotage_estimation::vehicle::{AnyVehicle, VehicleModel, VehicleVisitor};
use pilotage_mission::settings::{EstimatorChoice, NavigatorSettings};

pub use door::{CorrectedStep, Engine, Expectation, MeasurementModel, PredictedStep};
pub use vehicle::{map_error, vehicle, visit_model};

/// The settings of the sigma points, which every estimator shows.
pub fn unscented(settings: &NavigatorSettings) -> UnscentedSettings {
    UnscentedSettings {
        alpha: settings.alpha,
        beta: settings.beta,
        redraw: if settings.redraw {
            Redraw::AfterProcessNoise
        } else {
            Redraw::CarriedThrough
        },
    }
}

/// The estimator that the settings ask for, at the start of a flight.
pub fn engine(
    settings: &NavigatorSettings,
    position: GroundPoint,
    deviation: f64,
) -> Result<Box<dyn Engine>, FilterError> {
    struct Build<'a> {
        settings: &'a NavigatorSettings,
        position: GroundPoint,
        deviation: f64,
    }
    impl VehicleVisitor for Build<'_> {
        type Output = Result<Box<dyn Engine>, FilterError>;

        fn visit<const N: usize, V>(self, model: V) -> Self::Output
        where
            V: VehicleModel<N> + Clone + Send + Sync + 'static,
        {
            let model: AnyVehicle<N> = Arc::new(model);
            let prior = model.prior(self.position, self.deviation);
            let unscented = unscented(self.settings);
            let estimator = &self.settings.estimator;
            Ok(match estimator.choice {
                EstimatorChoice::Unscented => {
                    Box::new(FilterEngine::new(Ukf::new(prior, unscented)?, model))
                }
                EstimatorChoice::Extended => {
                    Box::new(FilterEngine::new(Ekf::new(prior, unscented)?, model))
                }
                EstimatorChoice::Particles => {
                    let filter = ParticleFilter::new(&prior, estimator.particles, unscented)?;
                    Box::new(FilterEngine::new(filter, model))
                }
            })
        }
    }
    visit_model(
        settings,
        Build {
            settings,
            position,
            deviation,
        },
    )
}
