//! The selected road, or how many there are of each class, on a card over the map.

use egui::{ComboBox, DragValue, Frame, Label, Rect, RichText, Stroke, TextEdit, Ui, UiBuilder};
use egui::{Sense, pos2, vec2};
use pilotage_core::roads::{RoadClass, RoadLine};

use super::Roads;
use super::command::{RoadChange, RoadCommand};
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{BELOW_HUD, icon_button, muted, text_button};

/// Width of what is on the card, points.
const WIDTH: f32 = 224.0;
/// Widths of roads that can be set, metres.
const WIDTHS: (f64, f64) = (0.5, 60.0);

fn change(change: RoadChange, finished: bool) -> RoadCommand {
    RoadCommand::Change { change, finished }
}

impl Roads {
    /// Draws the card beside the map's controls; the part of the map that it covers.
    pub(super) fn card(&self, ui: &mut Ui, map: Rect, context: &mut ViewContext<'_>) -> Rect {
        let tokens = context.tokens;
        let left = (map.right() - 84.0 - WIDTH).max(map.left() + 8.0);
        let corner = pos2(left, map.top() + BELOW_HUD);
        let room = Rect::from_min_max(corner, map.max.max(corner + vec2(WIDTH, 160.0)));
        // Clicks between the fields are none on the map.
        let builder = UiBuilder::new()
            .max_rect(room)
            .sense(Sense::click_and_drag());
        let mut ui = ui.new_child(builder.id_salt("roads"));
        let frame = Frame::new()
            .fill(tokens.over_map())
            .stroke(Stroke::new(1.0, tokens.line))
            .corner_radius(tokens.radius)
            .inner_margin(8);
        let card = frame.show(&mut ui, |ui| {
            ui.set_width(WIDTH);
            self.content(ui, context);
        });
        card.response.rect
    }

    fn content(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        ui.horizontal(|ui| {
            let title = RichText::new("Roads").color(tokens.text);
            ui.label(title.font(tokens.heading()));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if icon_button(ui, tokens, Icon::Close, "Stop editing roads").clicked() {
                    context.commands.push(RoadCommand::Toggle.into());
                }
            });
        });
        let roads = &context.mission.roads;
        let selected = self
            .selected
            .and_then(|index| Some((index, roads.get(index)?)));
        let hint = match (&self.drawing, selected) {
            (Some(_), _) => {
                "Click along the middle of the road. Enter or a double click ends it, Backspace takes a point back."
            }
            (None, Some(_)) if self.is_joining => "Click the road to join it with.",
            (None, Some(_)) => "Drag its points, or the middle of a piece to add one.",
            (None, None) if roads.is_empty() => "The mission has no roads.",
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
    }

    /// Draws the fields of the selected road, and what can be done with it.
    fn fields(ui: &mut Ui, road: &RoadLine, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let mut said = Vec::new();
        let mut name = road.name.clone();
        let field = TextEdit::singleline(&mut name).hint_text("Name");
        let field = ui.add(field.desired_width(WIDTH - 8.0));
        let field = field.accessible_name("Name of the road");
        if field.changed() {
            said.push(change(RoadChange::Name(name.clone()), false));
        }
        if field.lost_focus() {
            said.push(change(RoadChange::Name(name.trim().to_owned()), true));
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
            let mut value = road.width * factor;
            let field = DragValue::new(&mut value)
                .range(WIDTHS.0 * factor..=WIDTHS.1 * factor)
                .speed(0.1)
                .fixed_decimals(1)
                .suffix(format!(" {unit}"));
            let field = ui.add(field).accessible_name("Width of the road");
            if field.changed() || field.drag_stopped() {
                let width = RoadChange::Width(value / factor);
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
