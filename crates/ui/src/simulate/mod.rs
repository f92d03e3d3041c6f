//! Simulated flights: a scenario, or the selected route, flown in the place of what is open.

mod command;
mod dialog;
mod feature;

use self::dialog::SimulateDialog;

/// Feature that simulates flights: its dialog.
#[derive(Debug, Default)]
pub struct SimulateFeature {
    dialog: SimulateDialog,
}
