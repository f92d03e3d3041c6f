//! The numbers of the line on a card over the map.

use egui::{Label, Rect, RichText, ScrollArea, Ui};

use super::line::LineStage;
use super::{Measure, MeasureCommand};
use crate::context::ViewContext;
use crate::map::MapCard;
use crate::shell::{muted, text_button};

/// The card.
const CARD: MapCard = MapCard {
    id: "measure",
    title: "Measure",
    close: "Stop measuring",
    width: 216.0,
};

impl Measure {
    /// Draws the card beside the map's controls; the part of the map that it covers.
    pub(super) fn card(&self, ui: &mut Ui, map: Rect, context: &mut ViewContext<'_>) -> Rect {
        let tokens = context.tokens;
        let mut content = |ui: &mut Ui, height: f32| self.content(ui, height - 152.0, context);
        let (rect, is_closed) = CARD.show(ui, map, tokens, &mut content);
        if is_closed {
            context.commands.push(MeasureCommand::Toggle.into());
        }
        rect
    }

    fn content(&self, ui: &mut Ui, most_height: f32, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let muted = |text: &str| Label::new(muted(tokens, text)).wrap();
        let mut say = |command: MeasureCommand| context.commands.push(command.into());
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
        if self.line.stage == LineStage::Drawing {
            ui.add(muted(tokens.advice(
                "Enter or a double click ends the line, a click on its first point closes it.",
                "A double tap ends the line, a tap on its first point closes it.",
            )));
        }
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
            if text_button(ui, tokens, None, "Copy", false).clicked() {
                say(MeasureCommand::Copy);
            }
            if self.line.can_close()
                && text_button(ui, tokens, None, "Close the line", false).clicked()
            {
                say(MeasureCommand::Close);
            }
            if text_button(ui, tokens, None, "Clear", false).clicked() {
                say(MeasureCommand::Clear);
            }
        });
    }
}
