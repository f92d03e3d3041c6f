//! Command that asks for the pictures of a match.

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature of matches.
pub const MATCH: FeatureId = "match";

/// Question for the pictures that explain a match; may be sent every frame, asked once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchCommand {
    /// Time of the step, seconds in the flight's time base.
    pub time: f64,
    /// Landmark id.
    pub landmark: u32,
}

impl From<MatchCommand> for Command {
    fn from(command: MatchCommand) -> Self {
        Self::Feature(FeatureCommand::new(MATCH, command))
    }
}
