//! Tables of a flight: what their columns mean is asked, a flight is made of them in a worker, and flown.

mod dialog;
mod feature;
mod rows;

pub use feature::ColumnsFeature;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "columns";

/// Commands of the dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnsCommand {
    /// Make a flight of the tables and open it.
    OpenFlight,
    /// Leave the tables alone.
    Cancel,
}

impl From<ColumnsCommand> for Command {
    fn from(command: ColumnsCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
