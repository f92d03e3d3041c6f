//! Dialogs: simulate a flight, set the filter.

mod settings;
mod simulate;
mod web_map;

pub use settings::settings_sheet;
pub use simulate::SimulateDialog;
pub use web_map::{Download, WebMapCommand, WebMapDialog, WebMapScene};
