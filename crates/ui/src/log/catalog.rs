//! Catalogue of the commands about the open log.

use egui::Key;

use super::LogCommand::{self, ShowPreset};
use super::{ID, LogTab, Preset};
use crate::command::Command;
use crate::feature_command::FeatureCommand;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, shift};

/// Rows of the table of all commands.
pub fn commands() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        entry(CommandGroup::View, label, shortcuts, Command::from(command))
    };
    vec![
        entry(
            CommandGroup::View,
            "Show the flight log",
            vec![shift(Key::L)],
            Command::Feature(FeatureCommand::show(ID)),
        ),
        of(
            "Fields of the log, expressions over them",
            vec![shift(Key::X)],
            LogCommand::ShowTab(LogTab::Fields),
        ),
        of(
            "Statistics of the selected time",
            vec![shift(Key::S)],
            LogCommand::ShowTab(LogTab::Statistics),
        ),
        of("Plot the attitude", vec![], ShowPreset(Preset::Attitude)),
        of(
            "Plot speeds and wind",
            vec![],
            ShowPreset(Preset::SpeedsAndWind),
        ),
        of("Plot the heights", vec![], ShowPreset(Preset::Height)),
        of(
            "Plot the navigation",
            vec![],
            ShowPreset(Preset::Navigation),
        ),
        of("Plot the vibration", vec![], ShowPreset(Preset::Vibration)),
        of(
            "Save the plotted fields as CSV",
            vec![],
            LogCommand::SaveTable,
        ),
        of("Save the plots as SVG", vec![], LogCommand::SaveSvg),
        of("Save the plots as PNG", vec![], LogCommand::SavePng),
    ]
}
