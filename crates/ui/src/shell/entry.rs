//! A command as the table of all of them has it: its words, its group and its keys.

use std::borrow::Cow;

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::command::Command;

/// Group of a command in the help sheet and the palette.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandGroup {
    /// Time and playback.
    Playback,
    /// Map and panels.
    View,
    /// Landmarks and undo.
    Edit,
    /// Routes and what is predicted of them.
    Plan,
    /// Flights, files, settings.
    Document,
}

impl CommandGroup {
    /// Every group, in reading order.
    pub const ALL: [Self; 5] = [
        Self::Playback,
        Self::View,
        Self::Edit,
        Self::Plan,
        Self::Document,
    ];

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Playback => "Playback",
            Self::View => "Map and panels",
            Self::Edit => "Landmarks",
            Self::Plan => "Plan",
            Self::Document => "Flight and files",
        }
    }
}

/// Menu of the top bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarMenu {
    /// Files and flights to open.
    Open,
    /// Files to save, and what can be shared.
    Save,
    /// Files for other programs, below what can be saved.
    Export,
    /// The same of routes, a menu by itself among them.
    ExportRoute,
    /// The same of landmarks.
    ExportLandmarks,
    /// The same of where a flight went.
    ExportTrack,
    /// Settings, where they have no button of their own.
    Settings,
    /// Panels, units, colours and map.
    View,
    /// Explanations of the app.
    Help,
}

impl BarMenu {
    /// Words with which every label in it begins, where it opens as a menu by itself out of another.
    pub fn beginning(self) -> Option<&'static str> {
        match self {
            Self::ExportRoute => Some("Export the route as"),
            Self::ExportLandmarks => Some("Export the landmarks as"),
            Self::ExportTrack => Some("Save the flown track as"),
            _ => None,
        }
    }
}

/// Row of the table.
#[derive(Clone, Debug)]
pub struct CommandEntry {
    /// Label of the command, in words.
    pub label: Cow<'static, str>,
    /// Its group.
    pub group: CommandGroup,
    /// Its keys, the first shown first.
    pub shortcuts: Vec<KeyboardShortcut>,
    /// Command that is sent.
    pub command: Command,
    /// Other words for it by which people look for it.
    pub also: &'static str,
    /// Menu in which it stands, if it does in one.
    pub menu: Option<BarMenu>,
}

/// Lack for which a command can do nothing now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommandLack {
    /// Lack, in a few words.
    pub what: &'static str,
    /// Advice to whoever wants the command nevertheless.
    pub advice: &'static str,
}

impl CommandLack {
    /// That lack, unless what is needed `is_there`.
    pub fn unless(is_there: bool, what: &'static str, advice: &'static str) -> Option<Self> {
        (!is_there).then_some(Self { what, advice })
    }
}

/// Commands of which menus show theirs.
pub struct MenuTable<'a> {
    /// All commands.
    pub catalog: &'a [CommandEntry],
    /// Lack for which a command can do nothing now.
    pub lack: &'a dyn Fn(&Command) -> Option<CommandLack>,
}

impl CommandEntry {
    /// The same command, found by other words as well.
    #[must_use]
    pub fn also(self, also: &'static str) -> Self {
        Self { also, ..self }
    }

    /// The same command in a menu of the top bar.
    #[must_use]
    pub fn under(self, menu: BarMenu) -> Self {
        let menu = Some(menu);
        Self { menu, ..self }
    }

    /// Its first shortcut as people read it, or an empty text.
    pub fn keys(&self) -> String {
        self.shortcuts.first().map(describe).unwrap_or_default()
    }

    /// The same beside its label in a list, unless fingers `touch` it: they have no keys.
    pub fn keys_beside(&self, touch: bool) -> String {
        if touch { String::new() } else { self.keys() }
    }
}

/// A shortcut as people read it.
pub fn describe(shortcut: &KeyboardShortcut) -> String {
    let mut words = Vec::new();
    if shortcut.modifiers.command {
        words.push("Ctrl");
    }
    if shortcut.modifiers.shift {
        words.push("Shift");
    }
    let key = match shortcut.logical_key {
        Key::ArrowLeft => "←",
        Key::ArrowRight => "→",
        Key::OpenBracket => "[",
        Key::CloseBracket => "]",
        Key::Questionmark => "?",
        Key::Comma => ",",
        Key::Period => ".",
        Key::Plus => "+",
        Key::Minus => "-",
        other => other.name(),
    };
    words.push(key);
    words.join(" ")
}

/// A key alone.
pub fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

/// A key with Shift.
pub fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

/// A key with Control, or with Command where that is usual.
pub fn control(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

/// A row of the table.
pub fn entry(
    group: CommandGroup,
    label: impl Into<Cow<'static, str>>,
    shortcuts: Vec<KeyboardShortcut>,
    command: Command,
) -> CommandEntry {
    CommandEntry {
        label: label.into(),
        group,
        shortcuts,
        command,
        also: "",
        menu: None,
    }
}

#[cfg(test)]
mod tests {
    use egui::Key;

    use super::*;

    #[test]
    fn fingers_are_told_of_no_keys() {
        let keys = vec![control(Key::S)];
        let save = entry(CommandGroup::Document, "Save", keys, Command::Undo);
        assert_eq!(save.keys_beside(false), "Ctrl S");
        assert_eq!(save.keys_beside(true), "");
    }
}
