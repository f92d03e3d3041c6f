//! The list of arrangements: built-in ones, saved ones, and the field that saves one.

use egui::{Key, Popup, PopupCloseBehavior, RichText, TextEdit, Ui};

use super::arrangement::Preset;
use super::presets::{OwnPresets, PresetCommand};
use super::{LogCommand, OpenLog};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::is_entered;
use crate::tokens::Tokens;
use crate::views::parts;

/// The list's own state.
#[derive(Clone, Debug, Default)]
pub struct PresetMenu {
    /// The name under which to save.
    name: String,
    /// The arrangement that is being renamed, and the name as far as it is written.
    renaming: Option<(String, String)>,
}

impl PresetMenu {
    /// Draws the chip that opens the list.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        log: &OpenLog,
        own: &OwnPresets,
    ) {
        let tokens = context.tokens;
        let chip = parts::chip(ui, tokens, false, "Presets", "Presets of plots");
        let mut asked = Vec::new();
        Popup::menu(&chip)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show(|ui| {
                ui.set_width(32.0 * tokens.space);
                for preset in Preset::ALL {
                    built_in(ui, log, preset, &mut asked);
                }
                ui.separator();
                for preset in own.all() {
                    self.own(ui, tokens, &preset.name, &mut asked);
                }
                if own.can_undo() && ui.button("Take back the last change").clicked() {
                    asked.push(LogCommand::Presets(PresetCommand::Undo));
                }
                self.save(ui, tokens, &mut asked);
            });
        let asked = asked.into_iter().map(Command::from);
        context.commands.extend(asked);
    }

    /// A saved arrangement: shown by a click, with chips to rename and delete it.
    fn own(&mut self, ui: &mut Ui, tokens: &Tokens, name: &str, asked: &mut Vec<LogCommand>) {
        if let Some((from, to)) = self.renaming.as_mut().filter(|(from, _)| from == name) {
            let edit = TextEdit::singleline(to)
                .align(egui::Align2::LEFT_CENTER)
                .desired_width(f32::INFINITY);
            let field = ui.add(edit).accessible_name("New name of the preset");
            if !field.has_focus() && !field.lost_focus() {
                field.request_focus();
            }
            if field.lost_focus() {
                if ui.input(|i| i.key_pressed(Key::Enter)) {
                    let (from, to) = (from.clone(), to.clone());
                    asked.push(LogCommand::Presets(PresetCommand::Rename { from, to }));
                }
                self.renaming = None;
            }
            return;
        }
        ui.horizontal(|ui| {
            if named_button(ui, name, true, &format!("Show preset {name}")) {
                asked.push(LogCommand::Presets(PresetCommand::Show(name.to_owned())));
                ui.close();
            }
            let right = egui::Layout::right_to_left(egui::Align::Center);
            ui.with_layout(right, |ui| {
                let delete = parts::chip(ui, tokens, false, "×", &format!("Delete preset {name}"));
                if delete.clicked() {
                    asked.push(LogCommand::Presets(PresetCommand::Delete(name.to_owned())));
                }
                let said = format!("Rename preset {name}");
                if parts::chip(ui, tokens, false, "rename", &said).clicked() {
                    self.renaming = Some((name.to_owned(), name.to_owned()));
                }
            });
        });
    }

    /// The field that saves the plots as they are.
    fn save(&mut self, ui: &mut Ui, tokens: &Tokens, asked: &mut Vec<LogCommand>) {
        ui.horizontal(|ui| {
            let edit = TextEdit::singleline(&mut self.name)
                .align(egui::Align2::LEFT_CENTER)
                .hint_text("Save these plots as …")
                .desired_width(22.0 * tokens.space);
            let field = ui.add(edit).accessible_name("Name of a new preset");
            let is_entered = is_entered(&field);
            let is_clicked = named_button(ui, "Save", true, "Save these plots as a preset");
            let name = self.name.trim();
            if (is_entered || is_clicked) && !name.is_empty() {
                asked.push(LogCommand::Presets(PresetCommand::Save(name.to_owned())));
                self.name.clear();
            }
        });
    }
}

/// A built-in arrangement; grey where the log has nothing of it.
fn built_in(ui: &mut Ui, log: &OpenLog, preset: Preset, asked: &mut Vec<LogCommand>) {
    let has_any = !preset.panels(log).is_empty();
    let label = preset.label();
    if named_button(ui, label, has_any, &format!("Show preset {label}")) {
        asked.push(LogCommand::ShowPreset(preset));
        ui.close();
    }
}

/// A flat button with a name of its own; whether it was clicked.
fn named_button(ui: &mut Ui, text: &str, is_enabled: bool, name: &str) -> bool {
    let button = egui::Button::new(RichText::new(text)).frame(false);
    let response = ui.add_enabled(is_enabled, button);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_enabled, name));
    response.clicked()
}
