//! What the series of a log mean: which is heading, which airspeed, and the flight that they tell of.

mod flight;
mod role;
mod ros;
mod series;
mod source;
#[cfg(test)]
mod tests;

pub use flight::{InterpretError, Interpreted, flight_from_log};
pub use role::Role;
pub use series::{RoleSeries, series};
