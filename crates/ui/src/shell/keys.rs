//! Shortcuts, taken before egui moves its focus with the arrows, but never from a text field.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers, Plugin, Popup, RawInput};

use super::catalog::CommandEntry;
use crate::command::Command;

/// Listens to the keyboard ahead of every widget.
pub struct ShortcutListener {
    table: Vec<(KeyboardShortcut, Command)>,
    pending: Vec<Command>,
    /// Whether letters are for a field that is about to have the keyboard.
    held: bool,
    /// Whether keys of the frame are for something above the views.
    covered: bool,
    /// Events that wait for the next frame, in their order.
    waiting: Vec<Event>,
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
            covered: false,
            waiting: Vec::new(),
        }
    }

    /// The commands asked for since the last call.
    pub fn take(context: &Context) -> Vec<Command> {
        context
            .with_plugin(|listener: &mut Self| std::mem::take(&mut listener.pending))
            .unwrap_or_default()
    }

    /// Whether keys or clicks wait for the next frame.
    pub fn waits(context: &Context) -> bool {
        let waits = context.with_plugin(|listener: &mut Self| !listener.waiting.is_empty());
        waits.unwrap_or_default()
    }

    /// Says whether letters belong to a dialog, even before its field has the keyboard.
    pub fn hold(context: &Context, held: bool) {
        context.with_plugin(|listener: &mut Self| listener.held = held);
    }

    /// Says, before anything is drawn, that a dialog lies over the views.
    pub fn cover(context: &Context) {
        context.with_plugin(|listener: &mut Self| listener.covered = true);
    }

    /// Whether keys of this frame are for what lay above the views as it began: a field that is written in, a list to
    /// choose from, a dialog. What a key closes is gone for those that are drawn later; the key was not for them.
    pub fn is_covered(context: &Context) -> bool {
        context
            .with_plugin(|listener: &mut Self| listener.covered)
            .unwrap_or_default()
    }

    /// Leaves in `events` the presses of one key, or the clicks, that come first, with what is around them; the others
    /// wait.
    ///
    /// A slow frame may hold several. Shortcuts are obeyed as it begins and other keys and clicks as it is drawn, so
    /// that together they would be obeyed in another order than the one in which they came.
    fn wait_in_turn(&mut self, events: &mut Vec<Event>) {
        let mut first = None;
        let second = events.iter().position(|event| {
            let turn = match event {
                Event::Key {
                    key, pressed: true, ..
                } => Some(*key),
                Event::PointerButton { .. } => None,
                _ => return false,
            };
            *first.get_or_insert(turn) != turn
        });
        if let Some(second) = second {
            self.waiting = events.split_off(second);
        }
    }

    /// Leaves in `events`, while letters are for a field, all up to a key that may end that: what comes behind it may be
    /// for something else, and waits.
    fn wait_for_end_of_typing(&mut self, events: &mut Vec<Event>) {
        let ends = |event: &Event| {
            matches!(
                event,
                Event::Key {
                    key: Key::Escape | Key::Enter | Key::Tab,
                    pressed: true,
                    ..
                }
            )
        };
        if let Some(end) = events.iter().position(ends) {
            self.waiting = events.split_off(end + 1);
        }
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
        // Escape takes the keyboard from a field before anything is drawn.
        let is_written = context.text_edit_focused();
        self.covered = is_written || Popup::is_any_open(context);
        let mut typing = self.held || is_written;
        if !self.waiting.is_empty() {
            input.events.splice(0..0, self.waiting.drain(..));
        }
        if typing {
            self.wait_for_end_of_typing(&mut input.events);
        } else {
            self.wait_in_turn(&mut input.events);
        }
        if !self.waiting.is_empty() {
            context.request_repaint();
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn press(key: Key) -> Event {
        Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        }
    }

    /// For each of four frames, of which the first holds all the events: presses of "down" and of the mouse that
    /// widgets see, and commands. A field has the keyboard, if `typing`, until it sees Escape.
    fn seen(events: Vec<Event>, typing: bool) -> Vec<(usize, usize, usize)> {
        let context = Context::default();
        let shortcut = KeyboardShortcut::new(Modifiers::NONE, Key::Q);
        let mut listener = ShortcutListener::new(&[]);
        listener.table = vec![(shortcut, Command::TogglePlay)];
        listener.held = typing;
        context.add_plugin(listener);
        let mut events = Some(events);
        let frames = (0..4).map(|_| {
            let input = RawInput {
                events: events.take().unwrap_or_default(),
                ..RawInput::default()
            };
            let mut seen = (0, 0, 0);
            let mut output = context.run_ui(input, |ui| {
                seen.0 = ui.input(|i| i.num_presses(Key::ArrowDown));
                seen.1 = usize::from(ui.input(|i| i.pointer.any_pressed()));
                seen.2 = ShortcutListener::take(ui.ctx()).len();
                if ui.input(|i| i.key_pressed(Key::Escape)) {
                    ShortcutListener::hold(ui.ctx(), false);
                }
            });
            output.textures_delta.clear();
            seen
        });
        frames.collect()
    }

    #[test]
    fn keys_and_clicks_of_a_slow_frame_are_obeyed_in_their_order() {
        let [down, shortcut] = [press(Key::ArrowDown), press(Key::Q)];
        let click = Event::PointerButton {
            pos: egui::pos2(5.0, 5.0),
            button: egui::PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::NONE,
        };
        let letter = Event::Text("q".to_owned());
        let events = vec![
            down.clone(),
            down,
            shortcut.clone(),
            letter,
            click,
            shortcut,
        ];
        assert_eq!(
            seen(events, false),
            [(2, 0, 0), (0, 0, 1), (0, 1, 0), (0, 0, 1)]
        );
    }

    #[test]
    fn a_shortcut_behind_the_escape_from_a_field_is_obeyed() {
        let [shortcut, escape] = [press(Key::Q), press(Key::Escape)];
        let letters = vec![shortcut.clone(), escape, shortcut];
        let commands: Vec<usize> = seen(letters, true).iter().map(|it| it.2).collect();
        assert_eq!(commands, [0, 1, 0, 0]);
    }
}
