//! The dialog that sets the filter.

mod aid_settings;
mod landmark_settings;
mod setting_rows;
mod settings;

pub use settings::settings_sheet;
