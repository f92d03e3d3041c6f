//! The table of way-points and legs, with a keyboard path for everything the map does.

use egui::{
    Align2, ComboBox, EventFilter, Key, Modifiers, Painter, Rect, Role, Sense, Ui, UiBuilder,
    WidgetInfo, pos2, vec2,
};
use pilotage_core::frames::{Altitude, AltitudeFrame, AltitudeReference, GroundPoint};
use pilotage_core::mission::{Route, WayPointAction};

use super::PlanCommand;
use super::actions::{action, action_words};
use super::legs::{Leg, time_text};
use super::planner::Planner;
use super::pointer::middle;
use super::relief::Relief;
use super::symbols::paint_home;
use super::words::distance_text;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{NumberField, icon_button, icons::Icon, muted, paint_focus_ring, paint_row};
use crate::tokens::Tokens;
use crate::units::Units;
use pilotage_core::plan::cruise;

const ROW: f32 = 38.0;
/// Left edge of the words in a row.
const LEFT: f32 = 38.0;

/// Figures of the legs in the table.
pub struct Sums<'a> {
    /// The ground that it lies over.
    pub relief: Relief<'a>,
    /// The legs.
    pub legs: &'a [Leg],
    /// Energy left at each way-point, watt hours, where it is stated.
    pub left: Option<Vec<f64>>,
    /// Legs too short for their turns, by the way-point that they lead to.
    pub tight: Vec<usize>,
}

/// Draws the table, and below it what can be set of the selected way-point.
pub fn way_points(
    ui: &mut Ui,
    planner: &Planner,
    route: &Route,
    sums: &Sums<'_>,
    context: &mut ViewContext<'_>,
) {
    ui.spacing_mut().item_spacing.y = 0.0;
    for index in 0..route.way_points.len() {
        row(ui, planner, route, index, sums, context);
        if planner.way_point == Some(index) {
            // An id of its own: what stands above may change while a value is dragged.
            let id = egui::Id::unique("selected way-point");
            ui.scope_builder(UiBuilder::new().scope_id(id), |ui| {
                ui.spacing_mut().item_spacing.y = 4.0;
                selected(ui, route, index, &sums.relief, context);
            });
        }
    }
    if let Some(leg) = sums.legs.get(route.way_points.len().saturating_sub(1)) {
        way_back_row(ui, leg, context);
    }
    ui.spacing_mut().item_spacing.y = 4.0;
    if planner.way_point.is_none() {
        let words = context.tokens.advice(
            "Choose a way-point to set its altitude and speed. Arrows move it, Shift with arrows \
             by ten metres, Insert adds one, Delete deletes it.",
            "Choose a way-point to set its altitude and speed. Drag it on the map to move it.",
        );
        ui.add_space(4.0);
        ui.label(muted(context.tokens, words));
    }
}

/// An altitude with its unit and what it counts from.
pub fn altitude_words(altitude: &Altitude, units: Units) -> String {
    let (factor, unit) = units.length();
    let value = altitude.metres * factor;
    format!("{value:.0} {unit} {}", altitude.frame.name())
}

