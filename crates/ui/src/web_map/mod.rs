//! Maps of the web: opened by an address, and downloaded for use without a network.

mod address;
mod dialog;
mod feature;
mod services;

pub use feature::WebMapFeature;

use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_jobs::WebMap;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "web_map";

/// Commands of the dialog.
#[derive(Clone, Debug, PartialEq)]
pub enum WebMapCommand {
    /// Open the dialog for a map that begins at a place, whatever world is open.
    BeginAt(Geodetic),
    /// Show a map of tiles, in a world of its own unless its origin is that of the world that is open.
    OpenTiles(Box<WebMap>),
    /// Open the file at an address.
    OpenFile(String),
    /// Download tiles of the map that is open over an area, at zooms from the first to the last.
    Download(GroundRect, (u8, u8)),
    /// Stop that.
    StopDownload,
}

impl From<WebMapCommand> for Command {
    fn from(command: WebMapCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
