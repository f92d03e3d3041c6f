//! The letters on screen: Ubuntu Light for text, the figures of Hack where they stand in columns.
//!
//! egui would bring the whole of Hack, which is a twelfth of the page, and the hints of Ubuntu Light, which are two
//! thirds of it and weigh more than its outlines.

use std::sync::Arc;

use egui::{FontData, FontDefinitions, FontFamily};

/// The fonts of the app.
pub fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let figures = include_bytes!("../../fonts/hack-figures.ttf");
    let text = include_bytes!("../../fonts/ubuntu-light.ttf");
    for (name, bytes) in [
        ("text", text.as_slice()),
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
