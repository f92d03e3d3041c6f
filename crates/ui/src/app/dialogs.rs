//! Dialogs over everything, open or not.

use egui::Ui;

use crate::command::Command;
use crate::shell::{MenuTable, Palette, Toasts, help_sheet, notices_sheet};
use crate::tokens::Tokens;

/// Open state of the dialogs.
#[derive(Debug, Default)]
pub(super) struct Dialogs {
    pub(super) palette: Palette,
    pub(super) help: bool,
    pub(super) notices: bool,
    pub(super) settings: bool,
}

impl Dialogs {
    /// Draws the palette over the commands of `table`, and the sheets that are open, with the notices as old as they
    /// are `now`.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        table: &MenuTable<'_>,
        (toasts, now): (&Toasts, f64),
        commands: &mut Vec<Command>,
    ) {
        self.palette.show(ui, tokens, table, commands);
        if self.help && help_sheet(ui.ctx(), tokens, table.catalog) {
            self.help = false;
        }
        if self.notices && notices_sheet(ui.ctx(), tokens, toasts, now) {
            self.notices = false;
        }
    }
}
