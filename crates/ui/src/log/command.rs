//! Commands about a log.

use super::arrangement::Preset;
use super::presets::PresetCommand;
use crate::command::Command;
use crate::feature_command::{FeatureCommand, FeatureId};
use pilotage_jobs::SeriesName;

/// Identity of the feature.
pub const ID: FeatureId = "log";

/// Something to do about the open log.
#[derive(Clone, Debug, PartialEq)]
pub enum LogCommand {
    /// Plot a field in the panel that was touched last, or take it away where it is plotted.
    Toggle(SeriesName),
    /// Plot a field in the panel that was touched last.
    Plot(SeriesName),
    /// Plot a field in a panel of its own.
    PlotAlone(SeriesName),
    /// Take a field out of a panel.
    Remove {
        /// Number of the panel, from the top.
        panel: usize,
        /// The field.
        series: SeriesName,
    },
    /// Take a panel away.
    ClosePanel(usize),
    /// Plot a panel against a field, or over time.
    PlotAgainst {
        /// Number of the panel, from the top.
        panel: usize,
        /// The field; time if `None`.
        against: Option<SeriesName>,
    },
    /// Join the points of a panel that is plotted against a field, or not.
    JoinPoints {
        /// Number of the panel, from the top.
        panel: usize,
        /// Whether they are joined.
        joined: bool,
    },
    /// Show a built-in arrangement of plots.
    ShowPreset(Preset),
    /// Something about arrangements that people saved.
    Presets(PresetCommand),
    /// Save the plots as an SVG drawing.
    SaveSvg,
    /// Save the plots as a PNG picture.
    SavePng,
    /// Colour the track by a field, or no more.
    ColourTrack(Option<SeriesName>),
    /// Show a part of what is known of it there.
    ShowTab(LogTab),
    /// Save the plotted fields of the selected span, or of the one shown, as comma-separated values.
    SaveTable,
    /// Fly another of its vehicles, by the number of its system.
    FlyVehicle(u32),
    /// Go on with reading it, once it was stopped.
    ReadAgain,
}

impl From<LogCommand> for Command {
    fn from(command: LogCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Tab of a log in the column at the right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LogTab {
    /// The log at a glance.
    #[default]
    Overview,
    /// Its fields, to be plotted.
    Fields,
    /// Figures of the plotted fields.
    Statistics,
}

impl LogTab {
    /// Every part, in reading order.
    pub const ALL: [Self; 3] = [Self::Overview, Self::Fields, Self::Statistics];

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Overview => "Overview",
            Self::Fields => "Fields",
            Self::Statistics => "Statistics",
        }
    }
}
