//! What can be asked of a log.

use crate::jobs::SeriesName;

/// Something to do about the open log.
#[derive(Clone, Debug, PartialEq)]
pub enum LogCommand {
    /// Plot a field in the panel that was touched last, or take it away where it is plotted.
    Toggle(SeriesName),
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
    /// Colour the track by a field, or no more.
    ColourTrack(Option<SeriesName>),
    /// Show the overview of the log.
    Show,
    /// Go on with reading it, once it was stopped.
    ReadAgain,
}
