//! Commands about trained detectors, as the table of all commands has them.

use egui::Key;

use super::DetectorCommand;
use crate::command::Command;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, plain, shift};

/// Rows of the table of all commands.
pub fn commands() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        entry(CommandGroup::View, label, shortcuts, Command::from(command))
    };
    vec![
        of(
            "Show what a trained detector saw",
            vec![plain(Key::Z)],
            DetectorCommand::Show,
        ),
        of(
            "Detector: one stage back",
            vec![plain(Key::Comma)],
            DetectorCommand::Stages(-1),
        ),
        of(
            "Detector: one stage on",
            vec![plain(Key::Period)],
            DetectorCommand::Stages(1),
        ),
        of(
            "Detector: evaluate on days it has not seen",
            vec![],
            DetectorCommand::Evaluate,
        ),
        of(
            "Detector: let the stages pass",
            vec![shift(Key::Z)],
            DetectorCommand::Play,
        ),
    ]
}
