//! Keys for the work on roads.

use egui::{Key, Response, Ui};

use super::Roads;
use super::command::RoadCommand;
use crate::context::ViewContext;
use crate::map::tool_keys;

impl Roads {
    /// Takes Enter, Backspace, Delete and Escape, unless they are for somebody else.
    pub(super) fn keyboard(&self, ui: &Ui, response: &Response, context: &mut ViewContext<'_>) {
        let keys = [Key::Enter, Key::Backspace, Key::Delete, Key::Escape];
        let [enter, back, delete, escape] = tool_keys(ui, response, keys);
        let mut say = |command: RoadCommand| context.commands.push(command.into());
        if enter {
            say(RoadCommand::Draw);
        }
        match &self.drawing {
            Some(_) if back || delete => say(RoadCommand::TakeBack),
            None if back || delete => say(RoadCommand::DeletePoint),
            _ => {}
        }
        if escape {
            say(RoadCommand::Back);
        }
    }
}
