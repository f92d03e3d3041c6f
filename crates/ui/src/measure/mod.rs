//! Distances, courses and areas measured on the map, whatever workspace shows it.

mod card;
mod feature;
mod line;
mod on_map;

use pilotage_core::frames::LocalFrame;

use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};
use crate::units::Units;

use line::Line;

/// Identity of the feature.
const ID: FeatureId = "measure";

/// Something to do about measuring.
#[derive(Clone, Copy, Debug, PartialEq)]
enum MeasureCommand {
    /// Begin, or leave.
    Toggle,
    /// Lead the line back to its first point.
    Close,
    /// Take all points away.
    Clear,
    /// Copy what is measured as text.
    Copy,
}

impl From<MeasureCommand> for Command {
    fn from(command: MeasureCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Measuring on the map.
#[derive(Debug, Default)]
pub struct Measure {
    /// Whether clicks on the map are for it.
    is_on: bool,
    line: Line,
    /// Point that is being dragged.
    dragged: Option<usize>,
    /// Frame of the world of the map, if that has a place on the globe.
    frame: Option<LocalFrame>,
    units: Units,
}
