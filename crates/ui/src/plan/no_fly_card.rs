//! The no-fly areas of the mission: named, drawn, cut and deleted.

use egui::Ui;

use super::PlanCommand;
use super::button::button;
use super::command::AreaChange;
use super::name_field::name_field;
use super::planner::Planner;
use super::purpose::{FEWEST, Purpose};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{caption, icon_button, icons::Icon, muted};

/// Draws the list of the areas, and what draws more.
pub fn no_fly_card(ui: &mut Ui, planner: &mut Planner, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    caption(ui, tokens, "No-fly areas");
    let mission = context.mission;
    for (index, area) in mission.no_fly.iter().enumerate() {
        ui.horizontal(|ui| {
            area_name(ui, planner, index, context);
            let delete = PlanCommand::DeleteArea(index);
            deletes(ui, &format!("Delete {}", area.name), delete, context);
            ui.label(muted(tokens, corners_text(area.corners.len())));
        });
        for (number, hole) in area.holes.iter().enumerate() {
            ui.horizontal(|ui| {
                let corners = corners_text(hole.len());
                let words = format!("    Hole {}, {corners}: one may fly there", number + 1);
                ui.label(muted(tokens, words));
                let label = format!("Delete hole {} of {}", number + 1, area.name);
                let fill = PlanCommand::EditArea {
                    index,
                    change: AreaChange::FillHole(number),
                    finished: true,
                };
                deletes(ui, &label, fill, context);
            });
        }
    }
    if !mission.no_fly.is_empty() {
        ui.label(muted(tokens, "Drag a corner on the map to move it."));
    }
    ui.horizontal_wrapped(|ui| draw_buttons(ui, planner, context));
}

/// Buttons that begin an area or a hole, and end what is being drawn.
fn draw_buttons(ui: &mut Ui, planner: &Planner, context: &mut ViewContext<'_>) {
    let marking = planner.marking.as_ref();
    let is = |purpose| marking.is_some_and(|it| it.purpose == purpose);
    let stop = "Stop drawing";
    let area = if is(Purpose::NoFlyArea) {
        stop
    } else {
        "Draw an area"
    };
    let mark = PlanCommand::Mark(Purpose::NoFlyArea);
    button(ui, context, Some(Icon::Plus), area, false, mark);
    if !context.mission.no_fly.is_empty() {
        let hole = if is(Purpose::Hole) {
            stop
        } else {
            "Cut a hole"
        };
        let mark = PlanCommand::Mark(Purpose::Hole);
        button(ui, context, Some(Icon::Plus), hole, false, mark);
    }
    if let Some(drawn) =
        marking.filter(|it| it.purpose.is_about_no_fly() && it.corners.len() >= FEWEST)
    {
        let close = match drawn.purpose {
            Purpose::Hole => "Close the hole",
            _ => "Close the area",
        };
        button(ui, context, None, close, true, PlanCommand::FinishMarking);
    }
}

/// A button that deletes something.
fn deletes(ui: &mut Ui, label: &str, command: PlanCommand, context: &mut ViewContext<'_>) {
    if icon_button(ui, context.tokens, Icon::Trash, label).clicked() {
        context.commands.push(Command::from(command));
    }
}

fn corners_text(corners: usize) -> String {
    format!("{corners} corners")
}

/// The name of an area in a field of its own.
fn area_name(ui: &mut Ui, planner: &mut Planner, index: usize, context: &mut ViewContext<'_>) {
    let area = &context.mission.no_fly[index];
    let width = 0.6 * ui.available_width();
    let typed = name_field(ui, &mut planner.area_draft, (index, &area.name), width);
    if let Some(name) = typed {
        context.say_first(PlanCommand::EditArea {
            index,
            change: AreaChange::Name(name),
            finished: true,
        });
    }
}
