//! Results of what was open before: faded, below words that say so.

use egui::{Label, RichText, Ui};

use crate::tokens::Tokens;

/// Opacity of a result of what was open before.
pub const FADED: f32 = 0.5;

/// Draws a result; one of what was open before, as `words` say, is faded below them.
pub fn of_before(ui: &mut Ui, tokens: &Tokens, words: Option<&str>, draw: impl FnOnce(&mut Ui)) {
    if let Some(words) = words {
        let words = RichText::new(words).color(tokens.warning);
        ui.add(Label::new(words).wrap());
    }
    ui.scope(|ui| {
        if words.is_some() {
            ui.multiply_opacity(FADED);
        }
        draw(ui);
    });
}
