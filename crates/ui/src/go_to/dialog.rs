//! The dialog.

use egui::{
    Align, EventFilter, Frame, Id, Key, Layout, Modal, Modifiers, ScrollArea, TextEdit, Ui,
};
use pilotage_jobs::{MapSource, WebMap};

use super::{GoTo, GoToCommand};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{is_entered, muted, text_button, title};
use crate::web_map::WebMapCommand;

impl GoTo {
    /// Draws the dialog.
    pub(super) fn show(&mut self, ui: &Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let room = ui.ctx().content_rect().width() - 96.0;
        let response = Modal::new(Id::unique("go to a place"))
            .frame(Frame::window(&ui.ctx().global_style()).inner_margin(24))
            .show(ui.ctx(), |ui| {
                ui.set_width(room.min(480.0));
                let close = title(ui, context.tokens, "Go to a place");
                self.field(ui, context);
                close || self.other_map(ui, context, documents)
            });
        if response.inner || response.should_close() {
            self.is_open = false;
        }
    }

    fn field(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let [up, down] = [Key::ArrowUp, Key::ArrowDown]
            .map(|key| ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key)));
        let last = self.offered.len().saturating_sub(1);
        self.chosen = (self.chosen + down).saturating_sub(up).min(last);
        let hint = "Duluth, or 46.8571, -92.0765";
        // The field holds the focus before it reads the frame's first letter.
        let id = Id::unique("place that is typed");
        if self.wants_keyboard {
            ui.memory_mut(|memory| memory.request_focus(id));
            // What is drawn only to be measured cannot keep it.
            self.wants_keyboard = ui.is_sizing_pass();
        }
        let field = TextEdit::singleline(&mut self.typed)
            .align(egui::Align2::LEFT_CENTER)
            .id(id)
            .hint_text(hint);
        let field = ui.add(field.desired_width(f32::INFINITY));
        let field = field.accessible_name("Place");
        // Arrows choose among the towns; Tab leads on.
        let filter = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(field.id, filter));
        if field.changed() {
            context.commands.push(GoToCommand::Search.into());
        }
        let is_entered = is_entered(&field);
        let is_chosen = self.towns(ui, up + down > 0);
        let words = "A town, degrees (46°51.4' N 92°4.6' W), UTM (32T 448251 5211932), MGRS (32TMT4825111932) or a \
                     plus code (8FVC9G8F+6X, 9G8F+6X Zürich).";
        ui.label(muted(tokens, words));
        ui.label(muted(tokens, self.places.words()));
        if !self.why.is_empty() {
            ui.label(muted(tokens, self.why.clone()).color(tokens.warning));
        }
        if text_button(ui, tokens, None, "Go there", true).clicked() || is_entered || is_chosen {
            context.commands.push(GoToCommand::Go.into());
        }
    }

    /// Lists the towns that are offered; whether one was clicked, which is the chosen one then.
    fn towns(&mut self, ui: &mut Ui, is_moved: bool) -> bool {
        let mut clicked = None;
        let most = (ui.ctx().content_rect().height() - 360.0).max(96.0);
        let list = ScrollArea::vertical().max_height(most);
        list.show(ui, |ui| {
            ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
                for (index, (_, words)) in self.offered.iter().enumerate() {
                    let is_chosen = index == self.chosen;
                    let row = ui.selectable_label(is_chosen, words.as_str());
                    if is_chosen && is_moved {
                        row.scroll_to_me(None);
                    }
                    if row.clicked() {
                        clicked = Some(index);
                    }
                }
            });
        });
        self.chosen = clicked.unwrap_or(self.chosen);
        clicked.is_some()
    }

    /// Offers a map of the web at a place where the open map does not reach; whether it was taken.
    fn other_map(&self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) -> bool {
        let Some(origin) = self.elsewhere else {
            return false;
        };
        let (words, command) = if let MapSource::Web(map) = &documents.map.source {
            let there = WebMap {
                origin,
                ..map.clone()
            };
            let words = format!("Show the map of {} there", map.template.name);
            (words, WebMapCommand::OpenTiles(Box::new(there)))
        } else {
            let words = "Open a map from the web there…".to_owned();
            (words, WebMapCommand::BeginAt(origin))
        };
        let words_below =
            "A mission of its own begins there. Undo brings back the one that is open.";
        ui.add_space(context.tokens.space);
        let is_taken = text_button(ui, context.tokens, None, &words, false).clicked();
        ui.label(muted(context.tokens, words_below));
        if is_taken {
            context.commands.push(command.into());
        }
        is_taken
    }
}
