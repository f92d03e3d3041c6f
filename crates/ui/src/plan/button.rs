//! A button that sends what can be asked for while planning.

use egui::Ui;

use super::command::PlanCommand;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{icons::Icon, text_button};

/// A button that sends a command.
pub fn button(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    icon: Option<Icon>,
    label: &str,
    strong: bool,
    command: PlanCommand,
) {
    if text_button(ui, context.tokens, icon, label, strong).clicked() {
        context.commands.push(Command::from(command));
    }
}
