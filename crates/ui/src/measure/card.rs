//! The numbers of the line on a card over the map.

use egui::{Frame, Label, Rect, RichText, ScrollArea, Sense, Stroke, Ui, UiBuilder, pos2, vec2};

use super::line::Stage;
use super::{Measure, MeasureCommand};
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{BELOW_HUD, icon_button, text_button};

/// Width of what is on the card, points.
const WIDTH: f32 = 216.0;

impl Measure {
    /// Draws the card beside the map's controls; the part of the map that it covers.
    pub(super) fn card(&self, ui: &mut Ui, map: Rect, context: &mut ViewContext<'_>) -> Rect {
        let tokens = context.tokens;
        let left = (map.right() - 84.0 - WIDTH).max(map.left() + 8.0);
        let corner = pos2(left, map.top() + BELOW_HUD);
        let room = Rect::from_min_max(corner, map.max.max(corner + vec2(WIDTH, 160.0)));
        // Clicks between the numbers are no points of the line.
        let builder = UiBuilder::new()
            .max_rect(room)
            .sense(Sense::click_and_drag());
        let mut ui = ui.new_child(builder.id_salt("measure"));
        let frame = Frame::new()
            .fill(tokens.over_map())
            .stroke(Stroke::new(1.0, tokens.line))
            .corner_radius(tokens.radius)
            .inner_margin(8);
        let card = frame.show(&mut ui, |ui| {
            ui.set_width(WIDTH);
            self.content(ui, room.height() - 152.0, context);
        });
        card.response.rect
    }

    fn content(&self, ui: &mut Ui, most_height: f32, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let muted = |text: &str| {
            let text = RichText::new(text).size(tokens.text_sizes[0]);
            Label::new(text.color(tokens.muted)).wrap()
        };
        let mut say = |command: MeasureCommand| context.commands.push(command.into());
        ui.horizontal(|ui| {
            ui.label(
                RichText::new("Measure")
                    .color(tokens.text)
                    .font(tokens.heading()),
            );
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if icon_button(ui, tokens, Icon::Close, "Stop measuring").clicked() {
                    say(MeasureCommand::Toggle);
                }
            });
        });
        let rows = self.line.measures(self.frame.as_ref()).rows(context.units);
        if rows.is_empty() {
            ui.add(muted("Click points on the map."));
            return;
        }
        ScrollArea::vertical()
            .max_height(most_height.max(48.0))
            .show(ui, |ui| {
                for row in &rows {
                    ui.add(Label::new(RichText::new(row).color(tokens.text)).selectable(true));
                }
            });
        ui.add(muted(if self.frame.is_some() {
            "Courses in degrees true."
        } else {
            "Courses from the map's north: it has no place on the globe."
        }));
        if self.line.stage == Stage::Drawing {
            ui.add(muted(
                "Enter or a double click ends the line, a click on its first point closes it.",
            ));
        }
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
            if text_button(ui, tokens, None, "Copy", false).clicked() {
                say(MeasureCommand::Copy);
            }
            if self.line.can_close() && text_button(ui, tokens, None, "Close", false).clicked() {
                say(MeasureCommand::Close);
            }
            if text_button(ui, tokens, None, "Clear", false).clicked() {
                say(MeasureCommand::Clear);
            }
        });
    }
}
