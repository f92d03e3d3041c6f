//! Shortcuts, taken before egui moves its focus with the arrows, but never from a text field.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers, Plugin, RawInput};

use super::catalog::CommandEntry;
use crate::command::Command;

/// Listens to the keyboard ahead of every widget.
pub struct ShortcutListener {
    table: Vec<(KeyboardShortcut, Command)>,
    pending: Vec<Command>,
    /// Whether letters are for a field that is about to have the keyboard.
    held: bool,
}

impl ShortcutListener {
    /// Listener for the shortcuts of `catalog`.
    pub fn new(catalog: &[CommandEntry]) -> Self {
        let table = catalog
            .iter()
            .flat_map(|e| e.shortcuts.iter().map(|s| (*s, e.command.clone())))
            .collect();
        Self {
            table,
            pending: Vec::new(),
            held: false,
        }
    }

    /// The commands asked for since the last call.
    pub fn take(context: &Context) -> Vec<Command> {
        context
            .with_plugin(|listener: &mut Self| std::mem::take(&mut listener.pending))
            .unwrap_or_default()
    }

    /// Says whether letters belong to a dialog, even before its field has the keyboard.
    pub fn hold(context: &Context, held: bool) {
        context.with_plugin(|listener: &mut Self| listener.held = held);
    }

    fn command_for(&self, key: Key, modifiers: Modifiers) -> Option<&Command> {
        let control = modifiers.command || modifiers.ctrl;
        self.table
            .iter()
            .find(|(shortcut, _)| {
                shortcut.logical_key == key
                    && shortcut.modifiers.command == control
                    && shortcut.modifiers.shift == modifiers.shift
                    && !modifiers.alt
            })
            .map(|(_, command)| command)
    }
}

/// Keys that a focused widget (button, slider, list row) needs for itself.
fn belongs_to_focus(key: Key) -> bool {
    matches!(
        key,
        Key::Space
            | Key::Enter
            | Key::ArrowLeft
            | Key::ArrowRight
            | Key::ArrowUp
            | Key::ArrowDown
            | Key::Home
            | Key::End
    )
}

impl Plugin for ShortcutListener {
    fn debug_name(&self) -> &'static str {
        "pilotage shortcuts"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let mut typing = self.held || context.text_edit_focused();
        let focused = context.memory(|memory| memory.focused().is_some());
        let mut pending = Vec::new();
        let mut took_letter = false;
        input.events.retain(|event| {
            let (key, modifiers) = match event {
                Event::Key {
                    key,
                    pressed: true,
                    modifiers,
                    ..
                } => (key, modifiers),
                // The letter would otherwise be typed into the field that its command opens.
                Event::Text(_) => return !std::mem::take(&mut took_letter),
                _ => return true,
            };
            took_letter = false;
            let Some(command) = self.command_for(*key, *modifiers) else {
                return true;
            };
            let everywhere = matches!(command, Command::TogglePalette) && modifiers.command;
            if (typing && !everywhere) || (focused && belongs_to_focus(*key)) {
                return true;
            }
            took_letter = !modifiers.command && !modifiers.ctrl;
            typing |= matches!(command, Command::TogglePalette);
            pending.push(command.clone());
            false
        });
        self.pending.extend(pending);
    }
}
