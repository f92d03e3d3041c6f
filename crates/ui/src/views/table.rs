//! Rows of a table of numbers: what a row is about at the left, its numbers right-aligned.

use egui::{Align, Align2, Color32, FontId, Layout, Sense, Ui, UiBuilder, pos2, vec2};

use super::parts;
use crate::tokens::Tokens;

/// Width of a column of numbers, in letters of normal size.
const COLUMN: f32 = 3.6;

/// Draws a row as wide as `ui`: `lead` has the room that the `cells` leave.
pub(crate) fn row(
    ui: &mut Ui,
    tokens: &Tokens,
    cells: &[String],
    colour: Color32,
    lead: impl FnOnce(&mut Ui),
) {
    let cells = (cells, colour, parts::normal(tokens));
    tall_row(ui, tokens, cells, height(tokens), lead);
}

/// Draws the heads of columns: small, so that each has room within its column.
pub(crate) fn heads(ui: &mut Ui, tokens: &Tokens, titles: &[String], lead: impl FnOnce(&mut Ui)) {
    let titles = (titles, tokens.muted, parts::small(tokens));
    tall_row(ui, tokens, titles, height(tokens), lead);
}

/// Height of a row in which nothing can be pressed, points.
pub(crate) fn height(tokens: &Tokens) -> f32 {
    tokens.text_sizes[1] + 1.5 * tokens.space
}

fn tall_row(
    ui: &mut Ui,
    tokens: &Tokens,
    (cells, colour, font): (&[String], Color32, FontId),
    height: f32,
    lead: impl FnOnce(&mut Ui),
) {
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    if !cells.is_empty() {
        parts::name(&response, cells.join(" "));
    }
    let column = COLUMN * tokens.text_sizes[1];
    let mut right = rect.right() - 0.5 * tokens.space;
    for cell in cells.iter().rev() {
        let at = pos2(right, rect.center().y);
        ui.painter()
            .text(at, Align2::RIGHT_CENTER, cell, font.clone(), colour);
        right -= column;
    }
    let mut left = rect;
    left.set_right(right.max(rect.left()));
    let builder = UiBuilder::new()
        .max_rect(left)
        .layout(Layout::left_to_right(Align::Center));
    let mut inside = ui.new_child(builder);
    inside.set_clip_rect(left.intersect(ui.clip_rect()));
    inside.spacing_mut().item_spacing.x = 0.5 * tokens.space;
    lead(&mut inside);
}

/// Draws a row whose lead is a `name` with `beside` points of signs before it: where these do not fit beside the `cells`,
/// the cells go below them, so that no name is cut off.
pub(crate) fn named_row(
    ui: &mut Ui,
    tokens: &Tokens,
    cells: &[String],
    (name, beside): (&str, f32),
    lead: impl FnOnce(&mut Ui),
) {
    let font = parts::normal(tokens);
    let galley = ui
        .painter()
        .layout_no_wrap(name.to_owned(), font.clone(), tokens.text);
    // A name that can be clicked has a margin at both sides.
    let margin = 2.0 * ui.spacing().button_padding.x;
    let needed = beside + galley.size().x + margin + tokens.space;
    let of_cells = COLUMN * tokens.text_sizes[1] * cells.len() as f32;
    // What can be pressed in it is as high as a finger.
    let height = if tokens.touch {
        height(tokens).max(tokens.target())
    } else {
        height(tokens)
    };
    if needed + of_cells > ui.available_width() {
        tall_row(ui, tokens, (&[], tokens.text, font), height, lead);
        row(ui, tokens, cells, tokens.text, |_| {});
    } else {
        tall_row(ui, tokens, (cells, tokens.text, font), height, lead);
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    #[test]
    fn heads_of_columns_keep_apart() {
        let harness = egui_kittest::Harness::new_ui(|ui| {
            let titles = ["RMS", "median", "largest", "inside"].map(str::to_owned);
            heads(ui, &Tokens::dark(), &titles, |_| {});
        });
        let shapes = harness.output().shapes.iter();
        let rects = shapes.filter_map(|drawn| match &drawn.shape {
            egui::Shape::Text(text) => Some(text.galley.rect.translate(text.pos.to_vec2())),
            _ => None,
        });
        let mut rects: Vec<_> = rects.collect();
        rects.sort_by(|a, b| a.left().total_cmp(&b.left()));
        assert_eq!(rects.len(), 4);
        for pair in rects.windows(2) {
            assert!(pair[0].right() + 4.0 <= pair[1].left(), "{rects:?}");
        }
    }

    #[test]
    fn numbers_go_below_a_name_that_has_no_room_beside_them() {
        for (width, is_below) in [(240.0, true), (600.0, false)] {
            let draw = move |ui: &mut Ui| {
                ui.set_width(width);
                let (tokens, name) = (Tokens::dark(), "Dead reckoning alone");
                let cells = ["1.2", "3.4", "5.6"].map(str::to_owned);
                named_row(ui, &tokens, &cells, (name, 24.0), |ui| {
                    ui.add(egui::Label::new(name).truncate());
                });
            };
            let harness = egui_kittest::Harness::builder()
                .with_size(egui::vec2(700.0, 200.0))
                .build_ui(draw);
            let numbers = harness.get_by_label("1.2 3.4 5.6").rect();
            let name = harness.get_by_label("Dead reckoning alone").rect();
            assert_eq!(numbers.top() >= name.bottom(), is_below, "{width}");
        }
    }
}