fn row(
    ui: &mut Ui,
    planner: &Planner,
    route: &Route,
    index: usize,
    sums: &Sums<'_>,
    context: &mut ViewContext<'_>,
) {
    let tokens = context.tokens;
    let leg = index.checked_sub(1).and_then(|i| sums.legs.get(i));
    let tight = sums.tight.contains(&index);
    let way_point = &route.way_points[index];
    let chosen = planner.way_point == Some(index);
    let size = vec2(ui.available_width(), ROW);
    let (_, rect) = ui.allocate_space(size);
    let id = egui::Id::unique(("way-point", index));
    let response = ui.interact(rect, id, Sense::click());
    let leg_words = leg.map(|leg| leg_words(leg, context.units));
    let mut altitude = altitude_words(&way_point.altitude, context.units);
    if let Some(words) = action_words(&way_point.action) {
        altitude = format!("{words}, {altitude}");
    }
    if tight {
        altitude.push_str(", too short for its turns");
    }
    let energy = energy_words(sums, index);
    response.widget_info(|| {
        let leg = leg_words.as_ref().map_or_else(
            || "start".to_owned(),
            |[course, distance, time]| format!("course {course}, {distance}, {time}"),
        );
        let end = energy.as_ref().map_or(String::new(), |e| format!(", {e}"));
        let name = format!("Way-point {}: {leg}, {altitude}{end}", index + 1);
        WidgetInfo::selected(Role::Button, true, chosen, name)
    });
    let painter = ui.painter();
    paint_row(painter, rect, tokens, chosen, response.hovered());
    let (upper, lower) = (rect.top() + 12.0, rect.top() + 27.0);
    let number = pos2(rect.left() + 16.0, rect.center().y);
    painter.circle_stroke(number, 10.0, egui::Stroke::new(1.5, tokens.accent));
    let text = (index + 1).to_string();
    painter.text(
        number,
        Align2::CENTER_CENTER,
        text,
        tokens.small(),
        tokens.text,
    );
    let left = rect.left() + LEFT;
    if let Some(words) = leg_words {
        paint_columns(painter, rect, upper, words, tokens);
    } else {
        let at = pos2(left, upper);
        painter.text(
            at,
            Align2::LEFT_CENTER,
            "Start",
            tokens.normal(),
            tokens.text,
        );
    }
    let at = pos2(left, lower);
    painter.text(
        at,
        Align2::LEFT_CENTER,
        altitude,
        tokens.small(),
        if tight { tokens.warning } else { tokens.muted },
    );
    if leg.is_some() {
        let (factor, unit) = context.units.speed();
        let speed = way_point.speed.unwrap_or_else(cruise) * factor;
        let kind = if way_point.speed.is_some() {
            ""
        } else {
            "cruise "
        };
        let end = energy.map_or(String::new(), |e| format!(" · {e}"));
        let text = format!("{kind}{speed:.1} {unit}{end}");
        let at = pos2(rect.right() - 10.0, lower);
        painter.text(at, Align2::RIGHT_CENTER, text, tokens.small(), tokens.muted);
    }
    if response.clicked() {
        let which = (!chosen).then_some(index);
        let command = PlanCommand::SelectWayPoint(which).of(route.id);
        context.commands.push(Command::from(command));
    }
    if response.has_focus() {
        paint_focus_ring(painter, rect, tokens);
        keyboard(ui, response.id, route, index, context);
    }
}

/// Course, distance and time of a leg.
fn leg_words(leg: &Leg, units: Units) -> [String; 3] {
    let distance = distance_text(leg.distance, units);
    [course_words(leg.course), distance, time_text(leg.time)]
}

/// A course over the ground in whole degrees.
pub fn course_words(course: Option<f64>) -> String {
    course.map_or("–".to_owned(), |c| {
        format!("{:03.0}°", c.to_degrees().round().rem_euclid(360.0))
    })
}

/// Writes the figures of a leg into the columns of a row.
fn paint_columns(painter: &Painter, rect: Rect, y: f32, words: [String; 3], tokens: &Tokens) {
    let columns = [
        (rect.left() + LEFT, Align2::LEFT_CENTER),
        (rect.center().x + 36.0, Align2::RIGHT_CENTER),
        (rect.right() - 10.0, Align2::RIGHT_CENTER),
    ];
    for ((x, align), text) in columns.into_iter().zip(words) {
        painter.text(pos2(x, y), align, text, tokens.normal(), tokens.text);
    }
}

