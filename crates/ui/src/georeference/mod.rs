//! The georeferencer: a picture put on the ground by points picked in it and on the map.

mod canvas;
mod coordinates;
mod marks;
mod over_map;
mod over_picture;
mod panel;
mod state;

pub use state::{Georeferencer, NamedPlace};

use crate::command::Command;
use crate::feature_command::FeatureCommand;

/// Commands of the georeferencer to the app.
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
        Self::Feature(FeatureCommand::new("georeference", command))
    }
}
