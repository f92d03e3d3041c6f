//! Commands that save files, for whoever offers them; the feature of exports carries them out.

use pilotage_core::exchange::Format;
use pilotage_jobs::ExportOrder;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature that saves files.
pub const EXPORTS: FeatureId = "exports";

/// File to be saved.
#[derive(Clone, Debug, PartialEq)]
pub enum ExportCommand {
    /// The mission, with the pictures of its map.
    Mission,
    /// The mission alone, as GeoJSON.
    MissionAsGeoJson,
    /// The run.
    Run,
    /// The selected route as a file of another program.
    Route(Format),
    /// The estimated track, with the field that colours the recorded one, as a file of another program.
    Track(Format),
    /// All landmarks as a file of another program.
    Landmarks(Format),
    /// The rally points as way-points in a file of their own, as autopilots take them.
    Rally,
    /// Content of another feature as a file of another program.
    File(Box<(ExportedFile, ExportOrder)>),
}

/// File for another program, in words for people.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportedFile {
    /// Its content.
    pub what: String,
    /// Name of its format.
    pub format: &'static str,
    /// Its name.
    pub name: String,
}

impl From<ExportCommand> for Command {
    fn from(command: ExportCommand) -> Self {
        Self::Feature(FeatureCommand::new(EXPORTS, command))
    }
}
