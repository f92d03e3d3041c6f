//! The dialog.

use egui::{Frame, Id, Key, Modal, TextEdit, Ui};
use pilotage_jobs::{MapSource, WebMap};

use super::{GoTo, GoToCommand};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{muted, text_button, title};
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
        let hint = "46.8571, -92.0765";
        let field = TextEdit::singleline(&mut self.typed).hint_text(hint);
        let field = ui.add(field.desired_width(f32::INFINITY));
        let field = field.accessible_name("Place");
        if std::mem::take(&mut self.wants_keyboard) {
            field.request_focus();
        }
        let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        let words = "Degrees (46°51.4' N 92°4.6' W), UTM (32T 448251 5211932), MGRS (32TMT4825111932) or a plus code \
                     (8FVC9G8F+6X).";
        ui.label(muted(tokens, words));
        if !self.why.is_empty() {
            ui.label(muted(tokens, self.why.clone()).color(tokens.warning));
        }
        if text_button(ui, tokens, None, "Go there", true).clicked() || is_entered {
            context.commands.push(GoToCommand::Go.into());
        }
    }

    /// Offers a map of the web at a place where the open map does not reach; whether it was taken.
    fn other_map(&self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) -> bool {
        let Some(origin) = self.elsewhere else {
            return false;
        };
        let (words, command) = if let MapSource::Web(map) = &documents.map_source {
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
