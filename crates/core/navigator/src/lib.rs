//! The navigator and what surrounds it: instruments and dead reckoning, the pipeline from prediction to
//! report, the camera's calibration against its log, and studies of many flights.

pub mod calibration;
pub mod instruments;
pub mod navigator;
pub mod study;
