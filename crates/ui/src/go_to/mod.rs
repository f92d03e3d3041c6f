//! Going to a place: a town by its name, or coordinates in any form in which people write them.

mod dialog;
mod feature;
mod mark;
mod places;

use pilotage_core::frames::Geodetic;
use pilotage_core::gazetteer::FoundTown;

use self::mark::GoToMark;
use self::places::TownList;
use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "go_to";

/// Something to do about going to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum GoToCommand {
    /// Offer the towns of which the name is typed.
    Search,
    /// Go to what is typed, or to the chosen town.
    Go,
}

impl From<GoToCommand> for Command {
    fn from(command: GoToCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Dialog that asks for a place, and the mark at the one that was gone to.
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
    places: TownList,
    /// Towns that are offered, each with its row in words.
    offered: Vec<(FoundTown, String)>,
    /// Index of the one that Enter chooses.
    chosen: usize,
    mark: Option<GoToMark>,
}
