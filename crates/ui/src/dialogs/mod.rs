//! Dialogs: simulate a flight, set the filter.

mod scenarios;
mod settings;
mod simulate;

pub use scenarios::{SCENARIOS, Scenario};
pub use settings::settings_sheet;
pub use simulate::SimulateDialog;
