//! Dialogs: simulate a flight, set the filter.

mod aid_settings;
mod landmark_settings;
mod setting_rows;
mod settings;
mod simulate;

pub use settings::settings_sheet;
pub use simulate::SimulateDialog;
