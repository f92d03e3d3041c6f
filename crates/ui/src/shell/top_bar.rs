//! The bar at the top: name, workspaces, document, and what can be done with it.

use egui::{Align, Layout, RichText, Ui};

use super::icons::Icon;
use super::widgets::{icon_button, icon_toggle, muted, tab, text_button};
use crate::command::{Command, Workspace};
use crate::export_command::ExportCommand;
use crate::feature_command::{FeatureCommand, FeatureId};
use crate::tokens::Tokens;
use crate::units::Units;

/// Content of the bar.
pub struct TopBar<'a> {
    /// The open workspace.
    pub workspace: Workspace,
    /// The document's title.
    pub title: &'a str,
    /// Computation under way: progress (0 to 1) and words.
    pub progress: Option<(f32, &'a str)>,
    /// The user's units.
    pub units: Units,
    /// Whether the settings are open.
    pub settings_open: bool,
    /// Whether the column at the right is open.
    pub side_open: bool,
    /// Whether the plots are open.
    pub plots_open: bool,
    /// Buttons of features: sign, words, and whose it is.
    pub buttons: &'a [(Icon, &'static str, FeatureId)],
}

/// Draws the bar.
pub fn top_bar(ui: &mut Ui, tokens: &Tokens, bar: &TopBar<'_>, commands: &mut Vec<Command>) {
    let width = ui.available_width();
    let narrow = width < 860.0;
    let height = ui.available_height();
    ui.spacing_mut().item_spacing.x = if narrow { 2.0 } else { 4.0 };
    let (mark, _) = ui.allocate_exact_size(egui::vec2(28.0, height), egui::Sense::hover());
    Icon::Aircraft.paint_sized(ui.painter(), mark.center(), 20.0, tokens.accent);
    if !narrow {
        ui.label(
            RichText::new("Pilotage")
                .font(tokens.large())
                .color(tokens.text),
        );
        ui.add_space(2.0 * tokens.space);
    }
    for workspace in Workspace::ALL {
        if tab(
            ui,
            tokens,
            workspace.label(),
            workspace == bar.workspace,
            height,
        )
        .clicked()
        {
            commands.push(Command::ShowWorkspace(workspace));
        }
    }
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if narrow {
            menu(ui, tokens, commands);
        } else {
            toggles(ui, tokens, bar, commands);
        }
        actions(ui, tokens, bar, commands, width < 1180.0);
        if width > 620.0 {
            middle(ui, tokens, bar, commands);
        }
    });
}

fn actions(
    ui: &mut Ui,
    tokens: &Tokens,
    bar: &TopBar<'_>,
    commands: &mut Vec<Command>,
    compact: bool,
) {
    if icon_toggle(
        ui,
        tokens,
        Icon::Settings,
        "Filter settings",
        bar.settings_open,
    )
    .clicked()
    {
        commands.push(Command::ToggleSettings);
    }
    if compact {
        if icon_button(ui, tokens, Icon::Open, "Open…").clicked() {
            commands.push(Command::Open);
        }
    } else {
        ui.add_space(4.0);
        if text_button(ui, tokens, Some(Icon::Open), "Open…", false).clicked() {
            commands.push(Command::Open);
        }
        ui.add_space(4.0);
    }
    for (icon, label, of) in bar.buttons {
        if icon_button(ui, tokens, *icon, label).clicked() {
            commands.push(Command::Feature(FeatureCommand::show(of)));
        }
    }
    if text_button(ui, tokens, Some(Icon::Aircraft), "Simulate…", true).clicked() {
        commands.push(Command::ToggleSimulate);
    }
}

fn toggles(ui: &mut Ui, tokens: &Tokens, bar: &TopBar<'_>, commands: &mut Vec<Command>) {
    if icon_button(ui, tokens, Icon::Help, "All shortcuts").clicked() {
        commands.push(Command::ToggleHelp);
    }
    if icon_button(ui, tokens, Icon::Search, "Find a command").clicked() {
        commands.push(Command::TogglePalette);
    }
    let (icon, label) = if tokens.dark {
        (Icon::Sun, "Light colours")
    } else {
        (Icon::Moon, "Dark colours")
    };
    if icon_button(ui, tokens, icon, label).clicked() {
        commands.push(Command::ToggleTheme);
    }
    let label = match bar.units {
        Units::Metric => "Units: metric. Change to aviation",
        Units::Aviation => "Units: aviation. Change to metric",
    };
    if icon_button(ui, tokens, Icon::Ruler, label).clicked() {
        commands.push(Command::ToggleUnits);
    }
    if icon_toggle(ui, tokens, Icon::Plots, "Plots", bar.plots_open).clicked() {
        commands.push(Command::TogglePlots);
    }
    if icon_toggle(ui, tokens, Icon::Side, "Side column", bar.side_open).clicked() {
        commands.push(Command::ToggleSide);
    }
    if icon_button(ui, tokens, Icon::Save, "Save the mission").clicked() {
        commands.push(ExportCommand::Mission.into());
    }
}

/// Everything that finds no place in a narrow bar.
fn menu(ui: &mut Ui, tokens: &Tokens, commands: &mut Vec<Command>) {
    let button = icon_button(ui, tokens, Icon::More, "More");
    egui::Popup::menu(&button).show(|ui| {
        ui.set_min_width(220.0);
        for (label, command) in [
            ("Save the mission", ExportCommand::Mission.into()),
            ("Save the run", ExportCommand::Run.into()),
            ("Show or hide the plots", Command::TogglePlots),
            ("Show or hide the side column", Command::ToggleSide),
            ("Metric or aviation units", Command::ToggleUnits),
            ("Dark or light", Command::ToggleTheme),
            ("Find a command", Command::TogglePalette),
            ("All shortcuts", Command::ToggleHelp),
        ] {
            if ui.button(label).clicked() {
                commands.push(command);
                ui.close();
            }
        }
    });
}

fn middle(ui: &mut Ui, tokens: &Tokens, bar: &TopBar<'_>, commands: &mut Vec<Command>) {
    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
        ui.add_space(2.0 * tokens.space);
        if let Some((fraction, words)) = bar.progress {
            let (rect, _) = ui.allocate_exact_size(egui::vec2(64.0, 4.0), egui::Sense::hover());
            ui.painter().rect_filled(rect, 2.0, tokens.line);
            let mut done = rect;
            done.set_right(rect.left() + rect.width() * fraction.clamp(0.0, 1.0));
            ui.painter().rect_filled(done, 2.0, tokens.accent);
            if icon_button(ui, tokens, Icon::Close, "Stop computing").clicked() {
                commands.push(Command::CancelJob);
            }
            ui.add(egui::Label::new(muted(tokens, words)).truncate());
        } else {
            let text = RichText::new(bar.title).color(tokens.muted);
            ui.add(egui::Label::new(text).truncate());
        }
    });
}
