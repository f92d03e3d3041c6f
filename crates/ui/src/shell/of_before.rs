//! Results of what was open before: faded, below words that say so.

use egui::{Label, RichText, Ui};

use super::widgets::text_button;
use crate::tokens::Tokens;

/// Opacity of a result of what was open before.
pub const FADED: f32 = 0.5;

/// Draws a result as `of_before` does; one of what was open before has a button that works it out again below its words,
/// unless that is under way. Whether it was pressed.
pub fn of_before_again(
    ui: &mut Ui,
    tokens: &Tokens,
    words: Option<&str>,
    is_under_way: bool,
    draw: impl FnOnce(&mut Ui),
) -> bool {
    let mut is_pressed = false;
    if let Some(words) = words {
        said(ui, tokens, words);
        is_pressed =
            !is_under_way && text_button(ui, tokens, None, "Work it out again", true).clicked();
    }
    faded(ui, words.is_some(), draw);
    is_pressed
}

/// Draws a result; one of what was open before, as `words` say, is faded below them.
pub fn of_before(ui: &mut Ui, tokens: &Tokens, words: Option<&str>, draw: impl FnOnce(&mut Ui)) {
    if let Some(words) = words {
        said(ui, tokens, words);
    }
    faded(ui, words.is_some(), draw);
}

fn said(ui: &mut Ui, tokens: &Tokens, words: &str) {
    let words = RichText::new(words).color(tokens.warning);
    ui.add(Label::new(words).wrap());
}

fn faded(ui: &mut Ui, is_faded: bool, draw: impl FnOnce(&mut Ui)) {
    ui.scope(|ui| {
        if is_faded {
            ui.multiply_opacity(FADED);
        }
        draw(ui);
    });
}
