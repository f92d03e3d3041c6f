//! Frames, angles and units.
//!
//! World is local north-east-down (NED) at the mission's origin, metres; body is
//! forward-right-down; camera is x right, y down, z out of the lens. Angles are radians, yaw
//! clockwise from north. A point on the ground plane is a [`GroundPoint`] (north, east).

mod altitude;
mod attitude;
mod ellipsoid;
mod ground;
mod local;
mod other_system;
mod reference_system;
mod survey;
mod transverse_mercator;
pub mod units;

pub use altitude::{Altitude, AltitudeFrame, AltitudeReference};
pub use attitude::{Attitude, Pose, wrap_pi};
pub use ellipsoid::Ellipsoid;
pub use ground::{GroundPoint, GroundRect, inside};
pub use local::{Geodetic, LocalFrame};
pub use other_system::{Datum, OtherSystem, ProjectionMethod, SystemMethods, SystemNumbers};
pub use reference_system::ReferenceSystem;
pub use transverse_mercator::TransverseMercator;
