//! The letters on screen: Ubuntu Light for text, the figures of Hack where they stand in columns.
//!
//! egui would bring the whole of Hack, which is a twelfth of the page.

use std::sync::Arc;

use egui::{FontData, FontDefinitions, FontFamily};

/// The fonts of the app.
pub fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let figures = include_bytes!("../../fonts/hack-figures.ttf");
    for (name, bytes) in [
        ("text", epaint_default_fonts::UBUNTU_LIGHT),
        ("figures", figures.as_slice()),
        ("icons", epaint_default_fonts::EGUI_ICONS),
    ] {
        let data = Arc::new(FontData::from_static(bytes));
        fonts.font_data.insert(name.to_owned(), data);
    }
    for (family, order) in [
        (FontFamily::Proportional, ["text", "figures", "icons"]),
        (FontFamily::Monospace, ["figures", "text", "icons"]),
    ] {
        fonts
            .families
            .insert(family, order.map(str::to_owned).to_vec());
    }
    fonts
}