/// Draws the leg back to home.
fn way_back_row(ui: &mut Ui, leg: &Leg, context: &ViewContext<'_>) {
    let tokens = context.tokens;
    let size = vec2(ui.available_width(), ROW);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let words = leg_words(leg, context.units);
    response.widget_info(|| {
        let [course, distance, time] = &words;
        let name = format!("Return: course {course}, {distance}, {time}");
        WidgetInfo::labeled(Role::Label, true, name)
    });
    let painter = ui.painter();
    let home = pos2(rect.left() + 16.0, rect.center().y);
    paint_home(painter, home, tokens.surface, tokens);
    paint_columns(painter, rect, rect.top() + 12.0, words, tokens);
    let at = pos2(rect.left() + LEFT, rect.top() + 27.0);
    let (align, font) = (Align2::LEFT_CENTER, tokens.small());
    painter.text(at, align, "return to the start", font, tokens.muted);
}

/// Energy that is left on board behind the leg to a way-point, in words, where it is stated.
fn energy_words(sums: &Sums<'_>, index: usize) -> Option<String> {
    let left = sums.left.as_ref()?.get(index).filter(|_| index > 0)?;
    Some(format!("{left:.0} Wh left"))
}

/// Arrows move the way-point by a metre, with Shift by ten; Insert adds one behind it.
fn keyboard(ui: &Ui, widget: egui::Id, route: &Route, index: usize, context: &mut ViewContext<'_>) {
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..Default::default()
    };
    ui.memory_mut(|m| m.set_focus_lock_filter(widget, filter));
    let (north, east, insert, delete) = ui.input_mut(|i| {
        let along = |minus: Key, plus: Key| {
            f64::from(u32::try_from(i.num_presses(plus)).unwrap_or(0))
                - f64::from(u32::try_from(i.num_presses(minus)).unwrap_or(0))
        };
        let scale = if i.modifiers.shift { 10.0 } else { 1.0 };
        (
            scale * along(Key::ArrowDown, Key::ArrowUp),
            scale * along(Key::ArrowLeft, Key::ArrowRight),
            i.key_pressed(Key::Insert),
            // The map would delete what is selected by the same press.
            i.consume_key(Modifiers::NONE, Key::Delete),
        )
    });
    let mut say = |command: PlanCommand| context.commands.push(command.of(route.id).into());
    let at = route.way_points[index].position;
    if north != 0.0 || east != 0.0 {
        say(PlanCommand::MoveWayPoint {
            index,
            to: GroundPoint::new(at.north + north, at.east + east),
            finished: true,
        });
    }
    if insert {
        say(insertion(route, index));
    }
    if delete {
        say(PlanCommand::DeleteWayPoint(Some(index)));
    }
}

/// A way-point behind another: in the middle of the leg, or beyond the end.
fn insertion(route: &Route, index: usize) -> PlanCommand {
    let here = route.way_points[index].position;
    let at = match route.way_points.get(index + 1) {
        Some(next) => middle(here, next.position),
        None => match index.checked_sub(1).and_then(|i| route.way_points.get(i)) {
            Some(before) => {
                let back = before.position;
                GroundPoint::new(2.0 * here.north - back.north, 2.0 * here.east - back.east)
            }
            None => GroundPoint::new(here.north + 100.0, here.east),
        },
    };
    PlanCommand::InsertWayPoint {
        behind: index,
        at,
        finished: true,
    }
}

