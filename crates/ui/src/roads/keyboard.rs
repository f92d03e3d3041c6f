//! Keys for the work on roads.

use egui::{Key, Modifiers, Response, Ui};

use super::Roads;
use super::command::RoadCommand;
use crate::context::ViewContext;

impl Roads {
    /// Takes Enter, Backspace, Delete and Escape, unless they are for somebody else.
    pub(super) fn keyboard(&mut self, ui: &Ui, response: &Response, context: &mut ViewContext<'_>) {
        let (focused, dialog) = ui.memory(|it| (it.focused(), it.top_modal_layer()));
        if ui.ctx().text_edit_focused() || dialog.is_some() || egui::Popup::is_any_open(ui.ctx()) {
            return;
        }
        let takes_enter = focused.is_none_or(|id| id == response.id);
        let [enter, back, delete, escape] = ui.input_mut(|input| {
            let mut take = |key| input.consume_key(Modifiers::NONE, key);
            [
                takes_enter && take(Key::Enter),
                take(Key::Backspace),
                take(Key::Delete),
                take(Key::Escape),
            ]
        });
        let mut say = |command: RoadCommand| context.commands.push(command.into());
        if enter {
            say(RoadCommand::Draw);
        }
        match &mut self.drawing {
            Some(points) if back || delete => {
                points.pop();
            }
            None if back || delete => say(RoadCommand::DeletePoint),
            _ => {}
        }
        if escape {
            say(RoadCommand::Back);
        }
    }
}
