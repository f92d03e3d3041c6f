//! Field for the name of a thing in a list.

use egui::{TextEdit, Ui};

/// Draws the field of the thing `index` of a list, which is called `name`, `width` points wide; the new name once one
/// was typed. What is being typed, and for which thing, is kept in `draft`.
pub fn name_field(
    ui: &mut Ui,
    draft: &mut Option<(usize, String)>,
    (index, name): (usize, &str),
    width: f32,
) -> Option<String> {
    let text = match draft {
        Some((of, text)) if *of == index => text,
        _ => &mut name.to_owned(),
    };
    let field = ui.add(
        TextEdit::singleline(text)
            .align(egui::Align2::LEFT_CENTER)
            .desired_width(width),
    );
    let field = field.accessible_name(format!("Name of {name}"));
    if field.lost_focus() {
        let typed = text.trim().to_owned();
        *draft = None;
        return (!typed.is_empty() && typed != name).then_some(typed);
    }
    if field.has_focus() {
        *draft = Some((index, text.clone()));
    }
    None
}
