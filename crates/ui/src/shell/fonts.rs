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

    /// Number of two bytes at `offset`, the greater one first.
    fn number(bytes: &[u8], offset: usize) -> usize {
        usize::from(bytes[offset]) << 8 | usize::from(bytes[offset + 1])
    }

    /// Tables of a font by their four letters.
    fn tables(font: &[u8]) -> Vec<(&str, &[u8])> {
        let wide = |offset: usize| number(font, offset) << 16 | number(font, offset + 2);
        let entries = (0..number(font, 4)).map(|index| 12 + 16 * index);
        entries
            .map(|entry| {
                let name = str::from_utf8(&font[entry..entry + 4]).expect("letters");
                let begin = wide(entry + 8);
                (name, &font[begin..begin + wide(entry + 12)])
            })
            .collect()
    }

    /// Kinds of the lookups of a `GSUB` or `GPOS` table.
    fn kinds_of_lookups(table: &[u8]) -> Vec<usize> {
        let list = number(table, 8);
        let lookups =
            (0..number(table, list)).map(|index| list + number(table, list + 2 + 2 * index));
        lookups.map(|lookup| number(table, lookup)).collect()
    }

    /// Scripts that a `GSUB` or `GPOS` table is made for.
    fn scripts(table: &[u8]) -> Vec<&str> {
        let list = number(table, 4);
        let entries = (0..number(table, list)).map(|index| list + 2 + 6 * index);
        entries
            .map(|entry| str::from_utf8(&table[entry..entry + 4]).expect("letters"))
            .collect()
    }

    /// The code for other fonts is taken out of the page (`xtask/never_called.toml`).
    #[test]
    fn letters_are_plain_outlines_of_true_type_with_kerning_of_pairs() {
        let plain = [
            "GDEF", "GPOS", "GSUB", "OS/2", "cmap", "gasp", "glyf", "head", "hhea", "hmtx", "loca",
            "maxp", "name", "post",
        ];
        for (name, font) in fonts().font_data {
            for (table, bytes) in tables((*font.font).as_ref()) {
                assert!(plain.contains(&table), "{name} has {table}");
                match table {
                    "GSUB" => {
                        assert_eq!(kinds_of_lookups(bytes), [0; 0], "{name}");
                        assert_eq!(scripts(bytes), ["DFLT", "cyrl", "grek", "latn"], "{name}");
                    }
                    "GPOS" => {
                        let kinds = kinds_of_lookups(bytes);
                        assert!(kinds.iter().all(|kind| *kind == 2), "{name}: {kinds:?}");
                    }
                    "maxp" => assert_eq!(number(bytes, 26), 0, "{name}: bytes of hints"),
                    _ => {}
                }
            }
        }
    }

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
