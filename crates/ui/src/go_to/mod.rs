//! Going to a place by its coordinates, in any form in which people write them.

mod dialog;
mod feature;

use pilotage_core::frames::Geodetic;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "go_to";

/// Something to do about going to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum GoToCommand {
    /// Go to what is typed.
    Go,
}

impl From<GoToCommand> for Command {
    fn from(command: GoToCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Dialog that asks for a place.
#[derive(Debug, Default)]
pub struct GoTo {
    is_open: bool,
    /// Whether the field has yet to get the keyboard.
    wants_keyboard: bool,
    typed: String,
    /// Reason for which the map stayed where it is, in words.
    why: String,
    /// Place that was meant, where the open map does not reach.
    elsewhere: Option<Geodetic>,
}
