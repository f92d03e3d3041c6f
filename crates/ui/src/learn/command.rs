//! Commands of the tour.

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub(super) const ID: FeatureId = "tour";

/// Something about the tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LearnCommand {
    /// Start the guided tour, or leave it.
    Toggle,
    /// Open the page of lessons, in a tab of its own.
    OpenLessons,
    /// Show the line of advice over the map no more.
    DismissAdvice,
}

impl From<LearnCommand> for Command {
    fn from(command: LearnCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
