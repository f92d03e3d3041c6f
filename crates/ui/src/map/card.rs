//! The card of a tool, over the map beside its controls.

use egui::{Align, Frame, Layout, Rect, RichText, Sense, Stroke, Ui, UiBuilder, pos2, vec2};

use crate::shell::icons::Icon;
use crate::shell::{BELOW_HUD, icon_button};
use crate::tokens::Tokens;

/// A card with a title and a button that closes it.
pub(crate) struct MapCard {
    /// Salt of the ids of what is on it.
    pub id: &'static str,
    /// Title.
    pub title: &'static str,
    /// Name of the button that closes it.
    pub close: &'static str,
    /// Width of what is on it, points.
    pub width: f32,
}

impl MapCard {
    /// Draws the card with its `content`, which is told the height of the map below the card's top, points; the part of
    /// the map that it covers, and whether it is closed.
    pub fn show(
        &self,
        ui: &mut Ui,
        map: Rect,
        tokens: &Tokens,
        content: &mut dyn FnMut(&mut Ui, f32),
    ) -> (Rect, bool) {
        let left = (map.right() - 84.0 - self.width).max(map.left() + 8.0);
        let corner = pos2(left, map.top() + BELOW_HUD);
        let room = Rect::from_min_max(corner, map.max.max(corner + vec2(self.width, 160.0)));
        // Clicks between what is on it are none on the map.
        let builder = UiBuilder::new()
            .max_rect(room)
            .sense(Sense::click_and_drag());
        let mut ui = ui.new_child(builder.id_salt(self.id));
        let frame = Frame::new()
            .fill(tokens.over_map())
            .stroke(Stroke::new(1.0, tokens.line))
            .corner_radius(tokens.radius)
            .inner_margin(8);
        let card = frame.show(&mut ui, |ui| {
            ui.set_width(self.width);
            let is_closed = self.head(ui, tokens);
            content(ui, room.height());
            is_closed
        });
        (card.response.rect, card.inner)
    }

    fn head(&self, ui: &mut Ui, tokens: &Tokens) -> bool {
        let head = ui.horizontal(|ui| {
            let title = RichText::new(self.title).color(tokens.text);
            ui.label(title.font(tokens.heading()));
            let right = Layout::right_to_left(Align::Center);
            let button = |ui: &mut Ui| icon_button(ui, tokens, Icon::Close, self.close).clicked();
            ui.with_layout(right, button).inner
        });
        head.inner
    }
}
