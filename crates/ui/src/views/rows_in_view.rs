//! Rows of a long list, of which those in view are laid out.

use egui::Ui;

/// Rows laid out beyond either edge of what is seen: the keyboard and a screen reader go on to them.
const BEYOND: usize = 40;

/// Draws `count` rows of the same `height` (points) below each other without gaps, each by its number: those that are
/// seen and a few dozen more at either end. The others have their room and nothing else, so that a list of ten thousand
/// costs a frame no more than one of a hundred.
pub fn rows_in_view(ui: &mut Ui, count: usize, height: f32, mut row: impl FnMut(&mut Ui, usize)) {
    let gap = std::mem::take(&mut ui.spacing_mut().item_spacing.y);
    let top = ui.cursor().top();
    let seen = ui.clip_rect().y_range();
    let number = |y: f32| ((y - top) / height).clamp(0.0, count as f32) as usize;
    let first = number(seen.min).saturating_sub(BEYOND);
    let end = (number(seen.max) + 1 + BEYOND).min(count).max(first);
    ui.add_space(first as f32 * height);
    for number in first..end {
        // By its number: what a row holds is the same one wherever the list begins.
        ui.push_id(number, |ui| row(ui, number));
    }
    ui.add_space((count - end) as f32 * height);
    ui.spacing_mut().item_spacing.y = gap;
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput, Rect, ScrollArea, Sense, pos2, vec2};

    use super::*;

    /// Numbers of the rows laid out where the list has been scrolled by `offset` in a view of ten rows, and its height.
    fn laid_out(count: usize, offset: f32) -> (Vec<usize>, f32) {
        let context = Context::default();
        let mut rows = Vec::new();
        let mut height = 0.0;
        let screen = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 600.0));
        for _ in 0..3 {
            let input = RawInput {
                screen_rect: Some(screen),
                ..RawInput::default()
            };
            rows.clear();
            let mut called = 0;
            let mut output = context.run_ui(input, |ui| {
                let area = ScrollArea::vertical().max_height(200.0);
                let shown = area.vertical_scroll_offset(offset).show(ui, |ui| {
                    rows_in_view(ui, count, 20.0, |ui, number| {
                        called += 1;
                        let (rect, _) = ui.allocate_exact_size(vec2(100.0, 20.0), Sense::hover());
                        if ui.is_rect_visible(rect) {
                            rows.push(number);
                        }
                    });
                });
                height = shown.content_size.y;
            });
            output.textures_delta.clear();
            assert!(called <= 2 * BEYOND + 12, "{called} rows are laid out");
        }
        (rows, height)
    }

    #[test]
    fn rows_in_view_are_laid_out_wherever_a_list_is_scrolled_to() {
        for offset in [0.0, 1000.0, 100_007.0, 199_800.0] {
            let (rows, height) = laid_out(10_000, offset);
            assert!((height - 200_000.0).abs() < 1.0, "{height}");
            let first = (offset / 20.0).floor() as usize;
            let last = ((offset + 199.9) / 20.0).floor() as usize;
            let seen: Vec<usize> = (first..=last.min(9_999)).collect();
            // A row more at either end may peep out.
            let peeps = rows.iter().filter(|row| !seen.contains(row)).count();
            assert!(seen.iter().all(|row| rows.contains(row)), "{rows:?}");
            assert!(peeps <= 2, "{rows:?} at {offset}");
        }
    }

    #[test]
    fn short_lists_are_laid_out_as_a_whole() {
        for count in [0, 1, 7] {
            let (rows, height) = laid_out(count, 0.0);
            assert_eq!(rows.len(), count);
            assert!((height - 20.0 * count as f32).abs() < 0.1, "{height}");
        }
    }
}
