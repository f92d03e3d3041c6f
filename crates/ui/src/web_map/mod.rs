//! Maps of the web: opened by an address, and downloaded for use without a network.

mod dialog;
mod feature;

pub use feature::WebMapFeature;

use pilotage_core::frames::GroundRect;
use pilotage_jobs::WebMap;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "web_map";

/// Commands of the dialog.
#[derive(Clone, Debug, PartialEq)]
pub enum WebMapCommand {
    /// Show a map of tiles.
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
