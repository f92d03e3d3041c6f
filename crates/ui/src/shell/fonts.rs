//! The letters on screen: one face in two weights, whose figures are all as wide as one another.
//!
//! egui's own would bring a face for columns of figures, which is a twelfth of the page, and hints that weigh more than
//! the outlines. Its second family, meant for that face, is the heavier weight here.

use std::sync::Arc;

use egui::{FontData, FontDefinitions, FontFamily};

/// The fonts of the app.
pub fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let strong = include_bytes!("../../fonts/pilotage-sans-semibold.ttf");
    let text = include_bytes!("../../fonts/pilotage-sans.ttf");
    for (name, bytes) in [
        ("text", text.as_slice()),
        ("strong", strong.as_slice()),
        ("icons", epaint_default_fonts::EGUI_ICONS),
    ] {
        let data = Arc::new(FontData::from_static(bytes));
        fonts.font_data.insert(name.to_owned(), data);
    }
    let orders: [(FontFamily, &[&str]); 2] = [
        (FontFamily::Proportional, &["text", "icons"]),
        (FontFamily::Monospace, &["strong", "text", "icons"]),
    ];
    for (family, order) in orders {
        let order = order.iter().map(|name| (*name).to_owned());
        fonts.families.insert(family, order.collect());
    }
    fonts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tokens::Tokens;

    #[test]
    fn figures_and_signs_are_as_wide_as_one_another_in_both_weights() {
        let context = egui::Context::default();
        context.set_fonts(fonts());
        let tokens = Tokens::dark();
        let mut output = context.run_ui(egui::RawInput::default(), |ui| {
            for font in [tokens.normal(), tokens.figure()] {
                let width = |sign| ui.ctx().fonts_mut(|fonts| fonts.glyph_width(&font, sign));
                let zero = width('0');
                for sign in "123456789−+".chars() {
                    let other = width(sign);
                    assert!((other - zero).abs() < 0.01, "{sign} {other} {zero}");
                }
            }
        });
        output.textures_delta.clear();
    }
}
