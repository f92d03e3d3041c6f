//! The command palette: every command by a few of its letters.

use egui::{
    Align2, Area, Frame, Id, Key, Order, Role, Sense, Stroke, TextEdit, Ui, WidgetInfo, vec2,
};
use pilotage_core::sorting::sort;

use super::entry::{CommandEntry, CommandLack, MenuTable};
use super::search::{by_words, in_order};
use crate::command::Command;
use crate::tokens::Tokens;

/// The palette's own state.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    open: bool,
    query: String,
    chosen: usize,
}

/// Command that fits, and its lack if it can do nothing now.
type FoundCommand = (CommandEntry, Option<CommandLack>);

impl Palette {
    /// Opens or closes the palette.
    pub fn toggle(&mut self) {
        *self = Self {
            open: !self.open,
            ..Self::default()
        };
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    fn matching(&self, table: &MenuTable<'_>) -> Vec<FoundCommand> {
        let ranked = |score: i32, entry: &CommandEntry| {
            let lack = (table.lack)(&entry.command);
            // Of equals, files of ten kinds come behind what is done with a thing, and what cannot be done last.
            let is_one_of_many = entry.menu.is_some_and(|menu| menu.beginning().is_some());
            let rank = 4 * score - 2 * i32::from(is_one_of_many) - 6 * i32::from(lack.is_some());
            (rank, (entry.clone(), lack))
        };
        let mut found: Vec<(i32, FoundCommand)> = (table.catalog.iter())
            .filter_map(|e| Some(ranked(by_words(&self.query, &e.label, e.also)?, e)))
            .collect();
        if found.is_empty() {
            // People who know a command type the first letters of its words.
            let by_letters = table.catalog.iter();
            let by_letters =
                by_letters.filter_map(|e| Some(ranked(in_order(&self.query, &e.label)?, e)));
            found.extend(by_letters);
        }
        if !self.query.is_empty() {
            sort(&mut found, &|a, b| b.0.cmp(&a.0));
        }
        found.into_iter().map(|(_, found)| found).collect()
    }

    /// Draws the palette over the commands of `table` and sends the one that is chosen, unless it can do nothing now.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        table: &MenuTable<'_>,
        commands: &mut Vec<Command>,
    ) {
        if !self.open {
            return;
        }
        let (up, down, enter, escape) = ui.input_mut(|input| {
            (
                input.count_and_consume_key(egui::Modifiers::NONE, Key::ArrowUp),
                input.count_and_consume_key(egui::Modifiers::NONE, Key::ArrowDown),
                input.consume_key(egui::Modifiers::NONE, Key::Enter),
                input.consume_key(egui::Modifiers::NONE, Key::Escape),
            )
        });
        let mut entries = Vec::new();
        let mut run = None;
        let screen = ui.ctx().content_rect();
        let width = 520.0_f32.min(screen.width() - 48.0);
        let area = Area::new(Id::unique("palette"))
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 80.0))
            .show(ui.ctx(), |ui| {
                Frame::window(ui.style()).inner_margin(8).show(ui, |ui| {
                    ui.set_width(width);
                    // The field holds the focus before it reads the frame's first letter.
                    let id = Id::unique("letters of the palette");
                    ui.memory_mut(|memory| {
                        if !memory.has_focus(id) {
                            memory.request_focus(id);
                        }
                    });
                    let field = ui.add(
                        TextEdit::singleline(&mut self.query)
                            .align(egui::Align2::LEFT_CENTER)
                            .id(id)
                            .hint_text("Find a command")
                            .margin(vec2(8.0, 8.0))
                            .desired_width(f32::INFINITY),
                    );
                    let field = field.accessible_name("Find a command");
                    if field.changed() {
                        self.chosen = 0;
                    }
                    ui.memory_mut(|memory| {
                        memory.set_focus_lock_filter(
                            field.id,
                            egui::EventFilter {
                                vertical_arrows: true,
                                horizontal_arrows: true,
                                ..Default::default()
                            },
                        );
                    });
                    // Letters and Enter may arrive in one frame: what runs is what they name.
                    entries = self.matching(table);
                    let last = entries.len().saturating_sub(1);
                    self.chosen = (self.chosen + down).saturating_sub(up).min(last);
                    run = enter.then_some(self.chosen);
                    ui.add_space(4.0);
                    let height = 360.0_f32.min(screen.height() - 240.0);
                    egui::ScrollArea::vertical()
                        .max_height(height)
                        // Its room is that of the frame before, which may have had one row.
                        .min_scrolled_height(height)
                        .auto_shrink([false, true])
                        .show(ui, |ui| {
                            ui.spacing_mut().item_spacing.y = 0.0;
                            for (index, entry) in entries.iter().enumerate() {
                                let response = row(ui, tokens, entry, index == self.chosen);
                                if index == self.chosen && up + down > 0 {
                                    response.scroll_to_me(None);
                                }
                                if response.clicked() {
                                    run = Some(index);
                                }
                            }
                            if entries.is_empty() {
                                ui.label(super::muted(
                                    tokens,
                                    "No command found. Try “route”, “export” or “landmark”.",
                                ));
                            }
                        });
                });
            });
        let outside = ui.input(|i| {
            i.pointer.any_pressed()
                && i.pointer
                    .interact_pos()
                    .is_some_and(|p| !area.response.rect.contains(p))
        });
        if let Some((entry, None)) = run.and_then(|index| entries.get(index)) {
            commands.push(entry.command.clone());
            self.open = false;
        } else if escape || outside {
            self.open = false;
        }
        if !self.open {
            ui.memory_mut(egui::Memory::stop_text_input);
        }
    }
}

