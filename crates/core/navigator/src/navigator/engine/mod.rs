//! The filter behind one door, whatever the size of its state.

mod door;
mod filter_engine;
#[cfg(test)]
mod tests;
mod vehicle;

use std::sync::Arc;

use self::filter_engine::FilterEngine;
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::estimator::{Estimator, EstimatorVisitor, FilterSettings};
use pilotage_estimation::filter::{FilterError, Redraw, UnscentedSettings};
use pilotage_estimation::vehicle::{AnyVehicle, VehicleModel, VehicleVisitor};
use pilotage_mission::settings::NavigatorSettings;

pub use door::{CorrectedStep, Engine, MeasurementModel, PredictedStep};
pub use vehicle::{frame_noise, map_error, place_in_state, vehicle, visit_model};

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

/// A vehicle model that waits for its estimator.
struct On<const N: usize>(AnyVehicle<N>);

impl<const N: usize> EstimatorVisitor<N> for On<N> {
    type Output = Box<dyn Engine>;

    fn visit<F: Estimator<N> + 'static>(self, estimator: F) -> Self::Output {
        Box::new(FilterEngine::new(estimator, self.0))
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
            let estimator = &self.settings.estimator;
            let settings = FilterSettings {
                points: unscented(self.settings),
                particles: estimator.particles,
            };
            estimator.choice.begin(&prior, &settings, On(model))
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
