//! The command of simulating.

use pilotage_jobs::SimulationOptions;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub(super) const ID: FeatureId = "simulate";

/// Command to simulate a flight, and to navigate it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SimulateCommand(pub SimulationOptions);

impl From<SimulateCommand> for Command {
    fn from(command: SimulateCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