fn row(ui: &mut Ui, tokens: &Tokens, (entry, lack): &FoundCommand, chosen: bool) -> egui::Response {
    let size = vec2(ui.available_width(), tokens.target());
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let beside = match lack {
        Some(lack) => lack.what.to_owned(),
        None => entry.keys_beside(tokens.touch),
    };
    response.widget_info(|| {
        let lack = lack.map(|lack| format!(" ({})", lack.what));
        let is_enabled = lack.is_none();
        let label = format!("{}{}", entry.label, lack.unwrap_or_default());
        WidgetInfo::selected(Role::Button, is_enabled, chosen, label)
    });
    if ui.is_rect_visible(rect) {
        let painter = ui.painter();
        if chosen || response.hovered() {
            painter.rect(
                rect,
                tokens.radius,
                if chosen {
                    tokens.hover()
                } else {
                    tokens.raised
                },
                Stroke::NONE,
                egui::StrokeKind::Inside,
            );
        }
        let inner = rect.shrink2(vec2(tokens.space, 0.0));
        let left = painter.text(
            inner.left_center(),
            Align2::LEFT_CENTER,
            &entry.label,
            tokens.normal(),
            if lack.is_some() {
                tokens.muted
            } else {
                tokens.text
            },
        );
        // Beside a label stands what there is room for, first what is at the right.
        let small = |text: String| painter.layout_no_wrap(text, tokens.small(), tokens.muted);
        let (group, beside) = (small(entry.group.label().to_owned()), small(beside));
        let at = left.right() + tokens.space;
        let middle = |galley: &egui::Galley| inner.center().y - 0.5 * galley.size().y;
        let mut end = inner.right() - beside.size().x;
        if at <= end {
            painter.galley(egui::pos2(end, middle(&beside)), beside, tokens.muted);
            end -= tokens.space;
        }
        if at + group.size().x <= end {
            painter.galley(egui::pos2(at, middle(&group)), group, tokens.muted);
        }
    }
    match lack {
        Some(lack) if !lack.advice.is_empty() => response.on_hover_text(lack.advice),
        _ => response,
    }
}
