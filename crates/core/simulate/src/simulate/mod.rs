//! A world to try the method in: flights with sensors, and the built-in scenarios.

#[macro_use]
mod worlds;

mod aerial_camera;
mod channels;
mod county;
mod dryden;
mod flight;
mod flight_airframe;
mod flight_day;
mod flight_frames;
mod guidance;
mod route;
mod scenario;
pub mod scenery;
mod sensors;
mod world;

pub use aerial_camera::{AerialCamera, AerialCameraSettings, AerialFrame, frame_random};
pub use county::County;
pub use dryden::{DrydenGust, Turbulence};
pub use flight::{FlightPlan, Target, TrueFlight};
pub use flight_airframe::{AircraftState, Airframe, AirframeCommand};
pub use flight_day::FlightDay;
pub use flight_frames::{SimulatedFlight, SimulatedFrames};
pub use guidance::{GuidanceSettings, PathFollower};
pub use hall::IndoorHall;
pub use scenario::{Overrides, Scenario, Wind, world_origin};
pub use sensors::{SensorError, SensorSpec};
pub use world::{LaidWorld, SimulationChoice, World};

// All worlds: another one is a file or folder of this one with its type, and a line here.
worlds! {
    small {
        countryside::Countryside,
        hall::Hall,
    }
    whole {}
}
