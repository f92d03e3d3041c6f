//! Line of advice over the map.

use egui::{Frame, Margin, Rect, Stroke, Ui, UiBuilder, vec2};

use super::command::LearnCommand;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{BELOW_HUD, icon_button, icons::Icon};

/// Draws a line on what is seen and what to try first; returns the part of the screen that it covers.
pub(super) fn advice(
    ui: &mut Ui,
    rect: Rect,
    context: &mut ViewContext<'_>,
    documents: &Documents,
) -> Option<Rect> {
    if documents.flight.log.is_some() {
        return None;
    }
    let tokens = context.tokens;
    let text = if documents.run.navigated.is_some() {
        let draw = tokens.advice(
            "press N and draw a landmark of your own",
            "draw a landmark of your own: the first button at the right",
        );
        format!(
            "This aircraft finds its way without GPS. The dots show where it might be: they spread until the camera \
             recognises a landmark, then draw together. Drag the time below, or {draw}."
        )
    } else if let Some(words) = context.flying {
        format!("Preparing the demo flight: {words}")
    } else {
        "Nothing is flown yet. Simulate a flight, or drop a flight folder and a map here."
            .to_owned()
    };
    let width = (rect.width() - 96.0).min(720.0);
    let font = if width < 400.0 {
        tokens.small()
    } else {
        tokens.normal()
    };
    let at = Rect::from_min_size(rect.left_top() + vec2(16.0, BELOW_HUD), vec2(width, 64.0));
    let mut inside = ui.new_child(UiBuilder::new().max_rect(at).id_salt("advice"));
    let card = Frame::new()
        .fill(tokens.over_map())
        .stroke(Stroke::new(1.0, tokens.line))
        .corner_radius(tokens.radius)
        .inner_margin(Margin::symmetric(12, 4))
        .show(&mut inside, |ui| {
            ui.horizontal(|ui| {
                let room = ui.available_width() - 40.0;
                ui.scope(|ui| {
                    ui.set_max_width(room);
                    ui.add(
                        egui::Label::new(egui::RichText::new(text).font(font).color(tokens.text))
                            .wrap(),
                    );
                });
                if icon_button(ui, tokens, Icon::Close, "Dismiss the advice").clicked() {
                    context.commands.push(LearnCommand::DismissAdvice.into());
                }
            });
        });
    Some(card.response.rect)
}
