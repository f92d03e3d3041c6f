//! Photos laid on the map that is open, each by itself: what was asked, what came of each, which one is looked at.

mod chosen;
mod draped;
mod feature;
mod lay;
mod list;
mod on_map;
mod panel;
mod scene;
mod search;
mod state;

pub use feature::PhotosFeature;
pub use state::PhotoAppearance;

use pilotage_core::flight::photo::PhotoSearch;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
pub const ID: FeatureId = "photos";

/// Something to do about photos on the map.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotosCommand {
    /// Show something else.
    Close,
    /// Lay all of them on the map.
    Lay,
    /// Stop that; those that were laid stay.
    Stop,
    /// Look for them so from now on.
    Search(Box<PhotoSearch>),
    /// Look for them around the middle of what the map shows.
    AroundView,
    /// Look at one of them, by its number.
    Choose(usize),
    /// Show the chosen one on the map so.
    Display(PhotoAppearance),
}

impl From<PhotosCommand> for Command {
    fn from(command: PhotosCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
