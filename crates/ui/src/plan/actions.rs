//! Actions at way-points and at the ends of a route: in words, and chosen.

use egui::{ComboBox, Ui};
use pilotage_core::frames::{Altitude, AltitudeFrame};
use pilotage_core::mission::{Route, WayPoint, WayPointAction};

use super::PlanCommand;
use super::legs::time_text;
use crate::context::ViewContext;
use crate::shell::NumberField;

/// Radius of circles where nobody chose another, metres.
const RADIUS: f64 = 80.0;
/// Time of waiting where nobody chose another, seconds.
const SECONDS: f64 = 30.0;

/// Action at a way-point in words, where it is more than flying by.
pub fn action_words(action: &WayPointAction) -> Option<String> {
    match action {
        WayPointAction::FlyBy => None,
        WayPointAction::Loiter { turns, .. } => Some(circles_words(*turns)),
        WayPointAction::Wait {
            seconds: Some(seconds),
            ..
        } => Some(format!("waits {}", wait_words(*seconds))),
        WayPointAction::Wait { seconds: None, .. } => Some("waits without an end".to_owned()),
        WayPointAction::TakeOff => Some("take-off".to_owned()),
        WayPointAction::Land => Some("landing".to_owned()),
    }
}

/// Number of circles in words.
fn circles_words(turns: f64) -> String {
    let number = (turns * 10.0).round() / 10.0;
    let unit = if number == 1.0 { "circle" } else { "circles" };
    format!("{number} {unit}")
}

/// Time of waiting: seconds, or minutes and seconds.
fn wait_words(seconds: f64) -> String {
    if seconds < 120.0 {
        format!("{seconds:.0} s")
    } else {
        format!("{} min", time_text(Some(seconds)))
    }
}

/// Action as it is offered and chosen.
fn choice_words(action: &WayPointAction) -> String {
    match action {
        WayPointAction::FlyBy => "Fly past".to_owned(),
        WayPointAction::Loiter { turns, .. } => {
            let number = (turns * 10.0).round() / 10.0;
            let unit = if number == 1.0 { "time" } else { "times" };
            format!("Circle {number} {unit}")
        }
        WayPointAction::Wait {
            seconds: Some(seconds),
            ..
        } => format!("Wait {}", wait_words(*seconds)),
        WayPointAction::Wait { seconds: None, .. } => "Wait".to_owned(),
        WayPointAction::TakeOff => "Take off here".to_owned(),
        WayPointAction::Land => "Land here".to_owned(),
    }
}

fn is_same_kind(a: &WayPointAction, b: &WayPointAction) -> bool {
    std::mem::discriminant(a) == std::mem::discriminant(b)
}

/// Draws the choice of the action at the way-point; returns the command that changes it.
pub fn action(
    ui: &mut Ui,
    now: WayPointAction,
    index: usize,
    route: &Route,
    context: &ViewContext<'_>,
) -> Option<PlanCommand> {
    let loiter = WayPointAction::Loiter {
        radius: RADIUS,
        turns: 1.0,
    };
    let wait = WayPointAction::Wait {
        radius: RADIUS,
        seconds: Some(SECONDS),
    };
    let mut choices = vec![
        ("Fly past", WayPointAction::FlyBy),
        ("Circle", loiter),
        ("Wait", wait),
    ];
    if index == 0 {
        choices.push(("Take off here", WayPointAction::TakeOff));
    }
    if index + 1 == route.way_points.len() && index > 0 {
        choices.push(("Land here", WayPointAction::Land));
    }
    let mut next = (now, true);
    let combo = ComboBox::from_id_salt("action").width(116.0);
    let combo = combo.selected_text(choice_words(&now)).show_ui(ui, |ui| {
        for (label, choice) in &choices {
            let same = is_same_kind(choice, &now);
            if ui.selectable_label(same, *label).clicked() && !same {
                next = (*choice, true);
            }
        }
    });
    combo
        .response
        .accessible_name("What is done at the way-point");
    match now {
        WayPointAction::Loiter { radius, turns } => {
            let mut count = turns;
            let circles = NumberField::new(0.5..=99.0).suffix(" ×");
            let circles = circles.speed(0.1).decimals(2).show(ui, &mut count);
            let circles = circles.accessible_name("Number of circles");
            let (changed, is_over) = radius_field(ui, radius, context);
            if circles.changed() || changed.is_some() {
                let action = WayPointAction::Loiter {
                    radius: changed.unwrap_or(radius),
                    turns: count,
                };
                next = (action, is_over && !circles.dragged());
            }
        }
        WayPointAction::Wait { radius, seconds } => {
            let mut time = seconds.unwrap_or(0.0);
            let field = NumberField::new(0.0..=36000.0).words(|time| match time {
                0.0 => "no end".to_owned(),
                time => format!("{time:.0} s"),
            });
            let field = field.show(ui, &mut time);
            let field = field.accessible_name("Seconds of waiting");
            let (changed, is_over) = radius_field(ui, radius, context);
            if field.changed() || changed.is_some() {
                let action = WayPointAction::Wait {
                    radius: changed.unwrap_or(radius),
                    seconds: (time > 0.0).then_some(time),
                };
                next = (action, is_over && !field.dragged());
            }
        }
        _ => {}
    }
    let (action, finished) = next;
    (action != now).then_some(PlanCommand::SetAction {
        index,
        action,
        finished,
    })
}

