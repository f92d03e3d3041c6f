//! Estimators as the navigator and people know them: behind one trait, and in one table.

#[macro_use]
mod choice;
mod kind;

pub use choice::EstimatorSettings;
pub use kind::{
    Corrected, Estimator, EstimatorInfo, EstimatorVisitor, Expectation, FilterSettings, StateModel,
};

// All estimators: another one is a file of this folder with its `INFO` and its `Estimator`, and a line here.
estimators! {
    /// The unscented Kalman filter (DeAngelo 2016, Table 3).
    #[default]
    Unscented(unscented, crate::filter::Ukf),
    /// The extended Kalman filter.
    Extended(extended, crate::filter::Ekf),
    /// The regularised particle filter.
    Particles(particles, crate::filter::ParticleFilter),
}
