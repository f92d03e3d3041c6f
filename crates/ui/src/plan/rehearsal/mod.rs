//! Rehearsal of the selected route: flights of it in the simulation, beside its prediction.

mod command;
mod drawn;
mod flights;
mod paint;
mod words;

pub use command::RehearseCommand;
pub use flights::{MOST_FLIGHTS, RehearsalPreferences, RouteRehearsal};
pub use paint::FlownErrors;
