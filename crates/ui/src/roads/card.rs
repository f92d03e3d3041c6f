//! The selected road, or how many there are of each class, on a card over the map.

use std::ops::RangeInclusive;

use egui::{ComboBox, Label, Rect, RichText, TextEdit, Ui};
use pilotage_core::roads::{RoadClass, RoadLine};

use super::Roads;
use super::command::{FOLLOW, RoadChange, RoadCommand, change};
use super::drawing::{LegKind, RoadDrawing};
use crate::command::Command;
use crate::context::ViewContext;
use crate::map::MapCard;
use crate::shell::{NumberField, at_work, muted, text_button};

/// The card.
const CARD: MapCard = MapCard {
    id: "roads",
    title: "Roads",
    close: "Stop editing roads",
    width: 224.0,
};
/// Words for the work on a leg.
pub(super) const FOLLOWING: &str = "Following the road";
/// Widths of roads that can be set, metres.
const WIDTHS: RangeInclusive<f64> = 0.5..=60.0;

impl Roads {
    /// Draws the card beside the map's controls; the part of the map that it covers.
    pub(super) fn card(&self, ui: &mut Ui, map: Rect, context: &mut ViewContext<'_>) -> Rect {
        let tokens = context.tokens;
        let mut content = |ui: &mut Ui, _| self.content(ui, context);
        let (rect, is_closed) = CARD.show(ui, map, tokens, &mut content);
        if is_closed {
            context.commands.push(RoadCommand::Toggle.into());
        }
        rect
    }

    fn content(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let roads = &context.mission.roads;
        let selected = self
            .selected
            .and_then(|index| Some((index, roads.get(index)?)));
        let hint = match (&self.drawing, selected) {
            (Some(drawing), _) if drawing.is_awaited() => "Looking for the road in the picture.",
            (Some(_), _) if self.legs == LegKind::Followed => tokens.advice(
                "Click along the road: the line follows it. Shift and a click goes straight. Enter, Escape or a double click ends it, Backspace takes a leg back.",
                "Tap along the road: the line follows it. A double tap ends it.",
            ),
            (Some(_), _) => {
                tokens.advice(
                    "Click along the middle of the road. Enter, Escape or a double click ends it, Backspace takes a point back.",
                    "Tap along the middle of the road. A double tap ends it.",
                )
            }
            (None, Some(_)) if self.is_joining => "Click the road to join it with.",
            (None, Some(_)) => "Drag its points, or the middle of a piece to add one.",
            (None, None) if roads.is_empty() => {
                "The mission has no roads. The camera recognises roads that it knows: draw one, or open a file \
                 of OpenStreetMap (.osm)."
            }
            (None, None) => "Click a road to change it.",
        };
        match selected {
            Some((_, road)) if self.drawing.is_none() => Self::fields(ui, road, context),
            _ => counts(ui, context),
        }
        ui.add(Label::new(muted(tokens, hint)).wrap());
        let label = if self.drawing.is_some() {
            "End the road"
        } else {
            "Draw a road"
        };
        if text_button(ui, tokens, None, label, false).clicked() {
            context.commands.push(RoadCommand::Draw.into());
        }
        let mut follows = self.legs == LegKind::Followed;
        if ui.checkbox(&mut follows, FOLLOW).changed() {
            context.commands.push(RoadCommand::ToggleFollowing.into());
        }
        let is_long = self.drawing.as_ref().and_then(RoadDrawing::progress);
        if is_long.is_some() && at_work(ui, tokens, FOLLOWING) {
            context.commands.push(Command::CancelJob);
        }
    }

    /// Draws the fields of the selected road, and what can be done with it.
    fn fields(ui: &mut Ui, road: &RoadLine, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let mut said = Vec::new();
        let mut name = road.name.clone();
        let field = TextEdit::singleline(&mut name)
            .align(egui::Align2::LEFT_CENTER)
            .hint_text("Name");
        let field = ui.add(field.desired_width(CARD.width - 8.0));
        let field = field.accessible_name("Name of the road");
        if field.lost_focus() {
            context.say_first(change(RoadChange::Name(name.trim().to_owned()), true));
        } else if field.changed() {
            said.push(change(RoadChange::Name(name), false));
        }
        ui.horizontal(|ui| {
            let combo = ComboBox::from_id_salt("class").width(112.0);
            let combo = combo.selected_text(road.class.key());
            let shown = combo.show_ui(ui, |ui| {
                for (class, key, _) in RoadClass::ALL.iter().rev() {
                    if ui.selectable_label(road.class == *class, *key).clicked() {
                        said.push(change(RoadChange::Class(*class), true));
                    }
                }
            });
            shown.response.accessible_name("Class of the road");
            let (factor, unit) = context.units.length();
            let mut width = road.width;
            let field = NumberField::new(WIDTHS).unit((factor, unit));
            let field = field.suffix(format!(" {unit} wide"));
            let field = field.speed(0.1).decimals(1).show(ui, &mut width);
            let field = field.accessible_name("Width of the road");
            if field.changed() || field.drag_stopped() {
                let width = RoadChange::Width(width);
                said.push(change(width, !field.dragged()));
            }
        });
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
            for (label, command) in [
                ("Split", RoadCommand::Split),
                ("Join", RoadCommand::Join),
                ("Delete", RoadCommand::Delete),
            ] {
                if text_button(ui, tokens, None, label, false).clicked() {
                    said.push(command);
                }
            }
        });
        context.commands.extend(said.into_iter().map(Into::into));
    }
}

/// Draws how many roads there are of each class.
fn counts(ui: &mut Ui, context: &ViewContext<'_>) {
    for (class, key, _) in RoadClass::ALL.iter().rev() {
        let of_class = context.mission.roads.iter();
        let count = of_class.filter(|road| road.class == *class).count();
        if count > 0 {
            ui.label(RichText::new(format!("{count} {key}")).color(context.tokens.text));
        }
    }
}
