//! Commands of labelling, as the table of all commands has them.

use egui::Key;
use pilotage_core::exchange::labels::LabelFormat;

use super::LabelCommand;
use crate::command::Command;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, plain};

/// Rows of the table of all commands.
pub fn commands() -> Vec<CommandEntry> {
    let of = |label, shortcuts, command| {
        entry(CommandGroup::Edit, label, shortcuts, Command::from(command))
    };
    vec![
        of(
            "Label landmarks in the pictures",
            vec![plain(Key::K)],
            LabelCommand::Toggle,
        )
        .also("annotate annotation bounding box"),
        of(
            "Propose the label of the landmark",
            vec![plain(Key::Q)],
            LabelCommand::Propose,
        ),
        of(
            "The landmark is not in the picture",
            vec![plain(Key::O)],
            LabelCommand::MarkAbsent,
        ),
        of(
            "The landmark is hard to see in the picture",
            vec![plain(Key::Y)],
            LabelCommand::ToggleDifficult,
        ),
        of(
            "Delete the label of the landmark",
            vec![],
            LabelCommand::Delete,
        ),
        of(
            "Export the labels as COCO",
            vec![],
            LabelCommand::Export(LabelFormat::Coco),
        ),
        of(
            "Export the labels as Pascal VOC",
            vec![],
            LabelCommand::Export(LabelFormat::Voc),
        ),
    ]
}
