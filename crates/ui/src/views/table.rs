//! Rows of a table of numbers: what a row is about at the left, its numbers right-aligned.

use egui::{Align, Align2, Color32, Layout, Sense, Ui, UiBuilder, pos2, vec2};

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
    let height = tokens.text_sizes[1] + 1.5 * tokens.space;
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    parts::name(&response, cells.join(" "));
    let column = COLUMN * tokens.text_sizes[1];
    let mut right = rect.right() - 0.5 * tokens.space;
    for cell in cells.iter().rev() {
        let at = pos2(right, rect.center().y);
        let font = parts::normal(tokens);
        ui.painter()
            .text(at, Align2::RIGHT_CENTER, cell, font, colour);
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
