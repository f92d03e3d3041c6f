//! Roles of the series of a log: which is heading, which airspeed, and the flight that they tell of.

mod beside_flight;
mod board_axes;
mod flight;
#[cfg(test)]
mod measured_tests;
mod origin;
mod places;
mod reader;
#[cfg(test)]
mod ros_tests;
mod rows;
mod series;
mod source;
#[cfg(test)]
mod tests;
mod topics;
mod tracks;

pub use beside_flight::{BesideFlight, log_of_flight};
pub use flight::{InterpretError, Interpreted, MeasuredSeries, flight_from_log};
pub use places::{Navigation, estimated_places, places};
pub use series::series;
#[cfg(test)]
pub(crate) use source::factor_of_unit;
pub use tracks::{RecordedTrack, recorded_tracks};

pub use super::role::{Role, RoleSeries};
