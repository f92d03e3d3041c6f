//! Process models of vehicles for the filter, listed in one registry.

mod airplane;
mod airplane_full;
mod airplane_scaled;
mod airplane_wind;
mod airplane_wind_bias;
mod airplane_wind_gust;
mod any;
mod at_height;
mod component;
mod constant_velocity;
mod extended;
mod kinematics;
mod model;
mod multirotor;
mod noise;
mod over_map;
mod parts;
mod random_walk;
mod registry;
#[cfg(test)]
mod tests;
mod thesis_noise;
mod tilted;
mod unmodelled_air;
mod velocity_driven;

pub use airplane::{AIRSPEED_MEMORY, AirData};
pub use airplane_full::AirplaneFull;
pub use airplane_scaled::{AirDataErrors, AirplaneScaled};
pub use airplane_wind::AirplaneWind;
pub use airplane_wind_bias::AirplaneWindBias;
pub use airplane_wind_gust::AirplaneWindGust;
pub use at_height::{AtHeight, HeightModel};
pub use component::StateComponent;
pub use constant_velocity::ConstantVelocity;
pub use extended::{Extended, PairChange, StatePair};
pub use kinematics::{Kinematics, KinematicsPart, KinematicsReader};
pub use model::{AnyVehicle, ControlInput, VehicleModel};
pub use multirotor::Multirotor;
pub use over_map::{MapError, OverMap};
pub use parts::{AirDataBiases, Gusts};
pub use random_walk::RandomWalk;
pub use registry::{VehicleSettings, VehicleVisitor, all_vehicles};
pub use thesis_noise::ThesisNoise;
pub use tilted::{TiltBias, Tilted};
pub use unmodelled_air::UnmodelledAir;
pub use velocity_driven::VelocityDriven;
