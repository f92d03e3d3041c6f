//! Settings for people: of the navigator, its estimator, and the camera beside its log.

mod adjustment;
mod estimator;
mod navigator;
mod without_mission;

pub use adjustment::CameraAdjustment;
pub use estimator::{EstimatorChoice, EstimatorSettings};
pub use navigator::{
    Cruise, NavigatorSettings, ProcessNoise, SensorNoise, StartError, VehicleChoice,
};