/// Draws the radius and the side of circles; returns the radius if it is changed, and whether no drag goes on.
fn radius_field(ui: &mut Ui, radius: f64, context: &ViewContext<'_>) -> (Option<f64>, bool) {
    let mut size = radius.abs();
    let field = NumberField::new(0.0..=5000.0).unit(context.units.length());
    let field = field.show(ui, &mut size);
    let field = field.accessible_name("Radius of the circles");
    let left = radius < 0.0;
    let turned = ui.selectable_label(left, "left").clicked();
    let radius = size * if left == turned { 1.0 } else { -1.0 };
    (
        (field.changed() || turned).then_some(radius),
        !field.dragged(),
    )
}

/// Draws what the route does at its ends.
pub fn ends(ui: &mut Ui, route: &Route, context: &mut ViewContext<'_>) {
    let first = route.way_points.first();
    let takes_off = first.is_some_and(|it| it.action == WayPointAction::TakeOff);
    let lands = route.lands();
    for (label, on, enabled, command) in [
        (
            "Take off at the start",
            takes_off,
            true,
            PlanCommand::ToggleTakeOff,
        ),
        (
            "Return to the start at the end",
            route.returns && !lands,
            !lands,
            PlanCommand::ToggleReturn,
        ),
        (
            "Land at the last way-point",
            lands,
            route.way_points.len() > 1,
            PlanCommand::ToggleLanding,
        ),
    ] {
        let mut checked = on;
        let field = egui::Checkbox::new(&mut checked, label);
        if ui.add_enabled(enabled, field).changed() {
            context.commands.push(command.of(route.id).into());
        }
    }
}

/// Gives a way-point an action. Whoever lands comes down to the ground, and who no longer lands stays as high as before.
pub fn act(route: &mut Route, index: usize, action: WayPointAction) {
    let before = index.checked_sub(1).map(|i| route.way_points[i].altitude);
    let Some(way_point) = route.way_points.get_mut(index) else {
        return;
    };
    let landed = way_point.action == WayPointAction::Land;
    way_point.action = action;
    match (landed, action == WayPointAction::Land) {
        (false, true) => way_point.altitude = Altitude::new(0.0, AltitudeFrame::AboveGround),
        (true, false) => way_point.altitude = before.unwrap_or(way_point.altitude),
        _ => {}
    }
}

/// Does to a route what is chosen for its ends; a landing takes the return's place. False if the command is about
/// something else.
pub fn change_ends(route: &mut Route, command: &PlanCommand) -> bool {
    let last = route.way_points.len().saturating_sub(1);
    let (index, action) = match command {
        PlanCommand::ToggleReturn => {
            route.returns = !route.returns;
            return true;
        }
        PlanCommand::ToggleTakeOff => (0, WayPointAction::TakeOff),
        PlanCommand::ToggleLanding => {
            route.returns = false;
            (last, WayPointAction::Land)
        }
        _ => return false,
    };
    let own = route.way_points.get(index).map(|it| it.action);
    let is_on = own == Some(action);
    act(
        route,
        index,
        if is_on { WayPointAction::FlyBy } else { action },
    );
    true
}

/// Leads a route on to another way-point. A landing moves on to it.
pub fn lead_on(route: &mut Route, to: WayPoint) {
    let lands = route.lands();
    if lands {
        act(route, route.way_points.len() - 1, WayPointAction::FlyBy);
    }
    let altitude = route
        .way_points
        .last()
        .filter(|_| lands)
        .map(|it| it.altitude);
    let altitude = altitude.unwrap_or(to.altitude);
    route.way_points.push(WayPoint { altitude, ..to });
    if lands {
        act(route, route.way_points.len() - 1, WayPointAction::Land);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::mission::USUAL_ALTITUDE;

    #[test]
    fn a_route_lands_at_its_end_or_returns_and_never_both() {
        let at = |north| WayPoint::new(GroundPoint::new(north, 0.0), USUAL_ALTITUDE);
        let mut route = Route {
            way_points: vec![at(0.0), at(500.0)],
            ..Route::default()
        };
        change_ends(&mut route, &PlanCommand::ToggleReturn);
        assert!(route.returns);
        change_ends(&mut route, &PlanCommand::ToggleLanding);
        assert!(!route.returns);
        assert_eq!(route.way_points[1].action, WayPointAction::Land);
        // An autopilot takes the altitude of a landing for that of the ground there.
        let ground = Altitude::new(0.0, AltitudeFrame::AboveGround);
        assert_eq!(route.way_points[1].altitude, ground);
        lead_on(&mut route, at(900.0));
        let altitudes: Vec<_> = route.way_points.iter().map(|w| w.altitude).collect();
        assert_eq!(altitudes, [USUAL_ALTITUDE, USUAL_ALTITUDE, ground]);
        assert!(route.lands() && route.way_points[1].action == WayPointAction::FlyBy);
        route.way_points.remove(1);
        change_ends(&mut route, &PlanCommand::ToggleLanding);
        assert_eq!(route.way_points[1].altitude, USUAL_ALTITUDE);
        change_ends(&mut route, &PlanCommand::ToggleTakeOff);
        let actions = route.way_points.iter().map(|w| w.action);
        let wanted = [WayPointAction::TakeOff, WayPointAction::FlyBy];
        assert_eq!(actions.collect::<Vec<_>>(), wanted);
    }

    #[test]
    fn numbers_of_circles_and_times_are_words() {
        let loiter = |turns| WayPointAction::Loiter {
            radius: 80.0,
            turns,
        };
        assert_eq!(choice_words(&loiter(3.0)), "Circle 3 times");
        assert_eq!(action_words(&loiter(1.0)).as_deref(), Some("1 circle"));
        let wait = |seconds| WayPointAction::Wait {
            radius: 0.0,
            seconds: Some(seconds),
        };
        assert_eq!(choice_words(&wait(30.0)), "Wait 30 s");
        assert_eq!(
            action_words(&wait(150.0)).as_deref(),
            Some("waits 2:30 min")
        );
    }
}
