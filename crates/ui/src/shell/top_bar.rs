//! The bar at the top: name, workspaces, document, and what can be done with it.

use egui::{RichText, Ui};

use super::bar_menu::{BarButton, bar_menu};
use super::entry::{BarMenu, MenuTable};
use super::icons::Icon;
use super::widgets::{at_right, icon_button, muted, tab_in, text_button};
use crate::command::{Command, Workspace};
use crate::tokens::Tokens;

/// Bars at least as wide as this have words beside their signs.
const WITH_WORDS: f32 = 1200.0;
/// Bars narrower than this have one menu in the place of most groups.
const NARROW: f32 = 620.0;
/// Width of the bar that says how far what is under way is, points.
const PROGRESS: f32 = 64.0;

/// The step that comes next in a workspace: the one button that stands out.
#[derive(Clone, Debug)]
pub struct NextStep {
    /// Sign.
    pub icon: Icon,
    /// Action in words.
    pub label: &'static str,
    /// Command that it gives.
    pub command: Command,
}

/// Content of the bar.
pub struct TopBar<'a> {
    /// The open workspace.
    pub workspace: Workspace,
    /// The document's title.
    pub title: &'a str,
    /// Computation under way: progress (0 to 1) and words.
    pub progress: Option<(f32, &'a str)>,
    /// Whether the settings are open.
    pub settings_open: bool,
    /// The step that comes next.
    pub next: Option<NextStep>,
    /// Commands of its menus.
    pub table: MenuTable<'a>,
}

/// Draws the bar.
pub fn top_bar(ui: &mut Ui, tokens: &Tokens, bar: &TopBar<'_>, commands: &mut Vec<Command>) {
    let width = ui.available_width();
    let is_narrow = width < NARROW;
    let height = ui.available_height();
    ui.spacing_mut().item_spacing.x = if width < WITH_WORDS { 2.0 } else { 4.0 };
    if !is_narrow {
        let (mark, _) = ui.allocate_exact_size(egui::vec2(28.0, height), egui::Sense::hover());
        Icon::Aircraft.paint_sized(ui.painter(), mark.center(), 20.0, tokens.accent);
    }
    if width >= 860.0 {
        let name = RichText::new("Pilotage").font(tokens.large());
        ui.label(name.color(tokens.text));
        ui.add_space(2.0 * tokens.space);
    }
    for workspace in Workspace::ALL {
        let is_open = workspace == bar.workspace;
        let font = if is_narrow {
            tokens.small()
        } else {
            tokens.normal()
        };
        let label = (workspace.label(), font);
        if tab_in(ui, tokens, label, is_open, height).clicked() {
            commands.push(Command::ShowWorkspace(workspace));
        }
    }
    let mut stop = false;
    let before = |ui: &mut Ui| {
        if !is_narrow {
            stop = middle(ui, tokens, bar);
        }
    };
    at_right(ui, before, |ui| {
        if let Some(next) = &bar.next {
            next_step(ui, tokens, next, is_narrow, commands);
        }
        groups(ui, tokens, bar, width, commands);
    });
    if stop {
        commands.push(Command::CancelJob);
    }
}

/// Groups of what can be done: at most six groups, in narrow bars two.
fn groups(ui: &mut Ui, tokens: &Tokens, bar: &TopBar<'_>, width: f32, commands: &mut Vec<Command>) {
    let has_words = width >= WITH_WORDS;
    let button = |icon, name, words: &'static str| BarButton {
        icon,
        name,
        words: if has_words { words } else { "" },
        on: None,
        has_menu: false,
    };
    let mut menu = |ui: &mut Ui, icon, name: &'static str, menus: &[BarMenu]| {
        let face = BarButton {
            has_menu: width >= NARROW,
            ..button(icon, name, name)
        };
        let opened = face.show(ui, tokens);
        bar_menu(&opened, tokens, &bar.table, menus, commands);
    };
    if width < NARROW {
        let rest = [
            BarMenu::Save,
            BarMenu::ExportRoute,
            BarMenu::Settings,
            BarMenu::View,
            BarMenu::Help,
        ];
        menu(ui, Icon::Open, "Open", &[BarMenu::Open]);
        menu(ui, Icon::More, "More", &rest);
        return;
    }
    let save = [
        BarMenu::Save,
        BarMenu::Export,
        BarMenu::ExportRoute,
        BarMenu::ExportLandmarks,
        BarMenu::ExportTrack,
    ];
    menu(ui, Icon::Open, "Open", &[BarMenu::Open]);
    menu(ui, Icon::Save, "Save", &save);
    let filter = BarButton {
        on: Some(bar.settings_open),
        ..button(Icon::Settings, "Filter settings", "Filter")
    };
    let filter = filter.show(ui, tokens);
    menu(ui, Icon::Side, "View", &[BarMenu::View]);
    let find = button(Icon::Search, "Find a command", "Find").show(ui, tokens);
    menu(ui, Icon::Help, "Help", &[BarMenu::Help]);
    if find.clicked() {
        commands.push(Command::TogglePalette);
    }
    if filter.clicked() {
        commands.push(Command::ToggleSettings);
    }
}

fn next_step(
    ui: &mut Ui,
    tokens: &Tokens,
    next: &NextStep,
    is_narrow: bool,
    commands: &mut Vec<Command>,
) {
    let icon = (!is_narrow).then_some(next.icon);
    if text_button(ui, tokens, icon, next.label, true).clicked() {
        commands.push(next.command.clone());
    }
    if !is_narrow {
        ui.add_space(tokens.space);
    }
}

/// Draws what is under way, or else the title, as far as there is room; whether that is to be stopped.
fn middle(ui: &mut Ui, tokens: &Tokens, bar: &TopBar<'_>) -> bool {
    ui.add_space(2.0 * tokens.space);
    let Some((fraction, words)) = bar.progress else {
        let text = RichText::new(bar.title).color(tokens.muted);
        ui.add(egui::Label::new(text).truncate());
        return false;
    };
    if ui.available_width() < PROGRESS + tokens.target() + 3.0 * tokens.space {
        return false;
    }
    let (rect, _) = ui.allocate_exact_size(egui::vec2(PROGRESS, 4.0), egui::Sense::hover());
    ui.painter().rect_filled(rect, 2.0, tokens.line);
    let mut done = rect;
    done.set_right(rect.left() + rect.width() * fraction.clamp(0.0, 1.0));
    ui.painter().rect_filled(done, 2.0, tokens.accent);
    ui.add_space(0.5 * tokens.space);
    let words = egui::Label::new(muted(tokens, words)).truncate();
    let room = ui.available_width() - tokens.target() - tokens.space;
    ui.scope(|ui| {
        ui.set_max_width(room.max(0.0));
        ui.add(words);
    });
    icon_button(ui, tokens, Icon::Close, "Stop computing").clicked()
}
