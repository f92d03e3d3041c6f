//! The sheet of the notices that were shown, for those who were too slow to read them.

use egui::{Context, Frame, Id, Modal, RichText, ScrollArea};

use super::toasts::Toasts;
use super::widgets::{muted, title};
use crate::tokens::Tokens;

/// Draws the notices since the page was opened, the last first, each with its age at `now` (milliseconds); true when
/// the sheet is to be closed.
pub fn notices_sheet(context: &Context, tokens: &Tokens, toasts: &Toasts, now: f64) -> bool {
    let screen = context.content_rect();
    let response = Modal::new(Id::unique("notices"))
        .frame(Frame::window(&context.global_style()).inner_margin(24))
        .show(context, |ui| {
            ui.set_width(560.0_f32.min(screen.width() - 96.0));
            let close = title(ui, tokens, "Notices");
            if toasts.said().len() == 0 {
                ui.label(muted(tokens, "Nothing was said yet."));
            }
            let height = screen.height() - 200.0;
            ScrollArea::vertical().max_height(height).show(ui, |ui| {
                for toast in toasts.said() {
                    let color = if toast.trouble {
                        tokens.warning
                    } else {
                        tokens.text
                    };
                    ui.horizontal_wrapped(|ui| {
                        ui.label(
                            RichText::new(toast.heading())
                                .font(tokens.heading())
                                .color(color),
                        );
                        ui.label(muted(tokens, age(now - toast.born)));
                    });
                    if !toast.text.is_empty() {
                        ui.label(RichText::new(&toast.text).color(tokens.muted));
                    }
                    ui.add_space(tokens.space);
                }
            });
            close
        });
    response.inner || response.should_close()
}

/// An age of some milliseconds in words.
fn age(milliseconds: f64) -> String {
    match (milliseconds / 60_000.0) as u64 {
        0 => "just now".to_owned(),
        minutes @ 1..60 => format!("{minutes} min ago"),
        minutes => format!("{} h ago", minutes / 60),
    }
}
