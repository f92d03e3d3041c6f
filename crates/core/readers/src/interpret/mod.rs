//! Roles of the series of a log: which is heading, which airspeed, and the flight that they tell of.

mod beside_flight;
mod flight;
mod origin;
mod places;
mod series;
mod source;
#[cfg(test)]
mod tests;
mod tracks;

pub use beside_flight::{BesideFlight, log_of_flight};
pub use flight::{InterpretError, Interpreted, MeasuredSeries, flight_from_log};
pub use places::{Navigation, estimated_places, places};
pub use series::series;
pub use tracks::{RecordedTrack, recorded_tracks};

pub use super::role::{Role, RoleSeries};
#[cfg(test)]
pub(crate) use source::factor_of_unit;
