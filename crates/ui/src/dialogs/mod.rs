//! Dialogs: simulate a flight, set the filter, say what the columns of tables mean.

mod columns;
mod columns_rows;
mod landmark_settings;
mod setting_rows;
mod settings;
mod simulate;

pub use columns::{ColumnsCommand, ColumnsDialog, ColumnsDraft, DraftTable};
pub use settings::settings_sheet;
pub use simulate::SimulateDialog;
