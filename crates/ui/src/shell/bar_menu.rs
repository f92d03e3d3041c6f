//! Buttons of the top bar, and the menus that some of them open: rows of the table of all commands.

use egui::{Color32, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};

use super::entry::{BarMenu, CommandEntry, CommandLack, MenuTable};
use super::icons::Icon;
use crate::command::Command;
use crate::tokens::Tokens;

/// Face of a button of the top bar.
pub struct BarButton<'a> {
    /// Sign.
    pub icon: Icon,
    /// Name, also where no words are shown.
    pub name: &'a str,
    /// Words beside the sign; empty where there is no room.
    pub words: &'a str,
    /// Whether it shows that something is on; `None` for one that never stays pressed.
    pub on: Option<bool>,
    /// Whether it opens a menu.
    pub has_menu: bool,
}

impl BarButton<'_> {
    /// Draws the button.
    pub fn show(&self, ui: &mut Ui, tokens: &Tokens) -> Response {
        let text = self.words.to_owned();
        let font = tokens.normal();
        let galley = ui.painter().layout_no_wrap(text, font, tokens.text);
        let side = tokens.target();
        let words = if self.words.is_empty() {
            0.0
        } else {
            galley.size().x + 6.0
        };
        let arrow = if self.has_menu { 14.0 } else { 0.0 };
        let size = vec2(words + arrow + side, side);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        let enabled = ui.is_enabled();
        response.widget_info(|| WidgetInfo {
            selected: self.on,
            ..WidgetInfo::labeled(Role::Button, enabled, self.name)
        });
        let on = self.on.unwrap_or_default();
        let is_under = response.hovered() || response.has_focus();
        let fill = match (on, is_under) {
            (true, _) => tokens.accent.gamma_multiply(0.22),
            (false, true) => tokens.hover(),
            (false, false) => Color32::TRANSPARENT,
        };
        let ink = if on { tokens.accent } else { tokens.text };
        let painter = ui.painter();
        let inner = rect.shrink2(vec2(0.0, 2.0));
        painter.rect_filled(inner, tokens.radius, fill);
        if response.has_focus() {
            let line = Stroke::new(1.5, tokens.accent);
            painter.rect_stroke(inner, tokens.radius, line, StrokeKind::Inside);
        }
        let middle = rect.left_center() + vec2(0.5 * side, 0.0);
        self.icon.paint_sized(painter, middle, 16.0, ink);
        let corner = rect.left_center() + vec2(side - 2.0, -0.5 * galley.size().y);
        painter.galley_with_override_text_color(corner, galley, ink);
        if self.has_menu {
            let middle = rect.right_center() - vec2(11.0, 0.0);
            Icon::Down.paint_sized(painter, middle, 9.0, tokens.muted);
        }
        if self.words == self.name {
            response
        } else {
            response.on_hover_text(self.name)
        }
    }
}

/// Draws the menu that `button` opens: the commands of each of `menus`, with a line between them; those of one that opens by
/// itself behind a row of it. Rows that can do nothing now say what is missing.
pub fn bar_menu(
    button: &Response,
    tokens: &Tokens,
    table: &MenuTable<'_>,
    menus: &[BarMenu],
    commands: &mut Vec<Command>,
) {
    egui::Popup::menu(button).show(|ui| {
        ui.set_min_width(280.0);
        let room = ui.ctx().content_rect().height() - 96.0;
        egui::ScrollArea::vertical()
            .max_height(room)
            .min_scrolled_height(room)
            .show(ui, |ui| {
                let mut is_first = true;
                for menu in menus {
                    let rows = table
                        .catalog
                        .iter()
                        .filter(|entry| entry.menu == Some(*menu));
                    let rows: Vec<_> = rows.collect();
                    if rows.is_empty() {
                        continue;
                    }
                    if let Some(beginning) = menu.beginning() {
                        let title = format!("{beginning} …");
                        // What all of its rows lack is said before it is opened.
                        if let Some(lack) = (table.lack)(&rows[0].command) {
                            lacking_row(ui, tokens, &title, lack);
                            continue;
                        }
                        ui.menu_button(title, |ui| {
                            ui.set_min_width(220.0);
                            entries(ui, tokens, beginning, (&rows, table), commands);
                        });
                        continue;
                    }
                    if !std::mem::take(&mut is_first) {
                        ui.separator();
                    }
                    entries(ui, tokens, "", (&rows, table), commands);
                }
            });
    });
}

/// Rows of a menu, without the `beginning` of their labels.
fn entries(
    ui: &mut Ui,
    tokens: &Tokens,
    beginning: &str,
    (rows, table): (&[&CommandEntry], &MenuTable<'_>),
    commands: &mut Vec<Command>,
) {
    for entry in rows {
        let label = entry.label.as_ref();
        let shown = label.strip_prefix(beginning).unwrap_or(label).trim_start();
        if let Some(lack) = (table.lack)(&entry.command) {
            lacking_row(ui, tokens, shown, lack);
            continue;
        }
        if row(ui, tokens, entry, shown).clicked() {
            commands.push(entry.command.clone());
            ui.close();
        }
    }
}

fn row(ui: &mut Ui, tokens: &Tokens, entry: &CommandEntry, shown: &str) -> Response {
    let keys = egui::RichText::new(entry.keys_beside(tokens.touch)).color(tokens.muted);
    let button = egui::Button::new(shown).shortcut_text(keys);
    let response = ui.add(button);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, entry.label.as_ref()));
    response
}

/// A row that can do nothing now, above what is missing; advice under the pointer.
fn lacking_row(ui: &mut Ui, tokens: &Tokens, shown: &str, lack: CommandLack) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let response = ui.add_enabled(false, egui::Button::new(shown));
        let label = format!("{shown} ({})", lack.what);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, false, &label));
        response.on_disabled_hover_text(lack.advice);
        let words = egui::RichText::new(lack.what).font(tokens.small());
        let words = egui::Label::new(words.color(tokens.muted));
        let margin = egui::Margin {
            left: 10,
            bottom: 4,
            ..egui::Margin::ZERO
        };
        let line = egui::Frame::new().inner_margin(margin);
        let line = line.show(ui, |ui| ui.add(words)).response;
        line.on_hover_text(lack.advice);
    });
}