/// Altitude with its frame, speed, and what can be done with the way-point.
fn selected(
    ui: &mut Ui,
    route: &Route,
    index: usize,
    relief: &Relief<'_>,
    context: &mut ViewContext<'_>,
) {
    let tokens = context.tokens;
    let way_point = &route.way_points[index];
    let mut say: Vec<PlanCommand> = Vec::new();
    ui.horizontal(|ui| {
        ui.add_space(34.0);
        let reference = relief.reference(route, &way_point.position);
        say.extend(altitude(ui, way_point.altitude, index, &reference, context));
        if index > 0 {
            say.extend(speed(ui, way_point.speed, index, context));
        }
    });
    if !relief.is_level() || way_point.altitude.frame != AltitudeFrame::AboveGround {
        let (factor, unit) = context.units.length();
        let ground = relief.at(&way_point.position);
        let above = relief.above(route, way_point);
        ui.horizontal(|ui| {
            ui.add_space(34.0);
            let words = format!(
                "{:.0} {unit} above ground at {:.0} {unit} {}",
                above * factor,
                ground * factor,
                relief.frame()
            );
            let color = if above > 0.0 {
                tokens.muted
            } else {
                tokens.warning
            };
            ui.label(egui::RichText::new(words).color(color));
        });
    }
    ui.horizontal(|ui| {
        ui.add_space(34.0);
        say.extend(action(ui, way_point.action, index, route, context));
    });
    ui.horizontal(|ui| {
        ui.add_space(34.0);
        ui.spacing_mut().item_spacing.x = 0.0;
        let all_same = route
            .way_points
            .iter()
            .filter(|w| w.action != WayPointAction::Land)
            .all(|w| w.altitude == way_point.altitude);
        ui.add_enabled_ui(!all_same, |ui| {
            let label = "This altitude for all way-points";
            if icon_button(ui, tokens, Icon::Layers, label).clicked() {
                say.push(PlanCommand::SetAltitude {
                    index: None,
                    altitude: way_point.altitude,
                    finished: true,
                });
            }
        });
        if icon_button(ui, tokens, Icon::Plus, "Insert a way-point behind it").clicked() {
            say.push(insertion(route, index));
        }
        let inner = index > 0 && index + 1 < route.way_points.len();
        ui.add_enabled_ui(inner, |ui| {
            if icon_button(ui, tokens, Icon::Split, "Split the route here").clicked() {
                say.push(PlanCommand::Split);
            }
        });
        if icon_button(ui, tokens, Icon::Trash, "Delete the way-point").clicked() {
            say.push(PlanCommand::DeleteWayPoint(Some(index)));
        }
        let (factor, unit) = context.units.length();
        let p = way_point.position;
        let place = format!(
            "{:.0} north, {:.0} {unit} east",
            p.north * factor,
            p.east * factor
        );
        ui.add_space(6.0);
        ui.label(muted(tokens, place));
    });
    ui.add_space(4.0);
    let said = say.into_iter().map(|it| it.of(route.id).into());
    context.commands.extend(said);
}

fn altitude(
    ui: &mut Ui,
    now: Altitude,
    index: usize,
    reference: &AltitudeReference,
    context: &ViewContext<'_>,
) -> Option<PlanCommand> {
    let mut metres = now.metres;
    let field = NumberField::new(f64::MIN..=f64::MAX).unit(context.units.length());
    let field = field.show(ui, &mut metres);
    let field = field.accessible_name("Altitude of the way-point");
    let mut altitude = None;
    if field.changed() {
        altitude = Some(Altitude::new(metres, now.frame));
    }
    let combo = ComboBox::from_id_salt("frame").width(104.0);
    let combo = combo.selected_text(now.frame.name()).show_ui(ui, |ui| {
        for frame in AltitudeFrame::ALL {
            if ui
                .selectable_label(frame == now.frame, frame.name())
                .clicked()
            {
                altitude = Some(now.counted_from(frame, reference));
            }
        }
    });
    combo
        .response
        .accessible_name("What the altitude counts from");
    altitude.map(|altitude| PlanCommand::SetAltitude {
        index: Some(index),
        altitude,
        finished: !field.dragged(),
    })
}

fn speed(
    ui: &mut Ui,
    now: Option<f64>,
    index: usize,
    context: &ViewContext<'_>,
) -> Option<PlanCommand> {
    let mut value = now.unwrap_or_else(cruise);
    let field = NumberField::new(5.0..=100.0).unit(context.units.speed());
    let field = field.speed(0.1).decimals(1).show(ui, &mut value);
    let field = field.accessible_name("Airspeed on the leg to it");
    let finished = !field.dragged();
    if field.changed() {
        return Some(PlanCommand::SetSpeed {
            index,
            speed: Some(value),
            finished,
        });
    }
    let back =
        now.is_some() && icon_button(ui, context.tokens, Icon::Undo, "Cruise speed").clicked();
    back.then_some(PlanCommand::SetSpeed {
        index,
        speed: None,
        finished: true,
    })
}
