//! The georeferencer: a picture put on the ground by points picked in it and on the map.

mod canvas;
mod coordinates;
mod feature;
mod marks;
mod over_map;
mod over_picture;
mod panel;
mod state;
mod work;
mod world;

use state::{Georeferencer, NamedPlace};
pub use work::GeoreferencerFeature;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "georeferencer";

/// Commands of the georeferencer.
#[derive(Clone, Debug, PartialEq)]
pub enum GeoreferenceCommand {
    /// Show the picture as the map, where the fit puts it.
    UseAsMap,
    /// Save the world file and the .prj beside it.
    SaveWorldFile,
    /// Save the points as QGIS writes them.
    SavePoints,
    /// Open files with points or places.
    Load,
    /// Leave, and keep the map as it is.
    Close,
}

impl From<GeoreferenceCommand> for Command {
    fn from(command: GeoreferenceCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}
