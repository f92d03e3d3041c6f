//! Estimators and the process models that they work on: the unscented filter and its kin, gates and
//! consistency, a smoother, and how an aircraft moves between two pictures.

pub mod estimator;
pub mod filter;
pub mod vehicle;
