//! Commands about studies.

use crate::command::Command;
use crate::feature_command::{FeatureCommand, STUDIES};

/// Something to do about studies.
#[derive(Clone, Debug, PartialEq)]
pub enum StudyCommand {
    /// Show them.
    Show,
    /// Close the sheet; what was flown stays.
    Close,
    /// Fly the plan that is written down.
    Start,
    /// Stop flying; what was flown stays.
    Stop,
    /// Save the plan for the terminal.
    SavePlan,
    /// Fly a run once more, in Replay.
    Open(u64),
}

impl From<StudyCommand> for Command {
    fn from(command: StudyCommand) -> Self {
        Self::Feature(FeatureCommand::new(STUDIES, command))
    }
}
