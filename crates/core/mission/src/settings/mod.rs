//! Settings for people: of the navigator, its estimator, and the camera beside its log.

mod adjustment;
mod aids;
mod bounds;
mod navigator;
mod unstated_mount;
mod without_mission;

pub use adjustment::CameraAdjustment;
pub use aids::{ChosenAid, FilterAidNumber, GENERIC_LANDMARKS, MAP_EDGES, MAP_ERRORS, ROAD_MAP};
pub use pilotage_estimation::estimator::{EstimatorChoice, EstimatorSettings};

pub use navigator::{
    Cruise, NavigatorSettings, ProcessNoise, SensorNoise, StartError, VehicleChoice,
};
