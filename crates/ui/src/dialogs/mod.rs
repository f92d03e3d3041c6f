//! Dialogs: simulate a flight, set the filter.

mod settings;
mod simulate;

pub use settings::settings_sheet;
pub use simulate::SimulateDialog;
