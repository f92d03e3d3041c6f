//! The unscented Kalman filter and its kin, a smoother, gates, consistency and the bound that no
//! estimator beats.
//!
//! Knows no aircraft and no camera. One step reads:
//! ```
//! use nalgebra::{Matrix1, Matrix2, Vector1, Vector2};
//! use pilotage_estimation::filter::{Gate, Gaussian, Ukf, UnscentedSettings};
//!
//! // Position and speed on a line; the position is measured.
//! let prior = Gaussian::new(Vector2::new(0.0, 1.0), Matrix2::identity());
//! let mut filter = Ukf::new(prior, UnscentedSettings::default())?;
//! let dt = 0.5;
//! filter.predict(|x| Vector2::new(x[0] + dt * x[1], x[1]), &(Matrix2::identity() * 0.01))?;
//! let predicted = filter.predict_measurement(|x| Some(Vector1::new(x[0])), &Matrix1::new(0.1))?;
//! let measured = Vector1::new(0.7);
//! if Gate::default().judge(&predicted, &measured).accepted {
//!     let correction = filter.correct(&predicted, &measured)?;
//!     assert!(correction.after.covariance[(0, 0)] < correction.before.covariance[(0, 0)]);
//! }
//! # Ok::<(), pilotage_estimation::filter::FilterError>(())
//! ```

mod cloud;
mod consistency;
mod correction;
mod cramer_rao;
mod error;
mod extended;
mod fading;
mod gate;
mod gaussian;
mod jacobian;
mod measurement;
mod particles;
mod reference;
mod root;
mod sigma;
mod smoother;
#[cfg(test)]
mod tests;
mod ukf;

pub use consistency::{Consistency, ConsistencySummary, chi_square_interval, mean_interval};
pub use correction::Correction;
pub use cramer_rao::{CramerRao, numerical_jacobian};
pub use error::FilterError;
pub use extended::Ekf;
pub use fading::fading_factor;
pub use gate::{Gate, GateReason, Verdict};
pub use gaussian::Gaussian;
pub use jacobian::partial_jacobian;
pub use measurement::PredictedMeasurement;
pub use particles::{ExpectedMeasurement, ParticleFilter, ParticleSettings};
pub use reference::{
    ReferenceStep, reference_flight, reference_loop, reference_measurement,
    reference_measurement_noise, reference_prior, reference_process, reference_process_noise,
};
pub use sigma::{Redraw, SigmaPoints, UnscentedSettings, Weights};
pub use smoother::{SmootherLink, smooth};
pub use ukf::{Prediction, Ukf};
