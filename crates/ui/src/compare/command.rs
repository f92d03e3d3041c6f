//! Trajectories by their identity, and what people can do about them.

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub const ID: FeatureId = "compare";

/// Identity of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TrackId {
    /// True trajectory of the flight that is open.
    Truth,
    /// Trajectory that the navigator estimated in the run.
    Run,
    /// Trajectory by dead reckoning alone.
    Unaided,
    /// The run before the last change.
    Ghost,
    /// Trajectory that was kept, by its number.
    Kept(u32),
}

/// Something to do about trajectories.
#[derive(Clone, Debug, PartialEq)]
pub enum CompareCommand {
    /// Show them.
    Show,
    /// Keep one of what is open while other flights are opened and flown.
    Keep(TrackId),
    /// Keep the run that is open with every step estimated from all of the flight, before and after it.
    KeepSmoothed,
    /// Stop smoothing it.
    StopSmoothing,
    /// Fly the flight that is open by every estimator.
    FlyAll,
    /// Stop flying it by every estimator.
    StopFlights,
    /// Let go of one.
    Discard(u32),
    /// Draw one on the map, or not.
    ToggleShown(u32),
}

impl From<CompareCommand> for Command {
    fn from(command: CompareCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
