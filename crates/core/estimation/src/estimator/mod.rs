//! Estimators as the navigator and people know them: behind one trait, and in one table.

mod choice;
mod extended;
mod kind;
mod particles;
mod unscented;

pub use choice::{EstimatorChoice, EstimatorSettings};
pub use kind::{
    Corrected, Estimator, EstimatorInfo, EstimatorVisitor, Expectation, FilterSettings, StateModel,
};
