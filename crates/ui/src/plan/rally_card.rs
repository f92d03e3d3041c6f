//! Rally points in the column: names, altitudes, a button for another one.

use egui::Ui;
use pilotage_core::frames::Altitude;

use super::PlanCommand;
use super::button::button;
use super::command::RallyChange;
use super::name_field::name_field;
use super::planner::Planner;
use super::purpose::Purpose;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{NumberField, caption, icon_button, icons::Icon, muted};

/// Draws the card.
pub fn rally_card(ui: &mut Ui, planner: &mut Planner, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    caption(ui, tokens, "Rally points");
    let mission = context.mission;
    for (index, point) in mission.rally.iter().enumerate() {
        ui.horizontal(|ui| {
            name(ui, planner, index, context);
            let label = format!("Delete {}", point.name);
            if icon_button(ui, tokens, Icon::Trash, &label).clicked() {
                let command = PlanCommand::DeleteRally(index);
                context.commands.push(Command::from(command));
            }
            altitude(ui, index, context);
        });
    }
    if mission.rally.is_empty() {
        let words = "Places where the aircraft may land when it cannot go on.";
        ui.label(muted(tokens, words));
    } else {
        ui.label(muted(tokens, "Drag one on the map to move it."));
    }
    let is_marking = planner
        .marking
        .as_ref()
        .is_some_and(|m| m.purpose == Purpose::Rally);
    let label = if is_marking {
        "Stop marking"
    } else {
        "Mark a rally point"
    };
    let mark = PlanCommand::Mark(Purpose::Rally);
    button(ui, context, Some(Icon::Plus), label, false, mark);
}

/// Draws the name of a rally point in a field of its own.
fn name(ui: &mut Ui, planner: &mut Planner, index: usize, context: &mut ViewContext<'_>) {
    let point = &context.mission.rally[index];
    let width = 0.4 * ui.available_width();
    let typed = name_field(ui, &mut planner.rally_draft, (index, &point.name), width);
    if let Some(name) = typed {
        context.say_first(PlanCommand::EditRally {
            index,
            change: RallyChange::Name(name),
            finished: true,
        });
    }
}

/// Draws the altitude of a rally point.
fn altitude(ui: &mut Ui, index: usize, context: &mut ViewContext<'_>) {
    let point = &context.mission.rally[index];
    let mut metres = point.altitude.metres;
    let field = NumberField::new(f64::MIN..=f64::MAX).unit(context.units.length());
    let field = field.show(ui, &mut metres);
    let field = field.accessible_name(format!("Altitude of {}", point.name));
    ui.label(muted(context.tokens, point.altitude.frame.name()));
    if field.changed() {
        let altitude = Altitude::new(metres, point.altitude.frame);
        context.commands.push(Command::from(PlanCommand::EditRally {
            index,
            change: RallyChange::Altitude(altitude),
            finished: !field.dragged(),
        }));
    }
}
